// SPDX-License-Identifier: Apache-2.0
// What the studies of tire B claim: one minimum, stiffness that goes over, a foreign truth found
//
//   ./bench.sh tire_studies [uniqueness | transfer | foreign_truth]   all of them; some ten minutes
//
// The studies are run by the program as a person runs them, in copies of their folders with
// journals of their own. Uniqueness: the grid of 221 trials, and fits of the force alone, then of
// force and modes, that start at the four corners of the grid. One minimum is one place that all of
// them end at; a valley is one where they end apart and meet the measurements all the same.
// Transfer: the signs of Fig. 8 of [Hempel & Oertel 2016] with the intervals of the fits. Foreign
// truth: what CalculiX has computed lies in the study, committed, for it takes CalculiX minutes;
// measure.py there computes it anew.
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
#include "fit_study.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kLevel = 1e-4;  // of the target: 1 % of error, root mean square
constexpr double kSame = 0.02;   // two fits that end so near each other end at one place
constexpr double kApart = 2.0;   // times, where they do not
constexpr double kValley = 0.1;  // of the range at least that a valley at kLevel takes more
constexpr double kWider = 4.0;   // times the factor an interval with modes spans

/// A copy of studies/, journals left out.
class Studies {
 public:
  Studies() {
    for (const char* name : {"tires",
                             "tire_b_specimen",
                             "tire_b_uniqueness",
                             "tire_b_stiffness_transfer",
                             "foreign_truth"}) {
      copy(fs::path(LATSCH_SOURCE_DIR) / "studies" / name, folder_ / name);
    }
  }

  fs::path at(const std::string& file) const { return folder_.path() / file; }

  /// The same study under another name, with other initial values by variable.
  std::string started_at(const std::string& study,
                         const std::string& name,
                         const std::map<std::string, std::string>& initial) const {
    std::string text = read_text_file(at(study));
    text = std::regex_replace(text, std::regex("\njournal = [^\n]*"), "");
    for (const auto& [variable, value] : initial) {
      const std::regex there("(\\[variable\\." + variable + "\\][^\\[]*\ninitial = )\"[^\"]*\"");
      text = std::regex_replace(text, there, "$1\"" + value + "\"");
    }
    const fs::path file = at(study).parent_path() / (name + ".toml");
    write_text_file(file, text);
    return fs::relative(file, folder_.path()).string();
  }

  /// What `latsch VERB STUDY ARGUMENTS --json` answers.
  Json ask(const std::string& verb,
           const std::string& study,
           const std::string& arguments = {}) const {
    const fs::path answer = at("answer.json");
    const std::string command = fmt::format("'{}' {} '{}' {} --json --quiet > '{}'",
                                            program().string(),
                                            verb,
                                            at(study).string(),
                                            arguments,
                                            answer.string());
    if (std::system(command.c_str()) != 0) throw std::runtime_error(command + " failed");
    return Json::parse(read_text_file(answer)).at("result");
  }

 private:
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
  std::optional<double> lower, upper;  // of its interval; none: the bounds hold it, not the data
  bool has_interval = false;

  bool is_inside(double truth) const {
    return has_interval && (!lower || truth >= *lower) && (!upper || truth <= *upper);
  }
  /// From the lower end to the upper one, infinity where one is open.
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

constexpr std::array<std::array<const char*, 2>, 4> kCorners = {
    {{"14 N/mm^2", "50 N/mm^2"},
     {"14 N/mm^2", "3200 N/mm^2"},
     {"36 N/mm^2", "50 N/mm^2"},
     {"36 N/mm^2", "3200 N/mm^2"}}};  // matrix and carcass

struct Ends {
  std::map<std::string, std::array<double, 2>> range;  // of where the fits ended, by variable
  double worst = 0.0;                                  // target among them
  double farthest() const {
    double ratio = 1.0;
    for (const auto& [name, ends] : range) ratio = std::max(ratio, ends[1] / ends[0]);
    return ratio;
  }
  std::string text() const {
    std::string text;
    for (const auto& [name, ends] : range)
      text += fmt::format("{} {:.4g} .. {:.4g}, ", name, ends[0], ends[1]);
    return text + fmt::format("targets up to {:.4f} %", 100.0 * worst);
  }
};

Ends fits_from_corners(const Studies& studies, const std::string& study, const std::string& name) {
  Ends ends;
  for (std::size_t i = 0; i < kCorners.size(); ++i) {
    const Json answer =
        studies.ask("run",
                    studies.started_at(study,
                                       fmt::format("{}_{}", name, i),
                                       {{"matrix", kCorners[i][0]}, {"carcass", kCorners[i][1]}}));
    ends.worst = std::max(ends.worst, answer.at("target").get<double>());
    for (const auto& [variable, found] : values_of(answer)) {
      auto [at, is_first] = ends.range.try_emplace(variable, std::array{found.value, found.value});
      at->second[0] = std::min(at->second[0], found.value);
      at->second[1] = std::max(at->second[1], found.value);
    }
  }
  return ends;
}

struct Grid {
  std::size_t minima = 0;
  int points = 0;      // at most at kLevel
  double share = 0.0;  // of the carcass' range that they take
};

Grid grid(const Studies& studies, const std::string& study) {
  const Json answer = studies.ask("doe", study, fmt::format("--level \"{} %\"", 100.0 * kLevel));
  Grid found;
  if (answer.contains("minima")) found.minima = answer.at("minima").size();
  if (answer.contains("extent")) {
    found.points = answer.at("extent").at("points");
    found.share = answer.at("extent").at("share").at(1);  // after the matrix'
  }
  return found;
}

std::string text_of(const Grid& grid) {
  return fmt::format("{} points, {:.0f} % of the carcass' range, {} minima of the grid",
                     grid.points,
                     100.0 * grid.share,
                     grid.minima);
}

void compare_uniqueness(const Studies& studies, Table& table) {
  const Ends one = fits_from_corners(studies, "tire_b_uniqueness/study.toml", "from_corner");
  table.row("uniqueness, fits from the corners of the grid: force and modes",
            one.text(),
            fmt::format("one place, within {:g} %", 100.0 * kSame),
            one.farthest() <= 1.0 + kSame);
  const Ends valley =
      fits_from_corners(studies, "tire_b_uniqueness/force.toml", "force_from_corner");
  table.row("uniqueness, the same: force alone",
            valley.text(),
            fmt::format("places {:g} times apart, targets of at most 0.01 %", kApart),
            valley.farthest() >= kApart && valley.worst <= kLevel);
  const Values two_sided = fitted(studies, "tire_b_uniqueness/study.toml"),
               open = fitted(studies, "tire_b_uniqueness/force.toml");
  for (const char* name : {"matrix", "carcass"})
    table.note(fmt::format("uniqueness, {}: force alone; force and modes", name),
               open.at(name).text() + "; " + two_sided.at(name).text());
  const Value& carcass = two_sided.at("carcass");
  table.row("uniqueness, interval of the carcass",
            carcass.text(),
            fmt::format("two ends with modes; force alone: open, or {:g} times the factor", kWider),
            carcass.lower && carcass.upper && open.at("carcass").has_interval &&
                kWider * carcass.factor() <= open.at("carcass").factor());
  const Grid modes = grid(studies, "tire_b_uniqueness/study.toml"),
             force = grid(studies, "tire_b_uniqueness/force.toml");
  table.note("uniqueness, targets of at most 0.01 %: force alone", text_of(force));
  table.row("uniqueness, the same: force and modes",
            text_of(modes),
            "a smaller share",
            modes.points > 0 && modes.share + kValley <= force.share);
}

// --- transfer ---

/// Whether a modulus is higher with one mode than with five, or lower, and by more than both
/// intervals overlap.
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
    table.row(fmt::format("foreign truth, {}: {}, interval with the mesh's error", name, variable),
              value.text(),
              fmt::format("holds {:.5g}", truth),
              value.is_inside(truth));
  }
}

}  // namespace

int run(const std::string& only) {
  Table table("tire_studies");
  const Studies studies;
  const auto asks = [&](const char* name) { return only.empty() || only == name; };
  if (asks("foreign_truth")) {
    compare_truth(
        studies, "same mesh and element", "foreign_truth/same_mesh.toml", 1e-3, false, table);
    compare_truth(studies,
                  "shipped element, quadratic deck",
                  "foreign_truth/shipped_element.toml",
                  0.03,
                  true,
                  table);
  }
  if (asks("transfer")) compare_transfer(studies, table);
  if (asks("uniqueness")) compare_uniqueness(studies, table);
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  return latsch::benchmarks::guarded([&] { return latsch::benchmarks::run(only); });
}
