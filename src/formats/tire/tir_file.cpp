// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_file.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "base/text.h"

namespace latsch::formats {
namespace {

using magic_formula::ParameterField;
using magic_formula::Parameters;
using magic_formula::ParameterUnit;
using magic_formula::Side;
using magic_formula::Version;

double factor(ParameterUnit unit, const TeimOrbitUnits& u) {
  switch (unit) {
    case ParameterUnit::one:
      return 1.0;
    case ParameterUnit::length:
      return u.length;
    case ParameterUnit::force:
      return u.force;
    case ParameterUnit::angle:
      return u.angle;
    case ParameterUnit::mass:
      return u.mass;
    case ParameterUnit::time:
      return u.time;
    case ParameterUnit::pressure:
      return u.pressure;
    case ParameterUnit::velocity:
      return u.length / u.time;
    case ParameterUnit::acceleration:
      return u.length / (u.time * u.time);
    case ParameterUnit::stiffness:
      return u.force / u.length;
    case ParameterUnit::torsional_stiffness:
      return u.force * u.length / u.angle;
    case ParameterUnit::damping:
      return u.force * u.time / u.length;
    case ParameterUnit::inertia:
      return u.mass * u.length * u.length;
    case ParameterUnit::frequency:
      return 1.0 / u.time;
  }
  return 1.0;
}

/// Keys that describe the file or that another program reads.
const std::set<std::string, std::less<>>& silent_keys() {
  static const std::set<std::string, std::less<>> keys = {"FILE_TYPE",
                                                          "FILE_VERSION",
                                                          "FILE_FORMAT",
                                                          "FITTYP",
                                                          "TYRESIDE",
                                                          "USE_MODE",
                                                          "IP",
                                                          "IP_NOM",
                                                          "USER_SUB_ID",
                                                          "N_TIRE_STATES",
                                                          "HMAX_LOCAL",
                                                          "TIME_SWITCH_INTEG",
                                                          "ROAD_INCREMENT",
                                                          "ROAD_DIRECTION",
                                                          "FUNCTION_NAME",
                                                          "PROPERTY_FILE_FORMAT",
                                                          "TYPE",
                                                          "ELLIPS_MAX_STEP",
                                                          "CONTACT_MODEL",
                                                          "MESSAGES",
                                                          "SWITCH_INTEG",
                                                          "MANUFACTURER",
                                                          "NOM_SECTION_WIDTH"};
  return keys;
}

/// Sections whose keys are no parameters.
bool described(const TeimOrbitSection& section) {
  static const std::set<std::string, std::less<>> names = {
      "UNITS", "MDI_HEADER", "SHAPE", "DEFLECTION_LOAD_CURVE", "BOTTOMING_CURVE"};
  return names.contains(section.name());
}

/// Other spellings of a key.
std::string parameter_name(const std::string& key) {
  if (key == "IP") return "INFLPRES";
  if (key == "IP_NOM") return "NOMPRES";
  return key;
}

class TirReader {
 public:
  explicit TirReader(TirFile& tir) : tir_(tir), units_(tir.source.units()) {}

  void read() {
    for (const TeimOrbitSection& section : tir_.source.sections())
      if (!described(section)) read_section(section);
    read_model();
    read_pressures();
    require("UNLOADED_RADIUS");
    require("FNOMIN");
    require("VERTICAL_STIFFNESS");
    read_curve();
    report_missing();
  }

 private:
  void note(int line, const std::string& text) {
    tir_.notes.push_back(Place{tir_.source.file(), line}.text() + ": " + text);
  }

  void read_section(const TeimOrbitSection& section) {
    for (const TeimOrbitEntry& entry : section.entries()) {
      const ParameterField* field = magic_formula::find_parameter(parameter_name(entry.key));
      if (field != nullptr) {
        take(section, entry, *field);
      } else if (!silent_keys().contains(entry.key)) {
        note(entry.line,
             fmt::format("[{}] {} is not known here; it stays in the file, without effect",
                         section.name(),
                         entry.key));
      }
    }
  }

  void take(const TeimOrbitSection& section,
            const TeimOrbitEntry& entry,
            const ParameterField& field) {
    const double value = section.number(entry) * factor(field.unit, units_);
    const auto [before, first] = found_.try_emplace(std::string(field.name), &entry);
    if (!first && tir_.parameters.*field.member != value)
      throw InputError(section.place(entry.line),
                       fmt::format("{} is {}, but line {} says {}; keep one of them",
                                   entry.key,
                                   entry.value,
                                   before->second->line,
                                   before->second->value));
    tir_.parameters.*field.member = value;
  }

  void read_model() {
    const TeimOrbitSection* model = tir_.source.find("MODEL");
    if (model == nullptr)
      throw InputError(Place{tir_.source.file(), 0},
                       "there is no section [MODEL]: is this a tire property file?");
    tir_.parameters.version = version(*model);
    tir_.parameters.use_mode = static_cast<int>(model->integer("USE_MODE", 14));
    const std::string side = model->text("TYRESIDE", "LEFT");
    const std::map<std::string, Side> sides = {
        {"LEFT", Side::left}, {"RIGHT", Side::right}, {"SYMMETRIC", Side::symmetric}};
    std::string capitals = side;
    for (char& c : capitals) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    const auto known = sides.find(capitals);
    if (known == sides.end()) {
      note(model->find("TYRESIDE")->line,
           fmt::format("TYRESIDE is {}, expected LEFT, RIGHT or SYMMETRIC; taken as LEFT",
                       in_quotes(side)));
      return;
    }
    tir_.parameters.side = known->second;
  }

  Version version(const TeimOrbitSection& model) {
    const TeimOrbitEntry* entry = model.find("FITTYP");
    const std::string format = model.text("PROPERTY_FILE_FORMAT", "");
    if (entry == nullptr) {
      if (format != "PAC2002" && format != "MF_05" && format != "MF-TYRE")
        throw InputError(model.place(),
                         "[MODEL] has no FITTYP, expected 6 or 21 (MF 5.2), 61 or 62");
      note(model.place().line,
           "no FITTYP; " + format + " is evaluated with the equations of MF 5.2");
      return Version::mf52;
    }
    switch (model.integer("FITTYP", 0)) {
      case 5:
        note(entry->line, "FITTYP 5 is evaluated with the equations of MF 5.2");
        [[fallthrough]];
      case 6:
      case 21:
        return Version::mf52;
      case 61:
        return Version::mf61;
      case 62:
        return Version::mf62;
      default:
        throw InputError(
            model.place(entry->line),
            fmt::format("FITTYP is {}, expected 6 or 21 (MF 5.2), 61 or 62", entry->value));
    }
  }

  void read_pressures() {
    Parameters& p = tir_.parameters;
    const bool inflated = found_.contains("INFLPRES"), nominal = found_.contains("NOMPRES");
    if (inflated && !nominal) p.NOMPRES = p.INFLPRES;
    if (nominal && !inflated) p.INFLPRES = p.NOMPRES;
    if (!(p.NOMPRES > 0.0)) throw InputError(place_of("NOMPRES"), "NOMPRES is not above zero");
  }

  Place place_of(const std::string& name) const {
    const auto found = found_.find(name);
    return {tir_.source.file(), found == found_.end() ? 0 : found->second->line};
  }

  void require(const std::string& name) {
    const ParameterField* field = magic_formula::find_parameter(name);
    if (!found_.contains(name))
      throw InputError(place_of(name),
                       fmt::format("there is no {}; it stands in [{}]", name, field->section));
    if (!(tir_.parameters.*field->member > 0.0))
      throw InputError(
          place_of(name),
          fmt::format("{} is {}, expected a positive number", name, found_.at(name)->value));
  }

  void read_curve() {
    const TeimOrbitSection* curve = tir_.source.find("DEFLECTION_LOAD_CURVE");
    if (curve == nullptr) return;
    std::vector<double>& x = tir_.parameters.curve_deflection;
    for (const TeimOrbitTable& table : curve->tables()) {
      for (const TeimOrbitRow& row : table.rows) {
        const std::vector<double> pen_fz = curve->numbers(row, 2);
        const double deflection = pen_fz[0] * units_.length;
        if (!x.empty() && deflection <= x.back())
          throw InputError(curve->place(row.line), "the deflections of the curve do not ascend");
        x.push_back(deflection);
        tir_.parameters.curve_force.push_back(pen_fz[1] * units_.force);
      }
    }
    if (x.size() < 2)
      throw InputError(curve->place(), "[DEFLECTION_LOAD_CURVE] has fewer than two rows");
  }

  /// The coefficients without which the tire has no force of that kind.
  void report_missing() {
    const bool new_formula = tir_.parameters.version != Version::mf52;
    std::vector<std::string> expected = {
        "PCX1", "PDX1", "PKX1", "PCY1", "PDY1", "PKY1", "PKY2", "QBZ1", "QCZ1", "QDZ1", "LONGVL"};
    if (new_formula)
      expected.insert(expected.end(),
                      {"Q_RA1", "Q_RB1", "LONGITUDINAL_STIFFNESS", "LATERAL_STIFFNESS", "NOMPRES"});
    for (const std::string& name : expected) {
      const ParameterField* field = magic_formula::find_parameter(name);
      if (!found_.contains(name))
        note(0,
             fmt::format("there is no {}; taken as {}",
                         name,
                         format_number(tir_.parameters.*field->member)));
    }
  }

  TirFile& tir_;
  TeimOrbitUnits units_;
  std::map<std::string, const TeimOrbitEntry*> found_;
};

const char* name_of(Side side) {
  return side == Side::left ? "LEFT" : side == Side::right ? "RIGHT" : "SYMMETRIC";
}

int fittyp_of(Version version) {
  return version == Version::mf52 ? 6 : version == Version::mf61 ? 61 : 62;
}

/// "KEY = value" lines below their [SECTION]s, in the order of the fields; `section` is open
/// already.
std::string written(const std::vector<const ParameterField*>& fields,
                    const Parameters& p,
                    const TeimOrbitUnits& units,
                    std::string_view section = {}) {
  std::string text;
  for (const ParameterField* field : fields) {
    if (field->section != section) text += fmt::format("[{}]\n", field->section);
    section = field->section;
    text += fmt::format(
        "{:<24} = {}\n", field->name, format_number(p.*field->member / factor(field->unit, units)));
  }
  return text;
}

}  // namespace

TirFile parse_tir(std::string text, std::string file_name) {
  TirFile tir;
  tir.source = TeimOrbit::parse(std::move(text), std::move(file_name));
  TirReader(tir).read();
  return tir;
}

TirFile read_tir(const std::filesystem::path& file) {
  TirFile tir;
  tir.source = TeimOrbit::read(file);
  TirReader(tir).read();
  return tir;
}

std::string tir_text(const TirFile& tir, const Parameters& parameters) {
  const TeimOrbitUnits units = tir.source.units();
  std::map<std::string, const TeimOrbitEntry*> entries;
  std::map<const TeimOrbitEntry*, std::string> values;
  for (const TeimOrbitSection& section : tir.source.sections()) {
    if (described(section)) continue;
    for (const TeimOrbitEntry& entry : section.entries()) {
      entries.emplace(parameter_name(entry.key), &entry);
      const ParameterField* field = magic_formula::find_parameter(parameter_name(entry.key));
      if (field == nullptr || parameters.*field->member == tir.parameters.*field->member) continue;
      values[&entry] = format_number(parameters.*field->member / factor(field->unit, units));
    }
  }
  std::vector<const ParameterField*> added;
  for (const ParameterField& field : magic_formula::parameter_fields())
    if (!entries.contains(std::string(field.name)) &&
        parameters.*field.member != tir.parameters.*field.member)
      added.push_back(&field);
  std::string text = tir.source.with_values(values);
  if (!added.empty() && !text.empty() && text.back() != '\n') text += '\n';
  return text + written(added, parameters, units);
}

std::string tir_text(const Parameters& parameters) {
  std::string text = fmt::format(
      "[MDI_HEADER]\nFILE_TYPE = 'tir'\nFILE_VERSION = 3.0\nFILE_FORMAT = 'ASCII'\n"
      "[UNITS]\nLENGTH = 'meter'\nFORCE = 'newton'\nANGLE = 'radians'\nMASS = 'kg'\n"
      "TIME = 'second'\nPRESSURE = 'pascal'\n"
      "[MODEL]\nFITTYP = {}\nTYRESIDE = '{}'\nUSE_MODE = {}\n",
      fittyp_of(parameters.version),
      name_of(parameters.side),
      parameters.use_mode);
  std::vector<const ParameterField*> fields;
  for (const ParameterField& field : magic_formula::parameter_fields())
    if (parameters.*field.member != field.fallback || field.name == "NOMPRES" ||
        field.name == "INFLPRES" || field.name == "LONGVL")
      fields.push_back(&field);
  text += written(fields, parameters, {}, "MODEL");
  if (!parameters.curve_deflection.empty()) {
    text += "[DEFLECTION_LOAD_CURVE]\n{pen fz}\n";
    for (std::size_t i = 0; i < parameters.curve_deflection.size(); ++i)
      text += fmt::format("{} {}\n",
                          format_number(parameters.curve_deflection[i]),
                          format_number(parameters.curve_force[i]));
  }
  return text;
}

}  // namespace latsch::formats
