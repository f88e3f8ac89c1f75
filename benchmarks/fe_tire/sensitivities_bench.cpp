// SPDX-License-Identifier: Apache-2.0
// Slopes of a tire's loads and modes in ten numbers: their CPU time in trials, against differences
//
//   ./bench.sh sensitivities [SEED]           all tires, some of their numbers drawn at random
//   ./bench.sh sensitivities all [TIRE [PATH]]  all numbers, of one tire, one of its numbers
//
// A trial inflates, presses the tire in five steps and finds 20 modes: of the loaded tire, of tire
// A of the unloaded one, as in its study. Slopes are those of the five loads and of all modes in
// ten numbers of the tire's file; their time is that beyond the trial.
//
// Differences are those of whole trials, every one solved to the last digits, extrapolated to a
// step of zero with an estimate of their own error; where that leaves an answer unsure polynomials
// are fitted to sixty trials (extrapolated_slope.h). What trials are off is seen where a number
// moves by next to nothing. Where the points that touch are others, loads have a kink and modes a
// jump: steps are those within. Where such a place is at the number itself the row says so, and its
// slope is that of one side; where such places lie so close that differences tell nothing to a
// millionth, the same is asked in the middle of the widest reach without one, a percent aside.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "base/document.h"
#include "base/random.h"
#include "cpu_time.h"
#include "experiment/kinds/fe_variations.h"
#include "extrapolated_slope.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/slopes/tire_slopes.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr int kLoads = 5, kModes = 20;
constexpr int kRepeats = 3;  // of what is timed, plain and sloped in turn
constexpr double kShare = 0.5, kError = 1e-6;
constexpr std::size_t kDrawn = 2;  // numbers a tire
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
  std::vector<TireState> states;  // of the loads, the last one that of the modes
  std::vector<Mode> modes;
};

Trial run(FeTire& tire, double pressure, const Case& of, int modes) {
  std::vector<double> deflections;
  for (int i = 1; i <= kLoads; ++i) deflections.push_back(of.travel * i / kLoads);
  Trial trial;
  trial.inflated = value_of(tire.inflate(pressure));
  trial.states = value_of(tire.press(trial.inflated, Ground{}, deflections));
  if (modes == 0) return trial;
  trial.modes = value_of(of.loaded_modes ? tire.modes(trial.states.back(), modes)
                                         : tire.modes(trial.inflated, modes));
  return trial;
}

/// Of loads, then of frequencies [answers x numbers].
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

void time_row(Table& table, const Case& of, const Document& numbers) {
  std::vector<double> shares;
  double plain = 0.0;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const TireDescription description = read_tire(numbers.root());
    const double start = cpu_seconds();
    FeTire tire(description);
    const Trial trial = run(tire, description.pressure, of, kModes);
    const double between = cpu_seconds();
    TireSlopes slopes(
        tire,
        value_of(experiment::fe_variations(numbers, of.paths, experiment::described_tires())));
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

/// A trial solved until nothing is left that differences would enlarge, as plain values.
struct Exact {
  Eigen::VectorXd loads;
  std::vector<std::vector<Eigen::Vector2d>> touching;  // points, of every load
  std::vector<Mode> modes;
};

std::vector<Eigen::Vector2d> touching(FeTire& tire, const TireState& state) {
  std::vector<Eigen::Vector2d> points;
  for (const auto& point : tire.stand(state).patch.points) points.emplace_back(point.x, point.y);
  return points;
}

Exact exact(const Document& numbers, const Case& of) {
  constexpr int kSpare = 2;  // modes that may come down among the others
  const TireDescription description = read_tire(numbers.root());
  SolverSettings settings{.element = description.element};
  settings.tolerance = 1e-10;  // rounding where the tread stands leaves a third of it
  settings.mode_tolerance = 1e-9;
  FeTire tire(build_mesh(description), build_materials(description), settings);
  Trial trial = run(tire, description.pressure, of, kModes + kSpare);
  Exact found{Eigen::VectorXd(kLoads), {}, std::move(trial.modes)};
  for (int k = 0; k < kLoads; ++k) {
    const TireState& state = trial.states[static_cast<std::size_t>(k)];
    found.loads[k] = tire.stand(state).force.z();
    found.touching.push_back(touching(tire, state));
  }
  return found;
}

/// Whether the same points touch: they move by less than any two lie apart.
bool same_points(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  constexpr double kNear = 1e-3;  // m
  return std::ranges::equal(
      a, b, [](const auto& p, const auto& q) { return (p - q).norm() < kNear; });
}

/// The frequency of mode i of `at` in another trial: loaded ones by their shape, unloaded ones,
/// whose pairs have any phase, by place among those of their circumferential number.
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

/// What trials say of the slopes in one number.
class Judge {
 public:
  using Slopes = std::vector<std::optional<ExtrapolatedSlope>>;

  Judge(const Case& of, const Document& numbers) : of_(of), numbers_(numbers) {
    at_ = exact(numbers, of);
    for (int i = 0; i < kLoads + kModes; ++i) noise_[i] = kRounding * std::abs(value(i));
    constexpr double kNothing = 1e-8;  // of a number
    const std::string& path = of.paths.front();
    for (const double by : {kNothing, 2.0 * kNothing, 3.0 * kNothing}) {
      const Exact below = moved(path, -by), above = moved(path, by);
      for (int i = 0; i < kLoads + kModes; ++i) {
        const double off = 0.5 * (*answer(below, i) + *answer(above, i)) - value(i);
        noise_[i] = std::max(noise_[i], kSafety * std::abs(off));
      }
    }
  }

  double value(int i) const { return *answer(at_, i); }
  /// Of loads or of modes, the largest, as a share of them.
  double noise(int first, int count) const {
    double largest = 0.0;
    for (int i = first; i < first + count; ++i)
      largest = std::max(largest, noise_[i] / std::abs(value(i)));
    return largest;
  }

  /// Of every answer. Steps are halved until all are known well enough, or no further; then
  /// polynomials are fitted to many trials, as far as the unsure ones are of one branch, and taken
  /// where they know more.
  Slopes slopes(const std::string& path) const {
    constexpr int kFits = 60;
    Slopes found = by_steps(path);
    const std::vector<std::size_t> unsure = unsure_of(found, path);
    const double reach = unsure.empty() ? 0.0 : reach_of(unsure, path);
    if (reach == 0.0) return found;
    const double number = numbers_.get(path);
    std::vector<std::vector<PlacedValue>> values(found.size());
    for (int k = 0; k < kFits; ++k) {
      const double share = reach * (2.0 * (k + 0.5) / kFits - 1.0);
      const Exact trial = moved(path, share);
      for (const std::size_t i : unsure) {
        if (const auto value = answer(trial, static_cast<int>(i)))
          values[i].push_back({share * std::abs(number), *value});
      }
    }
    for (const std::size_t i : unsure) {
      if (!found[i] || values[i].size() < kFits) continue;
      if (const auto fit = fitted_slope(values[i]); fit.error < found[i]->error) found[i] = fit;
    }
    return found;
  }

  /// What errors are a share of: what a change of a number by its own size makes, or a hundredth of
  /// the answer itself.
  double size(int i, double slope, double number) const {
    return std::max(std::abs(slope), 1e-2 * std::abs(value(i)) / std::abs(number));
  }

 private:
  static constexpr double kFirst = 6.4e-2;    // step, as a share of the number
  static constexpr double kSafety = 2.0;      // of noise that is seen some times
  static constexpr double kRounding = 1e-13;  // of the answer, at least

  std::vector<std::size_t> unsure_of(const Slopes& slopes, const std::string& path) const {
    constexpr double kEnough = 3e-7;
    const double number = numbers_.get(path);
    std::vector<std::size_t> unsure;
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      const auto& slope = slopes[i];
      if (!slope || slope->one_sided ||
          slope->error > kEnough * size(static_cast<int>(i), slope->value, number))
        unsure.push_back(i);
    }
    return unsure;
  }

  Slopes by_steps(const std::string& path) const {
    constexpr int kFewest = 4, kMost = 12;
    const double number = numbers_.get(path);
    std::vector<std::vector<StepValues>> steps(kLoads + kModes);
    Slopes found(steps.size());
    for (int k = 0; k < kMost; ++k) {
      const double share = std::ldexp(kFirst, -k), h = share * std::abs(number);
      const Exact below = moved(path, -share), above = moved(path, share);
      for (int i = 0; i < kLoads + kModes; ++i) {
        auto& of_answer = steps[static_cast<std::size_t>(i)];
        of_answer.push_back({h, answer(below, i), answer(above, i)});
        found[static_cast<std::size_t>(i)] = extrapolated_slope(of_answer, value(i), noise_[i]);
      }
      if (k + 1 >= kFewest && unsure_of(found, path).empty()) break;
    }
    return found;
  }

  /// The widest step, each a fifth less than the one before, to both sides of which these answers
  /// are all of one branch; 0 where there is none.
  double reach_of(const std::vector<std::size_t>& answers, const std::string& path) const {
    constexpr int kMost = 30;
    for (int k = 0; k < kMost; ++k) {
      const double share = kFirst * std::pow(0.8, k);
      const Exact below = moved(path, -share), above = moved(path, share);
      if (std::ranges::all_of(answers, [&](std::size_t i) {
            return answer(below, static_cast<int>(i)) && answer(above, static_cast<int>(i));
          }))
        return share;
    }
    return 0.0;
  }

  /// With the number moved by a share of its size.
  Exact moved(const std::string& path, double share) const {
    Document other = numbers_;
    const double number = numbers_.get(path);
    other.set(path, number + share * std::abs(number));
    return exact(other, of_);
  }

  /// None where it is that of another branch.
  std::optional<double> answer(const Exact& trial, int i) const {
    const auto state = static_cast<std::size_t>(i < kLoads ? i : kLoads - 1);
    if ((i < kLoads || of_.loaded_modes) &&
        !same_points(trial.touching[state], at_.touching[state]))
      return std::nullopt;
    if (i < kLoads) return trial.loads[i];
    return followed(at_, i - kLoads, trial, of_.loaded_modes);
  }

  const Case& of_;
  const Document& numbers_;
  Exact at_;
  Eigen::VectorXd noise_ = Eigen::VectorXd(kLoads + kModes);
};

struct Errors {
  double loads = 0.0, modes = 0.0, judge = 0.0;
  int one_sided = 0, unknown = 0;
};

Errors errors_of(const Judge& judge,
                 const Eigen::VectorXd& slopes,
                 const std::string& path,
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
    errors.one_sided += slope->one_sided;
  }
  return errors;
}

std::string in_words(const Errors& errors) {
  std::string text = fmt::format(
      "loads {:.1e}, modes {:.1e}, judge {:.1e}", errors.loads, errors.modes, errors.judge);
  if (errors.one_sided > 0) text += fmt::format("; kink: {} of one side", errors.one_sided);
  if (errors.unknown > 0) text += fmt::format("; {} not judged", errors.unknown);
  return text;
}

/// Slopes of a tire with these numbers, in all paths of the case, and their judge.
class Sloped {
 public:
  Sloped(const Case& of, const Document& numbers)
      : of_(of), numbers_(numbers), judge_(of, numbers) {
    const TireDescription description = read_tire(numbers.root());
    SolverSettings settings{.element = description.element};
    settings.tolerance = 1e-10;
    FeTire tire(build_mesh(description), build_materials(description), settings);
    const Trial trial = run(tire, description.pressure, of, kModes);
    TireSlopes slopes(
        tire,
        value_of(experiment::fe_variations(numbers, of.paths, experiment::described_tires())));
    slopes_ = slopes_of(trial, of.loaded_modes, slopes);
  }

  const Judge& judge() const { return judge_; }
  Errors errors(std::size_t path) const {
    return errors_of(judge_,
                     slopes_.col(static_cast<Eigen::Index>(path)),
                     of_.paths[path],
                     numbers_.get(of_.paths[path]));
  }

 private:
  const Case& of_;
  const Document& numbers_;
  Judge judge_;
  Eigen::MatrixXd slopes_;
};

bool is_told(const Errors& errors) { return errors.judge <= kError && errors.unknown == 0; }

/// Share by which a number is moved to the middle of the widest reach within 1.5 percent in which
/// the same points touch under the last load.
double widest_reach(const Case& of, const Document& numbers, const std::string& path) {
  constexpr int kToEachSide = 60;
  constexpr double kStep = 2.5e-4;
  std::vector<Eigen::Vector2d> before;
  double middle = 0.0;
  for (int k = -kToEachSide, first = k, most = 0; k <= kToEachSide; ++k) {
    Document other = numbers;
    other.set(path, numbers.get(path) * (1.0 + k * kStep));
    const TireDescription description = read_tire(other.root());
    FeTire tire(description);
    auto points = touching(tire, run(tire, description.pressure, of, 0).states.back());
    if (!same_points(points, before)) first = k;
    if (k - first > most) {
      most = k - first;
      middle = 0.5 * (first + k) * kStep;
    }
    before = std::move(points);
  }
  return middle;
}

/// Where the number is moved by that share. Whether the slopes are right there is not looked at.
Errors errors_beside(const Case& of,
                     const Document& numbers,
                     const std::string& path,
                     double share) {
  Case one = of;
  one.paths = {path};
  Document other = numbers;
  other.set(path, numbers.get(path) * (1.0 + share));
  return Sloped(one, other).errors(0);
}

/// Of every number a row.
void error_rows(Table& table, const Case& of, const Document& numbers) {
  const Sloped at(of, numbers);
  table.note(fmt::format("{}: what trials are off", of.name),
             fmt::format("loads {:.0e}, modes {:.0e}",
                         at.judge().noise(0, kLoads),
                         at.judge().noise(kLoads, kModes)));
  for (std::size_t k = 0; k < of.paths.size(); ++k) {
    Errors errors = at.errors(k);
    std::string text = in_words(errors);
    if (!is_told(errors)) {
      const double share = widest_reach(of, numbers, of.paths[k]);
      errors = errors_beside(of, numbers, of.paths[k], share);
      text += fmt::format("; {:+.2f} % beside it {}", 100.0 * share, in_words(errors));
    }
    table.row(fmt::format("{}: {}", of.name, of.paths[k]),
              text,
              fmt::format("<= {:.0e}", kError),
              std::max(errors.loads, errors.modes) <= kError && is_told(errors));
  }
}

void draw(std::vector<std::string>& paths, RandomStream& random) {
  while (paths.size() > kDrawn)
    paths.erase(paths.begin() + static_cast<std::ptrdiff_t>(random.below(paths.size())));
}

struct Asked {
  bool all = false;
  std::uint64_t seed = kSeed;
  std::string tire, path;
};

int bench(const Asked& asked) {
  Table table("sensitivities");
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

int main(int count, char** arguments) {
  latsch::benchmarks::Asked asked;
  const std::string first = count > 1 ? arguments[1] : "";
  asked.all = first == "all";
  if (count > 2) asked.tire = arguments[2];
  if (count > 3) asked.path = arguments[3];
  return latsch::benchmarks::guarded([&] {
    if (!asked.all && !first.empty()) asked.seed = std::stoull(first);
    return latsch::benchmarks::bench(asked);
  });
}
