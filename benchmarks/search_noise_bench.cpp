// SPDX-License-Identifier: Apache-2.0
// The optimizer `auto`, as shipped, on residuals with white noise, on residuals that leap, and on
// variables whose bounds lie far from their values.
//
// The noise is a function of the point's bits; its deviation is a share of the root mean square of
// the data. The undisturbed residuals decide whether a run is solved: their sum of squares falls to
// a share tau of its value at the start, above the least value known. tau is 1e-3, and 1e-2 where
// the noise is 5 %. The problems are those of verification/identification_set: the tuning half was
// available while constants were chosen, the other half is evaluated once, afterward.
//
//   search_noise             the held-out half beside the tuning half
//   search_noise --tuning    the tuning half alone, and which runs are not solved
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "identification_set/identification_problems.h"
#include "optimization/strategy/optimizer_choice.h"
#include "table.h"

namespace {

using namespace latsch;
using namespace latsch::benchmarks;
using identification_set::Problem;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kDraws = 5;                              // number of draws of the noise
const std::vector<int> kBudgets{2, 3, 5, 10, 20, 50};  // in units of n + 1

double square(const std::vector<double>& r) {
  double sum = 0.0;
  for (const double value : r) sum += value * value;
  return std::isfinite(sum) ? sum : kInfinity;
}

std::uint64_t number_of(const DesignPoint& point) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : point.bits()) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  }
  return hash;
}

std::unique_ptr<Optimizer> shipped(const DesignSpace& space) {
  const ProblemTraits traits{.variables = space.size(), .has_residuals = true};
  OptimizerSettings settings;
  settings.method = "auto";
  return make_optimizer(method_of(settings, traits).method, space, settings, traits);
}

struct Search {
  std::vector<double> values;  // undisturbed sums of squares, in the order of the evaluations
  std::vector<double> best;    // point of the least of them
  std::string ending;
  int trials() const { return static_cast<int>(values.size()); }
};

/// Runs the search to its end, or for at most `most` evaluations.
Search search(const Problem& problem, double noise, std::uint64_t draw, int most) {
  Search found;
  const auto method = shipped(problem.space);
  double least = kInfinity;
  while (!method->converged() && found.trials() < most) {
    const DesignPoint point = method->propose(1).front();
    Score score{0.0, problem.residuals(point.values)};
    found.values.push_back(square(score.residuals));
    if (found.values.back() < least) {
      least = found.values.back();
      found.best = point.values;
    }
    RandomStream random(61 + draw, number_of(point));
    for (double& r : score.residuals) r += noise * random.normal();
    score.value = square(score.residuals);
    method->observe(point,
                    std::isfinite(score.value) ? Result<Score>(score) : Failure{"not finite"});
  }
  found.ending = method->ending();
  return found;
}

/// Returns the least undisturbed value known: at the true values or at the end of a long search
/// that starts there.
double least_known(const Problem& problem) {
  double least = square(problem.residuals(problem.truth));
  Problem from_truth = problem;
  std::vector<DesignVariable> variables = problem.space.variables();
  for (std::size_t i = 0; i < variables.size(); ++i) {
    variables[i].initial = std::clamp(problem.truth[i], variables[i].lower, variables[i].upper);
  }
  from_truth.space = DesignSpace(variables);
  const int most = 100 * (problem.n() + 1);
  for (const double value : search(from_truth, 0.0, 0, most).values) least = std::min(least, value);
  return least;
}

/// Returns the number of evaluations, in units of n + 1, after which the value was at most
/// `below`.
double solved_after(const Search& run, double below, int n) {
  const auto first = std::find_if(
      run.values.begin(), run.values.end(), [&](double value) { return value <= below; });
  if (first == run.values.end()) return kInfinity;
  return static_cast<double>(first - run.values.begin() + 1) / (n + 1.0);
}

struct Shares {
  std::vector<double> within;  // a share of runs for each budget
  double at(int budget) const {
    return within[std::find(kBudgets.begin(), kBudgets.end(), budget) - kBudgets.begin()];
  }
};

Shares shares(const std::vector<double>& times) {
  Shares found;
  for (const int budget : kBudgets) {
    const auto in_time =
        std::count_if(times.begin(), times.end(), [&](double time) { return time <= budget; });
    found.within.push_back(static_cast<double>(in_time) / static_cast<double>(times.size()));
  }
  return found;
}

std::string in_words(const Shares& found) {
  return fmt::format("{:.2f}", fmt::join(found.within, " "));
}

Shares solve(const std::vector<Problem>& problems, double noise, double tau, bool lists) {
  std::vector<double> times;
  for (const Problem& problem : problems) {
    const double start = square(problem.residuals(problem.space.initial().values));
    const double least = least_known(problem);
    for (int draw = 0; draw < (noise > 0.0 ? kDraws : 1); ++draw) {
      const Search run = search(problem, noise, draw, kBudgets.back() * (problem.n() + 1));
      times.push_back(solved_after(run, least + tau * (start - least), problem.n()));
      if (!lists) continue;
      fmt::print("    {:36} {:2} {:6.1f} of {:5.1f} {}\n",
                 problem.name,
                 problem.n(),
                 times.back(),
                 run.trials() / (problem.n() + 1.0),
                 run.ending);
    }
  }
  return shares(times);
}

std::vector<Problem> half(const std::vector<Problem>& problems,
                          bool is_held_out,
                          const Options& options) {
  std::vector<Problem> found;
  for (const Problem& problem : problems)
    if (problem.is_held_out == is_held_out) found.push_back(problem);
  if (options.is_smoke()) found.resize(2, found.front());
  return found;
}

struct Half {
  const char* name;
  bool is_held_out;
};

void noise_rows(Table& table, const Half& which, const Options& options, bool lists) {
  struct Level {
    double noise, tau;
    double at_5, at_10;  // required shares; 0: none
  };
  const Level levels[] = {{0.0, 1e-3, 0, 0},
                          {1e-3, 1e-3, 0.92, 0.96},
                          {1e-2, 1e-3, 0.65, 0.73},
                          {5e-2, 1e-2, 0.45, 0.65}};
  const auto problems = half(identification_set::problems(), which.is_held_out, options);
  for (const Level& level : levels) {
    const std::string what = fmt::format("{}, noise {:g}", which.name, level.noise);
    const Shares found = solve(problems, level.noise, level.tau, lists);
    table.note(fmt::format("{}, tau {:g} @{}", what, level.tau, fmt::join(kBudgets, "/")),
               in_words(found));
    if (level.at_5 == 0.0) continue;
    for (const auto& [budget, least] : {std::pair(5, level.at_5), std::pair(10, level.at_10)}) {
      table.full_row(fmt::format("{} @{}", what, budget),
                     fmt::format("{:.2f}", found.at(budget)),
                     fmt::format(">= {:.2f}", least),
                     found.at(budget) >= least);
    }
  }
}

void leap_rows(Table& table, const Half& which, const Options& options, bool lists) {
  const auto problems = half(identification_set::leaping_problems(), which.is_held_out, options);
  const Shares found = solve(problems, 0.0, 1e-3, lists);
  const std::string what = fmt::format("{}, leaps", which.name);
  table.note(fmt::format("{}, tau 0.001 @{}", what, fmt::join(kBudgets, "/")), in_words(found));
  for (const auto& [budget, least] : {std::pair(10, 0.55), std::pair(20, 0.75)}) {
    table.full_row(fmt::format("{} @{}", what, budget),
                   fmt::format("{:.2f}", found.at(budget)),
                   fmt::format(">= {:.2f}", least),
                   found.at(budget) >= least);
  }
}

/// A run is right if every variable ends within 5 % of its true value.
void wide_rows(Table& table, const Half& which, const Options& options, bool lists) {
  const auto problems = half(identification_set::wide_problems(), which.is_held_out, options);
  int right = 0, trials = 0;
  for (const Problem& problem : problems) {
    const Search run = search(problem, 0.0, 0, 100 * (problem.n() + 1));
    double worst = 0.0;
    for (int i = 0; i < problem.n(); ++i) {
      worst = std::max(worst, std::abs(run.best[i] / problem.truth[i] - 1.0));
    }
    right += worst < 0.05;
    trials += run.trials();
    if (lists) {
      fmt::print("    {:36} off by {:.1e} after {} trials, {}\n",
                 problem.name,
                 worst,
                 run.trials(),
                 run.ending);
    }
  }
  const auto count = static_cast<int>(problems.size());
  table.full_row(fmt::format("{}, wide ranges: ends with all variables right", which.name),
                 fmt::format("{} of {}, {} trials", right, count, trials),
                 "all",
                 right == count);
}

/// Bounds of +-1e12 around the same start must give the same search as bounds of +-10.
void bound_rows(Table& table, const Half& which, const Options& options, bool lists) {
  int alike = 0, count = 0;
  for (const Problem& problem :
       half(identification_set::wide_problems(), which.is_held_out, options)) {
    const auto within = [&](double reach) {
      Problem bounded = problem;
      std::vector<DesignVariable> variables = problem.space.variables();
      for (DesignVariable& variable : variables) {
        const double lower = std::min(variable.lower, 0.0);
        variable.lower = lower < 0.0 ? -reach : lower;
        variable.upper = reach * std::max(1.0, std::abs(variable.initial));
      }
      bounded.space = DesignSpace(variables);
      return search(bounded, 0.0, 0, 100 * (problem.n() + 1));
    };
    const Search near = within(10.0), far = within(1e12);
    double worst = 0.0;
    for (int i = 0; i < problem.n(); ++i) {
      worst = std::max(worst, std::abs(far.best[i] / near.best[i] - 1.0));
    }
    const double ratio = static_cast<double>(far.trials()) / near.trials();
    ++count;
    alike += worst < 0.01 && ratio < 1.2;
    if (lists) {
      fmt::print("    {:36} differs by {:.1e}, {} and {} trials\n",
                 problem.name,
                 worst,
                 near.trials(),
                 far.trials());
    }
  }
  table.full_row(
      fmt::format("{}, bounds of 1e12 against 10: same end, 20 % more trials at most", which.name),
      fmt::format("{} of {}", alike, count),
      "all",
      alike == count);
}

int bench(const Options& options) {
  const bool is_tuning = options.has("--tuning");
  Table table("search_noise", options);
  std::vector<Half> halves{{"tuning", false}};
  if (!is_tuning) halves.push_back({"held-out", true});
  for (const Half& which : halves) {
    noise_rows(table, which, options, is_tuning);
    leap_rows(table, which, options, is_tuning);
    wide_rows(table, which, options, is_tuning);
    bound_rows(table, which, options, is_tuning);
  }
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  return run_benchmark(
      argc, argv, {{"--tuning", "", "that half alone, and how every run ends"}}, bench);
}
