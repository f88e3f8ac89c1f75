// SPDX-License-Identifier: Apache-2.0
// The global search by basins on sums of squares with several minima, beside many searches from
// random starts, and what it costs where there is one basin.
//
// A run is solved once the sum of squares is at most a thousandth of the median at random points.
// Budgets count in n + 1. The even kinds of problems (multimodal_problems.h) were available
// while constants were chosen, the odd ones are evaluated once, afterward. A basin that exists is a
// minimum that more than 5 % of 100 random starts lead to.
//
//   basins             the held-out half beside the tuning half
//   basins --tuning    the tuning half alone, and every run
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/random.h"
#include "identification_set/identification_problems.h"
#include "multimodal_problems.h"
#include "optimization/problem/point_vector.h"
#include "optimization/strategy/basin_search.h"
#include "optimization/strategy/optimizer_choice.h"
#include "optimization/trust_region/residual_trust_region.h"
#include "table.h"

namespace {

using namespace latsch;
using namespace latsch::benchmarks;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSolved = 1e-3;
constexpr int kSeeds = 8, kMost = 300;
constexpr int kBudgets[] = {30, 100, 300};
constexpr double kSame = 0.02;  // largest distance of places of one minimum, in the unit cube

double square(const std::vector<double>& r) {
  double sum = 0.0;
  for (const double value : r) sum += value * value;
  return std::isfinite(sum) ? sum : kInfinity;
}

std::unique_ptr<Optimizer> local(const DesignSpace& space) {
  return std::make_unique<ResidualTrustRegion>(
      space, ResidualTrustRegionOptions{.restarts = 0, .tests_end = false});
}

DesignPoint random_point(const DesignSpace& space, RandomStream& random) {
  std::vector<double> u(static_cast<std::size_t>(space.size()));
  for (double& one : u) one = random.uniform();
  return space.from_unit(u);
}

struct Search {
  std::vector<double> values;  // in the order of the evaluations
  DesignPoint best;
  double least = kInfinity;
};

/// Runs a search to its end, or until it has evaluated `most` points in all.
void run(Optimizer& method,
         const std::function<std::vector<double>(const std::vector<double>&)>& residuals,
         int most,
         Search& found) {
  while (!method.converged() && std::ssize(found.values) < most) {
    const DesignPoint point = method.propose(1).front();
    Score score{0.0, residuals(point.values)};
    score.value = square(score.residuals);
    found.values.push_back(score.value);
    if (score.value < found.least) {
      found.least = score.value;
      found.best = point;
    }
    method.observe(point, score.value < kInfinity ? Result<Score>(score) : Failure{"not finite"});
  }
}

/// Searches from random starts, one after the other, for the whole budget.
Search random_starts(const MultimodalProblem& problem, std::uint64_t seed, int most) {
  RandomStream random(5, seed);
  Search all;
  DesignSpace space = problem.space;
  while (std::ssize(all.values) < most) {
    const auto method = local(space);
    all.least = kInfinity;
    run(*method, problem.residuals, most, all);
    space = problem.space.starting_at(random_point(problem.space, random));
  }
  return all;
}

double solved_after(const Search& search, double below, int n) {
  const auto first = std::find_if(
      search.values.begin(), search.values.end(), [&](double value) { return value <= below; });
  if (first == search.values.end()) return kInfinity;
  return static_cast<double>(first - search.values.begin() + 1) / (n + 1.0);
}

double median_of_random_points(const MultimodalProblem& problem) {
  RandomStream random(9, 0);
  std::vector<double> values;
  for (int k = 0; k < 101; ++k)
    values.push_back(square(problem.residuals(random_point(problem.space, random).values)));
  std::nth_element(values.begin(), values.begin() + 50, values.end());
  return values[50];
}

bool is_near(const DesignSpace& space, const DesignPoint& a, const DesignPoint& b) {
  return (to_vector(space.to_unit(a)) - to_vector(space.to_unit(b))).lpNorm<Eigen::Infinity>() <
         kSame;
}

/// Returns the minima that more than 5 % of random starts lead to.
std::vector<DesignPoint> large_basins(const MultimodalProblem& problem, int starts) {
  constexpr double kShare = 0.05;
  RandomStream random(6, 0);
  std::vector<std::pair<DesignPoint, int>> ends;
  for (int k = 0; k < starts; ++k) {
    Search one;
    const auto method = local(problem.space.starting_at(random_point(problem.space, random)));
    run(*method, problem.residuals, 100 * (problem.n() + 1), one);
    if (!method->converged()) continue;
    const auto same = std::find_if(ends.begin(), ends.end(), [&](const auto& end) {
      return is_near(problem.space, end.first, one.best);
    });
    if (same == ends.end())
      ends.emplace_back(one.best, 1);
    else
      ++same->second;
  }
  std::vector<DesignPoint> large;
  for (const auto& [point, count] : ends)
    if (count > kShare * starts) large.push_back(point);
  return large;
}

struct Outcome {
  std::vector<double> basins, starts;  // budgets at which runs were solved
  int found = 0, exist = 0;            // large basins
  int worst_behind = 0;                // runs of eight that random starts solve and basins do not
};

void add_kind(int kind, const Options& options, bool lists, Outcome& outcome) {
  const int seeds = options.size(kSeeds, 1), budget = options.size(kMost, 30);
  std::vector<double> basins, starts;
  int found = 0, exist = 0;
  std::string name, endings;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto problem = multimodal_problem(kind, static_cast<std::uint64_t>(seed));
    name = fmt::format("{} (n = {})", problem.name, problem.n());
    const double below = kSolved * median_of_random_points(problem);
    const int most = budget * (problem.n() + 1);
    BasinSearch method(
        problem.space, {.budget = budget, .seed = static_cast<std::uint64_t>(seed)}, local);
    Search search;
    run(method, problem.residuals, most, search);
    basins.push_back(solved_after(search, below, problem.n()));
    starts.push_back(solved_after(
        random_starts(problem, static_cast<std::uint64_t>(seed), most), below, problem.n()));
    endings += fmt::format(" {:.0f}:{}",
                           static_cast<double>(search.values.size()) / (problem.n() + 1),
                           method.basins().size());
    if (seed > 2) continue;
    for (const DesignPoint& large : large_basins(problem, options.size(100, 5))) {
      ++exist;
      for (const FoundBasin& basin : method.basins())
        if (is_near(problem.space, basin.minimum, large)) {
          ++found;
          break;
        }
    }
  }
  for (const int budget : kBudgets) {
    const auto solved = [&](const std::vector<double>& times) {
      return static_cast<int>(
          std::count_if(times.begin(), times.end(), [&](double time) { return time <= budget; }));
    };
    outcome.worst_behind = std::max(outcome.worst_behind, solved(starts) - solved(basins));
  }
  if (lists)
    fmt::print(
        "    {:26} basins {:.0f}\n    {:26} starts {:.0f}\n    {:26} ended after:basins{}; {} of "
        "{} large "
        "basins\n",
        name,
        fmt::join(basins, " "),
        "",
        fmt::join(starts, " "),
        "",
        endings,
        found,
        exist);
  outcome.basins.insert(outcome.basins.end(), basins.begin(), basins.end());
  outcome.starts.insert(outcome.starts.end(), starts.begin(), starts.end());
  outcome.found += found;
  outcome.exist += exist;
}

double share(const std::vector<double>& times, int budget) {
  return static_cast<double>(
             std::count_if(times.begin(), times.end(), [&](double t) { return t <= budget; })) /
         static_cast<double>(times.size());
}

void multimodal_rows(Table& table, bool is_held_out, const Options& options, bool lists) {
  const std::string half = is_held_out ? "held-out" : "tuning";
  Outcome outcome;
  for (int kind = is_held_out ? 1 : 0; kind < options.size(kMultimodalKinds, 2); kind += 2)
    add_kind(kind, options, lists, outcome);
  constexpr double kReach[] = {0.75, 0.86, 0.90};
  for (int b = 0; b < 3; ++b)
    table.full_row(fmt::format("{}, solved within {} (n + 1) (random starts {:.2f})",
                               half,
                               kBudgets[b],
                               share(outcome.starts, kBudgets[b])),
                   fmt::format("{:.2f}", share(outcome.basins, kBudgets[b])),
                   fmt::format(">= {:.2f}", kReach[b]),
                   share(outcome.basins, kBudgets[b]) >= kReach[b]);
  table.full_row(half + ", most runs of a problem behind random starts",
                 fmt::format("{}", outcome.worst_behind),
                 "<= 1",
                 outcome.worst_behind <= 1);
  table.full_row(half + ", basins of more than 5 % of random starts found",
                 fmt::format("{} of {}", outcome.found, outcome.exist),
                 "95 %",
                 outcome.found >= 0.95 * outcome.exist);
}

/// Prints, for each problem with one basin, the trials of the search by basins relative to those of
/// the shipped search to its end.
void single_rows(Table& table, bool is_held_out, const Options& options, bool lists) {
  std::vector<double> ratios;
  for (const auto& problem : is_held_out ? identification_set::held_out_problems()
                                         : identification_set::tuning_problems()) {
    if (options.is_smoke() && ratios.size() > 1) break;
    const ProblemTraits traits{.variables = problem.n(), .has_residuals = true};
    Search plain, global;
    const auto method =
        make_optimizer(Method::residual_trust_region, problem.space, OptimizerSettings{}, traits);
    const int budget = options.size(kMost, 30);
    run(*method, problem.residuals, budget * (problem.n() + 1), plain);
    BasinSearch basins(problem.space, {.budget = budget, .seed = 1}, local);
    run(basins, problem.residuals, budget * (problem.n() + 1), global);
    ratios.push_back(static_cast<double>(global.values.size()) /
                     static_cast<double>(plain.values.size()));
    if (lists)
      fmt::print("    {:36} {:2} plain {:5.1f}, basins {:5.1f}, {} found, {:.1e} and {:.1e}\n",
                 problem.name,
                 problem.n(),
                 static_cast<double>(plain.values.size()) / (problem.n() + 1),
                 static_cast<double>(global.values.size()) / (problem.n() + 1),
                 basins.basins().size(),
                 plain.least,
                 global.least);
  }
  std::sort(ratios.begin(), ratios.end());
  const double median = ratios[ratios.size() / 2];
  table.full_row(fmt::format("{}, trials over those of the plain search, smooth problems, median",
                             is_held_out ? "held-out" : "tuning"),
                 fmt::format("{:.2f}", median),
                 "<= 1.5",
                 median <= 1.5);
}

int bench(const Options& options) {
  const bool is_tuning = options.has("--tuning");
  Table table("basins", options);
  for (const bool is_held_out : {false, true}) {
    if (is_held_out && is_tuning) break;
    multimodal_rows(table, is_held_out, options, is_tuning);
    single_rows(table, is_held_out, options, is_tuning);
  }
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  return run_benchmark(argc, argv, {{"--tuning", "", "that half alone, and every run"}}, bench);
}
