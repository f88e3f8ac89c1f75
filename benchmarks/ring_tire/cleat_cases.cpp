// SPDX-License-Identifier: Apache-2.0
#include "cleat_cases.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "base/file.h"
#include "experiment/tests/drum_cleat.h"
#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "numerics/signals/welch.h"

namespace latsch::benchmarks::cleat {

std::filesystem::path study_folder() {
  return std::filesystem::path(LATSCH_SOURCE_DIR) / "studies" / "cleat_fit";
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* name : {"slow",
                           "fast",
                           "medium",
                           "faster",
                           "heavy",
                           "light",
                           "high",
                           "cambered",
                           "fast_cambered",
                           "oblique",
                           "fast_oblique"}) {
    const auto test =
        experiment::read_drum_cleat(study_folder() / "tests" / (std::string(name) + ".toml"));
    all.push_back({name, all.size() < 2, test});
    all.back().words = fmt::format("{}: {}", name, experiment::DrumCleatTest(test).in_words());
  }
  return all;
}

Document file() {
  return Document::read(std::string(LATSCH_SOURCE_DIR) +
                        "/studies/ring_tires/passenger_205_55R16.toml");
}

ring_tire::RingParameters tire_at(const Document& known, const DesignPoint& point) {
  Document changed = known;
  for (std::size_t i = 0; i < point.values.size(); ++i)
    changed.set(kNumbers[i].path, point.values[i]);
  return ring_tire::read_ring_tire(changed.root());
}

ring_tire::RingParameters with(ring_tire::RingParameters ring, const Numerics& numerics) {
  ring.nodes = numerics.nodes;
  ring.tread.blocks = numerics.blocks;
  ring.tread.lines = numerics.lines;
  return ring;
}

ring_tire::RingParameters with(ring_tire::RingParameters ring, const Friction& friction) {
  ring.sidewall.radial.friction_stiffening = friction.stiffening;
  ring.sidewall.radial.friction_force = friction.force;
  return ring;
}

Numerics enough(Numerics numerics, const Case& of) {
  if (of.test.camber == 0.0 && of.test.cleat->angle == 0.0) numerics.lines = 1;
  return numerics;
}

double noise(const experiment::DrumTest& test, int channel) {
  return kNoise[channel] * std::sqrt(M_PI * test.diameter / (kRecord * test.speed));
}

std::vector<double> with_noise(std::vector<double> force, double deviation, RandomStream random) {
  for (double& value : force) value += deviation * random.normal();
  return force;
}

std::vector<double> density(const std::vector<double>& force) {
  const int count = static_cast<int>(force.size());
  const auto settings = numerics::welch_settings(numerics::Convention::scipy, count, count);
  const numerics::Density density = numerics::power_density(force, 1000.0, settings);
  std::vector<double> kept;
  for (std::size_t i = 0; i < density.value.size() && density.frequency[i] <= kHighest; ++i)
    kept.push_back(density.value[i]);
  return kept;
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

void measure(std::vector<Case>& all,
             const ring_tire::RingParameters& specimen,
             int draw,
             int passages) {
  std::vector<std::string> failures(all.size());
  at_once(all.size(), [&](std::size_t i) {
    experiment::DrumTest test = all[i].test;
    test.step *= 0.5;
    test.passages = passages;
    test.wheel_step = 2.0 * M_PI / (kSpecimen.nodes * passages);
    ring_tire::RingTire tire(with(specimen, enough(kSpecimen, all[i])));
    const auto channels = experiment::run(tire, test);
    if (!channels) {
      failures[i] = channels.failure().reason;
      return;
    }
    for (int c = 0; c < 2; ++c) {
      const RandomStream random(2024 + 1000 * static_cast<std::uint64_t>(draw),
                                2 * i + static_cast<std::size_t>(c));
      all[i].noiseless[c] = (*channels)[kChannels[c]];
      all[i].force[c] = with_noise(all[i].noiseless[c], noise(all[i].test, c), random);
      all[i].measured[c] = density(all[i].force[c]);
    }
  });
  for (const std::string& failure : failures)
    if (!failure.empty()) throw InputError("the specimen: " + failure);
}

void write(const std::vector<Case>& all, const std::filesystem::path& study) {
  for (const Case& one : all) {
    std::string text = "time [s],Fx [N],Fz [N]\n";
    for (std::size_t i = 0; i < one.force[0].size(); ++i) {
      const double time = static_cast<double>(i + 1) * one.test.sample_step - one.test.lead;
      text += fmt::format("{:.3f},{:.1f},{:.1f}\n", time, one.force[0][i], one.force[1][i]);
    }
    write_text_file(study / "measured" / (one.name + ".csv"), text);
  }
}

}  // namespace latsch::benchmarks::cleat
