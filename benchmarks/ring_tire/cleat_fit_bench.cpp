// SPDX-License-Identifier: Apache-2.0
// Fits twelve parameters of a ring tire to two cleat tests on the drum and checks the fit on nine
// others.
//
//   bench_cleat_fit                    the specimen is the ring of studies/ring_tires
//   bench_cleat_fit --specimen fe      or a ring derived from the FE tire of that size
//   bench_cleat_fit --specimen friction  or the first with dry friction in its sidewall
//   bench_cleat_fit --genetic 180      adds that many evaluations of the genetic algorithm
//   bench_cleat_fit --draws 5          only the study's intervals, over 5 draws of the noise
//   bench_cleat_fit --write            writes the measurements of studies/cleat_fit
//
// The specimen is the ring with other parameters, a finer mesh and step than the model (kSpecimen,
// kModel), and noise. Errors are those of the thesis: RMS differences between power spectral
// densities (PSD) of Fx and Fz, every density in units of its own root mean square. Four choices
// decide how much larger the errors of the nine held-out tests are than those of the two fitted:
//   passages  The position of the segments and blocks that the cleat meets changes Fx over the low
//             cleat by 5 to 18 %. A laboratory averages passages at any angle of the wheel; so do
//             specimen and model. Only then is the objective smooth: the ripples of one passage are
//             local minima. The numbers of blocks per segment and of passages must have no common
//             divisor, otherwise all passages meet the blocks alike: 12 blocks and three passages
//             change Fx by 4 N, 16 blocks by 0.8 N.
//   numerics  The error of the model's mesh and step has to stay below the noise; otherwise the
//             fitted parameters compensate for it ("mesh and step over noise").
//   window    Welch's window is as long as the record. The impact is in its middle, where it counts
//             fully; an eighth after the beginning it would count 0.13, and the noise behind it 1.
//   noise     kNoise is that of one passage. A record of kRecord averages more passages the faster
//             the drum is: 26 at 30 km/h, as in the thesis.
// The residual method fits forces over time, the other objective of the thesis: if the peaks of two
// densities do not overlap, their difference has no derivative. Forces are weighted by their noise,
// which is white and known, and the prior of the parameters is added: this gives the most probable
// parameters if two tests leave some of them undetermined. The genetic algorithm fits the
// densities, as the thesis did. The "floor" is the error of the model with the specimen's own
// parameters; "noise alone" is the effect of another draw of the noise.
//
// Requirements are in units of the floor, so that a fit that is equally bad in all tests does not
// pass. With --specimen friction, the fitted model lacks the law of friction, and no parameters
// reach the floor, which is that of the model with friction; the requirement is that held-out tests
// suffer no more from the missing law than fitted ones. Passages are simulated in parallel, one on
// each core; the result does not depend on the number of cores.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/document.h"
#include "base/scratch_folder_testing.h"
#include "cleat_cases.h"
#include "cleat_intervals.h"
#include "command.h"
#include "correlation/study/variables.h"
#include "correlation/target/study_trials.h"
#include "experiment/rigs/drum_rig.h"
#include "experiment/tests/drum_cleat.h"
#include "fit_study.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "numerics/signals/welch.h"
#include "optimization/direct_search/genetic.h"
#include "optimization/trust_region/residual_trust_region.h"
#include "table.h"

namespace {

using namespace latsch;
using namespace latsch::benchmarks::cleat;

constexpr int kMostEvaluations = 200;  // for the residual method, to the end of its search
constexpr int kPopulation = 60;
// largest error in multiples of the floor: fitted cases, held-out cases
constexpr double kReach[2] = {1.25, 1.5};
// largest ratio of held-out to fitted errors if the model lacks friction
constexpr double kMissingLaw = 1.5;
/// Compared quantity: forces over time minus their means, in units of their noise; or spectral
/// densities, in units of the measured density's root mean square.
enum class Compared { times, densities };

void add_times(const std::vector<double>& model,
               const std::vector<double>& measured,
               double deviation,
               std::vector<double>& all) {
  const auto about_mean = [](std::vector<double> force) {
    double sum = 0.0;
    for (const double value : force) sum += value;
    for (double& value : force) value -= sum / static_cast<double>(force.size());
    return force;
  };
  const auto one = about_mean(model), other = about_mean(measured);
  for (std::size_t i = 0; i < one.size(); ++i) all.push_back((one[i] - other[i]) / deviation);
}

void add_densities(const std::vector<double>& model,
                   const std::vector<double>& measured,
                   std::vector<double>& all) {
  const double scale = rms(measured);
  for (std::size_t i = 0; i < model.size(); ++i) all.push_back((model[i] - measured[i]) / scale);
}

/// Returns the differences between simulated and measured values for both forces.
std::vector<double> differences(const Channels& channels, const Case& of, Compared compared) {
  std::vector<double> all;
  for (int c = 0; c < 2; ++c) {
    const auto& force = channels[kChannels[c]];
    if (compared == Compared::times) {
      add_times(force, of.force[c], noise(of.test, c), all);
    } else {
      add_densities(density(force), of.measured[c], all);
    }
  }
  return all;
}

/// Returns the means of both forces over several passages.
Result<Channels> mean(std::span<const Result<Channels>> passages) {
  Channels mean;
  for (const char* name : kChannels) {
    std::vector<double> sum;
    for (const Result<Channels>& passage : passages) {
      if (!passage) return passage.failure();
      const std::vector<double>& force = (*passage)[name];
      sum.resize(force.size());
      for (std::size_t i = 0; i < force.size(); ++i) sum[i] += force[i];
    }
    for (double& value : sum) value /= static_cast<double>(passages.size());
    mean.add({name, "N", std::move(sum)});
  }
  return mean;
}

/// Returns the PSD error between two draws of the noise, for the fitted or the held-out cases. The
/// noise is known from the part of the measurement before the cleat.
double scatter(const std::vector<Case>& all, bool fitted) {
  constexpr int kDraws = 20;
  std::vector<double> differences;
  for (const Case& one : all) {
    if (one.fitted != fitted) continue;
    for (int k = 0; k < 2 * kDraws; ++k) {
      const int c = k % 2;
      const RandomStream random(2025, static_cast<std::size_t>(k));
      const auto again = density(with_noise(one.force[c], noise(one.test, c), random));
      const double scale = rms(one.measured[c]);
      for (std::size_t i = 0; i < again.size(); ++i)
        differences.push_back((again[i] - one.measured[c][i]) / scale);
    }
  }
  return rms(differences);
}

class Fit {
 public:
  Fit(std::vector<Case> all, Document known, const DesignSpace& space)
      : cases_(std::move(all)), known_(std::move(known)), space_(space) {}

  Result<Score> score(const DesignPoint& point, Compared compared) {
    ++evaluations_;
    Score score;
    const auto runs = simulate(point, {}, /*fitted_alone=*/true);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (!cases_[i].fitted) continue;
      if (!runs[i]) return runs[i].failure();
      const auto found = differences(*runs[i], cases_[i], compared);
      score.residuals.insert(score.residuals.end(), found.begin(), found.end());
    }
    if (compared == Compared::times) add_known(point, score.residuals);
    score.value = rms(score.residuals);
    return score;
  }

  /// Returns the best design point within `most` evaluations of the optimizer.
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

  struct Errors {
    double fitted = 0.0, held_out = 0.0, worst = 0.0;
    std::string worst_case;
    // effect of the model's mesh and step relative to the noise: held-out cases, fitted cases
    double mesh_over_noise[2] = {};
  };
  /// Returns the errors of the densities compared with the measured ones, and the deviation of the
  /// forces over time from those of the specimen without noise, in units of the noise. With the
  /// specimen's own parameters this deviation is the effect of mesh and step.
  Errors errors(const DesignPoint& point, const Friction& friction = {}) {
    double sums[2] = {}, counts[2] = {};
    std::vector<double> times[2];
    Errors errors;
    const auto runs = simulate(point, friction, /*fitted_alone=*/false);
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Case& one = cases_[i];
      const double error = runs[i] ? rms(differences(*runs[i], one, Compared::densities)) : 1e9;
      fmt::print("  {:80} {} {:.4f}\n", one.words, one.fitted ? "fitted  " : "held out", error);
      sums[one.fitted] += error * error;
      counts[one.fitted] += 1.0;
      if (!one.fitted && error > errors.worst) {
        errors.worst = error;
        errors.worst_case = one.name;
      }
      for (int c = 0; c < 2 && runs[i]; ++c)
        add_times(
            (*runs[i])[kChannels[c]], one.noiseless[c], noise(one.test, c), times[one.fitted]);
    }
    errors.fitted = std::sqrt(sums[1] / counts[1]);
    errors.held_out = std::sqrt(sums[0] / counts[0]);
    for (const int fitted : {0, 1}) errors.mesh_over_noise[fitted] = rms(times[fitted]);
    return errors;
  }

  int evaluations() const { return evaluations_; }
  /// Returns the number of residuals in the comparison of forces over time.
  std::size_t residuals() const {
    std::size_t count = static_cast<std::size_t>(space_.size());
    for (const Case& one : cases_) {
      if (one.fitted) count += one.force[0].size() + one.force[1].size();
    }
    return count;
  }

 private:
  /// Simulates every case, or only the fitted ones; the result of a case that is not simulated is a
  /// Failure.
  std::vector<Result<Channels>> simulate(const DesignPoint& point,
                                         const Friction& friction,
                                         bool fitted_alone) const {
    const auto ring = with(tire_at(known_, point), friction);
    std::vector<std::pair<std::size_t, int>> passages;  // (case, passage) pairs of all cases
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      for (int k = 0; k < cases_[i].test.passages && (cases_[i].fitted || !fitted_alone); ++k)
        passages.emplace_back(i, k);
    }
    std::vector<Result<Channels>> parts(passages.size(), Failure{"not asked"});
    at_once(passages.size(), [&](std::size_t p) {
      const auto [i, k] = passages[p];
      experiment::DrumTest test = cases_[i].test;
      test.passages = 1;
      test.wheel_start += k * test.wheel_step;
      ring_tire::RingTire tire(with(ring, enough(kModel, cases_[i])));
      parts[p] = experiment::run(tire, test);
    });
    std::vector<Result<Channels>> runs(cases_.size(), Failure{"not asked"});
    for (std::size_t p = 0; p < parts.size(); p += cases_[passages[p].first].test.passages) {
      const auto [i, k] = passages[p];
      runs[i] = mean(std::span(parts).subspan(p, cases_[i].test.passages));
    }
    return runs;
  }

  /// Adds the residuals of the prior, the known values of the parameters.
  void add_known(const DesignPoint& point, std::vector<double>& residuals) const {
    for (int i = 0; i < space_.size(); ++i) {
      residuals.push_back(space_[i].prior->residual(point.values[static_cast<std::size_t>(i)]));
    }
  }

  std::vector<Case> cases_;
  Document known_;
  DesignSpace space_;
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
                         .scale = Scale::logarithmic,
                         .prior = Prior{value, number.range - 1.0, /*of_logarithm=*/true}});
  }
  return DesignSpace(std::move(variables));
}

DesignPoint truth_of(const DesignSpace& space) {
  DesignPoint truth = space.initial();
  for (std::size_t i = 0; i < truth.values.size(); ++i) truth.values[i] *= kNumbers[i].truth;
  return truth;
}

void say_errors(benchmarks::Table& table, const std::string& what, const Fit::Errors& errors) {
  table.note(what, fmt::format("{:.3f}, {:.3f}", errors.fitted, errors.held_out));
}

struct Specimen {
  std::string name;
  Document known;     // its twelve parameters are these times Number::truth
  Friction friction;  // friction of the specimen, which the fitted model lacks
};

void say_reached(benchmarks::Table& table,
                 const Specimen& specimen,
                 const Fit::Errors& errors,
                 const Fit::Errors& floor) {
  const auto row = [&](const std::string& what, double value, double most) {
    table.full_row(specimen.name + ": " + what,
                   fmt::format("{:.2f}", value),
                   fmt::format("<= {}", most),
                   value <= most);
  };
  if (specimen.friction.force > 0.0)
    return row("held out over fitted", errors.held_out / errors.fitted, kMissingLaw);
  row("fitted over floor", errors.fitted / floor.fitted, kReach[0]);
  row("held out over floor", errors.held_out / floor.held_out, kReach[1]);
}

void fit_specimen(const Specimen& specimen,
                  int genetic,
                  const benchmarks::Options& options,
                  benchmarks::Table& table) {
  fmt::print("{}\n", specimen.name);
  const DesignSpace space = space_of(specimen.known);
  const DesignPoint truth = truth_of(space);
  std::vector<Case> all = cases();
  all.resize(options.size(all.size(), std::size_t{3}));  // two of them are fitted
  if (options.is_smoke())
    for (Case& one : all) one.test.passages = 1;
  measure(all,
          with(tire_at(specimen.known, truth), specimen.friction),
          /*draw=*/0,
          options.size(kPassages, 1));
  Fit fit(all, specimen.known, space);
  table.note(specimen.name + ": PSD RMS", "fitted, held out");
  table.note("noise alone", fmt::format("{:.3f}, {:.3f}", scatter(all, true), scatter(all, false)));
  say_errors(table, "before", fit.errors(space.initial()));
  const auto floor = fit.errors(truth, specimen.friction);
  table.note("mesh and step over noise",
             fmt::format("{:.2f}, {:.2f}", floor.mesh_over_noise[1], floor.mesh_over_noise[0]));
  say_errors(table, "floor: the model at the specimen's numbers", floor);
  if (specimen.friction.force > 0.0) say_errors(table, "without friction", fit.errors(truth));

  // Both forces and the prior are in units of their noise, as in a study with stated noise.
  const double m = static_cast<double>(fit.residuals());
  ResidualTrustRegion method(space, {.noise_alone = m + 2.0 * std::sqrt(2.0 * m)});
  const DesignPoint found =
      fit.run(method, options.size(kMostEvaluations, 4), space.initial(), Compared::times);
  const int evaluations = fit.evaluations();
  const auto errors = fit.errors(found);
  for (std::size_t i = 0; i < truth.values.size(); ++i)
    fmt::print(
        "  {:40} {:.3f} of the specimen's\n", kNumbers[i].path, found.values[i] / truth.values[i]);
  say_errors(table, "residual method", errors);
  table.note("worst held out", fmt::format("{:.3f}: {}", errors.worst, errors.worst_case));
  say_reached(table, specimen, errors, floor);
  table.full_row(specimen.name + ": evaluations, residual method",
                 fmt::format("{}{}", evaluations, method.converged() ? "" : ", not at its end"),
                 fmt::format("<= {}", kMostEvaluations),
                 method.converged());
  if (genetic <= 0) return;
  const int generations = std::max(1, genetic / kPopulation - 1);
  Genetic algorithm(space, {.population = kPopulation, .generations = generations});
  const DesignPoint bred = fit.run(algorithm, genetic, space.initial(), Compared::densities);
  const int asked = fit.evaluations();
  say_errors(table, fmt::format("genetic algorithm, {} evaluations", asked), fit.errors(bred));
}

/// Returns the shipped ring with parameters derived from the FE tire of its size. Its twelve fitted
/// parameters are then changed by the same factors as those of the other specimen.
Document derived_from_fe(const Document& ring) {
  const ScratchFolder scratch;
  (void)benchmarks::run_command(fmt::format(
      "{} new {} --ring-data {}/studies/tires/passenger_205_55R16.toml --known {} --quiet",
      benchmarks::program().string(),
      (scratch.path() / "ring").string(),
      LATSCH_SOURCE_DIR,
      ring.file()));
  const auto study =
      correlation::read_study(scratch.path() / "ring" / "study.toml", experiment::language());
  const auto fit = benchmarks::fit(study, /*workers=*/2);
  if (!fit.run.best()) throw InputError("the ring of the FE tire: no trial succeeded");
  const DesignPoint& best = fit.run.best()->point;
  const auto channels = correlation::simulate_all(study, best);
  for (const auto& experiment : study.experiments)
    fmt::print(
        "{}",
        experiment.observable->table(*channels, compare(experiment, study.experiments, *channels)));
  for (int i = 0; i < study.space.size(); ++i)
    fmt::print("  {:30} {:.5g}\n", study.space[i].name, best.values[static_cast<std::size_t>(i)]);
  Document known = correlation::at(study.model, study.space, best);
  for (const Number& number : kNumbers)
    known.set(number.path, known.get(number.path) / number.truth);
  return known;
}

int write() {
  const Document known = file();
  std::vector<Case> all = cases();
  measure(all, tire_at(known, truth_of(space_of(known))));
  write(all, study_folder());
  return 0;
}

Specimen specimen_of(const std::string& name) {
  if (name == "ring") return {"ring", file(), {}};
  if (name == "fe") return {"ring of the FE tire", derived_from_fe(file()), {}};
  if (name == "friction") return {"ring with friction", file(), kFriction};
  throw InputError("--specimen is ring, fe or friction");
}

int intervals(const benchmarks::Options& options) {
  const int draws = static_cast<int>(options.integer("--draws", 1));
  benchmarks::Table table("cleat_fit", options);
  count_intervals(draws, table);
  return table.exit_code();
}

int cleat_fit(const benchmarks::Options& options) {
  const int genetic = static_cast<int>(options.integer("--genetic", 0));
  const std::string specimen = options.text("--specimen", "ring");
  benchmarks::Table table("cleat_fit", options);
  if (specimen == "ring" && genetic == 0 && !options.is_smoke()) count_intervals(1, table);
  fit_specimen(specimen_of(specimen), genetic, options, table);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  return benchmarks::run_benchmark(
      argc,
      argv,
      {{"--specimen", "NAME", "ring, fe or friction"},
       {"--genetic", "N", "evaluations of the genetic algorithm besides"},
       {"--draws", "N", "the study's intervals alone, over so many draws of the noise"},
       {"--write", "", "the measurements of studies/cleat_fit"}},
      [](const benchmarks::Options& options) {
        if (options.has("--write")) return write();
        return options.has("--draws") ? intervals(options) : cleat_fit(options);
      });
}
