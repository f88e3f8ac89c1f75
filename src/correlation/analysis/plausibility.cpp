// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/plausibility.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

#include "base/text.h"
#include "base/units.h"
#include "correlation/analysis/repeated_values.h"
#include "correlation/laboratory/table_axes.h"
#include "correlation/observable/curve.h"
#include "correlation/observable/force_curve.h"
#include "correlation/observable/mode_set.h"
#include "correlation/observable/values.h"
#include "experiment/language/usual_numbers.h"
#include "experiment/rigs/load_case.h"
#include "formats/tables/csv_table.h"
#include "measurement/meaning/channel_words.h"
#include "measurement/meaning/natural_unit.h"
#include "measurement/meaning/rest_offset.h"
#include "measurement/meaning/suspension_checks.h"

namespace latsch::correlation {
namespace {

using experiment::judged;
using experiment::key_of;
using experiment::Seen;
using experiment::unusual;
using experiment::usual_in_words;
using experiment::usual_magnitude;
using experiment::UsualMagnitude;
using experiment::Written;
using experiment::written_at;

const UsualMagnitude kUsualStiffness{
    "", "", "the stiffness of a tire", "N/mm", 2, 20, 3000, 3e4, {"N/mm", "kN/mm"}};
const UsualMagnitude kUsualMode{"", "", "a tire's mode", "Hz", 1, 8, 1000, 1e4, {"Hz", "kHz"}};

double in_unit(const UsualMagnitude& usual, double si) { return Unit::of(usual.unit).from_si(si); }

void append(std::vector<Finding> more, std::vector<Finding>& found) {
  found.insert(found.end(), more.begin(), more.end());
}

/// Checks a variable's bounds by the same ranges as the numbers that it sets, but only warns.
void examine_variables(const Study& study, const Document& file, std::vector<Finding>& found) {
  std::map<std::string, std::string> owners;
  for (const DesignVariable& variable : study.space.variables()) {
    const std::string at = "variable." + variable.name + ".";
    for (const std::string& path : variable.paths) {
      const auto [owner, first] = owners.emplace(path, variable.name);
      if (first) continue;
      found.push_back({variable.place,
                       fmt::format("{}path {} is set by variable {} already: expected each number "
                                   "in one variable, once",
                                   at,
                                   in_quotes(path),
                                   in_quotes(owner->second)),
                       true});
    }
    const UsualMagnitude* range =
        variable.paths.empty() ? nullptr : usual_magnitude(variable.paths.front(), variable.unit);
    if (!range) continue;
    for (const char* key : {"lower", "upper", "initial"}) {
      const std::string path = at + key;
      auto one = unusual(*range, written_at(file, path), path, file.get(path));
      if (!one) continue;
      // A bound far outside of the usual range may be intended, so only an impossible one is
      // reported.
      const bool is_bound = std::string_view(key) != "initial";
      if (is_bound && !one->impossible) continue;
      one->impossible = false;
      found.push_back(std::move(*one));
    }
  }
}

using TireSize = experiment::SpecimenKind::Size;

void examine_deflection(const TireSize& size,
                        const Place& place,
                        const std::string& name,
                        double deflection,
                        std::vector<Finding>& found) {
  // deflection over the height of the section above which the tire comes close to its rim
  constexpr double kDeep = 0.6;
  const bool impossible = deflection > size.section_height;
  if (deflection <= kDeep * size.section_height) return;
  found.push_back({place,
                   fmt::format("{} is {:.4g} mm, {} the section of this tire, {:.0f} mm high: "
                               "deflections are usually up to a third of it. Does it belong to "
                               "another tire, or is its unit wrong?",
                               name,
                               1e3 * deflection,
                               impossible ? "deeper than" : "close to",
                               1e3 * size.section_height),
                   impossible});
}

/// Checks the deflections that the study itself states, for its tests and for modes on the ground.
void examine_deflections(const Document& file, const TireSize& size, std::vector<Finding>& found) {
  for (const std::string& path : file.paths()) {
    const std::string key = key_of(path);
    const bool own = path.starts_with("experiment.") || path.starts_with("test.");
    if (!own || (key != "deflection" && key != "deflections") || file.unit(path) != "m") continue;
    examine_deflection(size, written_at(file, path).place, path, file.get(path), found);
  }
}

void examine_stiffness(const Place& place,
                       double force,
                       double deflection,
                       std::vector<Finding>& found) {
  const double stiffness = force / deflection;
  const Seen seen = judged(kUsualStiffness, stiffness);
  if (seen == Seen::usual) return;
  const bool soft = in_unit(kUsualStiffness, stiffness) < kUsualStiffness.from;
  const char* next = "";
  if (judged(kUsualStiffness, 1e3 * stiffness) == Seen::usual)
    next = ". Were the forces in kN? Then the column is \"force [kN]\"";
  if (judged(kUsualStiffness, 1e-3 * stiffness) == Seen::usual)
    next = ". Were the forces in N? Then the column is \"force [N]\"";
  found.push_back({place,
                   fmt::format("{:.4g} N at {:.4g} mm is {:.3g} N/mm, too {} for a tire: {}{}",
                               force,
                               1e3 * deflection,
                               in_unit(kUsualStiffness, stiffness),
                               soft ? "soft" : "stiff",
                               usual_in_words(kUsualStiffness),
                               next),
                   seen == Seen::impossible});
}

/// Reports one finding for each table, because an error in a column affects all of it: the first
/// impossible value, or else the first unusual one.
void examine_load_deflection(const StudyExperiment& experiment,
                             const LoadDeflectionCurve& measured,
                             const TireSize& size,
                             std::vector<Finding>& found) {
  // allows for growth by inflation and for a tire that is softer than described
  constexpr double kGrowth = 1.1;
  // deflection over the height of the section below which the force depends mainly on when contact
  // begins
  constexpr double kFirst = 0.03;
  if (measured.force.empty()) return;
  std::optional<formats::CsvTable> table;
  if (!experiment.read_from) table = formats::CsvTable::read(experiment.measurement_file);
  const bool radii = measured.abscissa == Abscissa::loaded_radius;
  const auto& positions = measured.position;
  std::vector<Finding> worst;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Place place = table ? table->place(static_cast<int>(i)) : experiment.read_from->place(i);
    std::vector<Finding> of_row;
    if (radii && positions[i] > kGrowth * size.outer_radius) {
      of_row.push_back(
          {place,
           fmt::format("loaded_radius is {:.1f} mm, but this tire has {:.1f} mm without "
                       "load: does it belong to another tire, or is it a diameter?",
                       1e3 * positions[i],
                       1e3 * size.outer_radius),
           true});
    }
    const double deflection = radii ? size.outer_radius - positions[i] : positions[i];
    examine_deflection(size,
                       place,
                       radii ? "the deflection of this loaded_radius" : "deflection",
                       deflection,
                       of_row);
    if (of_row.empty() && deflection > kFirst * size.section_height)
      examine_stiffness(place, measured.force[i], deflection, of_row);
    if (of_row.empty() || (!worst.empty() && !of_row.front().impossible)) continue;
    worst = {of_row.front()};
    if (worst.front().impossible) break;
  }
  found.insert(found.end(), worst.begin(), worst.end());
}

void examine_modes(const StudyExperiment& experiment,
                   const std::vector<ModeRecord>& modes,
                   bool hangs_free,
                   std::vector<Finding>& found) {
  const bool table = experiment.measurement_file.extension() != ".toml";
  std::optional<formats::CsvTable> rows;
  if (table && !modes.empty()) rows = formats::CsvTable::read(experiment.measurement_file);
  const auto place = [&](std::size_t i) {
    return rows ? rows->place(static_cast<int>(i)) : Place{experiment.measurement_file.string(), 0};
  };
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const double f = modes[i].frequency;
    if (const Seen seen = judged(kUsualMode, f); seen != Seen::usual) {
      found.push_back({place(i),
                       fmt::format("frequency is {:.4g} Hz, but {}", f, usual_in_words(kUsualMode)),
                       seen == Seen::impossible});
    }
    int same = 0;
    for (std::size_t j = 0; j < i; ++j) {
      same += modes[j].frequency == f && modes[j].label() == modes[i].label();
    }
    // On a freely suspended tire every mode with n >= 1 is a pair, so a table may list it twice,
    // but not three times.
    const bool is_pair = hangs_free && modes[i].n != 0;
    if (same < 1 || (is_pair && same == 1)) continue;
    found.push_back(
        {place(i),
         fmt::format("{:.4g} Hz, {} is in the table {}: {}",
                     f,
                     modes[i].label(),
                     same == 1 ? "twice" : "three times",
                     same == 1 ? "a row too many?"
                               : "a tire has a mode twice at most, expected each row once"),
         same > 1});
  }
}

/// The usual magnitude of a channel that is compared as single values.
struct UsualChannel {
  std::string_view part;  // end of the channel's name
  bool is_of_tire;        // false: of a wheel on a suspension's rig
  UsualMagnitude usual;
};

const std::vector<UsualChannel>& usual_channels() {
  const std::vector<const char*> frequencies{"Hz", "kHz"}, stiffnesses{"N/mm", "kN/mm", "N/m"};
  const std::vector<const char*> compliances{"mm/kN", "mm/N", "m/N"};
  static const std::vector<UsualChannel> all{
      {"frequency", true, kUsualMode},
      {"damping", true, {"", "", "the damping of a mode", "%", 0, 0.02, 40, 100, {"%", "1"}, true}},
      {"vertical", true, kUsualStiffness},
      {"lateral", true, {"", "", "a tire's stiffness", "N/mm", 1, 8, 3e3, 3e4, stiffnesses}},
      {"longitudinal", true, {"", "", "a tire's stiffness", "N/mm", 1, 8, 5e3, 5e4, stiffnesses}},
      {"torsional",
       true,
       {"",
        "",
        "a tire's torsional stiffness",
        "N m/deg",
        0.5,
        5,
        2e4,
        1e6,
        {"N m/deg", "N m/rad"}}},
      {"dx_by_Fx",
       false,
       {"", "", "a compliance", "mm/kN", 0, 0, 60, 1e4, compliances, true, true}},
      {"dy_by_Fy",
       false,
       {"", "", "a compliance", "mm/kN", 0, 0, 60, 1e4, compliances, true, true}},
      {"camber_by_Fy", false, {"", "", "a compliance", "deg/kN", 0, 0, 20, 1e3, {}, true, true}},
      {"toe_by_Fy", false, {"", "", "a compliance", "deg/kN", 0, 0, 20, 1e3, {}, true, true}}};
  return all;
}

/// Reports the first unusual value of an experiment that compares single values.
void examine_values(const StudyExperiment& experiment,
                    const Values& values,
                    const Document& file,
                    std::vector<Finding>& found) {
  const std::string& channel = values.measured().channel;
  const std::string_view part = std::string_view(channel).substr(channel.find('/') + 1);
  for (const UsualChannel& one : usual_channels()) {
    if (part != one.part ||
        !Unit::of(one.usual.unit).same_dimension(Unit::of(values.measured().unit)))
      continue;
    for (const double si : values.measured().values) {
      const Seen seen = judged(one.usual, si);
      if (seen == Seen::usual || !std::isfinite(si)) continue;
      found.push_back({written_at(file, "experiment." + experiment.name + ".channel").place,
                       fmt::format("experiment.{} has {:.5g} {}, but {}",
                                   experiment.name,
                                   in_unit(one.usual, si),
                                   one.usual.unit,
                                   usual_in_words(one.usual)),
                       seen == Seen::impossible});
      return;
    }
  }
}

/// True if the tire does not touch the ground in the test of these modes.
bool hangs_free(const Study& study, const ModeSet& modes) {
  const std::string name = test_of(modes.asks().front());
  for (const StudyTest& test : study.tests) {
    const auto* of = test.test->settings_as<experiment::ModalTest>();
    if (of && test.name == name) return !of->loaded();
  }
  return false;
}

/// Returns the side of the model's wheel, +1 for left; 0 if the model states none.
int side_of_model(const Study& study) {
  const Node root = study.model.root();
  const std::string side = root.has("side") ? root.text("side") : "";
  return side == "left" ? 1 : side == "right" ? -1 : 0;
}

bool axes_are_stated(const Measurement& measurement, const Document& file) {
  return measurement.is_stated() &&
         file.root().table("measurement").table(measurement.name()).has("axes");
}

/// Compares the side of the car to which a K&C table belongs, as the signs of toe and camber show
/// it, with the side that the model states.
void examine_sides(const Study& study, const Document& file, std::vector<Finding>& found) {
  const int side = side_of_model(study);
  if (side == 0) return;
  for (const auto& measurement : study.laboratory) {
    const int measured = side_of_wheel(measurement->channels());
    if (measured == 0 || measured == side) continue;
    const std::string table = "measurement." + measurement->name();
    const auto statements =
        statements_for_side(*measurement, axes_are_stated(*measurement, file), side);
    found.push_back(
        {written_at(file, table + ".file").place,
         fmt::format("{} has the signs of a {} wheel (toe over Mz, camber over Fy), but the model "
                     "is a {} one{}{}",
                     table,
                     measured > 0 ? "left" : "right",
                     side > 0 ? "left" : "right",
                     statements.empty() ? ""
                                        : fmt::format(". If the wheel is the {} one, say ",
                                                      side > 0 ? "left" : "right"),
                     fmt::join(statements, "; or ")),
         false});
  }
}

/// Returns every measurement that the study uses: those of [measurement.NAME], and files that an
/// experiment names itself.
Laboratory measurements_of(const Study& study) {
  Laboratory all = study.laboratory;
  for (const StudyExperiment& experiment : study.experiments)
    if (experiment.read_from && std::none_of(all.begin(), all.end(), [&](const auto& one) {
          return one == experiment.read_from ||
                 (!one->is_stated() && one->files() == experiment.read_from->files());
        }))
      all.push_back(experiment.read_from);
  return all;
}

void examine_unstated_axes(const Study& study, const Document& file, std::vector<Finding>& found) {
  const int side = side_of_model(study);
  for (const auto& measurement : measurements_of(study)) {
    if (axes_are_stated(*measurement, file)) continue;
    std::vector<std::string> alike = axes_alike(*measurement, side);
    if (alike.empty()) continue;
    const std::string last = alike.back();
    alike.pop_back();
    const std::string all = fmt::format("{} or {}", fmt::join(alike, ", "), last);
    const bool is_stated = measurement->is_stated();
    found.push_back(
        {is_stated ? written_at(file, "measurement." + measurement->name() + ".file").place
                   : measurement->place(),
         fmt::format("{}{} states no axes, so iso is taken (x forward, y to the left, z up), and "
                     "its signs do not tell the axes: with {} in {} they agree alike, and the "
                     "results differ. Say axes = {}",
                     is_stated ? "measurement." : "",
                     measurement->name(),
                     measurement->samples() == 1
                         ? std::string("its one row")
                         : fmt::format("its {} rows", measurement->samples()),
                     all,
                     all + (is_stated ? "" : " in a [measurement.NAME] of the file")),
         false});
  }
}

/// Notes noise that a measurement states for a channel of which an experiment compares the
/// spectrum. It is the noise of samples, and that of spectral lines does not follow from it alone.
void examine_noise_of_spectra(const Study& study,
                              const Document& file,
                              std::vector<Finding>& found) {
  for (const StudyExperiment& experiment : study.experiments) {
    const auto* curve = dynamic_cast<const Curve*>(experiment.observable.get());
    if (!curve || !experiment.fitted || !experiment.measurement || experiment.noise ||
        experiment.estimates_noise)
      continue;
    const ComparedCurve what = curve->measured().comparison.what;
    if (what != ComparedCurve::psd && what != ComparedCurve::band_levels) continue;
    const std::string& y = curve->measured().y;
    const std::string channel = y.substr(y.find('/') + 1);
    if (!experiment.measurement->noise(channel)) continue;
    found.push_back(
        {written_at(file, "experiment." + experiment.name + ".compare").place,
         fmt::format("experiment.{} compares a spectrum, so it does not use the noise that "
                     "measurement.{} states for the samples of {}. The deviation of its lines is "
                     "estimated; noise in the experiment states it",
                     experiment.name,
                     experiment.measurement->name(),
                     channel),
         false,
         true});
  }
}

/// Finds statements that leave a variable or a number without effect on the target, or a measured
/// value without weight.
void examine_statements(const Study& study, const Document& file, std::vector<Finding>& found) {
  const auto add = [&](const Place& place, std::string text) {
    found.push_back({place, std::move(text), false});
  };
  std::size_t values = 0;
  bool has_prior = false;
  for (const StudyExperiment& experiment : study.experiments) {
    if (experiment.fitted) values += experiment.values();
    const auto deviations = stated_deviations(experiment);
    const auto& scales = experiment.observable->scales();
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (std::size_t i = 0; i < deviations.size() && i < scales.size(); ++i)
      least = std::min(least, deviations[i] * std::abs(scales[i]));
    for (const double value : experiment.observable->measured_values())
      most = std::max(most, std::abs(value));
    if (!experiment.fitted || deviations.empty() || !(least > most)) continue;
    const std::string& unit = experiment.observable->shown_unit();
    add(written_at(file, "experiment." + experiment.name + ".noise").place,
        fmt::format(
            "experiment.{}: the noise is at least {}, more than the largest measured value, "
            "{}: the experiment hardly counts; is its unit right?",
            experiment.name,
            format_quantity(least, unit, 3),
            format_quantity(most, unit, 3)));
  }
  for (const DesignVariable& variable : study.space.variables()) {
    has_prior = has_prior || variable.prior.has_value();
    if (variable.prior &&
        (variable.prior->value < variable.lower || variable.prior->value > variable.upper))
      add(variable.place,
          fmt::format(
              "variable.{}.prior is {}, outside of its bounds, {} .. {}: it pulls the value "
              "to a bound",
              variable.name,
              format_quantity(variable.prior->value, variable.unit, 4),
              format_quantity(variable.lower, variable.unit, 4),
              format_quantity(variable.upper, variable.unit, 4)));
    for (const Follower& follower : variable.followers)
      if (follower.factor == 0.0)
        add(variable.place,
            fmt::format("{} follows variable {} with factor 0: it stays constant, whatever the "
                        "variable is",
                        in_quotes(follower.paths.front()),
                        variable.name));
  }
  if (values > 0 && !has_prior && values < static_cast<std::size_t>(study.space.size()))
    add({study.file.string(), 0},
        fmt::format("{} fitted for {} variables: the values cannot determine all of them; measure "
                    "more, hold variables, or state priors",
                    values == 1 ? "1 value is" : fmt::format("{} values are", values),
                    study.space.size()));
}

/// True for a test of a K&C rig that prescribes loads and records changes relative to the unloaded
/// state.
bool records_changes(const experiment::Test& test) {
  bool has_load = false, has_motion = false;
  for (const experiment::ChannelInfo& channel : test.channels()) {
    const auto known = recognized(channel.name);
    const std::string_view name = known ? known->meaning->name : std::string_view();
    has_load = has_load || name == "Fx" || name == "Fy" || name == "Fz" || name == "Mz";
    has_motion = has_motion || name == "dx" || name == "dy" || name == "toe";
  }
  return has_load && has_motion;
}

/// Finds angles and displacements of a K&C table that are not 0 without load, although the test
/// computes changes relative to the unloaded state.
void examine_rest(const Study& study, const Document& file, std::vector<Finding>& found) {
  std::map<std::string, std::pair<std::shared_ptr<const Measurement>, std::vector<std::string>>> of;
  for (const StudyExperiment& experiment : study.experiments) {
    const auto* curve = dynamic_cast<const Curve*>(experiment.observable.get());
    if (!curve || !experiment.read_from ||
        curve->measured().comparison.what != ComparedCurve::values)
      continue;
    const std::string& y = curve->measured().y;
    const auto test = std::find_if(study.tests.begin(), study.tests.end(), [&](const auto& one) {
      return y.starts_with(one.name + "/");
    });
    const std::string moved = y.substr(y.find('/') + 1);
    if (test == study.tests.end() || !records_changes(*test->test) ||
        !experiment.read_from->has(moved))
      continue;
    auto& [measurement, names] = of[experiment.read_from->name()];
    measurement = experiment.read_from;
    names.push_back(measurement->name_of(moved));
  }
  for (const auto& [name, channels] : of) {
    const Channels& table = channels.first->channels();
    const auto offsets = offsets_at_rest(table, channels.second);
    if (offsets.empty()) continue;
    std::vector<std::string> values, names;
    for (const RestOffset& one : offsets) {
      const std::string& unit = table.find(one.channel)->unit;
      values.push_back(one.channel + " is " +
                       format_quantity(Unit::of(natural_unit(unit)).from_si(one.offset), "1", 3) +
                       " " + natural_unit(unit));
      names.push_back(in_quotes(one.channel));
    }
    const std::string windows = rest_windows(table);
    found.push_back(
        {written_at(file, "measurement." + name + ".file").place,
         fmt::format(
             "measurement.{}: without load {}, but the test records changes from the "
             "unloaded wheel. {}compare = \"about_mean\" in the experiments compares without "
             "constant offsets",
             name,
             fmt::join(values, ", "),
             windows.empty() ? ""
                             : fmt::format("zero = {{channels = [{}], at = {}}} takes these "
                                           "values off; ",
                                           fmt::join(names, ", "),
                                           windows)),
         false});
  }
}

}  // namespace

std::vector<Finding> implausible(const Study& study) {
  std::vector<Finding> found;
  const Document file = Document::read(study.file);
  const experiment::SpecimenKind* kind = study.specimens->kind();
  if (kind) append(experiment::findings_of_model(*kind, study.model, study.model_file), found);
  // Unusual numbers are found only in Latsch's own models, in which the quantity of each number is
  // known; settings of a run are known in any case.
  append(experiment::unusual_numbers(file,
                                     "",
                                     [&](const std::string& path) {
                                       return !kind && !path.starts_with("run.") &&
                                              !path.starts_with("simulator.timeout");
                                     }),
         found);
  examine_variables(study, file, found);
  append(repeated_values(study, file), found);
  examine_sides(study, file, found);
  examine_unstated_axes(study, file, found);
  examine_rest(study, file, found);
  examine_noise_of_spectra(study, file, found);
  examine_statements(study, file, found);
  const auto size = kind ? kind->size(study.model) : std::nullopt;
  if (size) examine_deflections(file, *size, found);
  for (const StudyExperiment& experiment : study.experiments) {
    if (const auto* modes = dynamic_cast<const ModeSet*>(experiment.observable.get()))
      examine_modes(experiment, modes->measured(), hangs_free(study, *modes), found);
    if (const auto* values = dynamic_cast<const Values*>(experiment.observable.get()))
      examine_values(experiment, *values, file, found);
    if (const auto* forces = dynamic_cast<const ForceCurve*>(experiment.observable.get());
        forces && size)
      examine_load_deflection(experiment, forces->measured(), *size, found);
  }
  return found;
}

}  // namespace latsch::correlation
