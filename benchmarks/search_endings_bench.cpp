// SPDX-License-Identifier: Apache-2.0
// The statements with which the optimizer `auto`, as shipped, ends, and how many of them are false.
//
// Every search is left to its own end, or to 100 (n + 1) evaluations. Another method judges the
// point where it ended: Levenberg-Marquardt with slopes by central differences of the undisturbed
// residuals. S is the sum of squares.
//
//   false "at a minimum"       that method, started there, gains more than 1 % of the S that the
//                              search saw
//   false "nothing is left"    a variable that the statement does not name as undetermined is off
//                              its true value by more than 5 %
//   trials after the solution  from the first S that is within 1 % of that least value, or within
//                              1e-5 of the first S, to the end; in units of n + 1
//
// The problems are those of verification/identification_set. The tuning half was available while
// the endings were written; the other half is evaluated once, afterward.
//
//   search_endings             the held-out half beside the tuning half
//   search_endings --tuning    the tuning half alone, and how every run ends
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "identification_set/disturbed_problem.h"
#include "optimization/least_squares/levenberg_marquardt.h"
#include "optimization/strategy/optimizer_choice.h"
#include "table.h"

namespace {

using namespace latsch;
using namespace latsch::benchmarks;
using identification_set::DisturbedProblem;
using identification_set::Problem;
using identification_set::Variant;
using identification_set::Vector;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMost = 100;            // evaluations of a search, in units of n + 1
constexpr double kWorthAGain = 0.01;  // share of S
constexpr double kOff = 0.05;         // relative error of a variable that counts as wrong

double square(const Vector& r) {
  double sum = 0.0;
  for (const double value : r) sum += value * value;
  return std::isfinite(sum) ? sum : kInfinity;
}

struct Search {
  std::vector<double> exact;      // undisturbed S of every evaluation; infinite if it failed
  Vector best;                    // point with the least S that the search saw
  double seen = kInfinity;        // S at this point
  double exact_best = kInfinity;  // undisturbed S at this point
  std::string ending;             // empty: the search did not end
  int trials() const { return static_cast<int>(exact.size()); }
};

Search search(const DisturbedProblem& on) {
  const DesignSpace& space = on.problem().space;
  const ProblemTraits traits{.variables = space.size(), .has_residuals = true};
  OptimizerSettings settings;
  settings.method = "auto";
  const auto method = make_optimizer(method_of(settings, traits).method, space, settings, traits);
  Search found;
  while (!method->converged() && found.trials() < kMost * (space.size() + 1)) {
    const DesignPoint point = method->propose(1).front();
    const auto shown = on.shown(point.values);
    const double value = shown ? square(*shown) : kInfinity;
    found.exact.push_back(on.exact(point.values));
    if (value < found.seen) {
      found.seen = value;
      found.best = point.values;
      found.exact_best = found.exact.back();
    }
    if (value < kInfinity) {
      method->observe(point, Score{value, *shown});
    } else {
      method->observe(point, Failure{"no outcome"});
    }
  }
  found.ending = method->ending();
  return found;
}

/// Returns the undisturbed residuals and their slopes by central differences, or by one-sided ones
/// beside a bound or a failure.
Result<Score> exact_score(const DisturbedProblem& on, const DesignPoint& point) {
  constexpr double kMove = 1e-6;  // share of a range or of a decade
  const Problem& problem = on.problem();
  if (on.fails(point.values)) return Failure{"no outcome"};
  const Vector r = problem.residuals(point.values);
  if (!(square(r) < kInfinity)) return Failure{"not finite"};
  Score score{square(r), r};
  const auto n = static_cast<std::size_t>(problem.n());
  score.jacobian.assign(r.size() * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const DesignVariable& variable = problem.space[static_cast<int>(i)];
    const double size =
        variable.scale == Scale::logarithmic
            ? std::abs(point.values[i])
            : std::max(std::abs(point.values[i]), 1e-3 * (variable.upper - variable.lower));
    Vector up = point.values, down = point.values;
    up[i] = std::min(up[i] + kMove * size, variable.upper);
    down[i] = std::max(down[i] - kMove * size, variable.lower);
    const Vector r_up = problem.residuals(up), r_down = problem.residuals(down);
    for (std::size_t k = 0; k < r.size(); ++k)
      score.jacobian[k * n + i] = (r_up[k] - r_down[k]) / (up[i] - down[i]);
  }
  for (const double slope : score.jacobian)
    if (!std::isfinite(slope)) return Failure{"not finite"};
  return score;
}

/// Returns the least undisturbed S to which Levenberg-Marquardt leads from the point.
double downhill(const DisturbedProblem& on, const Vector& from) {
  std::vector<DesignVariable> variables = on.problem().space.variables();
  for (std::size_t i = 0; i < variables.size(); ++i)
    variables[i].initial = std::clamp(from[i], variables[i].lower, variables[i].upper);
  LevenbergMarquardt method(
      DesignSpace(variables),
      {.initial_step = 1e-2, .step_tolerance = 1e-10, .gain_tolerance = 1e-12});
  double least = kInfinity;
  constexpr int kMostSteps = 300;
  for (int k = 0; k < kMostSteps && !method.converged(); ++k) {
    const DesignPoint point = method.propose(1).front();
    const Result<Score> score = exact_score(on, point);
    if (score) least = std::min(least, score->value);
    method.observe(point, score);
  }
  return least;
}

/// Returns the names of the variables that are off their true values.
std::vector<std::string> wrong_variables(const Problem& problem, const Vector& best) {
  std::vector<std::string> names;
  for (int i = 0; i < problem.n(); ++i)
    if (std::abs(best[i] - problem.truth[i]) > kOff * std::abs(problem.truth[i]))
      names.push_back(problem.space[i].name);
  return names;
}

bool begins(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }

/// Counts over the runs of one class of problems.
struct Count {
  int runs = 0, ended = 0;
  int at_minimum = 0, false_minimum = 0;
  int nothing_left = 0, false_nothing = 0;
  std::vector<double> after;  // trials from solved to ended, in units of n + 1
};

void judge(const DisturbedProblem& on, Count& count, bool lists) {
  const Problem& problem = on.problem();
  const Search run = search(on);
  const double units = problem.n() + 1.0;
  const double least = std::min(run.exact_best, downhill(on, run.best));
  const double start = run.exact.front();
  const double solved_below = least + std::max(kWorthAGain * least, 1e-5 * (start - least));
  const auto solved = std::find_if(
      run.exact.begin(), run.exact.end(), [&](double value) { return value <= solved_below; });
  ++count.runs;
  const bool is_ended = !run.ending.empty();
  count.ended += is_ended;
  if (is_ended && solved != run.exact.end())
    count.after.push_back(static_cast<double>(run.exact.end() - solved - 1) / units);
  const double gain = (run.exact_best - least) / run.seen;
  std::string verdict;
  if (begins(run.ending, "at a minimum")) {
    ++count.at_minimum;
    if (gain > kWorthAGain) verdict = fmt::format("FALSE: {:.2g} of S is left to gain", gain);
    count.false_minimum += !verdict.empty();
  } else if (begins(run.ending, "with nothing left")) {
    ++count.nothing_left;
    for (const std::string& name : wrong_variables(problem, run.best))
      if (run.ending.find('"' + name + '"') == std::string::npos) verdict += " " + name;
    if (!verdict.empty()) verdict = "FALSE: wrong are" + verdict;
    count.false_nothing += !verdict.empty();
  }
  if (!lists) return;
  fmt::print("    {:36} {:2} S {:.1e} of {:.1e}, {:4.1f} of {:4.1f}, {} {}\n",
             problem.name,
             problem.n(),
             run.seen,
             start,
             is_ended && solved != run.exact.end() ? count.after.back() : 0.0,
             run.trials() / units,
             is_ended ? run.ending.substr(0, 70) : "not ended",
             verdict);
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * (static_cast<double>(values.size()) - 1.0) + 0.5)];
}

struct Class {
  std::string name;
  std::vector<DisturbedProblem> problems;
  double most_false;  // required share of false statements "at a minimum"; below 0: none
};

/// Returns the classes of one half of the problems. A smoke run gets two problems of each class.
std::vector<Class> classes(bool is_held_out, const Options& options) {
  std::vector<Class> all{{"smooth", {}, 0.01},
                         {"rough", {}, 0.03},
                         {"failing", {}, 0.03},
                         {"wide", {}, 0.01},
                         {"exact", {}, 0.01}};
  const auto add = [&](Class& to, const Problem& problem, Variant variant, int number) {
    if (problem.is_held_out != is_held_out) return;
    if (options.is_smoke() && to.problems.size() >= 2) return;
    to.problems.emplace_back(problem, variant, number);
  };
  int number = 0;
  for (const Problem& problem : identification_set::problems()) {
    add(all[0], problem, Variant::smooth, number);
    add(all[1], problem, Variant::rough, number);
    add(all[2], problem, Variant::failing, number++);
  }
  for (const Problem& problem : identification_set::wide_problems()) {
    add(all[3], problem, Variant::smooth, 0);
    // Without the error of its data the same problem has a fit that leaves no residuals.
    Problem exact = problem;
    const Vector left = problem.residuals(problem.truth);
    exact.residuals = [residuals = problem.residuals, left](const Vector& x) {
      Vector r = residuals(x);
      for (std::size_t i = 0; i < r.size(); ++i) r[i] -= left[i];
      return r;
    };
    add(all[4], exact, Variant::smooth, 0);
  }
  return all;
}

void rows(Table& table, const char* half, bool is_held_out, const Options& options, bool lists) {
  std::vector<double> after;
  int false_nothing = 0;
  for (const Class& one : classes(is_held_out, options)) {
    Count count;
    for (const DisturbedProblem& problem : one.problems) judge(problem, count, lists);
    const std::string what = fmt::format("{}, {}", half, one.name);
    table.note(
        what + ": runs, ended, at a minimum, nothing left",
        fmt::format("{} {} {} {}", count.runs, count.ended, count.at_minimum, count.nothing_left));
    table.full_row(what + ": false \"at a minimum\"",
                   fmt::format("{} of {}", count.false_minimum, count.at_minimum),
                   fmt::format("<= {:g} %", 100.0 * one.most_false),
                   count.false_minimum <= one.most_false * count.at_minimum);
    table.note(
        what + ": trials after the solution, 50 and 90 %",
        fmt::format(
            "{:.1f} {:.1f} (n + 1)", quantile(count.after, 0.5), quantile(count.after, 0.9)));
    after.insert(after.end(), count.after.begin(), count.after.end());
    false_nothing += count.false_nothing;
  }
  table.full_row(fmt::format("{}: false \"nothing is left\"", half),
                 fmt::format("{}", false_nothing),
                 "0",
                 false_nothing == 0);
  for (const auto& [share, most] : {std::pair(0.5, 3.0), std::pair(0.9, 6.0)}) {
    table.full_row(fmt::format("{}: trials after the solution, {:g} %", half, 100.0 * share),
                   fmt::format("{:.1f} (n + 1)", quantile(after, share)),
                   fmt::format("<= {:g}", most),
                   quantile(after, share) <= most);
  }
}

int bench(const Options& options) {
  const bool is_tuning = options.has("--tuning");
  Table table("search_endings", options);
  rows(table, "tuning", false, options, is_tuning);
  if (!is_tuning) rows(table, "held-out", true, options, false);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  return run_benchmark(
      argc, argv, {{"--tuning", "", "that half alone, and how every run ends"}}, bench);
}
