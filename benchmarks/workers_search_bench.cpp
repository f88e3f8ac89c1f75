// SPDX-License-Identifier: Apache-2.0
// The worth of many workers to the residual trust region, in virtual time.
//
// As many workers as the batch has places evaluate points of the smooth problems of
// verification/identification_set. The time of an evaluation is lognormal (deviation 0.4 of the
// logarithm, mean 1), drawn from the point's bits. Outcomes are observed in the order of proposals,
// so a place waits for the slowest point before it. The yardstick is the serial search as shipped.
// A row states the median over problems of the serial time over the parallel time at which the
// value falls to 1e-3 of its first one, and of the trials begun until then over those of the serial
// search.
//
//   workers_search             the held-out half beside the tuning half
//   workers_search --tuning    the tuning half alone, and every run
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/random.h"
#include "identification_set/identification_problems.h"
#include "optimization/trust_region/residual_trust_region.h"
#include "table.h"

namespace {

using namespace latsch;
using namespace latsch::benchmarks;
using identification_set::Problem;

constexpr double kDeviation = 0.4;  // deviation of the logarithm of an evaluation's time
constexpr double kTau = 1e-3;
constexpr int kMost = 40;  // largest time of a search, in units of n + 1 mean evaluations
constexpr int kDraws = 3;

double square_of(const std::vector<double>& r) {
  double sum = 0.0;
  for (const double value : r) sum += value * value;
  return sum;
}

/// Returns the time of an evaluation, which is the same for the same point in every search.
double duration(const DesignPoint& point, int draw) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : point.bits()) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  }
  RandomStream random(71 + draw, hash);
  return std::exp(kDeviation * random.normal() - 0.5 * kDeviation * kDeviation);
}

struct Outcome {
  double time = std::numeric_limits<double>::infinity();  // at which the search was solved
  double trials = 0.0;                                    // begun until then
  bool is_solved() const { return std::isfinite(time); }
};

/// Runs a search with as many workers as the batch has places. With a batch of 1 and more workers
/// the idle ones evaluate points that the search would propose next.
Outcome run(const Problem& problem, double below, int batch, int workers, int draw) {
  ResidualTrustRegion method(problem.space, {.outstanding = batch});
  struct Begun {
    DesignPoint point;
    double end;
  };
  std::vector<Begun> begun;
  const auto find = [&](const DesignPoint& point) {
    return std::find_if(
        begun.begin(), begun.end(), [&](const Begun& b) { return b.point == point; });
  };
  double time = 0.0;
  while (!method.converged() && time < kMost * (problem.n() + 1.0)) {
    const auto plan = method.propose(workers);
    for (const DesignPoint& point : plan) {
      const auto busy =
          std::count_if(begun.begin(), begun.end(), [&](const Begun& b) { return b.end > time; });
      if (busy >= workers) break;
      if (find(point) == begun.end()) begun.push_back({point, time + duration(point, draw)});
    }
    auto first = find(plan.front());
    while (first == begun.end()) {  // all workers are busy with points that are withdrawn
      double free = std::numeric_limits<double>::infinity();
      for (const Begun& b : begun)
        if (b.end > time) free = std::min(free, b.end);
      time = free;
      begun.push_back({plan.front(), time + duration(plan.front(), draw)});
      first = begun.end() - 1;
    }
    time = std::max(time, first->end);
    const DesignPoint point = first->point;
    Score score{0.0, problem.residuals(point.values)};
    score.value = square_of(score.residuals);
    if (score.value <= below) return {time, static_cast<double>(begun.size())};
    method.observe(point,
                   std::isfinite(score.value) ? Result<Score>(score) : Failure{"not finite"});
  }
  return {};
}

/// Returns the least value that a long serial search from the true values finds.
double least_of(const Problem& problem) {
  std::vector<DesignVariable> variables = problem.space.variables();
  for (std::size_t i = 0; i < variables.size(); ++i) {
    variables[i].initial = std::clamp(problem.truth[i], variables[i].lower, variables[i].upper);
  }
  ResidualTrustRegion method{DesignSpace(variables)};
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 100 * (problem.n() + 1) && !method.converged(); ++k) {
    const DesignPoint point = method.propose(1).front();
    Score score{0.0, problem.residuals(point.values)};
    score.value = square_of(score.residuals);
    least = std::min(least, score.value);
    method.observe(point,
                   std::isfinite(score.value) ? Result<Score>(score) : Failure{"not finite"});
  }
  return least;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// A class of problems by their number of variables, and what is required of it.
struct Class {
  int fewest, most;
  std::map<int, std::pair<double, double>> required;  // batch: speed-up, trials
};

const std::vector<Class> kClasses{{2, 4, {{4, {1.6, 2.2}}, {16, {1.9, 6.0}}}},
                                  {5, 7, {{4, {2.0, 1.8}}, {16, {2.3, 5.0}}}},
                                  {8, 15, {{4, {2.2, 1.6}}, {16, {3.0, 3.7}}}}};

void rows_of(Table& table,
             const std::string& half,
             const std::vector<Problem>& problems,
             bool lists) {
  for (const Class& group : kClasses) {
    const std::string variables = fmt::format("{} to {} variables", group.fewest, group.most);
    struct Places {
      int batch, workers;
    };
    for (const auto [batch, workers] : {Places{4, 4}, Places{16, 16}, Places{1, 16}}) {
      std::vector<double> speedups, trials;
      int lost = 0;
      for (const Problem& problem : problems) {
        if (problem.n() < group.fewest || problem.n() > group.most) continue;
        const double start = square_of(problem.residuals(problem.space.initial().values));
        const double least = least_of(problem);
        const double below = least + kTau * (start - least);
        for (int draw = 0; draw < kDraws; ++draw) {
          const Outcome serial = run(problem, below, 1, 1, draw);
          const Outcome parallel = run(problem, below, batch, workers, draw);
          lost += serial.is_solved() && !parallel.is_solved();
          if (!serial.is_solved()) continue;
          speedups.push_back(serial.time / parallel.time);
          trials.push_back(parallel.trials / serial.trials);
          if (!lists) continue;
          fmt::print("    {:36} {:2}  batch {:2}: {:5.1f} of {:5.1f}, {:4.0f} trials of {:3.0f}\n",
                     problem.name,
                     problem.n(),
                     batch,
                     parallel.time,
                     serial.time,
                     parallel.trials,
                     serial.trials);
        }
      }
      const double speedup = median(speedups), spent = median(trials);
      const std::string what =
          fmt::format("{}, {}, batch {} on {} workers", half, variables, batch, workers);
      const std::string value = fmt::format(
          "{:.1f} times as fast, {:.1f} times the trials, {} lost", speedup, spent, lost);
      if (!group.required.contains(batch)) {
        table.note(what, value);
        continue;
      }
      const auto [fast, few] = group.required.at(batch);
      table.full_row(what,
                     value,
                     fmt::format(">= {:.1f}, <= {:.1f}, 0", fast, few),
                     speedup >= fast && spent <= few && lost == 0);
    }
  }
}

int bench(const Options& options) {
  const bool is_tuning = options.has("--tuning");
  Table table("workers_search", options);
  const auto half = [&](std::vector<Problem> problems) {
    if (options.is_smoke()) problems.resize(2, problems.front());
    return problems;
  };
  rows_of(table, "tuning", half(identification_set::tuning_problems()), is_tuning);
  if (!is_tuning) rows_of(table, "held-out", half(identification_set::held_out_problems()), false);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  return run_benchmark(argc, argv, {{"--tuning", "", "that half alone, and every run"}}, bench);
}
