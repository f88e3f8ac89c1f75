// SPDX-License-Identifier: Apache-2.0
// Derivatives of a tire's loads and modes with respect to ten parameters: CPU time in units of a
// trial, and accuracy judged by differences.
//
//   ./bench.sh sensitivities [SEED]           all tires, some of their parameters drawn at random
//   ./bench.sh sensitivities all [TIRE [PATH]]  all parameters, of one tire, one of them
//
// A trial inflates the tire, presses it in five steps and finds 20 modes: of the loaded tire, or
// for tire A of the unloaded one, as in its study. The derivatives are those of the five loads and
// of all modes with respect to ten numbers in the tire's file. Their time is the increase of the
// trial's time if derivatives are requested.
//
// The reference is whole trials with one parameter changed, each solved as accurately as possible,
// and polynomials fitted to them, which estimate their own error (fitted_slope.h). The noise of the
// trials is measured with tiny changes of a parameter. Points of the tread that begin to touch or
// to leave the ground cause kinks of the loads and jumps of the modes; the computed derivatives
// hold between two such events. Therefore changed tires are forced to touch at the same points as
// the unchanged one under each load (Ground::held), as far as step sizes allow. One row shows that
// free tires have the same derivatives of the loads, with a step so short that their touching
// points seldom change.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/document.h"
#include "base/random.h"
#include "cpu_time.h"
#include "experiment/kinds/fe_variations.h"
#include "fitted_slope.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/slopes/tire_slopes.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr int kLoads = 5, kModes = 20;
// repetitions of timed trials, alternately without and with derivatives
constexpr int kRepeats = 5;
constexpr double kShare = 0.5, kError = 1e-6;
constexpr std::size_t kDrawn = 2;  // number of parameters drawn for each tire
constexpr std::uint64_t kSeed = 1;

struct Case {
  const char *name, *file;
  double travel;  // m
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
  return {{"tire A", "passenger_235_45R20", 0.025, false, four},
          {"tire B",
           "passenger_225_50R16",
           0.025,
           true,
           common({"rubber.matrix.young_modulus",
                   "rubber.matrix.density",
                   "layer.belt_2.young_modulus",
                   "layer.belt_2.density"})},
          {"205/55R16", "passenger_205_55R16", 0.025, true, four},
          {"race tire",
           "race_16x7.5-10",
           0.015,
           true,
           {"rubber.tread.young_modulus",
            "rubber.tread.density",
            "rubber.sidewall.young_modulus",
            "layer.carcass_1.young_modulus",
            "layer.carcass_1.angle",
            "layer.carcass_2.spacing",
            "layer.turnup_1.young_modulus",
            "layer.turnup_1.density",
            "section.thickness_outside.1.1",
            "pressure"}}};
}

struct Trial {
  Inflated inflated;
  std::vector<TireState> states;  // states at the loads; the modes are those of the last state
  std::vector<Mode> modes;
};

std::vector<double> deflections(const Case& of) {
  std::vector<double> all;
  for (int i = 1; i <= kLoads; ++i) all.push_back(of.travel * i / kLoads);
  return all;
}

Trial run(FeTire& tire, double pressure, const Case& of, int modes) {
  Trial trial;
  trial.inflated = value_of(tire.inflate(pressure));
  trial.states = value_of(tire.press(trial.inflated, Ground{}, deflections(of)));
  trial.modes = value_of(of.loaded_modes ? tire.modes(trial.states.back(), modes)
                                         : tire.modes(trial.inflated, modes));
  return trial;
}

/// Returns the derivatives of the loads, then of the frequencies [results x parameters].
Eigen::MatrixXd slopes_of(const Trial& trial, bool loaded_modes, TireSlopes& slopes) {
  const auto of_inflated = value_of(slopes.of_inflated(trial.inflated));
  Eigen::MatrixXd all(kLoads + kModes, slopes.variables());
  for (int k = 0; k < kLoads; ++k) {
    const auto of_state = value_of(slopes.of_state(trial.states[k]));
    all.row(k) = of_state.force + of_state.by_height * of_inflated.radius;
  }
  all.bottomRows(kModes) =
      value_of(loaded_modes ? slopes.of_modes(trial.states.back(), trial.modes, of_inflated.radius)
                            : slopes.of_modes(trial.inflated, trial.modes));
  return all;
}

/// Returns the CPU seconds of a trial, including reading the tire's file. The trial computes
/// derivatives with respect to the parameters at `paths`, or none if the list is empty.
double time_of(const Case& of, const Document& numbers, const std::vector<std::string>& paths) {
  const TireDescription description = read_tire(numbers.root());
  const double start = cpu_seconds();
  FeTire tire(description);
  std::optional<TireSlopes> slopes;
  if (!paths.empty())
    slopes.emplace(
        tire, value_of(experiment::fe_variations(numbers, paths, experiment::described_tires())));
  const Trial trial = run(tire, description.pressure, of, kModes);
  if (slopes) slopes_of(trial, of.loaded_modes, *slopes);
  return cpu_seconds() - start;
}

void time_row(Table& table, const Case& of, const Document& numbers) {
  std::vector<double> plain, shares;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    plain.push_back(time_of(of, numbers, {}));
    shares.push_back(time_of(of, numbers, of.paths) / plain.back() - 1.0);
  }
  std::ranges::sort(plain);
  std::ranges::sort(shares);
  const double share = shares[kRepeats / 2];
  table.row(fmt::format("{}: slopes of 25 answers in 10 numbers", of.name),
            fmt::format("{:.2f} of a trial of {:.2f} CPU s", share, plain[kRepeats / 2]),
            fmt::format("<= {:.1f}", kShare),
            share <= kShare);
}

/// The points of the tread that touch the ground under each of the loads.
using Branch = std::vector<TouchingPoints>;

/// Returns the equilibria under all loads with the set of touching points prescribed.
std::vector<TireState> stand_on(FeTire& tire,
                                const Inflated& inflated,
                                const Case& of,
                                const Branch& branch) {
  std::vector<TireState> states;
  TireState state = tire.over(inflated, Ground{});
  for (int k = 0; k < kLoads; ++k) {
    state.ground.held = branch[static_cast<std::size_t>(k)];
    const GroundPose pose = FeTire::below(inflated, of.travel * (k + 1) / kLoads);
    state = value_of(tire.advance(state, {pose})).back();
    states.push_back(state);
  }
  return states;
}

/// Returns a tire whose trials are solved so accurately that finite differences show no error of
/// the solver.
FeTire exact_tire(const TireDescription& description) {
  SolverSettings settings{.element = description.element};
  // smallest useful value: rounding leaves a third of it where the tread touches
  settings.tolerance = 1e-10;
  settings.mode_tolerance = 1e-9;
  return {build_mesh(description), build_materials(description), settings};
}

Eigen::VectorXd forces(FeTire& tire, const std::vector<TireState>& states) {
  Eigen::VectorXd all(kLoads);
  for (int k = 0; k < kLoads; ++k)
    all[k] = tire.stand(states[static_cast<std::size_t>(k)]).force.z();
  return all;
}

/// Returns the loads of a tire whose touching points are not prescribed, and its touching points.
std::pair<Eigen::VectorXd, Branch> free_loads(const Document& numbers, const Case& of) {
  const TireDescription description = read_tire(numbers.root());
  FeTire tire = exact_tire(description);
  const Inflated inflated = value_of(tire.inflate(description.pressure));
  const auto states = value_of(tire.press(inflated, Ground{}, deflections(of)));
  Branch branch;
  for (const TireState& state : states) branch.push_back(tire.touching(state));
  return {forces(tire, states), branch};
}

/// Results of a trial as plain numbers.
struct Exact {
  Eigen::VectorXd loads;
  std::vector<Mode> modes;
};

Exact exact(const Document& numbers, const Case& of, const Branch& branch) {
  // number of modes computed in addition, because one of them may become lower than others
  constexpr int kSpare = 2;
  const TireDescription description = read_tire(numbers.root());
  FeTire tire = exact_tire(description);
  const Inflated inflated = value_of(tire.inflate(description.pressure));
  const std::vector<TireState> states = stand_on(tire, inflated, of, branch);
  return {forces(tire, states),
          value_of(of.loaded_modes ? tire.modes(states.back(), kModes + kSpare)
                                   : tire.modes(inflated, kModes + kSpare))};
}

/// Returns the frequency that mode i of the trial `at` has in the trial `other`. Modes of a loaded
/// tire are matched by shape. Modes of an unloaded tire, which are pairs of any phase, are matched
/// by their rank among the modes of their circumferential number.
std::optional<double> followed(const Exact& at, int i, const Exact& other, bool loaded) {
  constexpr double kSame = 0.8;
  const Mode& mode = at.modes[static_cast<std::size_t>(i)];
  if (!loaded) {
    const auto before = std::count_if(
        at.modes.begin(), at.modes.begin() + i, [&](const Mode& m) { return m.n == mode.n; });
    std::ptrdiff_t place = 0;
    for (const Mode& m : other.modes) {
      if (m.n == mode.n && place++ == before) return m.frequency;
    }
    return std::nullopt;
  }
  for (const Mode& m : other.modes) {
    const double overlap = std::abs(mode.shape.cwiseProduct(m.shape).sum());
    if (overlap > kSame * mode.shape.norm() * m.shape.norm()) return m.frequency;
  }
  return std::nullopt;
}

/// Returns a copy of the tire's parameters in which the one at `path` is changed by a share of its
/// size.
Document moved(const Document& numbers, const std::string& path, double share) {
  Document other = numbers;
  const double number = numbers.get(path);
  other.set(path, number + share * std::abs(number));
  return other;
}

/// Computes the reference derivatives with respect to one parameter, from whole trials.
class Judge {
 public:
  using Slopes = std::vector<std::optional<FittedSlope>>;

  Judge(const Case& of, const Document& numbers)
      : of_(of),
        numbers_(numbers),
        branch_(free_loads(numbers, of).second),
        at_(exact(numbers, of, branch_)) {
    for (int i = 0; i < kLoads + kModes; ++i) noise_[i] = kRounding * std::abs(value(i));
    // relative change of a parameter that is so small that only the noise of the trials remains
    constexpr double kNothing = 1e-8;
    for (const double by : {kNothing, 2.0 * kNothing, 3.0 * kNothing}) {
      const Exact below = at(kMoves, -by), above = at(kMoves, by);
      for (int i = 0; i < kLoads + kModes; ++i) {
        const double off = 0.5 * (*answer(below, i) + *answer(above, i)) - value(i);
        noise_[i] = std::max(noise_[i], kSafety * std::abs(off));
      }
    }
  }

  double value(int i) const { return *answer(at_, i); }
  /// Returns the largest relative noise among `count` results, beginning with number `first`: loads
  /// or modes.
  double noise(int first, int count) const {
    double largest = 0.0;
    for (int i = first; i < first + count; ++i)
      largest = std::max(largest, noise_[i] / std::abs(value(i)));
    return largest;
  }

  /// Returns the reference derivatives of all results. The step is halved until all of them are
  /// accurate enough. If the shortest step is not sufficient, further steps are added where they
  /// help the inaccurate ones.
  Slopes slopes(const std::string& path) const {
    constexpr int kHalvings = 9, kFewest = 4;
    constexpr double kWidest = 6.4e-2;  // largest step, as a share of the parameter
    // ends of the range of further steps, relative to the range of steps that the fits use
    constexpr double kBeyond = 1.5, kTooShort = 1.0 / 30.0;
    std::vector<std::vector<StepValues>> steps(kLoads + kModes);
    Slopes found(steps.size());
    const double number = numbers_.get(path);
    for (const double between : {0.0, 0.5, 0.25, 0.75}) {
      const double reach = between > 0.0 ? reach_of_unsure(found, number) : 0.0;
      for (int k = 0; k < kHalvings; ++k) {
        const double share = kWidest * std::exp2(-k - between), h = share * std::abs(number);
        if (between > 0.0 && (h > kBeyond * reach || h < kTooShort * reach)) continue;
        add_step(path, share, steps);
        if (between == 0.0 && k + 1 < kFewest) continue;
        for (std::size_t i = 0; i < steps.size(); ++i)
          found[i] = fitted_slope(steps[i], noise_[static_cast<Eigen::Index>(i)]);
        if (reach_of_unsure(found, number) == 0.0) return found;
      }
    }
    return found;
  }

  /// Returns the difference between the derivatives of loads with prescribed touching points and
  /// those of free tires, both by the same short step.
  double off_free_loads() const {
    constexpr double kShort = 1e-5;  // share of the parameter
    const double number = numbers_.get(kMoves), way = 2.0 * kShort * std::abs(number);
    const Document below = moved(numbers_, kMoves, -kShort);
    const Document above = moved(numbers_, kMoves, kShort);
    const Eigen::VectorXd free =
        (free_loads(above, of_).first - free_loads(below, of_).first) / way;
    const Eigen::VectorXd held =
        (exact(above, of_, branch_).loads - exact(below, of_, branch_).loads) / way;
    double off = 0.0;
    for (int i = 0; i < kLoads; ++i)
      off = std::max(off, std::abs(free[i] - held[i]) / size(i, held[i], number));
    return off;
  }

  /// Returns the scale of a derivative's error: the magnitude of the derivative itself, or a
  /// hundredth of the result over the parameter if that is larger.
  double size(int i, double slope, double number) const {
    return std::max(std::abs(slope), 1e-2 * std::abs(value(i)) / std::abs(number));
  }

 private:
  // path of a parameter that affects every result of any tire
  static constexpr const char* kMoves = "pressure";
  static constexpr double kSafety = 2.0;  // factor on the largest of several observed noise values
  static constexpr double kRounding = 1e-13;  // least noise assumed, relative to the result

  /// Returns the widest step range among the fits whose derivative is not accurate enough; 0 if all
  /// are accurate.
  double reach_of_unsure(const Slopes& slopes, double number) const {
    constexpr double kEnough = 0.5 * kError;
    double reach = 0.0;
    for (int i = 0; i < kLoads + kModes; ++i) {
      const auto& slope = slopes[static_cast<std::size_t>(i)];
      if (!slope)
        reach = std::abs(number);
      else if (slope->error > kEnough * size(i, slope->value, number))
        reach = std::max(reach, slope->reach);
    }
    return reach;
  }

  void add_step(const std::string& path,
                double share,
                std::vector<std::vector<StepValues>>& steps) const {
    const Exact below = at(path, -share), above = at(path, share);
    for (int i = 0; i < kLoads + kModes; ++i) {
      const auto lower = answer(below, i), upper = answer(above, i);
      if (!lower || !upper) continue;
      steps[static_cast<std::size_t>(i)].push_back(
          {share * std::abs(numbers_.get(path)), *lower, *upper});
    }
  }

  Exact at(const std::string& path, double share) const {
    return exact(moved(numbers_, path, share), of_, branch_);
  }

  /// Returns result number i of the trial: a load or a frequency. Returns nothing if the mode is
  /// not found in the trial.
  std::optional<double> answer(const Exact& trial, int i) const {
    if (i < kLoads) return trial.loads[i];
    return followed(at_, i - kLoads, trial, of_.loaded_modes);
  }

  const Case& of_;
  const Document& numbers_;
  Branch branch_;
  Exact at_;
  Eigen::VectorXd noise_ = Eigen::VectorXd(kLoads + kModes);
};

struct Errors {
  double loads = 0.0, modes = 0.0, judge = 0.0;
  int unknown = 0;
};

Errors errors_of(const Judge& judge,
                 const std::string& path,
                 const Eigen::VectorXd& slopes,
                 double number) {
  Errors errors;
  const auto judged = judge.slopes(path);
  for (int i = 0; i < kLoads + kModes; ++i) {
    const auto& slope = judged[static_cast<std::size_t>(i)];
    if (!slope) {
      ++errors.unknown;
      continue;
    }
    const double size = judge.size(i, slope->value, number);
    double& largest = i < kLoads ? errors.loads : errors.modes;
    largest = std::max(largest, std::abs(slopes[i] - slope->value) / size);
    errors.judge = std::max(errors.judge, slope->error / size);
  }
  return errors;
}

std::string in_words(const Errors& errors) {
  std::string text = fmt::format(
      "loads {:.1e}, modes {:.1e}, judge {:.1e}", errors.loads, errors.modes, errors.judge);
  if (errors.unknown > 0) text += fmt::format("; {} not judged", errors.unknown);
  return text;
}

/// Returns the program's derivatives of loads and modes with respect to all parameters of the case,
/// from a trial that is as accurate as the references.
Eigen::MatrixXd exact_slopes(const Case& of, const Document& numbers) {
  const TireDescription description = read_tire(numbers.root());
  SolverSettings settings{.element = description.element};
  settings.tolerance = 1e-10;
  FeTire tire(build_mesh(description), build_materials(description), settings);
  TireSlopes slopes(
      tire, value_of(experiment::fe_variations(numbers, of.paths, experiment::described_tires())));
  const Trial trial = run(tire, description.pressure, of, kModes);
  return slopes_of(trial, of.loaded_modes, slopes);
}

/// Adds a row for every parameter, and one with the parameters whose touching points are not
/// prescribed.
void error_rows(Table& table, const Case& of, const Document& numbers) {
  constexpr double kFree = 1e-4;
  const Judge judge(of, numbers);
  const Eigen::MatrixXd slopes = exact_slopes(of, numbers);
  table.note(
      fmt::format("{}: what trials are off", of.name),
      fmt::format(
          "loads {:.0e}, modes {:.0e}", judge.noise(0, kLoads), judge.noise(kLoads, kModes)));
  const double off = judge.off_free_loads();
  table.row(fmt::format("{}: tires left to themselves", of.name),
            fmt::format("loads {:.1e}", off),
            fmt::format("<= {:.0e}", kFree),
            off <= kFree);
  for (std::size_t k = 0; k < of.paths.size(); ++k) {
    const std::string& path = of.paths[k];
    const Errors errors =
        errors_of(judge, path, slopes.col(static_cast<Eigen::Index>(k)), numbers.get(path));
    table.row(
        fmt::format("{}: {}", of.name, path),
        in_words(errors),
        fmt::format("<= {:.0e}", kError),
        std::max({errors.loads, errors.modes, errors.judge}) <= kError && errors.unknown == 0);
  }
}

void draw(std::vector<std::string>& paths, RandomStream& random) {
  while (paths.size() > kDrawn)
    paths.erase(paths.begin() + static_cast<std::ptrdiff_t>(random.below(paths.size())));
}

/// Compares the derivatives of the loads of a coarse tire with the difference of one short step,
/// within that step's accuracy.
void smoke(Table& table) {
  constexpr double kShort = 1e-5, kReach = 1e-3;
  Case of = cases()[1];
  of.paths = {"pressure", "rubber.matrix.young_modulus"};
  const Document numbers =
      Document::parse(with_coarse_mesh(read_text_file(tire_file(of.file))), "coarse tire");
  table.note("a trial with slopes",
             fmt::format("{:.2f} CPU s, {:.2f} without",
                         time_of(of, numbers, of.paths),
                         time_of(of, numbers, {})));
  const Branch branch = free_loads(numbers, of).second;
  const Eigen::MatrixXd slopes = exact_slopes(of, numbers);
  for (std::size_t k = 0; k < of.paths.size(); ++k) {
    const std::string& path = of.paths[k];
    const double way = 2.0 * kShort * std::abs(numbers.get(path));
    const Eigen::VectorXd judge = (exact(moved(numbers, path, kShort), of, branch).loads -
                                   exact(moved(numbers, path, -kShort), of, branch).loads) /
                                  way;
    const double off = (slopes.col(static_cast<Eigen::Index>(k)).head(kLoads) - judge).norm();
    table.row(fmt::format("coarse tire, slopes of loads in {}", path),
              fmt::format("{:.1e}", off / judge.norm()),
              fmt::format("<= {:g}", kReach),
              off <= kReach * judge.norm());
  }
}

struct Asked {
  bool all = false;
  std::uint64_t seed = kSeed;
  std::string tire, path;
};

Asked asked_by(const Options& options) {
  Asked asked{.tire = options.text("TIRE"), .path = options.text("PATH")};
  asked.all = options.text("SEED") == "all";
  if (!asked.all) asked.seed = static_cast<std::uint64_t>(options.integer("SEED", kSeed));
  return asked;
}

int bench(const Options& options) {
  const Asked asked = asked_by(options);
  Table table("sensitivities", options);
  if (options.is_smoke()) {
    smoke(table);
    return table.exit_code();
  }
  std::uint64_t stream = 0;
  for (Case of : cases()) {
    RandomStream random(asked.seed, stream++);
    if (!asked.tire.empty() && asked.tire != of.name) continue;
    const Document numbers = Document::read(tire_file(of.file));
    time_row(table, of, numbers);
    if (!asked.path.empty()) of.paths = {asked.path};
    if (!asked.all) draw(of.paths, random);
    error_rows(table, of, numbers);
  }
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc,
      argv,
      {{"SEED", "", "of the numbers drawn, or all: all numbers"},
       {"TIRE", "", "of that tire alone"},
       {"PATH", "", "that number alone"}},
      latsch::benchmarks::bench);
}
