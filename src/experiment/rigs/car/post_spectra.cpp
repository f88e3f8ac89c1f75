// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/car/post_spectra.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "experiment/rigs/car/car_record.h"
#include "numerics/signals/local_response.h"
#include "numerics/signals/sample_count.h"
#include "numerics/signals/welch.h"

namespace latsch::experiment {
namespace {

struct SensorUnits {
  const char *density, *response;
};

SensorUnits units_of(const std::string& sensor) {
  return sensor.starts_with("pushrod") ? SensorUnits{"N^2/Hz", "N/m"}
                                       : SensorUnits{"m^2/s^4/Hz", "1/s^2"};
}

std::vector<double> mode_signal(const Channels& record, PostMode mode) {
  const auto names = of_corners("post");
  const std::array<double, 4> sign = signs_of(mode);
  std::vector<double> u(record[names[0]].size());
  for (std::size_t post = 0; post < 4; ++post) {
    const std::vector<double>& h = record[names[post]];
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += 0.25 * sign[post] * h[i];
  }
  return u;
}

numerics::WelchSettings welch(double rate, std::size_t samples, double segment) {
  const int count = numerics::sample_count(segment, rate);
  auto settings = numerics::welch_settings(
      numerics::Convention::scipy, static_cast<int>(samples), std::max(count, 2));
  settings.overlap = settings.segment - std::max(settings.segment / 8, 1);
  return settings;
}

/// Response of one sensor at the lines within the band.
struct Response {
  std::vector<double> frequency, post, density, magnitude, phase, coherence;
};

/// The records of both runs, split into half the difference (odd) and half the sum minus its start
/// (even).
struct Parts {
  std::vector<double> odd, even;
};

Parts parts_of(const std::vector<double>& up, const std::vector<double>& down) {
  Parts parts;
  for (std::size_t i = 0; i < up.size(); ++i) {
    parts.odd.push_back(0.5 * (up[i] - down[i]));
    parts.even.push_back(0.5 * (up[i] + down[i]));
  }
  return parts;
}

Response response_of(const std::vector<double>& u,
                     const std::vector<double>& y,
                     const Parts& parts,
                     double rate,
                     const PostSpectra& settings) {
  const auto moving =
      settings.moving > 0.0
          ? std::min(u.size(), static_cast<std::size_t>(std::lround(settings.moving * rate)) + 1)
          : u.size();
  const auto s = numerics::densities(std::span(u).first(moving),
                                     std::span(y).first(moving),
                                     rate,
                                     welch(rate, moving, settings.segment));
  Response kept;
  for (std::size_t i = 0; i < s.frequency.size(); ++i) {
    if (s.frequency[i] < settings.from || s.frequency[i] > settings.to) continue;
    kept.frequency.push_back(s.frequency[i]);
    kept.post.push_back(s.xx[i]);
    kept.density.push_back(s.yy[i]);
  }
  // width of the fit on both sides of a line of the spectrum, over line spacing times length of the
  // segment
  constexpr double kHalfLine = 0.7;
  // Order and delay of the local polynomials. The response of a car lasts a second or two. A higher
  // order resolves longer responses, but must be fitted to more lines than kHalfLine allows.
  constexpr int kOrder = 6;
  constexpr double kDelay = 0.8;  // s
  const auto local = numerics::local_response(
      u,
      parts.odd,
      rate,
      kept.frequency,
      {.width = kHalfLine / settings.segment, .order = kOrder, .delay = kDelay},
      parts.even);
  for (const std::complex<double>& h : local.response) {
    kept.magnitude.push_back(std::abs(h));
    kept.phase.push_back(std::arg(h));
  }
  kept.coherence = local.coherence;
  return kept;
}

}  // namespace

std::vector<std::string> spectra_sensors() {
  std::vector<std::string> sensors;
  for (const char* name : {"pushrod", "hub"})
    for (const std::string& one : of_corners(name)) sensors.push_back(one);
  sensors.push_back("body_z");
  return sensors;
}

std::vector<std::pair<std::string, std::string>> spectra_channels() {
  std::vector<std::pair<std::string, std::string>> names = {{"frequency", "Hz"},
                                                            {"psd_post", "m^2/Hz"}};
  for (const std::string& sensor : spectra_sensors()) {
    names.emplace_back("psd_" + sensor, units_of(sensor).density);
    names.emplace_back("tf_" + sensor, units_of(sensor).response);
    names.emplace_back("phase_" + sensor, "rad");
    names.emplace_back("coherence_" + sensor, "1");
  }
  return names;
}

Channels spectra(const BothWays& runs, PostMode mode, double rate, const PostSpectra& settings) {
  const std::vector<double> u = mode_signal(runs.up, mode);
  Channels channels;
  for (const std::string& sensor : spectra_sensors()) {
    const std::vector<double>& y = runs.up[sensor];
    const Response response = response_of(u, y, parts_of(y, runs.down[sensor]), rate, settings);
    if (channels.empty()) {
      channels.add({"frequency", "Hz", response.frequency});
      channels.add({"psd_post", "m^2/Hz", response.post});
    }
    channels.add({"psd_" + sensor, units_of(sensor).density, response.density});
    channels.add({"tf_" + sensor, units_of(sensor).response, response.magnitude});
    channels.add({"phase_" + sensor, "rad", response.phase});
    channels.add({"coherence_" + sensor, "1", response.coherence});
  }
  return channels;
}

}  // namespace latsch::experiment
