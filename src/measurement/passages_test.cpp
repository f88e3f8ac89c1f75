// SPDX-License-Identifier: Apache-2.0
// The chain from a raw drum run to averaged passages, on a rig whose hits are known.
#include "measurement/passages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "base/random.h"
#include "measurement/drum_record.h"
#include "measurement/plateaus.h"
#include "measurement/synthetic_rig.h"

namespace latsch {
namespace {

constexpr double kKph = 1.0 / 3.6;

SyntheticRig rig() { return {2000.0, 6.0, RigResponse::of(0.45, 578.0, 0.06, 0.55), 3}; }

SyntheticRun run(double noise = 15.0) {
  SyntheticRun run;
  run.speeds = {40 * kKph, 70 * kKph};
  run.hold = 15.0;
  run.noise = noise;
  run.modes = {{45.0, 0.05, 400.0}, {92.0, 0.04, 250.0}, {140.0, 0.05, 100.0}};
  return run;
}

DrumRecord record(double noise = 15.0) {
  return drum_record(synthetic_run(rig(), run(noise)), "time", "run.csv");
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

void expect_says(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

/// Returns the starts of the passages relative to the nearest true hits, in samples: they are equal
/// for all passages except for scatter.
std::vector<double> offsets(const Plateau& plateau, const Passages& passages) {
  const auto hits = synthetic_hits(rig(), run());
  std::vector<double> offsets;
  for (const double start : passages.starts) {
    const double place = plateau.first + start;
    const auto hit = std::lower_bound(hits.begin(), hits.end(), place / rig().rate);
    offsets.push_back(*hit * rig().rate - place);
  }
  return offsets;
}

double scatter(const std::vector<double>& x) {
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  double sum = 0.0;
  for (const double v : x) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / static_cast<double>(x.size()));
}

TEST(Plateaus, AreWhereTheRigHeldItsSpeed) {
  const DrumRecord r = record();
  const auto plateaus = find_plateaus(r, "speed", {40 * kKph, 70 * kKph}, {});
  ASSERT_EQ(plateaus.size(), 2u);
  // Ramps of 4 s lead to 15 s of constant speed: 4 .. 19 s and 23 .. 38 s, of which a second is
  // trimmed at each end. The end of a ramp lies within the margin too.
  EXPECT_NEAR(r.time(plateaus[0].first), 5.0, 0.5);
  EXPECT_NEAR(r.time(plateaus[0].end), 18.0, 0.5);
  EXPECT_NEAR(r.time(plateaus[1].first), 24.0, 0.5);
  EXPECT_NEAR(plateaus[0].mean, 40 * kKph, 0.01);
  EXPECT_LT(plateaus[0].range, 0.1);
}

TEST(Plateaus, MissingOnesAreToldWithTheNearestSpeed) {
  const DrumRecord r = record();
  expect_says(message_of([&] { find_plateaus(r, "speed", {90 * kKph}, {}); }),
              "has no plateau at 90 km/h +- 1.08 km/h: the speed comes nearest with 70.");
  PlateauSettings longer;
  longer.shortest = 20.0;
  expect_says(message_of([&] { find_plateaus(r, "speed", {40 * kKph}, longer); }),
              "the longest stretch lasts 15.");
  expect_says(message_of([&] { find_plateaus(r, "velocity", {40 * kKph}, {}); }),
              "channel \"velocity\" is missing");
}

TEST(Period, IsTheDrumsAndNotAResonances) {
  const DrumRecord r = record();
  const auto plateau = find_plateaus(r, "speed", {40 * kKph}, {})[0];
  const auto Fz = r.channel("Fz").subspan(plateau.first, plateau.samples());
  const double exact = rig().circumference / plateau.mean * rig().rate;  // 1080 samples
  // The circumference of the drum is not used here. Resonances give peaks at lags of 14 to 44
  // samples, and the period and its multiples form a comb of peaks.
  const auto period = find_period(Fz, 10.0, Fz.size() / 2.0);
  ASSERT_TRUE(period);
  EXPECT_NEAR(period->samples, exact, 5e-4 * exact);  // the speed drifts by 2e-3 during the plateau
  EXPECT_GT(period->strength, 0.8);
}

TEST(Period, OfNoiseIsNone) {
  RandomStream random(1, 1);
  std::vector<double> noise(20000);
  for (double& v : noise) v = random.normal();
  EXPECT_FALSE(find_period(noise, 100.0, 5000.0));
  EXPECT_FALSE(find_period(std::vector<double>(1000, 3.0), 10.0, 400.0));
}

// The speed drifts, and a period is no whole number of samples. Relative to the true hits the
// starts scatter as far as the noise makes them uncertain: sigma_t = noise / |dF/dt| over a
// passage, a few hundredths of a sample here; with whole samples the scatter is 1/sqrt(12) = 0.29
// and more.
TEST(Passages, StartWithTheHitsToAFractionOfASample) {
  for (const double noise : {0.0, 15.0}) {
    const DrumRecord r = record(noise);
    for (const auto& plateau : find_plateaus(r, "speed", {40 * kKph, 70 * kKph}, {})) {
      const auto Fz = r.channel("Fz").subspan(plateau.first, plateau.samples());
      const double period = rig().circumference / plateau.mean * rig().rate;
      const auto fine = find_passages(Fz, r.rate, period, {});
      ASSERT_GT(fine.starts.size(), 20u);
      EXPECT_EQ(fine.left_out, 0);
      EXPECT_LT(scatter(offsets(plateau, fine)), noise == 0.0 ? 0.003 : 0.05);
      PassageSettings whole;
      whole.whole_samples = true;
      EXPECT_GT(scatter(offsets(plateau, find_passages(Fz, r.rate, period, whole))), 0.2);
    }
  }
}

TEST(Passages, AverageDownTheNoiseWithTheRootOfTheirNumber) {
  const DrumRecord noisy = record(40.0), clean = record(0.0);
  const auto plateau = find_plateaus(noisy, "speed", {40 * kKph}, {})[0];
  const double period = rig().circumference / plateau.mean * rig().rate;
  const auto passages = find_passages(
      noisy.channel("Fz").subspan(plateau.first, plateau.samples()), 2000.0, period, {});
  const auto mean_of_record = [&](const DrumRecord& r) {
    return average(cut(r.channel("Fz").subspan(plateau.first, plateau.samples()), passages));
  };
  const auto with = mean_of_record(noisy), without = mean_of_record(clean);
  double sum = 0.0, spread = 0.0;
  for (std::size_t i = 0; i < with.mean.size(); ++i) {
    sum += std::pow(with.mean[i] - without.mean[i], 2);
    spread += with.spread[i] * with.spread[i];
  }
  const auto count = static_cast<double>(passages.starts.size());
  const auto length = static_cast<double>(with.mean.size());
  // Interpolation passes nearly all of the noise below half the rate.
  EXPECT_NEAR(std::sqrt(sum / length), 40.0 / std::sqrt(count), 0.1 * 40.0 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(spread / length), 40.0, 3.0);
  // The coherence is 1 at frequencies of the tire's response and 1/count at frequencies with noise
  // alone.
  const auto coherence = ensemble_coherence(
      cut(noisy.channel("Fz").subspan(plateau.first, plateau.samples()), passages), 2000.0);
  double floor = 0.0, lines = 0.0;
  for (std::size_t k = 0; k < coherence.value.size(); ++k) {
    const double f = coherence.frequency[k];
    if (f > 43.0 && f < 47.0) {
      EXPECT_GT(coherence.value[k], 0.99);
    }
    if (f > 500.0) floor += coherence.value[k], ++lines;
  }
  EXPECT_NEAR(floor / lines, 1.0 / count, 0.3 / count);
}

TEST(Passages, ALostHitIsLeftOut) {
  Channels channels = synthetic_run(rig(), run(0.0));
  std::vector<double> Fz = channels["Fz"];
  const auto hits = synthetic_hits(rig(), run());
  const auto tenth = std::lower_bound(hits.begin(), hits.end(), 10.0);
  const int at = static_cast<int>(*tenth * 2000.0);
  std::fill(Fz.begin() + at - 100, Fz.begin() + at + 700, 4000.0);
  const DrumRecord r = record(0.0);
  const auto plateau = find_plateaus(r, "speed", {40 * kKph}, {})[0];
  const auto passages =
      find_passages(std::span<const double>(Fz).subspan(plateau.first, plateau.samples()),
                    2000.0,
                    rig().circumference / plateau.mean * rig().rate,
                    {});
  EXPECT_EQ(passages.left_out, 1);
}

TEST(DrumRecord, RefusesWhatIsNotARecordInWords) {
  Channels good = synthetic_run(rig(), run());
  const auto with = [&](const char* name, const std::function<void(std::vector<double>&)>& change) {
    Channels channels;
    for (Channel channel : good.all()) {
      if (channel.name == name) change(channel.values);
      channels.add(channel);
    }
    return message_of([&] { drum_record(channels, "time", "run.csv"); });
  };
  expect_says(with("Fz", [](auto& v) { v[99] = std::nan(""); }),
              "run.csv: channel \"Fz\" is not a finite number at sample 100 (1 such samples)");
  expect_says(with("Fz", [](auto& v) { v.pop_back(); }), "values, expected");
  expect_says(with("time", [](auto& v) { v[50] = v[49]; }), "time goes from");
  expect_says(with("time",
                   [](auto& v) {
                     for (std::size_t i = 60; i < v.size(); ++i) v[i] += 0.01;
                   }),
              "20 samples are missing between 0.0295 s");
  expect_says(with("time",
                   [](auto& v) {
                     for (std::size_t i = 0; i < v.size(); ++i) v[i] *= 1.0 + 1e-6 * i;
                   }),
              "time is not uniform");
  Channels constant = good;
  constant.add({"Mz", "Nm", std::vector<double>(good["time"].size(), 0.0)});
  const DrumRecord r = drum_record(constant, "time", "run.csv");
  expect_says(message_of([&] { expect_varying(r, "Mz"); }), "is 0 all the time");
  expect_says(message_of([&] { expect_quantity(r, "Fz", "m/s"); }), "is in N, expected a ");
  EXPECT_NO_THROW(expect_quantity(r, "speed", "m/s"));
  expect_says(message_of([&] { r.channel("Fy"); }),
              "(channels: \"speed\", \"Fz\", \"Fx\" or \"Mz\")");
  Channels tiny;
  tiny.add({"time", "s", {0.0, 1.0}});
  expect_says(message_of([&] { drum_record(tiny, "time", "run.csv"); }), "has 2 samples");
}

}  // namespace
}  // namespace latsch
