// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/magic_formula_template.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/text.h"
#include "cli/templates/magic_formula_stages.h"
#include "cli/templates/tire_test_record.h"
#include "correlation/laboratory/measurement.h"
#include "experiment/language/provenance.h"
#include "experiment/rigs/slip/condition_levels.h"
#include "formats/tire/tir_file.h"
#include "measurement/meaning/absent_channel.h"
#include "measurement/meaning/channel_words.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;
using correlation::Measurement;

// Limit of the fitted samples. More samples add little information, because neighboring samples
// share noise.
constexpr std::size_t kMostSamples = 2000;

/// Returns the names of a recording's files as a place for error messages.
Place place_of(const Measurement& measured) {
  std::string files = measured.files().front().string();
  if (measured.files().size() > 1)
    files += fmt::format(" and {} more", measured.files().size() - 1);
  return {files, 0};
}

/// Returns a sentence that lists the columns that may hold a missing channel and the option that
/// names such a column; "" if there are none.
std::string columns_for(const Measurement& measured, const ChannelMeaning& missing) {
  std::vector<OtherColumn> columns;
  for (const Channel& channel : measured.recorded().all()) {
    const auto& written = measured.written(channel.name);
    columns.push_back({.name = written.column,
                       .unit = channel.unit,
                       .has_unit = !written.unit.empty(),
                       .taken_as = channel.name});
  }
  const auto may_be = columns_that_may_be(missing.name, missing.unit, columns);
  if (may_be.empty()) return "";
  constexpr std::size_t kMostNamed = 12;
  return "; columns that may be it: " + list_in_words(may_be, kMostNamed);
}

/// Throws InputError if the recordings lack a channel that every tire test needs.
void expect_channels(const Measurement& measured) {
  for (const char* needed : {"Fz", "alpha"}) {
    if (measured.has(needed)) continue;
    throw InputError(
        place_of(measured),
        fmt::format("no column is called {}{}; expected the recording of a tire test, with Fz, "
                    "slips and forces; --column \"{} = NAME [unit]\" says how a column is called",
                    spellings_of(needed),
                    columns_for(measured, *find_meaning(needed)),
                    needed));
  }
}

/// Throws InputError if the recordings contain neither a sweep of the slip angle nor one of the
/// longitudinal slip, so that there is nothing to fit.
void expect_curve(const Measurement& measured, const TireTest& test) {
  if (test.cornering || test.driving) return;
  const auto missing = [&](const char* slip, const char* force, double least) {
    return test.spread(slip) > least && !test.has(force)
               ? fmt::format(
                     "{} goes through a sweep, but no column is called {}{}; --column "
                     "\"{} = NAME [unit]\" says how it is called",
                     slip,
                     spellings_of(force),
                     columns_for(measured, *find_meaning(force)),
                     force)
               : std::string();
  };
  for (const std::string& why :
       {missing("alpha", "Fy", kLeastSweep), missing("kappa", "Fx", 2.0 * kFreeRolling)})
    if (!why.empty()) throw InputError(place_of(measured), why);
  throw InputError(place_of(measured),
                   "neither slip angle nor slip goes through a sweep: there is no curve to fit");
}

/// Loads and loaded radii, which determine stiffness and free radius.
struct RecordedRadius {
  std::vector<double> load, radius;  // N, m
  bool at_nominal_pressure = false;  // true: samples at other pressures are left out
};

double nominal_pressure(const TireTest& t) { return std::round(t.median("p") / 1e3) * 1e3; }

/// Returns the recorded loaded radius. The stiffness depends on the pressure, so if the pressure
/// varies, only samples near NOMPRES count; all count if those have no spread of loads.
RecordedRadius recorded_radius(const TireTest& t) {
  constexpr double kNear = 0.04;         // share of the nominal pressure
  constexpr double kLeastSpread = 0.15;  // share of the largest load
  constexpr std::size_t kFewest = 20;
  RecordedRadius all{t.of("Fz"), t.of("loaded_radius")};
  if (!t.has("p")) return all;
  const std::vector<double> p = t.of("p");
  const double nominal = nominal_pressure(t);
  RecordedRadius near;
  for (std::size_t i = 0; i < all.load.size(); ++i) {
    if (std::abs(p[i] - nominal) > kNear * nominal) continue;
    near.load.push_back(all.load[i]);
    near.radius.push_back(all.radius[i]);
  }
  if (near.load.size() == all.load.size() || near.load.size() < kFewest) return all;
  const auto [least, most] = std::minmax_element(near.load.begin(), near.load.end());
  if (*most - *least < kLeastSpread * *most) return all;
  near.at_nominal_pressure = true;
  return near;
}

/// Returns the vertical stiffness, N/m, if the recorded loaded radius falls with the load.
std::optional<double> recorded_stiffness(const TireTest& t) {
  if (!t.has("loaded_radius")) return std::nullopt;
  const RecordedRadius recorded = recorded_radius(t);
  const double slope = line_through(recorded.load, recorded.radius).first;
  return slope < 0.0 ? std::optional(-1.0 / slope) : std::nullopt;
}

/// Throws InputError for a radius that no tire has: it is probably in another unit.
void expect_radius(const Measurement& measured, double radius, bool is_given) {
  constexpr double kLeast = 0.1, kMost = 2.5;  // m, from a kart to the largest mining truck
  if (radius >= kLeast && radius <= kMost) return;
  const std::string expected = fmt::format(
      "expected the radius of an unloaded tire, {:.0f} mm to {:g} m", 1e3 * kLeast, kMost);
  if (is_given) throw InputError(fmt::format("--radius: {:g} m; {}", radius, expected));
  throw InputError(
      place_of(measured),
      fmt::format(
          "its loaded radius leads to {:g} m without load; {}, or --radius", radius, expected));
}

/// Returns start values of the coefficients, estimated directly from the recordings.
magic_formula::Parameters start_of(const TireTest& t,
                                   const Measurement& measured,
                                   const std::optional<double>& unloaded_radius,
                                   std::vector<std::string>& words) {
  magic_formula::Parameters p;
  const auto rounded = [](double x, double to) { return std::round(x / to) * to; };
  p.FNOMIN = std::max(100.0, rounded(t.median("Fz"), 100.0));
  p.NOMPRES = p.INFLPRES = t.has("p") ? nominal_pressure(t) : p.NOMPRES;
  if (t.has("Vx")) p.LONGVL = rounded(std::abs(t.median("Vx")), 0.01);
  if (t.has("loaded_radius")) {
    const RecordedRadius recorded = recorded_radius(t);
    p.UNLOADED_RADIUS = rounded(line_through(recorded.load, recorded.radius).second, 1e-4);
  }
  if (unloaded_radius) p.UNLOADED_RADIUS = *unloaded_radius;
  if (!unloaded_radius && !t.has("loaded_radius"))
    throw InputError(
        place_of(measured),
        "has no loaded radius: the tire's radius has to be given, --radius \"0.32 m\"");
  expect_radius(measured, p.UNLOADED_RADIUS, unloaded_radius.has_value());
  // deflection under the nominal load as a share of the radius
  constexpr double kUsualDeflection = 0.05;
  const auto stiffness = recorded_stiffness(t);
  p.VERTICAL_STIFFNESS =
      rounded(stiffness.value_or(p.FNOMIN / (kUsualDeflection * p.UNLOADED_RADIUS)), 1e3);
  if (!stiffness)
    words.push_back(fmt::format(
        "assumed: VERTICAL_STIFFNESS = {:.0f} N/mm, a deflection of {:.0f} % of the radius under "
        "{:.0f} N, because no loaded radius that falls with the load was recorded; if the "
        "stiffness is known, write it into tire.tir",
        p.VERTICAL_STIFFNESS / 1e3,
        100.0 * kUsualDeflection,
        p.FNOMIN));
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
  // The relaxation lengths are the slip stiffnesses divided by these carcass stiffnesses, equation
  // (19).
  if (t.side_lag && t.side_lag->is_seen())
    p.LATERAL_STIFFNESS = rounded(-p.PKY1 * kAtNominalLoad * p.FNOMIN / t.side_lag->sigma, 100.0);
  if (t.drive_lag && t.drive_lag->is_seen())
    p.LONGITUDINAL_STIFFNESS = rounded(p.PKX1 * p.FNOMIN / t.drive_lag->sigma, 100.0);
  p.QBZ1 = 8.0;
  p.QCZ1 = 1.05;
  p.QDZ1 = 0.1;
  p.QEZ1 = -1.0;
  p.QSX11 = 1.0;  // load, in units of FNOMIN, at which the term of QSX10 applies
  p.RBX1 = p.RBY1 = 10.0;
  p.RBX2 = p.RBY2 = 8.0;
  p.RCX1 = p.RCY1 = 1.0;
  return p;
}

std::string quoted(const std::vector<std::string>& names) {
  return fmt::format("[\"{}\"]", fmt::join(names, "\", \""));
}

/// Returns the keys of a [measurement] that reads the files `of`.
std::string measurement_keys(const TireTestFiles& test,
                             const std::vector<fs::path>& of,
                             std::size_t every) {
  std::vector<std::string> files;
  for (const fs::path& file : of) files.push_back(file.string());
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
      const std::string ours(trimmed(std::string_view(column).substr(0, equals)));
      if (!recognized(ours))
        throw InputError("--column " + in_quotes(column) + ": " + in_quotes(ours) +
                         " is no channel of a tire test; expected our name of the channel and the "
                         "file's, such as \"Fz = LOAD [N]\" (also alpha, kappa, gamma, p, Vx, Fx, "
                         "Fy, Mx, My, Mz)");
      columns.push_back(fmt::format(
          "{} = \"{}\"", trimmed(column.substr(0, equals)), trimmed(column.substr(equals + 1))));
    }
    text += fmt::format(", columns = {{{}}}", fmt::join(columns, ", "));
  }
  if (every > 1) text += fmt::format(", every = {}", every);
  return text;
}

/// file name in messages about keys that are made from command line options
constexpr const char* kNoFile = "recordings";

/// Converts a message about a key of the measurement to one about the command line option from
/// which the key was made: "measurement.all.columns.alpha is ..." becomes "--column alpha is ...".
std::string of_option(std::string message, const std::vector<fs::path>& files) {
  constexpr std::pair<std::string_view, std::string_view> kOptions[] = {
      {"columns.", "--column "},
      {"columns", "--column"},
      {"axes", "--axes"},
      {"select.", "--hold-out "},
      {"files", "--magic-formula"},
      {"file", ""}};
  const std::size_t at = message.find("measurement.all.");
  if (at == message.npos) return message;
  message.erase(0, at + std::string_view("measurement.all.").size());
  for (const auto& [key, option] : kOptions) {
    if (!message.starts_with(key)) continue;
    message.replace(0, key.size(), option.empty() ? files.front().string() : option);
    break;
  }
  return message;
}

Measurement read_some(const TireTestFiles& test,
                      const std::vector<fs::path>& files,
                      const Select& select) {
  try {
    const Document document = Document::parse(
        "measurement.all = {" + measurement_keys(test, files, 1) + select_text(select) + "}\n",
        kNoFile);
    return correlation::read_measurement(document.root().table("measurement").table("all"), "");
  } catch (const InputError& error) {
    if (error.place().file != kNoFile) throw;
    throw InputError(of_option(error.what(), files));
  }
}

/// Samples that a study fits or predicts: the recordings, and the ranges of values that select
/// samples from them.
struct Samples {
  std::vector<fs::path> files;
  Select select;
};

/// Reads the samples to fit. If some are held out, the whole recordings have been read before, so
/// only the ranges can be at fault here.
Measurement read_fitted(const TireTestFiles& test, const Samples& fitted) {
  try {
    return read_some(test, fitted.files, fitted.select);
  } catch (const InputError&) {
    if (fitted.select.empty()) throw;
  }
  throw InputError(fmt::format(
      "--hold-out \"{} = {}\": holds every sample out; expected windows outside of which samples "
      "remain to be fitted",
      test.held_out.channel,
      fmt::join(test.held_out.windows, ", ")));
}

/// Returns the test with its axis convention. If the user has not stated one, the sign of Fz
/// decides.
TireTestFiles with_axes(const TireTestFiles& test) {
  if (!test.axes.empty()) return test;
  const Measurement measured = read_some(test, test.files, {});
  if (!measured.has("Fz") || quantile(measured.values("Fz", "N"), 0.5) >= 0.0) return test;
  TireTestFiles sae = test;
  sae.axes = "sae";
  return sae;
}

/// Splits the test into fitted samples and held-out samples; the latter have no files if nothing is
/// held out.
std::pair<Samples, Samples> parted(const TireTestFiles& test) {
  Samples fitted{test.files, {}}, held;
  const HeldOut& out = test.held_out;
  if (!out.files.empty()) {
    std::erase_if(fitted.files, [&](const fs::path& file) {
      return std::any_of(out.files.begin(), out.files.end(), [&](const fs::path& one) {
        return fs::exists(file) && fs::exists(one) && fs::equivalent(file, one);
      });
    });
    if (fitted.files.empty())
      throw InputError("--hold-out: holds every recording out; expected one that is fitted");
    held.files = out.files;
  } else if (!out.channel.empty()) {
    const Measurement all = read_some(test, test.files, {});
    const std::string unit = all.has(out.channel) ? all.unit(out.channel) : "1";
    if (!all.has(out.channel))
      throw InputError(
          place_of(all),
          "has no channel " + in_quotes(out.channel) + ", by which --hold-out selects");
    fitted.select[out.channel] = windows_outside(out.windows, unit);
    held = {test.files, {{out.channel, out.windows}}};
  }
  return {fitted, held};
}

/// An experiment of the study: a channel compared over a set of samples. The sets are "cornering"
/// and "driving", and "cornering_held" and "driving_held" for held-out samples.
struct Compared {
  std::string name, channel, set;

  std::string fitted() const { return line(name, set, "noise = \"own_stage\""); }
  std::string held_out() const { return line(name + "_held", set + "_held", "use = \"predict\""); }

 private:
  std::string line(const std::string& name_, const std::string& set_, const char* end) const {
    return fmt::format(
        "experiment.{} = {{kind = \"curve\", y = \"{}/{}\", measurement = \"{}\", exponent = 2, "
        "{}}}\n",
        name_,
        set_,
        channel,
        set_,
        end);
  }
};

std::vector<Compared> compared_in(const TireTest& t) {
  std::vector<Compared> all;
  if (t.cornering) all.push_back({"Fy", "Fy", "cornering"});
  if (t.cornering && t.has("Mz")) all.push_back({"Mz", "Mz", "cornering"});
  if (t.driving) all.push_back({"Fx", "Fx", "driving"});
  if (t.combined) all.push_back({"Fy_driven", "Fy", "driving"});
  const std::string set = t.cornering ? "cornering" : "driving";
  for (const char* moment : {"Mx", "My"})
    if (t.has(moment)) all.push_back({moment, moment, set});
  return all;
}

/// Adds the condition by which samples belong to a set. Without both sets in the test, all samples
/// belong to its only set.
Select select_of(const TireTest& t, const std::string& set, Select select) {
  if (!(t.cornering && t.driving)) return select;
  if (select.contains("kappa"))
    throw InputError(
        "--hold-out: kappa already separates samples of cornering and driving; "
        "expected another channel");
  const std::string limit = fmt::format("{}", kFreeRolling);
  select["kappa"] = set == "cornering" ? std::vector<std::string>{"-" + limit + " .. " + limit}
                                       : std::vector<std::string>{".. -" + limit, limit + " .."};
  return select;
}

/// True if the held-out samples contain samples of the set.
bool has_samples(const TireTest& t, const TireTest& held, const std::string& set) {
  if (set == "cornering" ? !t.cornering : !t.driving) return false;
  if (!(t.cornering && t.driving)) return true;
  const std::vector<double> slips = held.magnitudes("kappa");
  return std::any_of(slips.begin(), slips.end(), [&](double kappa) {
    return set == "cornering" ? kappa <= kFreeRolling : kappa >= kFreeRolling;
  });
}

constexpr const char* kSets[] = {"cornering", "driving"};

std::string set_lines(const TireTest& t,
                      const std::string& set,
                      const std::string& suffix,
                      const std::string& keys,
                      const Select& select) {
  return fmt::format(
      "measurement.{0}{1} = {{{2}{3}}}\n"
      "test.{0}{1} = {{kind = \"{4}\", states = {{from = \"measurement.{0}{1}\"}}}}\n",
      set,
      suffix,
      keys,
      select_text(select_of(t, set, select)),
      t.lags ? "slip_history" : "steady_states");
}

/// Returns file names relative to the folder of the study.
std::vector<fs::path> seen_from(const fs::path& folder, std::vector<fs::path> files) {
  for (fs::path& file : files) file = fs::proximate(fs::absolute(file), fs::absolute(folder));
  return files;
}

/// Returns the text of the measurements of held-out samples and of the experiments that predict
/// them.
std::string held_out_lines(const TireTest& t,
                           const TireTestFiles& test,
                           const Samples& held,
                           const fs::path& folder,
                           std::size_t every,
                           std::vector<std::string>& words) {
  if (held.files.empty()) return "";
  const Measurement measured = read_some(test, held.files, held.select);
  const TireTest h(measured);
  words.push_back(
      fmt::format("held out, predicted and not fitted: {} samples", measured.samples()));
  std::string text;
  const std::string keys = measurement_keys(test, seen_from(folder, held.files), every);
  for (const char* set : kSets) {
    if (!has_samples(t, h, set)) continue;
    text += set_lines(t, set, "_held", keys, held.select);
    for (const Compared& one : compared_in(t))
      if (one.set == set && measured.has(one.channel)) text += one.held_out();
  }
  return text;
}

/// Returns a comment for each detected loop, the lag of a force behind its slip.
std::string lags_in_words(const TireTest& t) {
  std::string text;
  const auto add =
      [&](const char* force, const std::optional<RecordedLag>& lag, double unit, const char* rate) {
        if (!lag) {
          text += fmt::format(
              "# {}: whether it lags is not known, because time, speed or samples are "
              "missing\n",
              force);
          return;
        }
        text += fmt::format(
            "# {} lags behind the slip by {:.3f} +- {:.3f} m (95 %), swept at {:.2g} {} and {:.3g} "
            "m/s: {}\n",
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

std::string names_in_words(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.filename().string());
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Returns the .tir file at which the fit starts. A remark at each value says whether it was
/// estimated from the recordings or assumed.
std::string tire_text(const TireTest& t,
                      const magic_formula::Parameters& p,
                      const std::vector<fs::path>& files,
                      const TireTestFiles& test) {
  formats::TirRemarks remarks;
  remarks.header = experiment::comment_lines(
      {"Written by latsch new: the tire at which a fit of " + names_in_words(files) + " starts"},
      "$ ");
  for (const auto& field : magic_formula::parameter_fields())
    if (p.*field.member != field.fallback)
      remarks.of_keys[std::string(field.name)] = "assumed by latsch new";
  for (const char* word : {"FITTYP", "TYRESIDE", "USE_MODE"})
    remarks.of_keys[word] = "assumed by latsch new";
  const auto seen = [&](const char* name, const char* how) { remarks.of_keys[name] = how; };
  seen("FNOMIN", "from the recordings: median load");
  if (t.has("p")) {
    seen("NOMPRES", "from the recordings: median pressure");
    seen("INFLPRES", "from the recordings: median pressure");
  }
  if (t.has("Vx")) seen("LONGVL", "from the recordings: median speed");
  if (recorded_stiffness(t))
    seen("VERTICAL_STIFFNESS",
         recorded_radius(t).at_nominal_pressure
             ? "from the recordings near NOMPRES: load over loaded radius"
             : "from the recordings: load over loaded radius");
  seen(
      "UNLOADED_RADIUS",
      test.unloaded_radius ? "given by the user" : "from the recordings: loaded radius at no load");
  if (t.cornering) {
    seen("PDY1", "estimated from the recordings, as a start value");
    seen("PKY1", "estimated from the recordings, as a start value");
  }
  if (t.driving) {
    seen("PDX1", "estimated from the recordings, as a start value");
    seen("PKX1", "estimated from the recordings, as a start value");
  }
  if (t.side_lag && t.side_lag->is_seen())
    seen("LATERAL_STIFFNESS", "from the recordings: lag of the side force");
  if (t.drive_lag && t.drive_lag->is_seen())
    seen("LONGITUDINAL_STIFFNESS", "from the recordings: lag of the longitudinal force");
  return formats::tir_text(p, remarks);
}

}  // namespace

MagicFormulaStudy magic_formula_study(const TireTestFiles& given, const fs::path& folder) {
  const TireTestFiles test = with_axes(given);
  const auto [fitted, held] = parted(test);
  const Measurement measured = read_fitted(test, fitted);
  expect_channels(measured);
  const TireTest t(measured);
  expect_curve(measured, t);
  MagicFormulaStudy written;
  written.words = measured.words();
  const auto start = start_of(t, measured, test.unloaded_radius, written.words);
  written.words.emplace_back(
      "assumed: TYRESIDE = 'LEFT'; if the recorded tire was that of the right side, write 'RIGHT' "
      "into tire.tir: a car mirrors a tire by it");
  written.tire = tire_text(t, start, fitted.files, test);
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
  const std::string bounded = bounded_variables(coefficients);
  std::vector<std::string> varied = coefficients;
  std::erase_if(varied, [](const std::string& name) { return is_bounded(name); });
  const std::size_t every = std::max<std::size_t>(1, measured.samples() / kMostSamples);
  const std::string held_out = held_out_lines(t, test, held, folder, every, written.words);
  std::string sets, experiments;
  const std::string keys = measurement_keys(test, seen_from(folder, fitted.files), every);
  for (const char* set : kSets)
    if (set == std::string("cornering") ? t.cornering : t.driving)
      sets += set_lines(t, set, "", keys, fitted.select);
  for (const Compared& one : compared_in(t)) experiments += one.fitted();
  written.study = fmt::format(
      "# Every coefficient goes through its usual range; [variable.NAME] in its place sets "
      "another.\n{}{}"
      "title = \"Magic Formula 6.1 from {}\"\nmodel = \"tire.tir\"\nvary = {}\n{}\n{}{}{}\n",
      left_out,
      lags_in_words(t),
      names_in_words(fitted.files),
      quoted(varied),
      bounded,
      sets,
      experiments,
      held_out);
  for (const Stage& stage : stages)
    written.study += fmt::format("stage.{} = {{free = {}, experiments = {}}}\n",
                                 stage.name,
                                 quoted(stage.coefficients),
                                 quoted(stage.experiments));
  written.study += "stage.all = {}\n\n[run]\nworkers = 2\n";
  return written;
}

}  // namespace latsch::cli
