// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "base/text.h"
#include "formats/text/letter_case.h"
#include "formats/tire/tir_curve.h"
#include "formats/tire/tir_dialect.h"
#include "formats/tire/tir_forces.h"
#include "formats/tire/tir_keys.h"
#include "formats/tire/tir_missing.h"
#include "formats/tire/tir_modes.h"
#include "formats/tire/tir_sizes.h"

namespace latsch::formats {
namespace {

using magic_formula::MeasuredSide;
using magic_formula::ParameterField;
using magic_formula::Parameters;
using magic_formula::ParameterUnit;
using magic_formula::Version;

/// Scaling factors by which the equations divide, or which at 0 would remove all forces of the
/// tire.
constexpr std::array<std::string_view, 9> kNeverZero = {
    "LFZO", "LCX", "LMUX", "LKX", "LCY", "LMUY", "LKY", "LIP", "LCZ"};
/// Pairs of keys for the smallest and the largest value of each input that the file's data cover.
constexpr std::array<std::array<std::string_view, 2>, 5> kRanges = {{{"PRESMIN", "PRESMAX"},
                                                                     {"FZMIN", "FZMAX"},
                                                                     {"KPUMIN", "KPUMAX"},
                                                                     {"ALPMIN", "ALPMAX"},
                                                                     {"CAMMIN", "CAMMAX"}}};
/// Coefficients that describe the effect of the pressure.
constexpr std::array<std::string_view, 17> kOfPressure = {"PPX1",
                                                          "PPX2",
                                                          "PPX3",
                                                          "PPX4",
                                                          "PPY1",
                                                          "PPY2",
                                                          "PPY3",
                                                          "PPY4",
                                                          "PPY5",
                                                          "PPZ1",
                                                          "PPZ2",
                                                          "PPMX1",
                                                          "PFZ1",
                                                          "QSY8",
                                                          "PCFX3",
                                                          "PCFY3",
                                                          "LIP"};

bool is_coefficient_group(std::string_view section) {
  return section.ends_with("_COEFFICIENTS") || section.ends_with("_RANGE");
}

/// Returns all sections that parameters belong to.
const std::set<std::string_view>& home_sections() {
  static const std::set<std::string_view> sections = [] {
    std::set<std::string_view> names;
    for (const ParameterField& field : magic_formula::parameter_fields())
      names.insert(field.section);
    return names;
  }();
  return sections;
}

/// Returns all keys that a misspelled key may have been, for suggestions.
const std::vector<std::string>& all_keys() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> keys = other_spellings();
    for (const ParameterField& field : magic_formula::parameter_fields())
      keys.emplace_back(field.name);
    for (const std::string& key : keys_with_reason()) keys.push_back(key);
    for (const char* key : {"FITTYP", "TYRESIDE", "USE_MODE", "PROPERTY_FILE_FORMAT", "LIP", "LCZ"})
      keys.emplace_back(key);
    return keys;
  }();
  return all;
}

// Number of unknown keys that are noted one by one, each with the key that was probably intended.
// The others are counted in one note, because a file of thousands is of another kind.
constexpr long kMostUnknownNoted = 100;

/// Returns a suggestion for a misspelled key. Short names of coefficients differ by single letters,
/// so only one wrong letter is allowed for them.
std::string suggestion(const std::string& key) {
  constexpr std::size_t kShort = 6;
  const auto best = nearest(key, all_keys());
  if (!best || (key.size() <= kShort && edit_distance(key, *best) > 1)) return "";
  return ", did you mean " + in_quotes(*best) + "?";
}

class TirReader {
 public:
  explicit TirReader(TirFile& tir)
      : tir_(tir), units_(tir.source.units(TeimOrbitUnits::Missing::is_si)) {}

  void read() {
    const TeimOrbitSection* model = tir_.source.find("MODEL");
    if (model == nullptr)
      throw InputError(Place{tir_.source.file(), 0},
                       "there is no section [MODEL]: is this a tire property file?");
    const TirDialect dialect = dialect_of(*model);
    tir_.parameters.version = dialect.version;
    tir_.pac2002 = dialect.pac2002;
    tir_.notes = dialect.notes;
    for (const TeimOrbitSection& section : tir_.source.sections()) read_section(section);
    if (unknown_ > kMostUnknownNoted)
      note(line_of_more_unknown_,
           fmt::format("from this line on, {} more keys are not known here; they have no effect, "
                       "and an exported file keeps them (latsch show FILE --json lists all of "
                       "them): is this a file of another tire model?",
                       unknown_ - kMostUnknownNoted));
    read_mode(*model);
    read_side(*model);
    check_scales();
    read_pressures();
    apply_scale("LIP", "NOMPRES");
    apply_scale("LCZ", "VERTICAL_STIFFNESS");
    require("UNLOADED_RADIUS");
    require("FNOMIN");
    require("VERTICAL_STIFFNESS");
    check_ranges();
    check_sizes();
    check_angles();
    read_load_curve(tir_, units_, [&](int line, const std::string& sentence) {
      doubt("[DEFLECTION_LOAD_CURVE]", line, sentence);
    });
    check_forces();
    report_units();
    report_missing(
        tir_.parameters,
        [&](std::string_view name) {
          return found_.contains(std::string(name)) || (name == "NOMPRES" && tells_pressure_);
        },
        [&](const std::string& sentence) { note(0, sentence); });
  }

 private:
  /// Adds a doubt, which every ledger of the file contains.
  void doubt(const std::string& name, int line, const std::string& text) {
    tir_.doubts.push_back({name, text, Place{tir_.source.file(), line}});
  }

  void note(int line, const std::string& text) {
    tir_.notes.push_back(Place{tir_.source.file(), line}.text() + ": " + text);
  }

  /// Reports or refuses sizes that no tire has.
  void check_sizes() {
    examine_sizes(
        tir_.parameters,
        [&](std::string_view name) { return found_.contains(std::string(name)); },
        [&](std::string_view name, const std::string& sentence) {
          throw InputError(place_of(std::string(name)), sentence);
        },
        [&](std::string_view name, const std::string& sentence) {
          doubt(std::string(name), place_of(std::string(name)).line, sentence);
        });
  }

  /// Reports forces and radii that no tire has.
  void check_forces() {
    examine_forces(tir_.parameters, [&](std::string_view name, const std::string& sentence) {
      doubt(std::string(name), place_of(std::string(name)).line, sentence);
    });
  }

  void read_section(const TeimOrbitSection& section) {
    std::map<std::string_view, const TeimOrbitEntry*> seen;
    for (const TeimOrbitEntry& entry : section.entries()) {
      const auto [before, first] = seen.emplace(entry.key, &entry);
      if (!first) twice(section, *before->second, entry);
      if (holds_no_parameters(section)) {
        check_stranger(section, entry);
      } else {
        read_entry(section, entry);
      }
    }
    report_tables(section);
  }

  void report_tables(const TeimOrbitSection& section) {
    if (section.tables().empty() || section.name() == "MDI_HEADER" ||
        section.name() == "DEFLECTION_LOAD_CURVE")
      return;
    const int line = section.tables().front().line;
    if (section.name() == "SHAPE") {
      tir_.keys.push_back(
          {section.name(), "{...}", line, "", "the cross-section belongs to another contact"});
      return;
    }
    tir_.keys.push_back({section.name(), "{...}", line, "", "the table is not read"});
    note(line, fmt::format("[{}] holds a table that is not read", section.name()));
  }

  void twice(const TeimOrbitSection& section,
             const TeimOrbitEntry& before,
             const TeimOrbitEntry& entry) {
    if (before.value != entry.value)
      throw InputError(section.place(entry.line),
                       fmt::format("{} is {}, but line {} says {}; keep one of them",
                                   entry.key,
                                   entry.value,
                                   before.line,
                                   before.value));
    note(entry.line, fmt::format("{} occurs twice, in line {}, too", entry.key, before.line));
  }

  /// Checks keys in [UNITS] and [MDI_HEADER]. These contain parameters only if the line [SECTION]
  /// after them is missing.
  void check_stranger(const TeimOrbitSection& section, const TeimOrbitEntry& entry) {
    static const std::set<std::string_view> units = {
        "LENGTH", "FORCE", "ANGLE", "MASS", "TIME", "PRESSURE"};
    const bool is_unit = section.name() == "UNITS" && units.contains(entry.key);
    const ParameterField* field = magic_formula::find_parameter(parameter_of_key(entry.key));
    if (!is_unit && field != nullptr)
      throw InputError(section.place(entry.line),
                       fmt::format("{} is in [{}], expected [{}]: is a line [SECTION] missing?",
                                   entry.key,
                                   section.name(),
                                   field->section));
    if (section.name() == "UNITS" && !is_unit)
      note(entry.line,
           fmt::format("[UNITS] {} is not a unit that is known here; it has no effect", entry.key));
    tir_.keys.push_back(
        {section.name(), entry.key, entry.line, "", is_unit ? "" : "describes the file"});
  }

  void read_entry(const TeimOrbitSection& section, const TeimOrbitEntry& entry) {
    static const std::set<std::string_view> of_model = {
        "FITTYP", "TYRESIDE", "USE_MODE", "PROPERTY_FILE_FORMAT"};
    static const std::set<std::string_view> only_units = {"LENGTH", "FORCE", "ANGLE", "TIME"};
    if (of_model.contains(entry.key)) {
      if (section.name() != "MODEL")
        throw InputError(
            section.place(entry.line),
            fmt::format("{} stands in [{}], expected [MODEL]", entry.key, section.name()));
      const auto [before, first] = model_words_.emplace(entry.key, &entry);
      if (!first && before->second->value != entry.value) twice(section, *before->second, entry);
      tir_.keys.push_back({section.name(), entry.key, entry.line, entry.key, ""});
      return;
    }
    if (only_units.contains(entry.key))
      throw InputError(section.place(entry.line),
                       fmt::format("{} = {} is a unit and stands in [{}], expected [UNITS]",
                                   entry.key,
                                   in_quotes(entry.value),
                                   section.name()));
    if (entry.key == "LIP" || entry.key == "LCZ") return read_scale(section, entry);
    const ParameterField* field = magic_formula::find_parameter(parameter_of_key(entry.key));
    const auto unused = reason_unused(entry.key, entry.value);
    if (field != nullptr) {
      take(section, entry, *field);
      tir_.keys.push_back({section.name(),
                           entry.key,
                           entry.line,
                           std::string(field->name),
                           unused ? unused->text : std::string(acts_only(field->name))});
    } else {
      tir_.keys.push_back(
          {section.name(), entry.key, entry.line, "", unused ? unused->text : kUnknownKey});
    }
    if (field == nullptr && !unused && ++unknown_ <= kMostUnknownNoted)
      note(entry.line,
           fmt::format(
               "[{}] {} is not known here; it has no effect, and an exported file keeps it{}",
               section.name(),
               entry.key,
               suggestion(entry.key)));
    if (field == nullptr && !unused && unknown_ == kMostUnknownNoted + 1)
      line_of_more_unknown_ = entry.line;
    if (unused && unused->told)
      note(entry.line,
           fmt::format("{} = {} has no effect: {}", entry.key, entry.value, unused->text));
  }

  /// Reads a factor of PAC2002 by which another number of the file is multiplied.
  void read_scale(const TeimOrbitSection& section, const TeimOrbitEntry& entry) {
    scales_[entry.key] = {section.number(entry), entry.line};
    const bool pressure = entry.key == "LIP";
    tir_.keys.push_back({section.name(),
                         entry.key,
                         entry.line,
                         entry.key,
                         pressure ? "multiplies NOMPRES" : "multiplies VERTICAL_STIFFNESS"});
  }

  void apply_scale(const std::string& scale, const char* name) {
    const auto found = scales_.find(scale);
    if (found == scales_.end()) return;
    if (!(found->second.first > 0.0))
      throw InputError(
          Place{tir_.source.file(), found->second.second},
          fmt::format("{} is {}, expected a number above 0", scale, found->second.first));
    tir_.parameters.*magic_formula::find_parameter(name)->member *= found->second.first;
    tir_.scales[name] = found->second.first;
  }

  void take(const TeimOrbitSection& section,
            const TeimOrbitEntry& entry,
            const ParameterField& field) {
    const double value = section.number(entry) * si_factor(field.unit, units_);
    const auto [before, first] = found_.try_emplace(std::string(field.name), &entry);
    if (!first && tir_.parameters.*field.member != value)
      throw InputError(section.place(entry.line),
                       fmt::format("{} is {}, but line {} says {}; keep one of them",
                                   entry.key,
                                   entry.value,
                                   before->second->line,
                                   before->second->value));
    tir_.parameters.*field.member = value;
    const bool astray = is_coefficient_group(field.section) && section.name() != field.section;
    if (astray)
      note(entry.line,
           fmt::format(
               "{} is in [{}]{}, it belongs in [{}]; used unchanged",
               entry.key,
               section.name(),
               home_sections().contains(section.name()) ? "" : ", a section that is not known",
               field.section));
  }

  void read_mode(const TeimOrbitSection& model) {
    const long mode = model.integer("USE_MODE", 14);
    if (mode < 0)
      doubt("USE_MODE",
            model.find("USE_MODE")->line,
            fmt::format("USE_MODE is {}: the minus asks for the tire's mirror image, which is not "
                        "made here; taken as {} (side = \"other\" of a test mirrors)",
                        mode,
                        -mode));
    tir_.parameters.use_mode = static_cast<int>(std::abs(mode));
    if (const std::string unlike = unlike_use_mode(tir_); !unlike.empty())
      doubt("USE_MODE", model.find("USE_MODE")->line, unlike);
  }

  void read_side(const TeimOrbitSection& model) {
    const std::string side = model.text("TYRESIDE", "LEFT");
    const std::map<std::string, MeasuredSide> sides = {{"LEFT", MeasuredSide::left},
                                                       {"RIGHT", MeasuredSide::right},
                                                       {"SYMMETRIC", MeasuredSide::symmetric}};
    const auto known = sides.find(capitals(side));
    if (known == sides.end()) {
      doubt("TYRESIDE",
            model.find("TYRESIDE")->line,
            fmt::format("TYRESIDE is {}, expected LEFT, RIGHT or SYMMETRIC; taken as LEFT",
                        in_quotes(side)));
      return;
    }
    tir_.parameters.side = known->second;
  }

  void check_scales() {
    std::vector<std::string> zeros;
    for (const ParameterField& field : magic_formula::parameter_fields()) {
      if (field.section != "SCALING_COEFFICIENTS" || field.fallback == 0.0) continue;
      const auto found = found_.find(std::string(field.name));
      if (found == found_.end()) continue;
      const double value = tir_.parameters.*field.member;
      const bool needed =
          std::find(kNeverZero.begin(), kNeverZero.end(), field.name) != kNeverZero.end();
      if (needed && !(value > 0.0))
        throw InputError(place_of(std::string(field.name)),
                         fmt::format("{} is {}: a scaling factor that the equations divide by, "
                                     "expected a number above 0; 1 scales nothing",
                                     field.name,
                                     found->second->value));
      // scaling factors of fitted tires lie between 0.5 and 2; a value above this limit is wrong
      constexpr double kFar = 100.0;
      if (needed && (value > kFar || value < 1.0 / kFar))
        doubt(std::string(field.name),
              found->second->line,
              fmt::format("{} is {}: a scaling factor is near 1, which scales nothing",
                          field.name,
                          found->second->value));
      if (value == 0.0) zeros.emplace_back(field.name);
    }
    if (!zeros.empty())
      note(found_.at(zeros.front())->line,
           fmt::format("{} 0: what {} scale{} is left out of the forces; 1 scales nothing",
                       zeros.size() == 1 ? zeros.front() + " is"
                                         : fmt::format("{} are", fmt::join(zeros, ", ")),
                       zeros.size() == 1 ? "it" : "they",
                       zeros.size() == 1 ? "s" : ""));
  }

  void read_pressures() {
    Parameters& p = tir_.parameters;
    const bool inflated = found_.contains("INFLPRES"), nominal = found_.contains("NOMPRES");
    if (inflated && !nominal) p.NOMPRES = p.INFLPRES;
    if (nominal && !inflated) p.INFLPRES = p.NOMPRES;
    if (!(p.NOMPRES > 0.0)) throw InputError(place_of("NOMPRES"), "NOMPRES is not above zero");
    if (inflated && nominal) return;
    std::vector<std::string_view> acting;
    for (const std::string_view name : kOfPressure) {
      const ParameterField* field = magic_formula::find_parameter(name);
      const bool acts = field != nullptr ? found_.contains(std::string(name)) &&
                                               p.*field->member != field->fallback
                                         : scales_.contains(std::string(name));
      if (acts) acting.push_back(name);
    }
    tells_pressure_ = !acting.empty();
    if (!acting.empty())
      note(0,
           fmt::format("there is no {}; taken as {} Pa, from which {} count{}",
                       !nominal ? "NOMPRES (IP_NOM of PAC2002)" : "INFLPRES (IP of PAC2002)",
                       format_number(!nominal ? p.NOMPRES : p.INFLPRES),
                       fmt::join(acting, ", "),
                       acting.size() == 1 ? "s" : ""));
  }

  Place place_of(const std::string& name) const {
    const auto found = found_.find(name);
    return {tir_.source.file(), found == found_.end() ? 0 : found->second->line};
  }

  void require(const std::string& name) {
    const ParameterField* field = magic_formula::find_parameter(name);
    if (!found_.contains(name))
      throw InputError(place_of(name),
                       fmt::format("there is no {}; expected it in [{}]", name, field->section));
    if (!(tir_.parameters.*field->member > 0.0))
      throw InputError(
          place_of(name),
          fmt::format("{} is {}, expected a positive number", name, found_.at(name)->value));
  }

  void check_ranges() {
    const Parameters& p = tir_.parameters;
    if (p.RIM_RADIUS >= p.UNLOADED_RADIUS)
      throw InputError(place_of("RIM_RADIUS"),
                       fmt::format("RIM_RADIUS is {:.4g} mm, expected less than UNLOADED_RADIUS, "
                                   "which is {:.4g} mm",
                                   1e3 * p.RIM_RADIUS,
                                   1e3 * p.UNLOADED_RADIUS));
    for (const auto& [lower, upper] : kRanges) {
      const double low = tir_.parameters.*magic_formula::find_parameter(lower)->member;
      const double high = tir_.parameters.*magic_formula::find_parameter(upper)->member;
      if (low <= high) continue;
      const std::string named(found_.contains(std::string(upper)) ? upper : lower);
      throw InputError(place_of(named),
                       fmt::format("{} is above {}: no state lies between them", lower, upper));
    }
  }

  /// Adds a doubt about a range of slips in percent, or of angles in degrees although ANGLE is
  /// 'radians': such a range would cover every possible state.
  void check_angles() {
    constexpr double kMostSlip = 5.0;  // files state up to 1.5
    for (const char* name : {"KPUMIN", "KPUMAX"}) {
      const double value = tir_.parameters.*magic_formula::find_parameter(name)->member;
      if (!found_.contains(name) || std::abs(value) <= kMostSlip) continue;
      doubt(name,
            found_.at(name)->line,
            fmt::format("{} is {}, a slip of {:.0f} %: is it in percent? {} % are {:.4g}",
                        name,
                        found_.at(name)->value,
                        100.0 * value,
                        found_.at(name)->value,
                        0.01 * value));
    }
    // rad; files without real limits state up to 180 degrees.
    constexpr double kMostAngle = 3.2;
    for (const auto& [lower, upper] : {std::pair{"ALPMIN", "ALPMAX"}, {"CAMMIN", "CAMMAX"}})
      for (const char* name : {lower, upper}) {
        const double value = tir_.parameters.*magic_formula::find_parameter(name)->member;
        if (!found_.contains(name) || std::abs(value) <= kMostAngle) continue;
        const TeimOrbitEntry& entry = *found_.at(name);
        doubt(
            name,
            entry.line,
            fmt::format("{} is {} rad, that are {:.0f} degrees: is it in degrees, while ANGLE says "
                        "or is taken as radians? In a file in radians {} degrees are {:.4g}",
                        name,
                        entry.value,
                        value * 180.0 / std::numbers::pi,
                        entry.value,
                        value * std::numbers::pi / 180.0));
        break;
      }
  }

  void report_units() {
    const TeimOrbitSection* units = tir_.source.find("UNITS");
    tir_.assumed_units = units_.missing();
    if (units == nullptr)
      return doubt("[UNITS]",
                   0,
                   "there is no section [UNITS]; all numbers are taken as SI, the default of such "
                   "files");
    std::vector<std::string> assumed;
    for (const std::string& key : tir_.assumed_units)
      assumed.push_back(fmt::format("{} is taken as {}", key, TeimOrbitUnits::si_in_words(key)));
    if (!assumed.empty())
      doubt("[UNITS]",
            units->place().line,
            fmt::format("[UNITS] is silent: {}", fmt::join(assumed, ", ")));
    const bool pressure = found_.contains("INFLPRES") || found_.contains("NOMPRES");
    if (pressure && !units->has("PRESSURE") && units_.pressure() != 1.0)
      note(units->place().line,
           fmt::format("[UNITS] has no PRESSURE; taken as FORCE/LENGTH^2, {} Pa",
                       format_number(units_.pressure())));
    if (units_.angle() != 1.0)
      note(units->find("ANGLE")->line,
           "ANGLE is no radian: it counts for ALPMIN to CAMMAX and YAW_STIFFNESS; coefficients "
           "such as PHY1 and PKY1 are taken in radians");
  }

  TirFile& tir_;
  TeimOrbitUnits units_;
  std::map<std::string, const TeimOrbitEntry*> found_;
  std::map<std::string_view, const TeimOrbitEntry*> model_words_;  // keys of all [MODEL] sections
  std::map<std::string, std::pair<double, int>> scales_;           // value, line
  bool tells_pressure_ = false;   // true: a note on the pressures has been made
  long unknown_ = 0;              // keys that are not known
  int line_of_more_unknown_ = 0;  // line of the first one that is not noted by itself
};

}  // namespace

double si_factor(ParameterUnit unit, const TeimOrbitUnits& u) {
  switch (unit) {
    case ParameterUnit::one:
      return 1.0;
    case ParameterUnit::length:
      return u.length();
    case ParameterUnit::force:
      return u.force();
    case ParameterUnit::angle:
      return u.angle();
    case ParameterUnit::mass:
      return u.mass();
    case ParameterUnit::time:
      return u.time();
    case ParameterUnit::pressure:
      return u.pressure();
    case ParameterUnit::velocity:
      return u.length() / u.time();
    case ParameterUnit::acceleration:
      return u.length() / (u.time() * u.time());
    case ParameterUnit::stiffness:
      return u.force() / u.length();
    case ParameterUnit::torsional_stiffness:
      return u.force() * u.length() / u.angle();
    case ParameterUnit::damping:
      return u.force() * u.time() / u.length();
    case ParameterUnit::inertia:
      return u.mass() * u.length() * u.length();
    case ParameterUnit::frequency:
      return 1.0 / u.time();
  }
  return 1.0;
}

bool holds_no_parameters(const TeimOrbitSection& section) {
  return section.name() == "UNITS" || section.name() == "MDI_HEADER";
}

void read_parameters(TirFile& tir) { TirReader(tir).read(); }

}  // namespace latsch::formats
