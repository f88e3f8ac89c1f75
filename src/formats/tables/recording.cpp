// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "base/file.h"
#include "base/text.h"
#include "base/units.h"
#include "formats/tables/mat_file.h"
#include "formats/tables/tydex_file.h"
#include "formats/text/csv_fields.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLargestRecording = std::size_t{2} << 30;  // bytes

struct Column {
  std::string name;
  std::string unit;  // as written; empty: none
  Unit read = Unit::of("1");
  bool is_si = true;  // no conversion
  std::vector<double> values;
};

/// "force [N]" -> "force", "N".
Column column_of(std::string_view cell) {
  cell = trimmed(cell);
  const auto bracket = cell.ends_with(']') ? cell.rfind('[') : cell.npos;
  if (bracket == cell.npos) return {std::string(cell), "", Unit::of("1"), true, {}};
  const auto unit = trimmed(cell.substr(bracket + 1, cell.size() - bracket - 2));
  return {
      std::string(trimmed(cell.substr(0, bracket))), std::string(unit), Unit::of("1"), true, {}};
}

std::vector<Column> titles_of(const CsvFields::Row& row, const Place& place) {
  std::vector<Column> columns;
  std::set<std::string> names;
  for (const std::string_view cell : row.cells) {
    columns.push_back(column_of(cell));
    const std::string& name = columns.back().name;
    if (name.empty()) throw InputError(place, "has a column without a name");
    if (parse_number(name)) {
      throw InputError(place, in_quotes(name) + " is a number, expected a line of column names");
    }
    if (!names.insert(name).second) {
      throw InputError(place, "column " + in_quotes(name) + " comes twice");
    }
  }
  return columns;
}

/// A row of units alone below the names; false: it is a row of numbers.
bool take_units(const CsvFields::Row& row, std::vector<Column>& columns) {
  bool any = false;
  for (const Column& column : columns) {
    if (!column.unit.empty()) return false;
  }
  for (const std::string_view cell : row.cells) {
    if (cell.empty() || cell == "-" || cell == "1") continue;
    if (parse_number(cell) || !Unit::find(cell)) return false;
    any = true;
  }
  if (!any) return false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    columns[i].unit = row.cells[i] == "-" ? std::string() : std::string(row.cells[i]);
  }
  return true;
}

void find_units(std::vector<Column>& columns, const Place& place) {
  for (Column& column : columns) {
    if (column.unit.empty()) continue;
    const auto unit = Unit::find(column.unit);
    if (!unit) {
      throw InputError(place,
                       "column " + in_quotes(column.name) + " has " + unknown_unit(column.unit));
    }
    column.read = *unit;
    column.is_si = unit->to_si(0.0L) == 0.0 && unit->to_si(1.0L) == 1.0;
  }
}

/// The whole cell as a number; NaN where it is none.
double number(std::string_view cell, bool decimal_comma, std::string& scratch) {
  if (decimal_comma && cell.find('.') == cell.npos) {
    scratch.assign(cell);
    std::replace(scratch.begin(), scratch.end(), ',', '.');
    cell = scratch;
  }
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool whole = error == std::errc() && end == cell.data() + cell.size();
  return whole ? value : std::nan("");
}

[[noreturn]] void no_number(const Column& column, std::string_view cell, const Place& place) {
  throw InputError(place,
                   column.name + (cell.empty() ? " is empty" : " is " + in_quotes(cell)) +
                       ", expected a finite number: fill the gap or cut the file there");
}

void take_row(const CsvFields::Row& row,
              bool decimal_comma,
              const std::string& file,
              std::vector<Column>& columns,
              std::string& scratch) {
  if (row.cells.size() != columns.size()) {
    throw InputError({file, row.line},
                     fmt::format("has {} {}, expected {} as in the header",
                                 row.cells.size(),
                                 row.cells.size() == 1 ? "field" : "fields",
                                 columns.size()));
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    double value = number(row.cells[i], decimal_comma, scratch);
    if (!columns[i].is_si) value = columns[i].read.to_si(value);
    if (!std::isfinite(value)) no_number(columns[i], row.cells[i], {file, row.line});
    columns[i].values.push_back(value);
  }
}

}  // namespace

namespace {

Channels parse(std::shared_ptr<const MappedFile> source, const std::string& file) {
  const std::size_t size = source->text().size();
  CsvFields fields(std::move(source), file);
  fields.expect_text();
  const bool decimal_comma = fields.separator() != ',';
  CsvFields::Row row;
  if (!fields.next(row)) throw InputError({file, 0}, "is empty, expected a line of column names");
  const Place header{file, row.line};
  std::vector<Column> columns = titles_of(row, header);
  std::string scratch;
  bool more = fields.next(row);
  if (more && row.cells.size() == columns.size() && take_units(row, columns)) {
    more = fields.next(row);
  }
  find_units(columns, header);
  constexpr std::size_t kUsualCell = 9;  // bytes: a first guess of the rows saves copies
  for (Column& column : columns) column.values.reserve(size / (kUsualCell * columns.size()));
  for (; more; more = fields.next(row)) take_row(row, decimal_comma, file, columns, scratch);
  Channels channels;
  for (Column& column : columns) {
    channels.add({column.name, si_unit(column.read.dimension()), std::move(column.values)});
  }
  return channels;
}

}  // namespace

Channels parse_recording(std::string text, const std::string& file) {
  return parse(std::make_shared<const MappedFile>(std::move(text)), file);
}

Channels read_recording(const std::filesystem::path& file,
                        const std::map<std::string, std::string>& units) {
  const std::string ending = file.extension().string();
  if (ending == ".tdx" || ending == ".TDX") return TydexFile::read(file).channels;
  if (ending == ".mat") return MatFile::read(file).channels(units);
  if (ending == ".csv" || ending == ".txt" || ending == ".CSV" || ending == ".TXT") {
    return parse(std::make_shared<const MappedFile>(file, kLargestRecording), file.string());
  }
  throw InputError({file.string(), 0},
                   "ends in " + in_quotes(ending) + ", expected .csv, .txt, .tdx or .mat");
}

}  // namespace latsch::formats
