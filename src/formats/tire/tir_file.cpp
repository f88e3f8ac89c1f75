// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_file.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "base/text.h"
#include "formats/tire/tir_dialect.h"
#include "formats/tire/tir_reader.h"

namespace latsch::formats {
namespace {

using magic_formula::MeasuredSide;
using magic_formula::ParameterField;
using magic_formula::Parameters;
using magic_formula::Version;

const char* name_of(MeasuredSide side) {
  return side == MeasuredSide::left ? "LEFT" : side == MeasuredSide::right ? "RIGHT" : "SYMMETRIC";
}

int fittyp_of(Version version) {
  return version == Version::mf52 ? 6 : version == Version::mf61 ? 61 : 62;
}

/// Units and names of the numbers in a file.
struct Spelling {
  TeimOrbitUnits units;
  bool pac2002 = false;
  std::map<std::string, double, std::less<>> scales;

  std::string_view key(const ParameterField& field) const {
    return pac2002 ? pac2002_spelling(field.name) : field.name;
  }
  std::string value(const ParameterField& field, const Parameters& p) const {
    const auto scale = scales.find(field.name);
    const double one = si_factor(field.unit, units) * (scale == scales.end() ? 1.0 : scale->second);
    return format_number(p.*field.member / one);
  }
};

/// Returns lines "KEY = value" below the heads of their sections, in the order of the fields; the
/// head of `section` has been written before.
std::string written(const std::vector<const ParameterField*>& fields,
                    const Parameters& p,
                    const Spelling& spelling,
                    std::string_view section = {}) {
  std::string text;
  for (const ParameterField* field : fields) {
    if (field->section != section) text += fmt::format("[{}]\n", field->section);
    section = field->section;
    text += fmt::format("{:<24} = {}\n", spelling.key(*field), spelling.value(*field, p));
  }
  return text;
}

}  // namespace

TirFile parse_tir(std::string text, std::string file_name) {
  TirFile tir;
  tir.source = TeimOrbit::parse(std::move(text), std::move(file_name));
  read_parameters(tir);
  return tir;
}

TirFile read_tir(const std::filesystem::path& file) {
  TirFile tir;
  tir.source = TeimOrbit::read(file);
  read_parameters(tir);
  return tir;
}

std::string tir_text(const TirFile& tir, const Parameters& parameters) {
  const Spelling spelling{
      tir.source.units(TeimOrbitUnits::Missing::is_si), tir.pac2002, tir.scales};
  std::map<std::string_view, const TeimOrbitEntry*> entries;
  std::map<const TeimOrbitEntry*, std::string> values;
  for (const TeimOrbitSection& section : tir.source.sections()) {
    if (holds_no_parameters(section)) continue;
    for (const TeimOrbitEntry& entry : section.entries()) {
      const std::string_view name = parameter_of_key(entry.key);
      const ParameterField* field = magic_formula::find_parameter(name);
      entries.emplace(name, &entry);
      if (field == nullptr || parameters.*field->member == tir.parameters.*field->member) continue;
      values[&entry] = spelling.value(*field, parameters);
    }
  }
  std::vector<const ParameterField*> added;
  for (const ParameterField& field : magic_formula::parameter_fields())
    if (!entries.contains(field.name) && parameters.*field.member != tir.parameters.*field.member)
      added.push_back(&field);
  std::string text = tir.source.with_values(values);
  if (!added.empty() && !text.empty() && text.back() != '\n') text += '\n';
  return text + written(added, parameters, spelling);
}

namespace {

/// Returns " $ remark" and the end of the line, to be written after a value.
std::string behind(const TirRemarks& remarks, std::string_view key) {
  const auto found = remarks.of_keys.find(key);
  return found == remarks.of_keys.end() ? "\n" : "  $ " + found->second + "\n";
}

std::string head_of(std::string_view section, const TirRemarks& remarks) {
  std::string text = fmt::format("[{}]\n", section);
  const auto found = remarks.of_sections.find(section);
  if (found != remarks.of_sections.end()) text += "$ " + found->second + "\n";
  return text;
}

}  // namespace

bool is_always_written(const ParameterField& field, Version version) {
  const bool is_mf52 = version == Version::mf52;
  for (const char* name : {"NOMPRES", "INFLPRES", "LONGVL", "VXLOW"})
    if (field.name == name) return true;
  for (const char* name : {"PKY4", "Q_RE0"})
    if (field.name == name) return !is_mf52;
  for (const char* name : {"LGAX", "LGAY", "LGAZ", "LSGKP", "LSGAL"})
    if (field.name == name) return is_mf52;
  return field.section == "SCALING_COEFFICIENTS" && field.fallback != 0.0;
}

namespace {

/// Returns the parameters below the heads of their sections, in the order of the fields. The head
/// of MODEL has been written before.
std::string sections_of(const Parameters& p, const TirRemarks& remarks) {
  std::string text;
  std::string_view section = "MODEL", last_field_of = "MODEL";
  for (const ParameterField& field : magic_formula::parameter_fields()) {
    if (field.section != last_field_of && remarks.of_sections.contains(field.section)) {
      section = field.section;
      text += head_of(section, remarks);
    }
    last_field_of = field.section;
    const double value = p.*field.member;
    const bool is_needed = value != field.fallback || is_always_written(field, p.version) ||
                           remarks.of_keys.contains(field.name);
    if (!is_needed || !std::isfinite(value)) continue;
    if (field.section != section) text += head_of(field.section, remarks);
    section = field.section;
    text += fmt::format(
        "{:<24} = {}{}", field.name, Spelling{}.value(field, p), behind(remarks, field.name));
  }
  return text;
}

}  // namespace

std::string tir_text(const Parameters& parameters, const TirRemarks& remarks) {
  std::string text = fmt::format(
      "[MDI_HEADER]\nFILE_TYPE = 'tir'\nFILE_VERSION = 3.0\nFILE_FORMAT = 'ASCII'\n{}"
      "[UNITS]\nLENGTH = 'meter'\nFORCE = 'newton'\nANGLE = 'radians'\nMASS = 'kg'\n"
      "TIME = 'second'\nPRESSURE = 'pascal'\n"
      "{}FITTYP = {}{}TYRESIDE = '{}'{}USE_MODE = {}{}",
      remarks.header,
      head_of("MODEL", remarks),
      fittyp_of(parameters.version),
      behind(remarks, "FITTYP"),
      name_of(parameters.side),
      behind(remarks, "TYRESIDE"),
      parameters.use_mode,
      behind(remarks, "USE_MODE"));
  text += sections_of(parameters, remarks);
  if (!parameters.curve_deflection.empty()) {
    text += "[DEFLECTION_LOAD_CURVE]\n{pen fz}\n";
    for (std::size_t i = 0; i < parameters.curve_deflection.size(); ++i)
      text += fmt::format("{} {}\n",
                          format_number(parameters.curve_deflection[i]),
                          format_number(parameters.curve_force[i]));
  }
  return text;
}

std::map<std::string, std::string, std::less<>> remarks_of(const TirFile& tir) {
  std::map<std::string, std::string, std::less<>> remarks;
  for (const TeimOrbitSection& section : tir.source.sections()) {
    if (holds_no_parameters(section)) continue;
    for (const TeimOrbitEntry& entry : section.entries()) {
      const std::string name(parameter_of_key(entry.key));
      const bool is_word = name == "FITTYP" || name == "TYRESIDE" || name == "USE_MODE";
      if (is_word || magic_formula::find_parameter(name))
        remarks.emplace(name, trimmed(entry.comment));
    }
  }
  return remarks;
}

}  // namespace latsch::formats
