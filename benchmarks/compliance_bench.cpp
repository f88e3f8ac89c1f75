// SPDX-License-Identifier: Apache-2.0
// Bushing stiffnesses of synthetic cars from sixteen numbers of a K&C rig: fit, and what its bands hold.
//
//   compliance [CARS] [SEED]     1000 cars of the seed nobody looked at before, unless given
//
// The study is studies/compliance/axes.toml: thirty stiffnesses with a prior. All goes the way of
// `latsch run`: the study read from its file, its search, a journal, the intervals.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "base/scratch_folder_testing.h"
#include "compliant_cars.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/search/study_fit.h"
#include "correlation/target/study_trials.h"
#include "evaluation/executors/inline_executor.h"
#include "optimization/identifiability/prediction_band.h"
#include "optimization/problem/point_vector.h"
#include "table.h"

namespace {

using namespace latsch;
using benchmarks::CompliantCar;
using benchmarks::CompliantCars;
using correlation::Study;
using correlation::StudyExperiment;

constexpr double kLevel = 0.9;       // of the bands
constexpr double kLevelOff = 0.03;   // that coverage may be off
constexpr int kFitted = 100;         // cars of the first rows
constexpr int kHeldOutOutputs = 6;   // of test E

/// One number, fitted or held out, of one car.
struct Number {
  double error = 0.0;  // of the fit against the car, over the latter
  bool inside = false;
};

struct FittedCar {
  std::vector<Number> measured, held_out;
  double time = 0.0;  // s, of the fit
  std::size_t steps = 0;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// dy/du of a channel of one value.
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
  Journal journal = Journal::open(study.run.journal, correlation::identity(study));
  InlineExecutor executor(correlation::evaluator(study));
  RunOptions options;
  options.max_steps = study.max_steps;
  const Run run = correlation::fit(study, executor, journal, options).run;
  result.time = seconds_since(start);
  result.steps = run.steps.size();
  const auto what = correlation::identify(
      study, run.best()->point, correlation::Depth::intervals, executor, journal, options);
  const correlation::Identifiability& what_at = **what;
  const Identification& identification = what_at.identification;
  const Linearization& at = identification.linearization();
  ConfidenceOptions of_level{.sigma = 1.0, .level = kLevel};
  const PredictionBands bands(at.u, confidence(at, of_level));
  const auto found = correlation::simulate_all(study, what_at.point);
  const Confidence cc = confidence(at, of_level);
  fmt::print("S {:.2f} left {:.3g} excess {:.2f} lsteps {} journal {} held {} {}\n", at.sum_of_squares(), cc.left_to_gain, cc.excess, run.steps.size(), journal.size(), std::count_if(cc.held.begin(), cc.held.end(), [](Bound b){return b!=Bound::none;}), run.ending.substr(0,30));
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

/// How many of the numbers of all cars lie inside their bands.
struct Coverage {
  double all = 0.0, least = 1.0, most = 0.0;  // of a single output
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

int compliance(int count, std::uint64_t seed) {
  benchmarks::Table table("compliance");
  const ScratchFolder folder;
  const CompliantCars cars(folder.path(), seed);
  std::vector<FittedCar> fitted;
  for (int i = 0; i < count; ++i) {
    fitted.push_back(fit_of(cars.draw(i)));
    std::filesystem::remove_all(folder / fmt::format("car_{}", i));
  }
  std::vector<double> errors, times, steps;
  int close = 0;
  const int first = std::min(kFitted, count);
  for (int i = 0; i < first; ++i) {
    const FittedCar& car = fitted[static_cast<std::size_t>(i)];
    for (const Number& number : car.measured) errors.push_back(number.error);
    close += std::count_if(car.measured.begin(), car.measured.end(), [](const Number& number) {
               return number.error <= 0.05;
             }) >= 14;
    times.push_back(car.time);
    steps.push_back(static_cast<double>(car.steps));
  }
  table.row("median error of a KPI", fmt::format("{:.2f} %", 100 * median(errors)), "<= 1 %", median(errors) <= 0.01);
  table.row("cars with 14 of 16 KPIs within 5 %", fmt::format("{} of {}", close, first), ">= 95 %", close >= 0.95 * first);
  const double slowest = *std::max_element(times.begin(), times.end());
  table.row("a fit, the slowest", fmt::format("{:.3f} s", slowest), "< 0.2 s", slowest < 0.2);
  table.note("a fit, the median", fmt::format("{:.3f} s, {:.0f} trials", median(times), median(steps)));
  const Coverage measured = coverage_of(fitted, &FittedCar::measured);
  const Coverage held_out = coverage_of(fitted, &FittedCar::held_out);
  table.row("90 % bands that hold the KPI", measured.text(), "90 +- 3 %", measured.holds());
  table.row("90 % bands that hold a held-out load case", held_out.text(), "90 +- 3 %", held_out.holds());
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 1000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 4;
  return latsch::benchmarks::guarded([&] { return compliance(count, seed); });
}
