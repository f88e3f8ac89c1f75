// SPDX-License-Identifier: Apache-2.0
#include "measurement/synthetic_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "numerics/signals/fft.h"

namespace latsch {
namespace {

using numerics::Spectrum;
constexpr double kRamp = 4.0;           // s between plateaus
constexpr double kPulseSeconds = 2.0;   // s; long enough for the response to a hit to die out
constexpr double kBefore = 0.1;         // s; part of a pulse before the hit
constexpr double kCleatLength = 0.015;  // m
constexpr double kShortestHit = 1e-3;   // s
constexpr double kSpeedNoise = 0.02;    // m/s

/// Returns the speed at time t, which rises to the first plateau and then changes from plateau to
/// plateau.
double speed_at(const SyntheticRun& run, double t) {
  double from = 0.0;
  for (const double v : run.speeds) {
    const double first = v * (1.0 - run.drift / 2.0), last = v * (1.0 + run.drift / 2.0);
    if (t < kRamp) {
      // the acceleration is 0 at both ends
      const double s = 0.5 - 0.5 * std::cos(std::numbers::pi * t / kRamp);
      return from + s * (first - from);
    }
    t -= kRamp;
    if (t < run.hold) return first + (last - first) * t / run.hold;
    t -= run.hold;
    from = last;
  }
  return from;
}

double duration(const SyntheticRun& run) {
  return static_cast<double>(run.speeds.size()) * (kRamp + run.hold);
}

std::vector<double> speeds_of(const SyntheticRig& rig, const SyntheticRun& run) {
  std::vector<double> v(static_cast<std::size_t>(duration(run) * rig.rate));
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = speed_at(run, static_cast<double>(i) / rig.rate);
  return v;
}

/// Returns the response to one hit; `place` is the position of the hit in the window, in samples.
std::vector<double> pulse(
    const SyntheticRig& rig, const SyntheticRun& run, double speed, double place, int length) {
  const double tau = std::max(kShortestHit, kCleatLength / speed);
  const double strength = std::pow(speed / run.speeds.front(), run.growth);
  Spectrum P(length / 2 + 1, 0.0);
  for (int k = 0; 2 * k < length; ++k) {
    const double w = kTwoPi * k * rig.rate / length;
    std::complex<double> sum = 0.0;
    for (const SyntheticMode& m : run.modes) {
      const double wm = kTwoPi * m.frequency;
      sum += m.amplitude * wm / std::complex<double>(wm * wm - w * w, 2.0 * m.zeta * wm * w);
    }
    const double smooth = std::exp(-0.5 * w * tau * w * tau);
    P[k] = strength * rig.rate * smooth * sum * std::polar(1.0, -w * place / rig.rate);
    if (run.dummy_rim) P[k] *= rig.response.at(w);
  }
  return numerics::inverse_real_fft(P, length);
}

Channel time_channel(std::size_t samples, double rate) {
  Channel time{"time", "s", std::vector<double>(samples)};
  for (std::size_t i = 0; i < samples; ++i) time.values[i] = static_cast<double>(i) / rate;
  return time;
}

}  // namespace

std::vector<double> synthetic_hits(const SyntheticRig& rig, const SyntheticRun& run) {
  const std::vector<double> v = speeds_of(rig, run);
  double turned = RandomStream(rig.seed, 2 * run.number).uniform();
  std::vector<double> hits;
  for (std::size_t i = 0; i + 1 < v.size(); ++i) {
    const double more = 0.5 * (v[i] + v[i + 1]) / (rig.rate * rig.circumference);
    if (turned + more >= 1.0) {
      hits.push_back((static_cast<double>(i) + (1.0 - turned) / more) / rig.rate);
      turned -= 1.0;
    }
    turned += more;
  }
  return hits;
}

Channels synthetic_run(const SyntheticRig& rig, const SyntheticRun& run) {
  std::vector<double> speed = speeds_of(rig, run);
  const int samples = static_cast<int>(speed.size());
  const double rest = run.dummy_rim ? rig.response.at(0.0).real() : 1.0;
  std::vector<double> fluctuation(samples, 0.0);
  const int length = numerics::fast_length(static_cast<int>(kPulseSeconds * rig.rate));
  const int before = static_cast<int>(kBefore * rig.rate);
  for (const double hit : synthetic_hits(rig, run)) {
    const int at = static_cast<int>(hit * rig.rate);
    const double place = before + (hit * rig.rate - at);
    const auto p = pulse(rig, run, speed[at], place, length);
    for (int i = 0; i < length; ++i) {
      const int sample = at - before + i;
      if (sample >= 0 && sample < samples) fluctuation[sample] += p[i];
    }
  }
  RandomStream random(rig.seed, 2 * run.number + 1);
  Channel Fz{"Fz", "N", std::move(fluctuation)}, Fx{"Fx", "N", Fz.values};
  for (int i = 0; i < samples; ++i) {
    Fx.values[i] = 0.5 * Fx.values[i] + run.noise * random.normal();
    Fz.values[i] += rest * run.load + run.noise * random.normal();
    speed[i] += kSpeedNoise * random.normal();
  }
  Channels channels;
  channels.add(time_channel(samples, rig.rate));
  channels.add({"speed", "m/s", std::move(speed)});
  channels.add(std::move(Fz));
  channels.add(std::move(Fx));
  return channels;
}

Channels synthetic_hammer(const SyntheticRig& rig, int hits, double noise) {
  constexpr double kPause = 2.0, kFirst = 1.0;        // s
  constexpr double kContact = 1e-3, kForce = 2000.0;  // s, N
  constexpr double kUnevenness = 0.2;                 // relative scatter of the strength of hits
  constexpr std::uint64_t kStream = 1'000'000'000;    // number of a random stream that no run uses
  const int samples = static_cast<int>((kFirst + hits * kPause) * rig.rate);
  std::vector<double> hammer(samples, 0.0);
  RandomStream random(rig.seed, kStream);
  for (int k = 0; k < hits; ++k) {
    const double at = kFirst + k * kPause + random.uniform() / rig.rate;
    const double force = kForce * (1.0 + kUnevenness * (2.0 * random.uniform() - 1.0));
    for (int i = static_cast<int>(at * rig.rate); i < (at + kContact) * rig.rate; ++i) {
      const double share = (i / rig.rate - at) / kContact;
      if (share > 0.0 && share < 1.0) hammer[i] += force * std::sin(std::numbers::pi * share);
    }
  }
  const int length = numerics::fast_length(samples + static_cast<int>(kPause * rig.rate));
  Spectrum F = numerics::real_fft(hammer, length);
  for (int k = 0; k < static_cast<int>(F.size()); ++k) {
    F[k] *= 2 * k == length ? 0.0 : rig.response.at(kTwoPi * k * rig.rate / length);
  }
  std::vector<double> force = numerics::inverse_real_fft(F, length);
  force.resize(samples);
  for (int i = 0; i < samples; ++i) {
    hammer[i] += noise * random.normal();
    force[i] += noise * random.normal();
  }
  Channels channels;
  channels.add(time_channel(samples, rig.rate));
  channels.add({"hammer", "N", std::move(hammer)});
  channels.add({"Fz", "N", std::move(force)});
  return channels;
}

}  // namespace latsch
