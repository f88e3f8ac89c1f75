// SPDX-License-Identifier: Apache-2.0
// Twelve numbers of a ring tire from two cleat runs on the drum, shown on nine others; for two
// specimens, the ring of studies/ring_tires and a ring derived from the FE tire of that size.
//
// The specimen is the ring with other numbers, finer than the model (kSpecimen, kModel) and with
// noise on its forces. Compared are power spectral densities of Fx and Fz, as in the thesis; every
// density in units of its own root mean square. What the model shows at the specimen's own numbers
// is the floor: an error below it is numerics that the fit absorbed. The residual method looks at
// the densities' logarithms first: where peaks do not overlap their difference has no slope. Then
// at both. "--genetic N": evaluations of the genetic algorithm beside the residual method, 0 leaves
// it out; "--specimen ring" or "fe": one of the two.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "base/document.h"
#include "base/random.h"
#include "correlation/fe_ring_data.h"
#include "experiment/drum_rig.h"
#include "models/fe_tire/fe_tire.h"
#include "models/fe_tire/tire_description.h"
#include "models/ring_tire/ring_reader.h"
#include "models/ring_tire/ring_tire.h"
#include "numerics/welch.h"
#include "optimization/genetic.h"
#include "optimization/residual_trust_region.h"
#include "table.h"

namespace {

using namespace latsch;

constexpr double kHighest = 200.0;          // Hz, compared up to
constexpr double kNoise[2] = {10.0, 20.0};  // N, of Fx and Fz, averaged over passages
constexpr int kMostEvaluations = 250, kPopulation = 60;
constexpr double kFirstRadius = 0.2;  // of the ranges: the start is known to be far off
constexpr const char* kChannels[2] = {"Fx", "Fz"};

/// How finely a tire is simulated.
struct Numerics {
  int nodes, blocks, lines;
  double step;  // s
};
// A segment of the model is shorter than the lower cleat: with longer ones the blow depends on
// which of its nodes the cleat meets first.
constexpr Numerics kModel{120, 8, 4, 2.5e-4}, kSpecimen{160, 10, 6, 1.25e-4};

ring_tire::RingParameters with(ring_tire::RingParameters ring, const Numerics& numerics) {
  ring.nodes = numerics.nodes;
  ring.tread.blocks = numerics.blocks;
  ring.tread.lines = numerics.lines;
  return ring;
}

/// A number of the tire: where it stands, what it is in the specimen over what is known before, and
/// how far it may be off.
struct Number {
  const char* path;
  double truth, range;
};
constexpr Number kNumbers[12] = {{"sidewall.radial.stiffness", 1.12, 1.5},
                                 {"sidewall.radial.damping", 1.30, 2.0},
                                 {"sidewall.radial.dynamic_stiffening", 0.80, 2.0},
                                 {"sidewall.time_constant", 1.25, 2.0},
                                 {"sidewall.tangential.stiffness", 0.88, 1.5},
                                 {"sidewall.tangential.damping", 0.75, 2.0},
                                 {"sidewall.progressivity", 0.85, 1.5},
                                 {"belt.pressure_width", 1.15, 1.5},
                                 {"belt.bending_in_plane", 1.30, 2.0},
                                 {"belt.extension", 0.85, 1.5},
                                 {"tread.shore_a", 0.95, 1.15},
                                 {"tread.damping_time", 1.30, 2.0}};

experiment::DrumTest drum_test(double kmh,
                               double load,
                               double camber,
                               experiment::DrumCleat cleat) {
  experiment::DrumTest test;
  test.speed = kmh / 3.6;
  test.load = load;
  test.camber = camber * M_PI / 180.0;
  test.diameter = 2.5;
  test.run_in = 0.16;
  test.duration = 0.256;
  test.lead = 0.03;
  test.step = kModel.step;
  test.sample_step = 1e-3;
  test.cleat = cleat;
  return test;
}

struct Case {
  std::string name;
  experiment::DrumTest test;
  bool fitted;
  std::vector<double> measured[2] = {};  // densities
};

std::vector<Case> cases() {
  const double deg = M_PI / 180.0;
  const experiment::DrumCleat low{.height = 0.010, .length = 0.020, .bevel = 0.003};
  const experiment::DrumCleat high{.height = 0.015, .length = 0.030, .bevel = 0.005};
  const auto turned = [&](experiment::DrumCleat cleat, double degrees) {
    cleat.angle = degrees * deg;
    return cleat;
  };
  return {{"30 km/h, 3.5 kN, 10 mm", drum_test(30, 3500, 0, low), true},
          {"60 km/h, 4.5 kN, 15 mm", drum_test(60, 4500, 0, high), true},
          {"45 km/h, 3.5 kN, 10 mm", drum_test(45, 3500, 0, low), false},
          {"75 km/h, 3.5 kN, 10 mm", drum_test(75, 3500, 0, low), false},
          {"30 km/h, 5 kN, 10 mm", drum_test(30, 5000, 0, low), false},
          {"60 km/h, 3 kN, 10 mm", drum_test(60, 3000, 0, low), false},
          {"30 km/h, 3.5 kN, 15 mm", drum_test(30, 3500, 0, high), false},
          {"30 km/h, 3.5 kN, 10 mm, camber 3 deg", drum_test(30, 3500, 3, low), false},
          {"60 km/h, 4.5 kN, 15 mm, camber -2 deg", drum_test(60, 4500, -2, high), false},
          {"30 km/h, 3.5 kN, 10 mm at 30 deg", drum_test(30, 3500, 0, turned(low, 30)), false},
          {"60 km/h, 4.5 kN, 15 mm at 15 deg", drum_test(60, 4500, 0, turned(high, 15)), false}};
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

/// Of the densities of both forces, each in units of the measured one's rms: their differences,
/// those of their logarithms, or both, the logarithms' by their weight.
enum class Compared { densities, levels, both };
Result<std::vector<double>> differences(const ring_tire::RingParameters& ring,
                                        const Case& of,
                                        Compared compared = Compared::densities) {
  constexpr double kFaint = 0.02;  // of the rms: what is fainter does not count in logarithms
  const double weight = compared == Compared::both ? 0.3 : 1.0;  // of logarithms
  ring_tire::RingTire tire(ring);
  const auto channels = experiment::run(tire, of.test);
  if (!channels) return channels.failure();
  std::vector<double> all;
  for (int c = 0; c < 2; ++c) {
    const auto simulated = density((*channels)[kChannels[c]]);
    const double scale = rms(of.measured[c]);
    for (std::size_t i = 0; i < simulated.size(); ++i) {
      const double model = simulated[i] / scale, measured = of.measured[c][i] / scale;
      if (compared != Compared::levels) all.push_back(model - measured);
      if (compared != Compared::densities)
        all.push_back(weight * std::log((model + kFaint) / (measured + kFaint)));
    }
  }
  return all;
}

void measure(std::vector<Case>& all, const ring_tire::RingParameters& specimen) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    experiment::DrumTest test = all[i].test;
    test.step = kSpecimen.step;
    ring_tire::RingTire tire(with(specimen, kSpecimen));
    const auto channels = experiment::run(tire, test);
    if (!channels) throw InputError("the specimen: " + channels.failure().reason);
    for (int c = 0; c < 2; ++c) {
      std::vector<double> force = (*channels)[kChannels[c]];
      RandomStream random(2024, 2 * i + static_cast<std::size_t>(c));
      for (double& value : force) value += kNoise[c] * random.normal();
      all[i].measured[c] = density(force);
    }
  }
}

class Fit {
 public:
  Fit(std::vector<Case> all, Document known) : cases_(std::move(all)), known_(std::move(known)) {}

  Result<Score> score(const DesignPoint& point, Compared compared) {
    ++evaluations_;
    Score score;
    for (const Case& one : cases_) {
      if (!one.fitted) continue;
      const auto found = differences(tire(point), one, compared);
      if (!found) return found.failure();
      score.residuals.insert(score.residuals.end(), found->begin(), found->end());
    }
    score.value = rms(score.residuals);
    return score;
  }

  /// Best of at most `most` evaluations.
  DesignPoint run(Optimizer& optimizer, int most, const DesignPoint& initial, Compared compared) {
    evaluations_ = 0;
    DesignPoint best = initial;
    best_ = 1e300;
    while (!optimizer.converged() && evaluations_ < most) {
      const auto plan = optimizer.propose(1);
      if (plan.empty()) break;
      const auto outcome = score(plan.front(), compared);
      if (outcome && outcome->value < best_) {
        best_ = outcome->value;
        best = plan.front();
      }
      optimizer.observe(plan.front(), outcome);
      if (evaluations_ % 25 == 0) fmt::print("  {} evaluations: {:.4f}\n", evaluations_, best_);
    }
    return best;
  }

  ring_tire::RingParameters tire(const DesignPoint& point) const {
    return with(tire_at(known_, point), kModel);
  }

  struct Errors {
    double fitted, held_out, worst;
    std::string worst_case;
  };
  Errors errors(const DesignPoint& point) {
    double sums[2] = {}, counts[2] = {};
    Errors errors{};
    for (const Case& one : cases_) {
      const auto found = differences(tire(point), one);
      const double error = found ? rms(*found) : 1e9;
      fmt::print("  {:40} {} {:.4f}\n", one.name, one.fitted ? "fitted  " : "held out", error);
      sums[one.fitted] += error * error;
      counts[one.fitted] += 1.0;
      if (!one.fitted && error > errors.worst) {
        errors.worst = error;
        errors.worst_case = one.name;
      }
    }
    errors.fitted = std::sqrt(sums[1] / counts[1]);
    errors.held_out = std::sqrt(sums[0] / counts[0]);
    return errors;
  }

  int evaluations() const { return evaluations_; }

 private:
  std::vector<Case> cases_;
  Document known_;
  int evaluations_ = 0;
  double best_ = 0.0;
};

DesignSpace space_of(const Document& known) {
  std::vector<DesignVariable> variables;
  for (const Number& number : kNumbers) {
    const double value = known.get(number.path);
    variables.push_back({.name = number.path,
                         .lower = value / number.range,
                         .upper = value * number.range,
                         .initial = value,
                         .scale = Scale::logarithmic});
  }
  return DesignSpace(std::move(variables));
}

DesignSpace space_from(const DesignSpace& space, const DesignPoint& start) {
  std::vector<DesignVariable> variables = space.variables();
  for (std::size_t i = 0; i < variables.size(); ++i) variables[i].initial = start.values[i];
  return DesignSpace(std::move(variables));
}

void say_errors(benchmarks::Table& table, const std::string& what, const Fit::Errors& errors) {
  table.note(what, fmt::format("{:.3f}, {:.3f}", errors.fitted, errors.held_out));
}

/// A specimen whose twelve numbers are those of `known` times Number::truth.
void fit_specimen(const std::string& name,
                  const Document& known,
                  int genetic,
                  benchmarks::Table& table) {
  fmt::print("{}\n", name);
  const DesignSpace space = space_of(known);
  DesignPoint truth = space.initial();
  for (std::size_t i = 0; i < truth.values.size(); ++i) truth.values[i] *= kNumbers[i].truth;
  std::vector<Case> all = cases();
  measure(all, tire_at(known, truth));
  Fit fit(all, known);
  table.note(name + ": PSD RMS", "fitted, held out");
  say_errors(table, "before", fit.errors(space.initial()));
  say_errors(table, "floor: the model at the specimen's numbers", fit.errors(truth));

  ResidualTrustRegion coarse(space, {.initial_radius = kFirstRadius});
  const DesignPoint near = fit.run(coarse, kMostEvaluations / 2, space.initial(), Compared::levels);
  int evaluations = fit.evaluations();
  say_errors(table, "residual method, levels alone", fit.errors(near));
  ResidualTrustRegion fine(space_from(space, near));
  const DesignPoint found = fit.run(fine, kMostEvaluations - evaluations, near, Compared::both);
  evaluations += fit.evaluations();
  const auto errors = fit.errors(found);
  for (std::size_t i = 0; i < truth.values.size(); ++i)
    fmt::print(
        "  {:40} {:.3f} of the specimen's\n", kNumbers[i].path, found.values[i] / truth.values[i]);
  say_errors(table, "residual method", errors);
  table.note("worst held out", fmt::format("{:.3f}: {}", errors.worst, errors.worst_case));
  table.row(name + ": held out over fitted",
            fmt::format("{:.2f}", errors.held_out / errors.fitted),
            "<= 1.5",
            errors.held_out <= 1.5 * errors.fitted);
  table.row(name + ": evaluations, residual method",
            fmt::format("{}", evaluations),
            fmt::format("<= {}", kMostEvaluations),
            evaluations <= kMostEvaluations);
  if (genetic <= 0) return;
  const int generations = std::max(1, genetic / kPopulation - 1);
  Genetic algorithm(space, {.population = kPopulation, .generations = generations});
  const DesignPoint bred = fit.run(algorithm, genetic, space.initial(), Compared::densities);
  const int asked = fit.evaluations();
  say_errors(table, fmt::format("genetic algorithm, {} evaluations", asked), fit.errors(bred));
}

/// The shipped ring with the numbers that the FE tire of its size asks for, and its twelve numbers
/// as far off as those of the other specimen were.
Document derived_from_fe(const Document& ring) {
  const Document file =
      Document::read(std::string(LATSCH_SOURCE_DIR) + "/studies/tires/passenger_205_55R16.toml");
  const auto description = fe_tire::read_tire(file.root());
  fe_tire::FeTire tire(fe_tire::build_mesh(description), fe_tire::build_materials(description));
  const auto data = correlation::ring_data_of(tire, description.pressure, ring);
  if (!data) throw InputError("the FE tire: " + data.failure().reason);
  const auto fit = correlation::fit_ring(*data);
  if (!fit) throw InputError("the ring of the FE tire: " + fit.failure().reason);
  for (std::size_t i = 0; i < data->targets.size(); ++i)
    fmt::print("  {:16} FE {:10.2f}  ring {:10.2f}\n",
               data->targets[i].name,
               data->targets[i].value,
               fit->values[i]);
  for (const DesignVariable& variable : data->space.variables())
    fmt::print("  {:30} {:.5g}\n", variable.name, fit->tire.get(variable.paths.front()));
  Document known = fit->tire;
  for (const Number& number : kNumbers)
    known.set(number.path, known.get(number.path) / number.truth);
  return known;
}

int cleat_fit(int genetic, const std::string& specimen) {
  benchmarks::Table table("cleat_fit");
  if (specimen != "fe") fit_specimen("ring", file(), genetic, table);
  if (specimen != "ring") fit_specimen("ring of the FE tire", derived_from_fe(file()), 0, table);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  int genetic = 600;
  std::string specimen = "both";
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--genetic") == 0) genetic = std::atoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--specimen") == 0) specimen = argv[i + 1];
  }
  return benchmarks::guarded([&] { return cleat_fit(genetic, specimen); });
}
