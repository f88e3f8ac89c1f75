// SPDX-License-Identifier: Apache-2.0
// Identifies two parameters of a ring tire from two noisy cleat passages on the drum, with the
// optimizer `auto` as shipped. A coarse ring rolls once over the cleat at 30 and at 60 km/h:
// stiffness and damping of its sidewall are identified from forces with 20 N of noise; the true
// values are known. The position of the segments and blocks that the cleat meets makes the forces
// ripple as functions of both parameters. Required: from every start, an objective (a sum of
// squares in units of the noise) of at most 1.1 times that at the true values.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "base/document.h"
#include "base/random.h"
#include "experiment/rigs/drum_rig.h"
#include "experiment/tests/drum_cleat.h"
#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "optimization/strategy/optimizer_choice.h"
#include "table.h"

namespace {

using namespace latsch;

constexpr double kNoise = 20.0;  // N, standard deviation of the noise in every sample of Fx and Fz
constexpr double kStiffness = 0.55e6;                 // N/m^2, true value
constexpr double kDamping = 55.0;                     // N s/m^2
constexpr int kNodes = 100, kBlocks = 6, kLines = 1;  // a coarse ring
constexpr int kMostTrials = 200;

std::vector<experiment::DrumTest> tests() {
  std::vector<experiment::DrumTest> all;
  for (const char* name : {"slow", "fast"}) {
    const auto file = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies" / "cleat_fit" / "tests" /
                      (std::string(name) + ".toml");
    auto test = experiment::read_drum_cleat(file);
    test.passages = 1;
    test.step = 5e-4;
    all.push_back(test);
  }
  return all;
}

class Drum {
 public:
  Drum()
      : known_(Document::read(std::string(LATSCH_SOURCE_DIR) +
                              "/studies/ring_tires/passenger_205_55R16.toml")),
        tests_(tests()) {
    const auto clean = forces({{kStiffness, kDamping}});
    if (!clean) throw InputError("the truth: " + clean.failure().reason);
    measured_ = *clean;
    RandomStream random(2027, 0);
    for (double& force : measured_) force += kNoise * random.normal();
  }

  Result<Score> score(const DesignPoint& point) const {
    const auto found = forces(point);
    if (!found) return found.failure();
    Score score;
    for (std::size_t i = 0; i < found->size(); ++i) {
      score.residuals.push_back(((*found)[i] - measured_[i]) / kNoise);
      score.value += score.residuals.back() * score.residuals.back();
    }
    return score;
  }

 private:
  Result<std::vector<double>> forces(const DesignPoint& point) const {
    Document changed = known_;
    changed.set("sidewall.radial.stiffness", point.values[0]);
    changed.set("sidewall.radial.damping", point.values[1]);
    ring_tire::RingParameters ring = ring_tire::read_ring_tire(changed.root());
    ring.nodes = kNodes;
    ring.tread.blocks = kBlocks;
    ring.tread.lines = kLines;
    std::vector<double> all;
    for (const experiment::DrumTest& test : tests_) {
      ring_tire::RingTire tire(ring);
      const auto channels = experiment::run(tire, test);
      if (!channels) return channels.failure();
      for (const char* name : {"Fx", "Fz"}) {
        const std::vector<double>& force = (*channels)[name];
        all.insert(all.end(), force.begin(), force.end());
      }
    }
    return all;
  }

  Document known_;
  std::vector<experiment::DrumTest> tests_;
  std::vector<double> measured_;
};

DesignSpace space(double stiffness, double damping) {
  return DesignSpace({{.name = "stiffness",
                       .lower = 0.37e6,
                       .upper = 0.82e6,
                       .initial = stiffness,
                       .scale = Scale::logarithmic},
                      {.name = "damping",
                       .lower = 10.0,
                       .upper = 200.0,
                       .initial = damping,
                       .scale = Scale::logarithmic}});
}

int bench(const benchmarks::Options& options) {
  benchmarks::Table table("drum_identification", options);
  const Drum drum;
  const auto truth = drum.score({{kStiffness, kDamping}});
  table.row("target at the truth, over the number of samples: the noise alone",
            fmt::format("{:.3f}", truth->value / static_cast<double>(truth->residuals.size())),
            "0.8 .. 1.2",
            std::abs(truth->value / static_cast<double>(truth->residuals.size()) - 1.0) <= 0.2);
  const ProblemTraits traits{.variables = 2, .has_residuals = true};
  const OptimizerSettings settings;  // default settings, with which `auto` chooses the method
  std::vector<std::pair<double, double>> starts{{0.45e6, 150.0}, {0.75e6, 20.0}, {0.4e6, 30.0}};
  starts.resize(options.size(starts.size(), std::size_t{1}));
  const int most = options.size(kMostTrials, 6);
  for (const auto& [stiffness, damping] : starts) {
    const DesignSpace here = space(stiffness, damping);
    const auto method = make_optimizer(method_of(settings, traits).method, here, settings, traits);
    double least = std::numeric_limits<double>::infinity();
    DesignPoint best = here.initial();
    int trials = 0;
    for (; trials < most && !method->converged(); ++trials) {
      const DesignPoint point = method->propose(1).front();
      const auto outcome = drum.score(point);
      if (outcome && outcome->value < least) {
        least = outcome->value;
        best = point;
      }
      method->observe(point, outcome);
    }
    const double ratio = least / truth->value;
    table.full_row(fmt::format("from {:.2f} MN/m^2, {:.0f} N s/m^2: target over the truth's",
                               1e-6 * stiffness,
                               damping),
                   fmt::format("{:.3f} in {} trials", ratio, trials),
                   "<= 1.1",
                   ratio <= 1.1);
    table.note("  found",
               fmt::format("{:.4f} MN/m^2, {:.1f} N s/m^2", 1e-6 * best.values[0], best.values[1]));
    table.note("  ended", method->ending());
  }
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return latsch::benchmarks::run_benchmark(argc, argv, {}, bench); }
