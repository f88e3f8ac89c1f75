// SPDX-License-Identifier: Apache-2.0
// Checks the claims of the studies of tires A and B: uniqueness of the fit, transfer of stiffness
// between parameters, and a fit to results of another program.
//
//   ./bench.sh tire_studies [uniqueness | tire_a | transfer | foreign_truth]   all: ten minutes
//
// The studies are run by the program as by a user, in copies of their folders with separate
// journals.
//
// Uniqueness: fits of force and modes from three starts, two of them opposite corners of the grid,
// must end at one point. With the carcass modulus fixed at half and at twice its value and the
// matrix modulus fitted, the force alone is matched as well (a valley of the objective). Force and
// modes are not matched: their error excludes both values at 99 %. The distance between the ends of
// fits of the force alone does not measure the valley, because fits reach its floor however flat it
// is.
//
// Tire A: fitting more moduli, then densities, must reduce the error each time. Transfer: the signs
// of Fig. 8 of [Hempel & Oertel 2016], judged with the intervals of the fits. Foreign truth: the
// measurements are results of CalculiX. They are committed in the study, because they take minutes;
// measure.py there computes them again.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "coarse_mesh.h"
#include "command.h"
#include "fit_study.h"
#include "numerics/student_t.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

using Settings = std::map<std::string, std::string>;  // initial values by variable

// value of the objective below which a fit counts as converged: an RMS error of 1 %
constexpr double kLevel = 1e-4;
constexpr double kSame = 0.02;  // relative distance up to which two fits end at one point
constexpr double kExcluded = 0.99,
                 // Confidence levels from which a profile counts as a single point, or as a valley.
    kNotExcluded = 0.95;
// least ratio of the length of an interval without modes to that of one with modes
constexpr double kWider = 4.0;
// least factor by which the error of tire A decreases; in [Hempel & Oertel 2016] from 15 % to 7.4 %
constexpr double kFall = 2.0;

// Relative tolerance of the moduli, on the shipped mesh and on one refined twofold. The mesh of the
// CalculiX deck itself changes the rubber by 1 % and the carcass by 3 %
// (studies/foreign_truth/README.md).
constexpr double kMeshReach = 0.03;

/// A copy of the folder studies/ without its journals.
class Studies {
 public:
  Studies() {
    for (const char* name : {"tires",
                             "tire_a",
                             "tire_b_specimen",
                             "tire_b_uniqueness",
                             "tire_b_stiffness_transfer",
                             "foreign_truth"}) {
      copy(fs::path(LATSCH_SOURCE_DIR) / "studies" / name, folder_ / name);
    }
  }

  fs::path at(const std::string& file) const { return folder_.path() / file; }

  /// Writes a copy of the study under another name, with other initial values.
  std::string started_at(const std::string& study,
                         const std::string& name,
                         const Settings& initial) const {
    std::string text = read_text_file(at(study));
    for (const auto& [variable, value] : initial) {
      const std::regex there("(\\[variable\\." + variable + "\\][^\\[]*\ninitial = )\"[^\"]*\"");
      text = std::regex_replace(text, there, "$1\"" + value + "\"");
    }
    return write_beside(study, name, text);
  }

  /// Writes a copy of the uniqueness study in which the carcass modulus is no variable but is fixed
  /// at `carcass`, N/mm^2.
  std::string held_at(double carcass, bool with_modes) const {
    const std::string study = "tire_b_uniqueness/study.toml";
    const std::string name = fmt::format("held_at_{:.0f}{}", carcass, with_modes ? "_modes" : "");
    std::string tire = read_text_file(at("tires/passenger_225_50R16.toml"));
    tire = std::regex_replace(
        tire,
        std::regex("(\\[layer\\.carcass\\][\\s\\S]*?young_modulus = )\"[^\"]*\""),
        fmt::format("$1\"{:.6g} N/mm^2\"", carcass),
        std::regex_constants::format_first_only);
    std::string text = read_text_file(at(study));
    text = std::regex_replace(text, std::regex("\\[variable\\.carcass\\][^\\[]*"), "");
    if (!with_modes)
      text = std::regex_replace(text, std::regex("\\[experiment\\.modes\\][^\\[]*"), "");
    text = std::regex_replace(
        text, std::regex("\nmodel = [^\n]*"), fmt::format("\nmodel = \"{}_tire.toml\"", name));
    write_text_file(at(study).parent_path() / (name + "_tire.toml"), tire);
    return write_beside(study, name, text);
  }

  /// Writes a copy of the study in which the tire has the refined mesh that the key [refined]
  /// describes, instead of its own.
  std::string on_refined_mesh(const std::string& study, const std::string& tire_file) const {
    std::string text = read_text_file(at(study)), tire = read_text_file(at(tire_file));
    const std::regex number("\nmodel\\.mesh\\.(\\w+) = (\\d+)");
    for (auto found = std::sregex_iterator(text.begin(), text.end(), number);
         found != std::sregex_iterator();
         ++found) {
      const std::string key = (*found)[1], value = (*found)[2];
      tire = std::regex_replace(
          tire, std::regex(fmt::format("\n{} = \\d+", key)), fmt::format("\n{} = {}", key, value));
    }
    write_text_file(at(study).parent_path() / "refined_tire.toml", tire);
    text = std::regex_replace(text, std::regex("\n\\[refined\\][^\\[]*"), "\n");
    text =
        std::regex_replace(text, std::regex("\nmodel = [^\n]*"), "\nmodel = \"refined_tire.toml\"");
    return write_beside(study, "refined", text);
  }

  /// Gives a tire file a coarse mesh.
  void coarsen(const std::string& tire) const {
    write_text_file(at(tire), with_coarse_mesh(read_text_file(at(tire))));
  }

  /// Writes a copy of the study without intervals that ends after two steps of the optimizer.
  std::string shortened(const std::string& study) const {
    std::string text = read_text_file(at(study)) + "\n[optimizer]\nmax_steps = 2\n";
    text = std::regex_replace(text, std::regex("\\[run\\]"), "[run]\nintervals = false");
    return write_beside(study, fs::path(study).stem().string() + "_shortened", text);
  }

  /// Returns the output of `latsch VERB STUDY ARGUMENTS --json`.
  Json ask(const std::string& verb,
           const std::string& study,
           const std::string& arguments = {}) const {
    const Printed printed = run_command(fmt::format(
        "'{}' {} '{}' {} --json --quiet", program().string(), verb, at(study).string(), arguments));
    return Json::parse(printed.output).at("result");
  }

 private:
  std::string write_beside(const std::string& study,
                           const std::string& name,
                           const std::string& text) const {
    const fs::path file = at(study).parent_path() / (name + ".toml");
    write_text_file(file, text);
    return fs::relative(file, folder_.path()).string();
  }

  static void copy(const fs::path& from, const fs::path& to) {
    fs::create_directories(to);
    for (const auto& entry : fs::directory_iterator(from)) {
      if (entry.is_directory()) {
        copy(entry.path(), to / entry.path().filename());
      } else if (entry.path().string().find(".latsch") == std::string::npos) {
        fs::copy_file(entry.path(), to / entry.path().filename());
      }
    }
  }

  ScratchFolder folder_;
};

struct Value {
  double value = 0.0;
  std::string unit;
  // ends of the confidence interval; none: the interval ends at the bound of the variable
  std::optional<double> lower, upper;
  bool has_interval = false;

  bool is_inside(double truth) const {
    return has_interval && (!lower || truth >= *lower) && (!upper || truth <= *upper);
  }
  /// Returns the upper end over the lower one; infinite if one is open.
  double factor() const {
    return lower && upper ? *upper / *lower : std::numeric_limits<double>::infinity();
  }
  std::string text() const {
    if (!has_interval) return fmt::format("{:.5g} {}, no interval", value, unit);
    const auto end = [](const std::optional<double>& x) {
      return x ? fmt::format("{:.5g}", *x) : std::string("open");
    };
    return fmt::format("{:.5g} {} ({} .. {})", value, unit, end(lower), end(upper));
  }
};

using Values = std::map<std::string, Value>;

Values values_of(const Json& answer) {
  Values values;
  for (const Json& row : answer.at("variables")) {
    Value value{row.at("value"), row.at("unit"), {}, {}, row.contains("interval")};
    if (value.has_interval) {
      const Json& interval = row.at("interval");
      if (!interval[0].is_null()) value.lower = interval[0].get<double>();
      if (!interval[1].is_null()) value.upper = interval[1].get<double>();
    }
    values[row.at("name")] = value;
  }
  return values;
}

Values fitted(const Studies& studies, const std::string& study) {
  return values_of(studies.ask("run", study));
}

// --- uniqueness ---

/// Further initial values for fits of force and modes: two opposite corners of the study's grid,
/// N/mm^2.
const std::vector<Settings> kCorners = {{{"matrix", "14 N/mm^2"}, {"carcass", "50 N/mm^2"}},
                                        {{"matrix", "36 N/mm^2"}, {"carcass", "3200 N/mm^2"}}};
// Fixed values of the carcass modulus, as multiples of the value that the fit with modes finds.
constexpr std::array<double, 3> kHeld = {0.5, 1.0, 2.0};

/// Returns the largest ratio of one variable between the ends of fits from several starts.
double farthest(const std::vector<Values>& ends) {
  double ratio = 1.0;
  for (const auto& [name, first] : ends.front()) {
    double low = first.value, high = first.value;
    for (const Values& end : ends) {
      low = std::min(low, end.at(name).value);
      high = std::max(high, end.at(name).value);
    }
    ratio = std::max(ratio, high / low);
  }
  return ratio;
}

/// Returns the number of rows in a table of measurements, without its header.
int rows_of(const fs::path& file) {
  const std::string text = read_text_file(file);
  return static_cast<int>(std::ranges::count(text, '\n')) - 1;
}

/// Returns the ratio of the objective to its minimum above which a fixed value of a variable is
/// excluded at this confidence level. The objective is the mean of `values` squared errors,
/// minimized over two variables: F = (values - 2) (ratio - 1) has 1 and values - 2 degrees of
/// freedom and equals t^2 [Bates & Watts, Nonlinear Regression Analysis and Its Applications, Wiley
/// 1988, section 6.1: profile t].
double excluded_from(double level, int values) {
  const double nu = values - 2.0, t = numerics::student_t_quantile(0.5 * (1.0 + level), nu);
  return 1.0 + t * t / nu;
}

void compare_valley(const Studies& studies, double carcass, Table& table) {
  std::array<double, kHeld.size()> force{}, modes{};  // minima over the matrix modulus
  for (std::size_t i = 0; i < kHeld.size(); ++i) {
    force[i] = studies.ask("run", studies.held_at(kHeld[i] * carcass, false)).at("target");
    modes[i] = studies.ask("run", studies.held_at(kHeld[i] * carcass, true)).at("target");
  }
  const std::string measured = "tire_b_specimen/measured_nearly_one_rubber/";
  const int forces = rows_of(studies.at(measured + "stiffness_26bar.csv")),
            frequencies = rows_of(studies.at(measured + "modes.csv"));
  const double valley = excluded_from(kNotExcluded, forces),
               walls = excluded_from(kExcluded, forces + frequencies);
  const auto text = [&](const auto& targets) {
    std::string text;
    for (std::size_t i = 0; i < kHeld.size(); ++i)
      text +=
          fmt::format("{}{:.4g}: {:.4f} %", i ? ", " : "", kHeld[i] * carcass, 100.0 * targets[i]);
    return text;
  };
  table.row("uniqueness, target with the carcass held, N/mm^2: force alone",
            text(force),
            fmt::format(
                "all at most {:g} %, none {:.1f} times another: a valley", 100.0 * kLevel, valley),
            std::ranges::max(force) <= kLevel &&
                std::ranges::max(force) < valley * std::ranges::min(force));
  table.row("uniqueness, the same: force and modes",
            text(modes),
            fmt::format("half and twice at least {:.2f} times the middle", walls),
            std::min(modes.front(), modes.back()) >= walls * modes[1]);
}

void compare_uniqueness(const Studies& studies, Table& table) {
  const std::string modes = "tire_b_uniqueness/study.toml";
  const Values two_sided = fitted(studies, modes),
               open = fitted(studies, "tire_b_uniqueness/force.toml");
  std::vector<Values> ends = {two_sided};
  for (std::size_t i = 0; i < kCorners.size(); ++i)
    ends.push_back(
        fitted(studies, studies.started_at(modes, fmt::format("corner_{}", i), kCorners[i])));
  const double apart = farthest(ends) - 1.0;
  table.row("uniqueness, force and modes: fits from three places end apart by",
            fmt::format("{:.2g} %", 100.0 * apart),
            fmt::format("at most {:g} %: one place", 100.0 * kSame),
            apart <= kSame);
  for (const char* name : {"matrix", "carcass"})
    table.note(fmt::format("uniqueness, {}: force alone; force and modes", name),
               open.at(name).text() + "; " + two_sided.at(name).text());
  const Value& carcass = two_sided.at("carcass");
  table.row("uniqueness, interval of the carcass",
            carcass.text(),
            fmt::format("two ends with modes; force alone: open, or {:g} times the factor", kWider),
            carcass.lower && carcass.upper && open.at("carcass").has_interval &&
                kWider * carcass.factor() <= open.at("carcass").factor());
  compare_valley(studies, carcass.value, table);
}

// --- transfer ---

/// Compares the modulus fitted with one mode with that fitted with five modes: which is higher, and
/// whether their intervals are disjoint.
void compare_sign(
    const std::string& name, const Value& five, const Value& one, bool rises, Table& table) {
  const bool is_right = rises ? one.value > five.value : one.value < five.value;
  const Value &low = rises ? five : one, &high = rises ? one : five;
  const bool is_beyond = low.upper && high.lower && *low.upper < *high.lower;
  table.row(fmt::format("transfer, {}: five modes, one mode", name),
            fmt::format("{}; {}: {:+.0f} %, {} the intervals",
                        five.text(),
                        one.text(),
                        100.0 * (one.value / five.value - 1.0),
                        is_beyond ? "beyond" : "inside"),
            rises ? "rises" : "falls",
            is_right && five.has_interval && one.has_interval);
}

void compare_transfer(const Studies& studies, Table& table) {
  const Values five = fitted(studies, "tire_b_stiffness_transfer/modes_5.toml"),
               one = fitted(studies, "tire_b_stiffness_transfer/modes_1.toml");
  compare_sign("belt", five.at("belt"), one.at("belt"), false, table);
  compare_sign("rubber", five.at("matrix"), one.at("matrix"), true, table);
}

// --- tire A ---

void compare_tire_a(const Studies& studies, Table& table) {
  const auto error = [&](const std::string& study) {
    return std::sqrt(studies.ask("run", "tire_a/" + study).at("target").get<double>());
  };
  const double three = error("three.toml"), five = error("five.toml"),
               masses = error("masses.toml");
  const auto falls = [&](const std::string& what, double from, double to) {
    table.row("tire A, root of the target: " + what,
              fmt::format("{:.2f} %, {:.2f} %: {:.1f} times", 100.0 * from, 100.0 * to, from / to),
              fmt::format("falls at least {:g} times", kFall),
              from >= kFall * to);
  };
  falls("three moduli, five", three, five);
  falls("five moduli, and three densities", five, masses);
}

// --- foreign truth ---

const std::map<std::string, double> kTruth = {
    {"matrix", 5.960264900662252}, {"carcass", 2000.0}, {"belt", 20000.0}};  // N/mm^2

void compare_truth(const Studies& studies,
                   const std::string& name,
                   const std::string& study,
                   double reach,
                   bool covered,
                   Table& table) {
  const Values found = fitted(studies, study);
  for (const auto& [variable, truth] : kTruth) {
    const Value& value = found.at(variable);
    const double error = value.value / truth - 1.0;
    table.row(fmt::format("foreign truth, {}: {}", name, variable),
              fmt::format("{}, {:+.3f} %", value.text(), 100.0 * error),
              fmt::format("within {:g} %", 100.0 * reach),
              std::abs(error) <= reach);
    if (!covered) continue;
    table.row(fmt::format("foreign truth, {}: {}, its interval", name, variable),
              value.text(),
              fmt::format("holds {:.5g}", truth),
              value.is_inside(truth));
  }
}

/// Runs every variant of a study in this benchmark once on a coarse tire, with two optimizer steps
/// for each fit.
void smoke(const Studies& studies, Table& table) {
  const std::string modes = "tire_b_uniqueness/study.toml";
  studies.coarsen("tires/passenger_225_50R16.toml");
  const auto row = [&](const std::string& what, const std::string& study) {
    const Json answer = studies.ask("run", studies.shortened(study));
    table.row(what,
              fmt::format("target {:.3g}", answer.at("target").get<double>()),
              "a number",
              std::isfinite(answer.at("target").get<double>()) && !values_of(answer).empty());
  };
  row("started at a corner", studies.started_at(modes, "corner", kCorners.front()));
  row("the carcass held, with modes", studies.held_at(300.0, true));
  row("the carcass held, force alone", studies.held_at(300.0, false));
  const std::string refined = studies.on_refined_mesh("foreign_truth/shipped_element.toml",
                                                      "foreign_truth/shipped_tire.toml");
  table.row(
      "on its refined mesh", refined, "is in order", studies.ask("check", refined).is_object());
}

}  // namespace

int run(const Options& options) {
  const std::string only = options.text("WHICH");
  Table table("tire_studies", options);
  const Studies studies;
  if (options.is_smoke()) {
    smoke(studies, table);
    return table.exit_code();
  }
  const auto asks = [&](const char* name) { return only.empty() || only == name; };
  if (asks("foreign_truth")) {
    compare_truth(
        studies, "same mesh and element", "foreign_truth/same_mesh.toml", 1e-3, false, table);
    // The fit is judged first with intervals that include the mesh error from [refined], then with
    // intervals that do not.
    compare_truth(studies,
                  "shipped element, quadratic deck",
                  "foreign_truth/shipped_element.toml",
                  kMeshReach,
                  true,
                  table);
    compare_truth(studies,
                  "the same, refined twice",
                  studies.on_refined_mesh("foreign_truth/shipped_element.toml",
                                          "foreign_truth/shipped_tire.toml"),
                  kMeshReach,
                  true,
                  table);
  }
  if (asks("tire_a")) compare_tire_a(studies, table);
  if (asks("transfer")) compare_transfer(studies, table);
  if (asks("uniqueness")) compare_uniqueness(studies, table);
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc,
      argv,
      {{"WHICH", "", "uniqueness, tire_a, transfer or foreign_truth: that alone"}},
      latsch::benchmarks::run);
}
