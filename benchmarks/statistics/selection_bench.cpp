// SPDX-License-Identifier: Apache-2.0
// Choice of the coefficients that values carry, on random linear models with a known answer.
//
// 180 candidates are in groups of four, whose columns are correlated by 0.5; 40 are true, of sizes
// of 4 to 40 standard deviations of the fit of all candidates. Twelve recordings of 60 values with
// Gaussian noise of unknown size are fitted, and twelve more are predicted. A true coefficient is
// felt if it is larger than five deviations. Each row is the mean over the sets. The sets of the
// reserve were not looked at while constants were chosen.
//
// Intervals of the chosen model are wrong in two ways: the values that are to be covered also chose
// (winner's curse), and a missed coefficient moves those that act alike. An interval of the first
// kind should hold the coefficient of the chosen model's own best fit without noise; the true one
// is counted, too.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/random.h"
#include "numerics/dense/cholesky.h"
#include "optimization/selection/coefficient_selection.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

constexpr double kNoise = 0.2;                 // deviation of a value
constexpr double kFelt = 5.0;                  // deviations
constexpr double kFewest = 4.0, kMost = 40.0;  // sizes of true coefficients, in deviations

struct Size {
  int candidates = 180, truths = 40, recordings = 12, values = 60;
  int rows() const { return recordings * values; }
};

/// A random model: coefficients are 2 u - 1 of the unit cube.
struct RandomSet {
  Eigen::MatrixXd X, X_new;
  Eigen::VectorXd b, y, y_new, deviations;
  std::vector<int> recordings;
};

Eigen::MatrixXd grouped_columns(int rows, int columns, RandomStream& random) {
  constexpr int kGroup = 4;
  Eigen::MatrixXd X(rows, columns);
  for (int row = 0; row < rows; ++row) {
    double common = 0.0;
    for (int j = 0; j < columns; ++j) {
      if (j % kGroup == 0) common = random.normal();
      X(row, j) = std::sqrt(0.5) * (common + random.normal());
    }
  }
  return X;
}

Eigen::VectorXd noise_of(int rows, RandomStream& random) {
  Eigen::VectorXd e(rows);
  for (double& one : e) one = kNoise * random.normal();
  return e;
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  return numerics::Cholesky(X.transpose() * X).solve(Eigen::VectorXd(X.transpose() * y));
}

RandomSet random_set(const Size& size, std::uint64_t number) {
  RandomStream random(71, number);
  RandomSet set;
  set.X = grouped_columns(size.rows(), size.candidates, random);
  set.X_new = grouped_columns(size.rows(), size.candidates, random);
  const Eigen::MatrixXd inverse =
      numerics::PivotedCholesky(set.X.transpose() * set.X)
          .solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(size.candidates, size.candidates)));
  set.deviations = kNoise * inverse.diagonal().cwiseSqrt();
  set.b = Eigen::VectorXd::Zero(size.candidates);
  for (int count = 0; count < size.truths;) {
    const auto j = static_cast<Eigen::Index>(random.uniform() * size.candidates);
    if (set.b[j] != 0.0) continue;
    const double ratio = kFewest * std::pow(kMost / kFewest, random.uniform());
    set.b[j] = (random.uniform() < 0.5 ? -1.0 : 1.0) * ratio * set.deviations[j];
    ++count;
  }
  set.y = set.X * set.b + noise_of(size.rows(), random);
  set.y_new = set.X_new * set.b + noise_of(size.rows(), random);
  for (int row = 0; row < size.rows(); ++row) set.recordings.push_back(row / size.values);
  return set;
}

CoefficientSelection selected(const RandomSet& set,
                              SelectionProblem problem,
                              const SelectionOptions& options) {
  problem.recordings = set.recordings;
  CoefficientSelection selection(std::move(problem), options);
  while (!selection.wanted().empty()) {
    std::vector<Result<Evaluated>> outcomes;
    for (const Eigen::VectorXd& u : selection.wanted()) {
      const Eigen::VectorXd c = 2.0 * u.array() - 1.0;
      outcomes.emplace_back(Evaluated(set.X * c - set.y, 2.0 * set.X));
      if (selection.is_enough(outcomes.front())) break;
    }
    selection.observe(outcomes);
  }
  return selection;
}

SelectionProblem problem_of(const RandomSet& set) {
  SelectionProblem problem;
  problem.start = Eigen::VectorXd::Constant(set.b.size(), 0.5);
  problem.toward = problem.start;
  for (int j = 0; j < set.b.size(); ++j) problem.units.push_back({j});
  return problem;
}

/// Sums over sets.
struct Counts {
  int sets = 0, felt = 0, missed = 0, wrong = 0, refits = 0, most_refits = 0, most_missed = 0,
      most_wrong = 0, limited = 0;
  double noisy_ratio = 0.0, exact_ratio = 0.0, most_ratio = 0.0;
  // numbers of intervals, and of those that hold; as projected, and true
  long own = 0, own_projected = 0, own_true = 0;
  long honest = 0, honest_projected = 0, honest_true = 0;
};

double root_mean_square(const Eigen::VectorXd& e) {
  return e.norm() / std::sqrt(static_cast<double>(e.size()));
}

/// Counts the intervals of the kept coefficients that hold, in the fit of these rows.
void count_intervals(const RandomSet& set,
                     const CoefficientSelection& selection,
                     const std::vector<int>& kept,
                     const std::vector<int>& rows,
                     long& all,
                     long& projected,
                     long& truly) {
  const Confidence c = selection.confidence_of(selection.path()[selection.best()]);
  const Eigen::MatrixXd X = set.X(rows, kept);
  const Eigen::VectorXd best = least_squares(X, set.X(rows, Eigen::all) * set.b);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Interval& interval = c.intervals[static_cast<std::size_t>(kept[k])];
    const auto holds = [&](double b) {
      const double u = 0.5 * (b + 1.0);
      return interval.lower <= u && u <= interval.upper;
    };
    ++all;
    projected += holds(best[static_cast<Eigen::Index>(k)]);
    truly += holds(set.b[kept[k]]);
  }
}

std::vector<int> rows_of(const RandomSet& set, const std::vector<int>& recordings) {
  std::vector<int> rows;
  for (std::size_t row = 0; row < set.recordings.size(); ++row)
    if (recordings.empty() ||
        std::find(recordings.begin(), recordings.end(), set.recordings[row]) != recordings.end())
      rows.push_back(static_cast<int>(row));
  return rows;
}

void add_set(const RandomSet& set, const SelectionOptions& options, Counts& counts) {
  const CoefficientSelection selection = selected(set, problem_of(set), options);
  const SelectedModel& best = selection.path()[selection.best()];
  const std::set<int> kept(best.units.begin(), best.units.end());
  int missed = 0, wrong = 0;
  std::vector<int> truths;
  for (int j = 0; j < set.b.size(); ++j) {
    const bool is_felt = std::abs(set.b[j]) > kFelt * set.deviations[j];
    counts.felt += is_felt;
    missed += is_felt && !kept.contains(j);
    wrong += set.b[j] == 0.0 && kept.contains(j);
    if (set.b[j] != 0.0) truths.push_back(j);
  }
  ++counts.sets;
  counts.missed += missed;
  counts.wrong += wrong;
  counts.refits += selection.refits();
  counts.most_refits = std::max(counts.most_refits, selection.refits());
  counts.limited += selection.ending() == SelectionEnd::refits;
  counts.most_missed = std::max(counts.most_missed, missed);
  counts.most_wrong = std::max(counts.most_wrong, wrong);
  const Eigen::VectorXd c = 2.0 * best.at.u.array() - 1.0;
  const Eigen::VectorXd of_truth = least_squares(set.X(Eigen::all, truths), set.y);
  const Eigen::VectorXd predicted = set.X_new * c,
                        by_truth = set.X_new(Eigen::all, truths) * of_truth;
  const double ratio =
      root_mean_square(predicted - set.y_new) / root_mean_square(by_truth - set.y_new);
  counts.noisy_ratio += ratio;
  counts.most_ratio = std::max(counts.most_ratio, ratio);
  const Eigen::VectorXd exact = set.X_new * set.b;
  counts.exact_ratio += root_mean_square(predicted - exact) / root_mean_square(by_truth - exact);
  count_intervals(set,
                  selection,
                  best.units,
                  rows_of(set, {}),
                  counts.own,
                  counts.own_projected,
                  counts.own_true);
}

/// Chooses on every second recording and refits the chosen coefficients on the others.
void add_honest(const RandomSet& set, const SelectionOptions& options, Counts& counts) {
  std::vector<int> choosing, refitted;
  for (int k = 0; k <= set.recordings.back(); ++k) (k % 2 == 0 ? choosing : refitted).push_back(k);
  SelectionProblem problem = problem_of(set);
  problem.fitted = choosing;
  const CoefficientSelection choice = selected(set, problem, options);
  const SelectedModel& best = choice.path()[choice.best()];
  SelectionProblem again;
  again.start = best.at.u;
  again.toward = problem.toward;
  again.free = best.units;
  again.fitted = refitted;
  const CoefficientSelection refit = selected(set, again, options);
  count_intervals(set,
                  refit,
                  best.units,
                  rows_of(set, refitted),
                  counts.honest,
                  counts.honest_projected,
                  counts.honest_true);
}

double share(long part, long all) {
  return all > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(all) : 0.0;
}

void add_rows(Table& table, const std::string& name, const Counts& counts) {
  const double sets = counts.sets;
  const double missed = counts.missed / sets, wrong = counts.wrong / sets;
  table.row(
      name + ": felt coefficients missed",
      fmt::format("{:.2f} of {:.1f}, at most {}", missed, counts.felt / sets, counts.most_missed),
      "<= 2",
      missed <= 2.0);
  table.row(name + ": useless coefficients kept",
            fmt::format("{:.2f}, at most {}", wrong, counts.most_wrong),
            "<= 2",
            wrong <= 2.0);
  table.row(name + ": refits",
            fmt::format("{:.1f}, at most {}", counts.refits / sets, counts.most_refits),
            "<= 20",
            counts.most_refits <= 20);
  table.note(name + ": sets whose path the limit of refits ended",
             fmt::format("{} of {}", counts.limited, counts.sets));
  table.row(name + ": prediction error over that of the true subset",
            fmt::format("{:.3f}, at most {:.3f}", counts.noisy_ratio / sets, counts.most_ratio),
            "<= 1.05",
            counts.noisy_ratio / sets <= 1.05);
  table.note(name + ": the same without noise in the predicted values",
             fmt::format("{:.3f}", counts.exact_ratio / sets));
  const double honest = share(counts.honest_projected, counts.honest);
  table.row(name + ": intervals of a split hold, chosen model",
            fmt::format("{:.1f} %", honest),
            "93 .. 97 %",
            honest >= 93.0 && honest <= 97.0);
  table.note(name + ": intervals of a split hold, true coefficients",
             fmt::format("{:.1f} %", share(counts.honest_true, counts.honest)));
  table.note(name + ": without a split, chosen model",
             fmt::format("{:.1f} %", share(counts.own_projected, counts.own)));
  table.note(name + ": without a split, true coefficients",
             fmt::format("{:.1f} %", share(counts.own_true, counts.own)));
}

Counts counts_of(const Size& size, int from, int to) {
  Counts counts;
  for (int k = from; k < to; ++k) {
    const RandomSet set = random_set(size, static_cast<std::uint64_t>(k));
    add_set(set, {}, counts);
    add_honest(set, {}, counts);
  }
  return counts;
}

int run(const Options& options) {
  Table table("selection", options);
  if (options.is_smoke()) {
    add_rows(table,
             "24 candidates, 6 true",
             counts_of({.candidates = 24, .truths = 6, .recordings = 6, .values = 20}, 0, 12));
    return table.exit_code();
  }
  const int sets = static_cast<int>(options.integer("--sets", 20));
  add_rows(table, "180 candidates, 40 true", counts_of({}, 0, sets));
  if (!options.has("--without-reserve"))
    add_rows(table, "reserve", counts_of({}, 1000, 1000 + sets));
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  using namespace latsch::benchmarks;
  return run_benchmark(argc,
                       argv,
                       {{"--sets", "N", "random sets, 20 unless given"},
                        {"--without-reserve", "", "leaves out the sets of the reserve"}},
                       run);
}
