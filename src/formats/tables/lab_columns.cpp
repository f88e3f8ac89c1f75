// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/lab_columns.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "base/units.h"

namespace latsch::formats {
namespace {

void expect_once(const std::vector<LabColumn>& columns, const Place& header) {
  std::map<std::string, int> places;
  for (const LabColumn& column : columns) {
    const auto [before, is_new] = places.emplace(column.source.name, column.source.place);
    if (!is_new)
      throw InputError(header,
                       fmt::format("column {} comes twice, as column {} and {}",
                                   in_quotes(column.source.name),
                                   before->second,
                                   column.source.place));
  }
}

/// Sets the units that the caller states for columns without unit.
void take_stated_units(std::vector<LabColumn>& columns,
                       const std::map<std::string, std::string>& units,
                       const Place& header) {
  std::vector<std::string> names, missing;
  for (const LabColumn& column : columns) names.push_back(column.source.name);
  for (const auto& [name, unit] : units) {
    const auto found =
        std::find_if(columns.begin(), columns.end(), [&name = name](const LabColumn& column) {
          return column.source.name == name || column.source.title == name;
        });
    if (found == columns.end()) {
      missing.push_back(name);
      continue;
    }
    found->source.name = name;
    const int line = found->source.unit_line;
    take_stated_unit(found->source, unit, {header.file, line > 0 ? line : header.line});
  }
  if (!missing.empty()) throw InputError(header, missing_columns(missing, names));
}

}  // namespace

void add_columns(std::vector<LabColumn> columns,
                 const std::map<std::string, std::string>& units,
                 const ExpectedUnit& expected,
                 const Place& header,
                 LabTable& table) {
  for (LabColumn& column : columns) take_minus_of_name(column.source);
  expect_once(columns, header);
  take_stated_units(columns, units, header);
  table.header = header;
  for (LabColumn& column : columns) {
    TableColumn& source = column.source;
    if (expected && !column.is_si) take_unit_of_name(source, expected(source.name));
    const std::string wanted =
        expected && !source.unit.empty() ? expected(source.name) : std::string();
    const bool is_known =
        units.contains(source.name) || (expected && !expected(source.name).empty());
    const Place place{header.file, source.unit_line > 0 ? source.unit_line : header.line};
    const std::string unit_fault = fault_of_unit(source, wanted);
    if (is_known && !unit_fault.empty()) throw InputError(place, unit_fault);
    if (is_known && !column.fault.empty())
      throw InputError(header, source.name + " " + column.fault);
    if (!unit_fault.empty() || !column.fault.empty()) {
      const std::size_t has = unit_fault.find(" has ");
      table.left_out[source.name] =
          has == unit_fault.npos ? column.fault : unit_fault.substr(has + 1);
      table.left_columns.push_back(std::move(source));
      continue;
    }
    const Unit unit = unit_of_column(source, wanted, place);
    if (!column.is_si)
      for (double& value : column.values) value = unit.to_si(value);
    if (source.is_negative)
      for (double& value : column.values) value = -value;
    table.channels.add({source.name, si_unit(unit.dimension()), std::move(column.values)});
    // For a unit with several meanings, the spelling of the chosen meaning is recorded.
    table.units.push_back(source.unit.empty() || unit.text() == source.unit ? source.unit
                                                                            : unit.text());
    table.columns.push_back(std::move(source));
  }
}

}  // namespace latsch::formats
