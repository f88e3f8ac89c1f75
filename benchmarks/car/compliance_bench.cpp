// SPDX-License-Identifier: Apache-2.0
// Identifies the bushing stiffnesses of synthetic cars from sixteen K&C numbers each. Rows: the
// error of the fit and the coverage of its uncertainty bands.
//
//   compliance [CARS] [SEED]     default: 1000 cars of a seed not used in development
//
// The study is studies/compliance/axes.toml: thirty stiffnesses with a prior. Everything runs as in
// `latsch run`: the study and its search are read from the file, with a journal and the intervals.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "base/scratch_folder_testing.h"
#include "compliant_cars.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/search/study_fit.h"
#include "correlation/target/study_trials.h"
#include "cpu_time.h"
#include "evaluation/executors/inline_executor.h"
#include "optimization/identifiability/prediction_band.h"
#include "optimization/problem/point_vector.h"
#include "table.h"

namespace {

using namespace latsch;
using benchmarks::CompliantCar;
using benchmarks::CompliantCars;
using benchmarks::cpu_seconds;
using correlation::Study;
using correlation::StudyExperiment;

constexpr double kLevel = 0.9;      // confidence level of the bands
constexpr double kLevelOff = 0.03;  // allowed deviation of the coverage
constexpr int kFitted = 100;        // number of cars that the rows of fit error and time use
constexpr double kClose = 0.05;
constexpr int kFewestClose = 14;  // least number of K&C values, out of sixteen, that must be close

/// One K&C value (kinematics and compliance) of one car, which is either fitted or held out of the
/// fit.
struct Number {
  double error = 0.0;  // error of the fit relative to the car's value
  bool inside = false;
};

struct FittedCar {
  std::vector<Number> measured, held_out;
  double time = 0.0;       // s of CPU for the fit with its journal
  double wall_time = 0.0;  // s
  std::size_t steps = 0;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Returns dy/du of a channel with one value.
Eigen::VectorXd slopes_of(const Study& study, const DesignPoint& point, const Channel& channel) {
  Score score;
  score.residuals = channel.values;
  score.jacobian = channel.slopes;
  return study.space.unit_jacobian(point, score).transpose();
}

FittedCar fit_of(const CompliantCar& car) {
  const Study& study = car.study;
  FittedCar result;
  const auto start = std::chrono::steady_clock::now();
  const double cpu_start = cpu_seconds();
  Journal journal = Journal::open(study.run.journal, correlation::identity(study));
  InlineExecutor executor(correlation::evaluator(study));
  RunOptions options;
  options.max_steps = study.max_steps;
  const Run run = correlation::fit(study, executor, journal, options).run;
  result.time = cpu_seconds() - cpu_start;
  result.wall_time = seconds_since(start);
  result.steps = run.steps.size();
  const auto what = correlation::identify(
      study, run.best()->point, correlation::Depth::intervals, executor, journal, options);
  const correlation::Identifiability& what_at = **what;
  const Identification& identification = what_at.identification;
  const Linearization& at = identification.linearization();
  ConfidenceOptions of_level{.sigma = 1.0, .level = kLevel};
  const PredictionBands bands(at.u, confidence(at, of_level));
  const auto found = correlation::simulate_all(study, what_at.point);
  for (const StudyExperiment& experiment : study.experiments) {
    const std::string name = experiment.observable->asks().front();
    if (!experiment.fitted && !name.starts_with("E/")) continue;
    const Channel& channel = *found->find(name);
    const double truth = car.recording[name].front(), off = truth - channel.values.front();
    const PredictionBand band = bands.of(slopes_of(study, what_at.point, channel));
    Number number{std::abs(off / truth), off >= band.lower && off <= band.upper};
    (experiment.fitted ? result.measured : result.held_out).push_back(number);
  }
  return result;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Share of the K&C values of all cars that lie inside their uncertainty bands.
struct Coverage {
  double all = 0.0, least = 1.0, most = 0.0;  // least, most: shares of single outputs
  std::string text() const {
    return fmt::format("{:.1f} % ({:.1f} .. {:.1f} %)", 100 * all, 100 * least, 100 * most);
  }
  bool holds() const { return std::abs(all - kLevel) <= kLevelOff; }
};

Coverage coverage_of(const std::vector<FittedCar>& cars, std::vector<Number> FittedCar::*numbers) {
  Coverage coverage;
  const std::size_t outputs = (cars.front().*numbers).size();
  for (std::size_t k = 0; k < outputs; ++k) {
    const double inside = static_cast<double>(std::count_if(
        cars.begin(), cars.end(), [&](const FittedCar& car) { return (car.*numbers)[k].inside; }));
    const double share = inside / static_cast<double>(cars.size());
    coverage.all += share / static_cast<double>(outputs);
    coverage.least = std::min(coverage.least, share);
    coverage.most = std::max(coverage.most, share);
  }
  return coverage;
}

/// Adds rows for the first kFitted cars: error and time of the fit.
void add_fits(const std::vector<FittedCar>& cars, benchmarks::Table& table) {
  std::vector<double> errors, times, wall_times, steps;
  int close = 0;
  for (const FittedCar& car : cars) {
    for (const Number& number : car.measured) errors.push_back(number.error);
    const auto is_close = [](const Number& number) { return number.error <= kClose; };
    close += std::count_if(car.measured.begin(), car.measured.end(), is_close) >= kFewestClose;
    times.push_back(car.time);
    wall_times.push_back(car.wall_time);
    steps.push_back(static_cast<double>(car.steps));
  }
  const auto count = std::ssize(cars);
  const double time = median(times), slowest = *std::max_element(times.begin(), times.end());
  table.row(fmt::format("median error of a KPI, {} cars", count),
            fmt::format("{:.2f} %", 100 * median(errors)),
            "<= 1 %",
            median(errors) <= 0.01);
  table.row("cars with 14 of 16 KPIs within 5 %",
            fmt::format("{} of {}", close, count),
            ">= 95 %",
            close >= 0.95 * static_cast<double>(count));
  table.full_row("CPU of a fit with its journal, the median car",
                 fmt::format("{:.3f} s, {:.0f} trials", time, median(steps)),
                 "< 0.2 s",
                 time < 0.2);
  const auto slow = std::count_if(times.begin(), times.end(), [](double t) { return t >= 0.2; });
  table.full_row("cars fitted within 0.2 s of CPU",
                 fmt::format("{} of {}, slowest {:.2f} s", count - slow, count, slowest),
                 "all",
                 slow == 0);
  table.note("wall time of the median car", fmt::format("{:.3f} s", median(wall_times)));
}

void add_coverage(const std::vector<FittedCar>& cars, benchmarks::Table& table) {
  const Coverage measured = coverage_of(cars, &FittedCar::measured);
  const Coverage held_out = coverage_of(cars, &FittedCar::held_out);
  table.full_row(fmt::format("KPIs of {} cars inside their 90 % band (one KPI)", cars.size()),
                 measured.text(),
                 "90 +- 3 %",
                 measured.holds());
  table.full_row("a held-out load case inside its 90 % band (one output)",
                 held_out.text(),
                 "90 +- 3 %",
                 held_out.holds());
}

/// Result of a search that is run on the study at `file` and whose best point is judged by the cost
/// function of the study `by`.
struct Searched {
  double cost = 0.0;
  std::size_t trials = 0;
};

Searched searched(const std::filesystem::path& file, const Study& by) {
  const Study study = correlation::read_study(file, experiment::language());
  std::filesystem::remove(study.run.journal);
  Journal journal = Journal::open(study.run.journal, correlation::identity(study));
  InlineExecutor executor(correlation::evaluator(study));
  RunOptions options;
  options.max_steps = study.max_steps;
  const Run run = correlation::fit(study, executor, journal, options).run;
  const DesignPoint best = run.best()->point;
  const auto recording = correlation::simulate_all(study, best);
  return {correlation::objective(by)(best, *recording)->value, run.steps.size()};
}

/// Compares the pattern search of the thesis with our search on one car of studies/compliance.
void add_pattern_search(const std::filesystem::path& folder, benchmarks::Table& table) {
  namespace fs = std::filesystem;
  fs::copy(fs::path(LATSCH_SOURCE_DIR) / "studies" / "compliance", folder / "study");
  const fs::path thesis = folder / "study" / "thesis.toml", ours = folder / "study" / "study.toml";
  const Study by = correlation::read_study(thesis, experiment::language());
  const auto text = [](const Searched& one) {
    return fmt::format("{} trials, cost {:.2g}", one.trials, one.cost);
  };
  table.note("cost (4-1) by pattern search, ten joints", text(searched(thesis, by)));
  table.note("cost (4-1) by Levenberg-Marquardt", text(searched(ours, by)));
}

int compliance(const benchmarks::Options& options) {
  const auto count = static_cast<int>(options.integer("CARS", options.size(1000, 2)));
  const auto seed = static_cast<std::uint64_t>(options.integer("SEED", 4));
  benchmarks::Table table("compliance", options);
  const ScratchFolder folder;
  const CompliantCars cars(folder.path(), seed);
  std::vector<FittedCar> fitted;
  for (int i = 0; i < count; ++i) {
    fitted.push_back(fit_of(cars.draw(i)));
    std::filesystem::remove_all(folder / fmt::format("car_{}", i));
    if (std::ssize(fitted) == std::min(kFitted, count)) add_fits(fitted, table);
  }
  add_coverage(fitted, table);
  if (!options.is_smoke()) add_pattern_search(folder.path(), table);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc,
      argv,
      {{"CARS", "", "how many"}, {"SEED", "", "of their stiffnesses and hardpoints"}},
      compliance);
}
