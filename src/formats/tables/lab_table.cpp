// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/lab_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/file.h"
#include "base/text.h"
#include "base/units.h"
#include "formats/tables/csv_table.h"
#include "formats/tables/mat_file.h"
#include "formats/tables/tydex_file.h"
#include "formats/text/lab_units.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

using Units = std::map<std::string, std::string>;

constexpr std::size_t kLargestLabFile = std::size_t{1} << 30;  // bytes

/// A column as the file has it.
struct LabColumn {
  std::string name, unit;      // as the file states it
  std::vector<double> values;  // NaN: a gap
  bool is_si = false;          // else in `unit`
};

/// Columns in SI, with units that the caller states for those that have none.
void add_columns(std::vector<LabColumn> columns,
                 const Units& units,
                 const Place& header,
                 LabTable& table) {
  std::vector<std::string> names;
  for (const LabColumn& column : columns) names.push_back(column.name);
  for (const auto& [name, unit] : units) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw InputError(header,
                       "column " + in_quotes(name) + " is missing" + did_you_mean(name, names) +
                           " (columns: " + list_of(names) + ")");
    LabColumn& column = columns[static_cast<std::size_t>(found - names.begin())];
    if (!column.unit.empty() && column.unit != unit)
      throw InputError(
          header,
          name + " is in " + in_quotes(column.unit) + ", but was said to be in " + in_quotes(unit));
    column.unit = unit;
  }
  table.header = header;
  for (LabColumn& column : columns) {
    const auto unit = find_lab_unit(column.unit);
    if (!unit) {
      table.left_out[column.name] = "has " + unknown_unit(column.unit);
      continue;
    }
    if (!column.is_si)
      for (double& value : column.values) value = unit->to_si(value);
    table.channels.add({column.name, si_unit(unit->dimension()), std::move(column.values)});
    table.units.push_back(column.unit);
  }
}

LabTable read_csv(const std::filesystem::path& file, const Units& units) {
  const CsvTable csv = CsvTable::read(file);
  LabTable table{file.string(), {}, {}, {}, {}, {file.string(), 0}};
  std::vector<CsvTable::Wanted> wanted;
  std::vector<LabColumn> columns;
  for (const std::string& name : csv.columns()) {
    const std::string& written = csv.unit(name);
    const auto unit = Unit::find(written);
    const bool is_si = !written.empty() && unit;  // converted from the digits, to the last bit
    wanted.push_back({name, is_si ? si_unit(unit->dimension()) : ""});
    columns.push_back({name, written, {}, is_si});
  }
  auto values = csv.numbers_and_gaps(wanted, table.lines);
  for (std::size_t k = 0; k < columns.size(); ++k) columns[k].values = std::move(values[k]);
  add_columns(std::move(columns), units, csv.header_place(), table);
  return table;
}

std::vector<std::string_view> fields_of(std::string_view line, bool tabs) {
  std::vector<std::string_view> fields;
  while (!line.empty()) {
    const std::size_t end = line.find_first_of(tabs ? "\t" : " \t");
    const std::string_view field = trimmed(line.substr(0, end));
    if (tabs || !field.empty()) fields.push_back(field);
    line = end == line.npos ? std::string_view() : line.substr(end + 1);
  }
  return fields;
}

double number_or_gap(std::string_view field) {
  const auto number = parse_number(field);
  return number && std::isfinite(*number) ? *number : std::nan("");
}

struct Line {
  std::string_view text;
  int number = 0;
};

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    if (!trimmed(line).empty()) lines.push_back({line, number});
    text = end == text.npos ? std::string_view() : text.substr(end + 1);
  }
  return lines;
}

bool all_units(const std::vector<std::string_view>& fields) {
  return std::all_of(fields.begin(), fields.end(), [](std::string_view f) {
    return find_lab_unit(f).has_value();
  });
}

/// The line of names and below it, where it stands, that of units: the last before the numbers.
std::vector<LabColumn> header_of(const std::vector<Line>& before, bool tabs) {
  const std::string_view last = before.back().text;
  std::vector<LabColumn> columns;
  if (before.size() > 1) {
    for (const std::string_view name : fields_of(trimmed(before[before.size() - 2].text), tabs))
      columns.push_back({std::string(name), "", {}});
    // The last channels may be plain numbers, whose units are blank.
    auto units = fields_of(last, tabs);
    while (tabs && units.size() < columns.size()) units.emplace_back();
    while (units.size() > columns.size() && units.back().empty()) units.pop_back();
    if (units.size() == columns.size() && all_units(units)) {
      for (std::size_t k = 0; k < units.size(); ++k) columns[k].unit = units[k];
      return columns;
    }
    columns.clear();
  }
  for (const std::string_view name : fields_of(trimmed(last), tabs))
    columns.push_back({std::string(name), "", {}});
  return columns;
}

LabTable read_dat(const std::filesystem::path& file, const Units& units) {
  const std::string text = read_text_file(file, kLargestLabFile);
  std::vector<Line> lines = lines_of(text);
  const auto numbers = std::find_if(lines.begin(), lines.end(), [](const Line& line) {
    return parse_number(fields_of(trimmed(line.text), false).front()).has_value();
  });
  if (numbers == lines.begin() || numbers == lines.end())
    throw InputError({file.string(), 0},
                     numbers == lines.end() ? "has no line of numbers"
                                            : "begins with numbers, expected names before them");
  const std::vector<Line> before(lines.begin(), numbers);
  const bool tabs = before.back().text.find('\t') != std::string_view::npos;
  std::vector<LabColumn> columns = header_of(before, tabs);
  LabTable table{file.string(), {}, {}, {}, {}, {file.string(), 0}};
  for (auto line = numbers; line != lines.end(); ++line) {
    const auto fields = fields_of(line->text, tabs);
    const bool ends_in_tab = fields.size() == columns.size() + 1 && fields.back().empty();
    if (fields.size() != columns.size() && !ends_in_tab)
      throw InputError({table.file, line->number},
                       fmt::format("has {} {}, expected {} as in the line of names",
                                   fields.size(),
                                   fields.size() == 1 ? "field" : "fields",
                                   columns.size()));
    table.lines.push_back(line->number);
    for (std::size_t k = 0; k < columns.size(); ++k)
      columns[k].values.push_back(number_or_gap(fields[k]));
  }
  add_columns(std::move(columns), units, {table.file, before.back().number}, table);
  return table;
}

LabTable read_mat(const std::filesystem::path& file, const Units& units) {
  LabTable table{
      file.string(), MatFile::read(file).channels(units), {}, {}, {}, {file.string(), 0}};
  for (const Channel& channel : table.channels.all()) table.units.push_back(channel.unit);
  return table;
}

LabTable read_tydex(const std::filesystem::path& file, const Units& units) {
  TydexFile tydex = TydexFile::read(file);
  LabTable table{file.string(), {}, {}, std::move(tydex.lines), {}, {file.string(), 0}};
  std::vector<LabColumn> columns;
  for (std::size_t k = 0; k < tydex.descriptions.size(); ++k) {
    const Channel& channel = tydex.channels.all()[k];
    columns.push_back({channel.name, tydex.descriptions[k].unit, channel.values, true});
  }
  for (const TydexFile::Entry& constant : tydex.constants) {
    if (!constant.number || tydex.channels.find(constant.name)) continue;
    columns.push_back({constant.name,
                       constant.unit,
                       std::vector<double>(table.lines.size(), *constant.number),
                       true});
  }
  add_columns(std::move(columns), units, {table.file, 0}, table);
  return table;
}

}  // namespace

Place LabTable::place(std::size_t sample) const {
  return {file, sample < lines.size() ? lines[sample] : 0};
}

LabTable read_lab_table(const std::filesystem::path& file, const Units& units) {
  using Reader = LabTable (*)(const std::filesystem::path&, const Units&);
  static const std::vector<std::pair<std::string, Reader>> kReaders = {{".csv", read_csv},
                                                                       {".txt", read_csv},
                                                                       {".dat", read_dat},
                                                                       {".mat", read_mat},
                                                                       {".tdx", read_tydex},
                                                                       {".tydex", read_tydex}};
  const std::string ending = lower(file.extension().string());
  std::vector<std::string> endings;
  for (const auto& [known, reader] : kReaders) {
    if (known == ending) return reader(file, units);
    endings.push_back(known);
  }
  throw InputError({file.string(), 0},
                   "ends in " + in_quotes(ending) + ", expected " + list_of(endings));
}

}  // namespace latsch::formats
