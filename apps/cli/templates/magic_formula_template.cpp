// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/magic_formula_template.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/text.h"
#include "cli/templates/recorded_lag.h"
#include "correlation/laboratory/measurement.h"
#include "experiment/rigs/slip/condition_levels.h"
#include "formats/tire/tir_file.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;
using correlation::Measurement;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::size_t kMostSamples = 2000;  // further samples of a sweep give little information,
                                            // because neighbors share noise
constexpr double kFreeRolling = 0.02;       // greatest |kappa| of a wheel that is not driven
constexpr double kSmallAngle = 1.5 * kDegree, kSmallSlip = 0.02;  // up to which forces are linear

/// Returns a quantile of a channel.
double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (values.empty()) return 0.0;
  const auto at = values.begin() + std::lround(share * (std::ssize(values) - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Slope and value at 0 of the least-squares line through y over x.
std::pair<double, double> line(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mx += x[i] / n;
    my += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
  }
  const double slope = xx > 0.0 ? xy / xx : 0.0;
  return {slope, my - slope * mx};
}

/// The samples of a test and which conditions vary in them.
class TireTest {
 public:
  explicit TireTest(const Measurement& measured) : measured_(measured) {
    cornering = has("Fy") && spread("alpha") > 1.0 * kDegree;
    driving = has("Fx") && spread("kappa") > 2.0 * kFreeRolling;
    combined = cornering && driving;
    if (cornering) side_lag = recorded_lag(measured, "Fy", "alpha", kSmallAngle);
    if (driving) drive_lag = recorded_lag(measured, "Fx", "kappa", kSmallSlip);
    lags = (side_lag && side_lag->is_seen()) || (drive_lag && drive_lag->is_seen());
  }

  std::optional<RecordedLag> side_lag, drive_lag;  // lags of Fy and Fx; none: cannot be determined
  bool lags = false;
  bool cornering, driving, combined;

  /// Levels of the samples that a stage fits: those of driving, or of cornering alone if a test has
  /// both.
  magic_formula::ConditionLevels levels_of(bool of_driving) const {
    return condition_levels([&](const std::string& channel) {
      std::vector<double> all = of(channel);
      const std::vector<double>& kappa = of("kappa");
      if (!(cornering && driving) || kappa.size() != all.size()) return all;
      std::vector<double> some;
      for (std::size_t i = 0; i < all.size(); ++i)
        if ((std::abs(kappa[i]) > kFreeRolling) == of_driving) some.push_back(all[i]);
      return some;
    });
  }

  bool has(const std::string& channel) const {
    return measured_.has(channel) && quantile(magnitudes(channel), 0.9) > 0.0;
  }
  const std::vector<double>& of(const std::string& channel) const {
    static const std::vector<double> none;
    return measured_.has(channel) ? measured_.values(channel, measured_.unit(channel)) : none;
  }
  double median(const std::string& channel) const { return quantile(of(channel), 0.5); }
  double spread(const std::string& channel) const {
    return quantile(of(channel), 0.97) - quantile(of(channel), 0.03);
  }
  std::vector<double> magnitudes(const std::string& channel) const {
    std::vector<double> all = of(channel);
    for (double& one : all) one = std::abs(one);
    return all;
  }
  /// Grip: the greatest ratio of a force to the load.
  double grip(const std::string& force) const { return quantile(shares(force), 0.98); }
  /// Slope of a force over the load at slips below `most` at which the other slip is small.
  double steepness(const std::string& force, const std::string& slip, double most) const {
    std::vector<double> x, y;
    const auto &Fz = of("Fz"), &F = of(force), &s = of(slip);
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (std::abs(s[i]) > most || Fz[i] < 0.5 * median("Fz")) continue;
      x.push_back(s[i]);
      y.push_back(F[i] / Fz[i]);
    }
    return x.size() < 3 ? 0.0 : line(x, y).first;
  }

 private:
  std::vector<double> shares(const std::string& force) const {
    std::vector<double> all = magnitudes(force);
    const double light = 0.2 * median("Fz");
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = of("Fz")[i] > light ? all[i] / of("Fz")[i] : 0.0;
    return all;
  }

  const Measurement& measured_;
};

/// Coefficients that a stage frees, if the test determines them.
struct Stage {
  const char* name;
  std::vector<std::string> experiments, coefficients;
};

/// The stages with all coefficients that the forces of a test could determine, for any conditions.
/// PEY3, PEY4, QEZ4 and QEZ5, the dependence of E on the side of the slip, are left out: where the
/// formula limits E to 1 no data determine them, and a search would vary them for long.
std::vector<Stage> every_stage_of(const TireTest& t) {
  std::vector<Stage> stages;
  if (t.cornering) {
    stages.push_back(
        {"Fy",
         {"Fy"},
         {"PCY1", "PDY1", "PEY1", "PKY1", "PHY1", "PVY1", "PDY2", "PEY2", "PKY2", "PHY2", "PVY2"}});
    stages.push_back(
        {"Fy_conditions",
         {"Fy"},
         {"PDY3", "PKY3", "PKY6", "PVY3", "PKY7", "PVY4", "PPY1", "PPY3", "PPY2", "PPY4", "PPY5"}});
    if (t.side_lag && t.side_lag->is_seen())
      stages.push_back({"relaxation_y", {"Fy"}, {"LATERAL_STIFFNESS"}});
  }
  if (t.driving) {
    stages.push_back(
        {"Fx", {"Fx"}, {"PCX1", "PDX1", "PEX1", "PKX1", "PHX1", "PVX1", "PDX2", "PKX2", "PKX3"}});
    if (t.combined)
      for (const char* combined : {"RBX1", "RBX2", "RCX1"})
        stages.back().coefficients.emplace_back(combined);
    stages.push_back({"Fx_conditions", {"Fx"}, {"PDX3", "PPX1", "PPX2", "PPX3", "PPX4"}});
    if (t.drive_lag && t.drive_lag->is_seen())
      stages.push_back({"relaxation_x", {"Fx"}, {"LONGITUDINAL_STIFFNESS"}});
  }
  if (t.combined) stages.push_back({"combined", {"Fy_driven"}, {"RBY1", "RBY2", "RCY1", "RHY1"}});
  if (t.cornering && t.has("Mz")) {
    stages.push_back({"Mz",
                      {"Mz"},
                      {"QBZ1",
                       "QBZ9",
                       "QCZ1",
                       "QDZ1",
                       "QDZ6",
                       "QEZ1",
                       "QHZ1",
                       "QBZ2",
                       "QDZ2",
                       "QDZ7",
                       "QEZ2",
                       "QHZ2"}});
    stages.push_back({"Mz_conditions",
                      {"Mz"},
                      {"QBZ4", "QBZ5", "QDZ3", "QDZ8", "QHZ3", "QDZ9", "QHZ4", "PPZ1", "PPZ2"}});
  }
  if (t.has("Mx")) {
    stages.push_back({"Mx", {"Mx"}, {"QSX1", "QSX2"}});
    if (t.cornering) stages.back().coefficients.emplace_back("QSX3");
  }
  if (t.has("My")) stages.push_back({"My", {"My"}, {"QSY1", "QSY3"}});
  return stages;
}

/// The freed coefficients, and the others by the reason: "of order 2 in the pressure, of which
/// there are 2 levels: 69, 83 kPa" with the coefficients for which this is true.
struct Freed {
  std::vector<Stage> stages;
  std::vector<std::pair<std::string, std::vector<std::string>>> left_out;

  std::vector<std::string> in_words() const {
    std::vector<std::string> lines;
    for (const auto& [reason, names] : left_out)
      lines.push_back(fmt::format("not freed, {}: {}", reason, fmt::join(names, ", ")));
    return lines;
  }
};

/// A coefficient of a condition is freed if the recordings have more distinct levels of the
/// condition than the order of the coefficient's polynomial.
Freed stages_of(const TireTest& t) {
  Freed freed;
  const magic_formula::ConditionLevels of_cornering = t.levels_of(false),
                                       of_driving = t.levels_of(true);
  for (Stage& stage : every_stage_of(t)) {
    const std::string& experiment = stage.experiments.front();
    const bool is_of_driving = experiment == "Fx" || experiment == "Fy_driven" || !t.cornering;
    std::vector<std::string> told;
    for (const std::string& name : stage.coefficients) {
      const std::string reason =
          magic_formula::reason_against(name, is_of_driving ? of_driving : of_cornering);
      if (reason.empty()) {
        told.push_back(name);
        continue;
      }
      const auto known = std::find_if(freed.left_out.begin(),
                                      freed.left_out.end(),
                                      [&](const auto& one) { return one.first == reason; });
      if (known == freed.left_out.end())
        freed.left_out.push_back({reason, {name}});
      else
        known->second.push_back(name);
    }
    stage.coefficients = told;
    if (!told.empty()) freed.stages.push_back(std::move(stage));
  }
  return freed;
}

void check(const Measurement& measured, const TireTest& test) {
  for (const char* needed : {"Fz", "alpha"}) {
    if (!measured.has(needed))
      throw InputError(measured.place(),
                       fmt::format("has no channel {}: expected the recording of a tire test, with "
                                   "Fz, slips and forces; --column \"{} = NAME [unit]\" says "
                                   "how a column is called",
                                   needed,
                                   needed));
  }
  if (!test.cornering && !test.driving)
    throw InputError(measured.place(),
                     "neither slip angle nor slip goes through a sweep: there is no curve to fit");
}

/// Estimates start values directly from the recordings.
magic_formula::Parameters start_of(const TireTest& t,
                                   const Measurement& measured,
                                   const std::optional<double>& unloaded_radius) {
  magic_formula::Parameters p;
  const auto rounded = [](double x, double to) { return std::round(x / to) * to; };
  p.FNOMIN = std::max(100.0, rounded(t.median("Fz"), 100.0));
  p.NOMPRES = p.INFLPRES = t.has("p") ? rounded(t.median("p"), 1e3) : p.NOMPRES;
  if (t.has("Vx")) p.LONGVL = rounded(std::abs(t.median("Vx")), 0.01);
  double stiffness = 0.0;
  if (t.has("loaded_radius")) {
    const auto [slope, radius] = line(t.of("Fz"), t.of("loaded_radius"));
    p.UNLOADED_RADIUS = rounded(radius, 1e-4);
    if (slope < 0.0) stiffness = -1.0 / slope;
  }
  if (unloaded_radius) p.UNLOADED_RADIUS = *unloaded_radius;
  if (!unloaded_radius && !t.has("loaded_radius"))
    throw InputError(
        measured.place(),
        "has no loaded radius: the tire's radius has to be given, --radius \"0.32 m\"");
  constexpr double kUsualDeflection = 0.05;  // share of the radius, under the nominal load
  p.VERTICAL_STIFFNESS =
      rounded(stiffness > 0.0 ? stiffness : p.FNOMIN / (kUsualDeflection * p.UNLOADED_RADIUS), 1e3);
  const auto digits = [](double x) { return std::round(x * 100.0) / 100.0; };
  constexpr double kAtNominalLoad = 0.9;  // estimate of sin(2 atan(1 / PKY2)) of (4.E25)
  p.PCY1 = 1.4;
  p.PDY1 = t.cornering ? digits(t.grip("Fy")) : 1.0;
  p.PEY1 = -0.5;
  p.PKY1 = std::min(-8.0, digits(t.steepness("Fy", "alpha", kSmallAngle) / kAtNominalLoad));
  p.PKY2 = 1.6;
  p.PCX1 = 1.5;
  p.PDX1 = t.driving ? digits(t.grip("Fx")) : 1.0;
  p.PEX1 = -0.5;
  p.PKX1 = std::max(8.0, digits(t.steepness("Fx", "kappa", kSmallSlip)));
  // Relaxation lengths are slip stiffnesses over these stiffnesses (19).
  if (t.side_lag && t.side_lag->is_seen())
    p.LATERAL_STIFFNESS = rounded(-p.PKY1 * kAtNominalLoad * p.FNOMIN / t.side_lag->sigma, 100.0);
  if (t.drive_lag && t.drive_lag->is_seen())
    p.LONGITUDINAL_STIFFNESS = rounded(p.PKX1 * p.FNOMIN / t.drive_lag->sigma, 100.0);
  p.QBZ1 = 8.0;
  p.QCZ1 = 1.2;
  p.QDZ1 = 0.1;
  p.QEZ1 = -1.0;
  p.RBX1 = p.RBY1 = 10.0;
  p.RBX2 = p.RBY2 = 8.0;
  p.RCX1 = p.RCY1 = 1.0;
  return p;
}

std::string quoted(const std::vector<std::string>& names) {
  return fmt::format("[\"{}\"]", fmt::join(names, "\", \""));
}

/// Returns the keys that all measurements share.
std::string measurement_keys(const TireTestFiles& test, std::size_t every) {
  std::vector<std::string> files;
  for (const fs::path& file : test.files) files.push_back(file.string());
  std::string text = files.size() == 1 ? fmt::format("file = \"{}\"", files.front())
                                       : fmt::format("files = {}", quoted(files));
  if (!test.axes.empty()) text += fmt::format(", axes = \"{}\"", test.axes);
  if (!test.columns.empty()) {
    std::vector<std::string> columns;
    for (const std::string& column : test.columns) {
      const auto equals = column.find('=');
      if (equals == std::string::npos)
        throw InputError("--column " + in_quotes(column) +
                         ": expected our name and the file's, such as \"Fz = LOAD [N]\"");
      columns.push_back(fmt::format(
          "{} = \"{}\"", trimmed(column.substr(0, equals)), trimmed(column.substr(equals + 1))));
    }
    text += fmt::format(", columns = {{{}}}", fmt::join(columns, ", "));
  }
  if (every > 1) text += fmt::format(", every = {}", every);
  return text;
}

Measurement read_all(const TireTestFiles& test) {
  const Document document =
      Document::parse("measurement.all = {" + measurement_keys(test, 1) + "}\n", "recordings");
  return correlation::read_measurement(document.root().table("measurement").table("all"), "");
}

/// Reads the files in the axes that the sign of Fz indicates, if no axes are stated.
std::pair<TireTestFiles, Measurement> read(const TireTestFiles& test) {
  Measurement measured = read_all(test);
  if (!test.axes.empty() || !measured.has("Fz") || quantile(measured.values("Fz", "N"), 0.5) >= 0.0)
    return {test, std::move(measured)};
  TireTestFiles sae = test;
  sae.axes = "sae";
  measured = read_all(sae);
  return {sae, std::move(measured)};
}

std::string experiment(const std::string& name,
                       const std::string& channel,
                       const std::string& set) {
  return fmt::format(
      "experiment.{} = {{kind = \"curve\", y = \"{}/{}\", measurement = \"{}\", exponent = 2, "
      "noise = \"own_stage\"}}\n",
      name,
      set,
      channel,
      set);
}

std::string experiments(const TireTest& t) {
  std::string text;
  if (t.cornering) text += experiment("Fy", "Fy", "cornering");
  if (t.cornering && t.has("Mz")) text += experiment("Mz", "Mz", "cornering");
  if (t.driving) text += experiment("Fx", "Fx", "driving");
  if (t.combined) text += experiment("Fy_driven", "Fy", "driving");
  const std::string set = t.cornering ? "cornering" : "driving";
  for (const char* moment : {"Mx", "My"})
    if (t.has(moment)) text += experiment(moment, moment, set);
  return text;
}

std::string sets(const TireTest& t, const std::string& keys) {
  std::string text;
  const auto add = [&](const char* name, const std::string& select) {
    text += fmt::format("measurement.{} = {{{}{}}}\n", name, keys, select);
  };
  if (t.cornering)
    add("cornering",
        t.driving ? fmt::format(", select = {{kappa = \"-{0} .. {0}\"}}", kFreeRolling) : "");
  if (t.driving)
    add("driving",
        t.cornering ? fmt::format(", select = {{kappa = [\".. -{0}\", \"{0} ..\"]}}", kFreeRolling)
                    : "");
  for (const char* name : {"cornering", "driving"}) {
    if (name == std::string("cornering") ? !t.cornering : !t.driving) continue;
    text += fmt::format("test.{0} = {{kind = \"{1}\", states = {{from = \"measurement.{0}\"}}}}\n",
                        name,
                        t.lags ? "slip_history" : "steady_states");
  }
  return text;
}

/// Describes the loops, one comment each.
std::string lags_in_words(const TireTest& t) {
  std::string text;
  const auto add =
      [&](const char* force, const std::optional<RecordedLag>& lag, double unit, const char* rate) {
        if (!lag) {
          text += fmt::format(
              "# {}: whether it lags cannot be told, for want of time, speed or samples\n", force);
          return;
        }
        text += fmt::format(
            "# {} lags by {:.3f} +- {:.3f} m (95 %), slips at {:.2g} {} and {:.3g} m/s: {}\n",
            force,
            lag->sigma,
            2.0 * lag->deviation,
            lag->rate / unit,
            rate,
            lag->speed,
            lag->is_seen() ? "its relaxation length is fitted" : "states count as steady");
      };
  if (t.cornering) add("Fy", t.side_lag, kDegree, "deg/s");
  if (t.driving) add("Fx", t.drive_lag, 1.0, "1/s");
  return text;
}

}  // namespace

MagicFormulaStudy magic_formula_study(const TireTestFiles& given, const fs::path& folder) {
  auto [test, measured] = read(given);
  for (fs::path& file : test.files) file = fs::proximate(fs::absolute(file), fs::absolute(folder));
  const TireTest t(measured);
  check(measured, t);
  MagicFormulaStudy written;
  written.words = measured.words();
  written.tire = formats::tir_text(start_of(t, measured, test.unloaded_radius));
  const Freed freed = stages_of(t);
  const std::vector<Stage>& stages = freed.stages;
  std::string left_out;
  for (const std::string& line : freed.in_words()) {
    written.words.push_back(line);
    left_out += "# " + line + "\n";
  }
  std::vector<std::string> coefficients;
  for (const Stage& stage : stages)
    coefficients.insert(coefficients.end(), stage.coefficients.begin(), stage.coefficients.end());
  const std::size_t every = std::max<std::size_t>(1, measured.samples() / kMostSamples);
  written.study = fmt::format(
      "# Every coefficient goes through its usual range; [variable.NAME] in its place sets "
      "another.\n{}{}"
      "title = \"Magic Formula 6.1 from {}\"\nmodel = \"tire.tir\"\nvary = {}\n\n{}{}\n",
      left_out,
      lags_in_words(t),
      fmt::join(
          [&] {
            std::vector<std::string> names;
            for (const fs::path& file : test.files) names.push_back(file.filename().string());
            return names;
          }(),
          ", "),
      quoted(coefficients),
      sets(t, measurement_keys(test, every)),
      experiments(t));
  for (const Stage& stage : stages)
    written.study += fmt::format("stage.{} = {{free = {}, experiments = {}}}\n",
                                 stage.name,
                                 quoted(stage.coefficients),
                                 quoted(stage.experiments));
  written.study += "stage.all = {}\n\n[run]\nworkers = 2\n";
  return written;
}

}  // namespace latsch::cli
