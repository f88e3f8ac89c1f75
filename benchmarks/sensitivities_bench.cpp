// SPDX-License-Identifier: Apache-2.0
// Slopes of a tire's loads and modes in ten numbers: their CPU time in trials, against differences
//
// A trial inflates, presses the tire to 25 mm in five steps and finds 20 modes: of the loaded tire,
// of tire A of the unloaded one, as in its study. Slopes are those of the five loads and of all
// modes in ten numbers of the tire's file; their time is that beyond the trial. Differences are
// central ones of whole trials, every one solved to the last digits, extrapolated to a step of zero
// with an error h^6; where a mode of another trial is another mode, the two differ in frequency by
// more than any slope makes.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "base/document.h"
#include "experiment/kinds/fe_variations.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/analysis/tire_slopes.h"
#include "models/fe_tire/description/tire_description.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr double kTravel = 0.025;  // m
constexpr int kLoads = 5, kModes = 20;
constexpr int kRepeats = 3;  // of what is timed, plain and sloped in turn
constexpr double kShare = 0.5, kError = 1e-6;

struct Case {
  const char *name, *file;
  bool loaded_modes;
  std::vector<std::string> paths;
};

std::vector<Case> cases() {
  const auto common = [](std::vector<std::string> rubbers) {
    for (const char* path : {"layer.carcass.young_modulus",
                             "layer.belt_1.young_modulus",
                             "layer.belt_1.angle",
                             "layer.carcass.spacing",
                             "section.thickness_outside.1.1",
                             "pressure"}) {
      rubbers.emplace_back(path);
    }
    return rubbers;
  };
  const std::vector<std::string> four = common({"rubber.tread.young_modulus",
                                                "rubber.belt.young_modulus",
                                                "rubber.upper_sidewall.young_modulus",
                                                "rubber.tread.density"});
  return {{"tire A", "passenger_235_45R20.toml", false, four},
          {"tire B",
           "passenger_225_50R16.toml",
           true,
           common({"rubber.matrix.young_modulus",
                   "rubber.matrix.density",
                   "layer.belt_2.young_modulus",
                   "layer.belt_2.density"})},
          {"205/55R16", "passenger_205_55R16.toml", true, four}};
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

template <class T>
T take(Result<T> result) {
  if (!result) throw std::runtime_error(result.failure().reason);
  return *std::move(result);
}

std::vector<double> deflections() {
  std::vector<double> all;
  for (int i = 1; i <= kLoads; ++i) all.push_back(kTravel * i / kLoads);
  return all;
}

struct Trial {
  Inflated inflated;
  std::vector<TireState> states;
  std::vector<Mode> modes;
  Eigen::VectorXd answers;  // loads, then frequencies
};

Trial run(FeTire& tire, double pressure, bool loaded_modes) {
  Trial trial;
  trial.inflated = take(tire.inflate(pressure));
  trial.states = take(tire.press(trial.inflated, Ground{}, deflections()));
  trial.modes = take(loaded_modes ? tire.modes(trial.states.back(), kModes)
                                  : tire.modes(trial.inflated, kModes));
  trial.answers.resize(kLoads + kModes);
  for (int k = 0; k < kLoads; ++k) trial.answers[k] = tire.stand(trial.states[k]).force.z();
  for (int k = 0; k < kModes; ++k) trial.answers[kLoads + k] = trial.modes[k].frequency;
  return trial;
}

/// [answers x numbers]
Eigen::MatrixXd slopes_of(const Trial& trial, bool loaded_modes, TireSlopes& slopes) {
  const auto of_inflated = take(slopes.of_inflated(trial.inflated));
  Eigen::MatrixXd all(kLoads + kModes, slopes.variables());
  for (int k = 0; k < kLoads; ++k) {
    const auto of_state = take(slopes.of_state(trial.states[k]));
    all.row(k) = of_state.force + of_state.by_height * of_inflated.radius;
  }
  all.bottomRows(kModes) =
      take(loaded_modes ? slopes.of_modes(trial.states.back(), trial.modes, of_inflated.radius)
                        : slopes.of_modes(trial.inflated, trial.modes));
  return all;
}

void time_row(Table& table, const Case& of, const Document& numbers) {
  std::vector<double> shares;
  double plain = 0.0;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const TireDescription description = read_tire(numbers.root());
    const double start = cpu_seconds();
    FeTire tire(description);
    const Trial trial = run(tire, description.pressure, of.loaded_modes);
    const double between = cpu_seconds();
    TireSlopes slopes(
        tire, take(experiment::fe_variations(numbers, of.paths, experiment::described_tires())));
    slopes_of(trial, of.loaded_modes, slopes);
    plain = between - start;
    shares.push_back((cpu_seconds() - between) / plain);
  }
  std::ranges::sort(shares);
  const double share = shares[kRepeats / 2];
  table.row(fmt::format("{}: slopes of 25 answers in 10 numbers", of.name),
            fmt::format("{:.2f} of a trial of {:.2f} CPU s", share, plain),
            fmt::format("<= {:.1f}", kShare),
            share <= kShare);
}

/// Solved until nothing is left that differences would enlarge.
Trial exact(const TireDescription& description, bool loaded_modes) {
  SolverSettings settings{.element = description.element};
  settings.tolerance = 1e-10;
  settings.mode_tolerance = 1e-9;
  FeTire tire(build_mesh(description), build_materials(description), settings);
  return run(tire, description.pressure, loaded_modes);
}

Eigen::VectorXd differences(const Case& of, const Document& numbers, const std::string& path) {
  const double value = numbers.get(path);
  // Loads move on straight lines, but for what they are solved to; modes of near frequencies bend.
  constexpr int kSteps = 5, kOfLoads = 0, kOfModes = 2;
  std::vector<Eigen::VectorXd> central;
  for (int k = 0; k < kSteps; ++k) {
    const double h = std::ldexp(2e-3, -k) * value;
    const auto moved = [&](double by) {
      Document other = numbers;
      other.set(path, value + by);
      return exact(read_tire(other.root()), of.loaded_modes).answers;
    };
    central.emplace_back((moved(h) - moved(-h)) / (2.0 * h));
  }
  // Three steps, each half of the one before: an error h^6 is left.
  const auto extrapolated = [&](int first) {
    const Eigen::VectorXd a = (4.0 * central[first + 1] - central[first]) / 3.0;
    const Eigen::VectorXd b = (4.0 * central[first + 2] - central[first + 1]) / 3.0;
    return Eigen::VectorXd((16.0 * b - a) / 15.0);
  };
  Eigen::VectorXd all = extrapolated(kOfModes);
  all.head(kLoads) = extrapolated(kOfLoads).head(kLoads);
  return all;
}

/// The largest difference, in proportion to what a change of a number by its own size makes, or to
/// a hundredth of the answer itself; of loads and of modes.
void error_row(Table& table, const Case& of, const Document& numbers) {
  const TireDescription description = read_tire(numbers.root());
  SolverSettings settings{.element = description.element};
  settings.tolerance = 1e-10;
  FeTire tire(build_mesh(description), build_materials(description), settings);
  const Trial trial = run(tire, description.pressure, of.loaded_modes);
  TireSlopes slopes(
      tire, take(experiment::fe_variations(numbers, of.paths, experiment::described_tires())));
  const Eigen::MatrixXd found = slopes_of(trial, of.loaded_modes, slopes);
  double largest = 0.0;
  for (std::size_t k = 0; k < of.paths.size(); ++k) {
    const Eigen::VectorXd expected = differences(of, numbers, of.paths[k]);
    const double number = std::abs(numbers.get(of.paths[k]));
    double of_loads = 0.0, of_modes = 0.0;
    for (int i = 0; i < found.rows(); ++i) {
      const double size =
          std::max(std::abs(expected[i]), 1e-2 * std::abs(trial.answers[i]) / number);
      const double error = std::abs(found(i, static_cast<Eigen::Index>(k)) - expected[i]) / size;
      (i < kLoads ? of_loads : of_modes) = std::max(i < kLoads ? of_loads : of_modes, error);
    }
    table.note(fmt::format("{}: {}", of.name, of.paths[k]),
               fmt::format("loads {:.1e}, modes {:.1e}", of_loads, of_modes));
    largest = std::max({largest, of_loads, of_modes});
  }
  table.row(fmt::format("{}: largest difference from differences of trials", of.name),
            fmt::format("{:.1e}", largest),
            fmt::format("<= {:.0e}", kError),
            largest <= kError);
}

/// Of one of the tires, and one of its numbers, alone where they are named.
int bench(const std::string& name, const std::string& path) {
  Table table("sensitivities");
  for (Case of : cases()) {
    if (!path.empty()) of.paths = {path};
    if (!name.empty() && name != of.name) continue;
    const Document numbers =
        Document::read(std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/tires" / of.file);
    time_row(table, of, numbers);
    error_row(table, of, numbers);
  }
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int count, char** arguments) {
  const std::string name = count > 1 ? arguments[1] : "", path = count > 2 ? arguments[2] : "";
  return latsch::benchmarks::guarded([&] { return latsch::benchmarks::bench(name, path); });
}
