// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/csv_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/text.h"
#include "base/unit_reading.h"

namespace latsch::formats {
namespace {

std::string_view without_square_brackets(std::string_view unit) {
  unit = trimmed(unit);
  if (unit.size() >= 2 && unit.front() == '[' && unit.back() == ']')
    unit = trimmed(unit.substr(1, unit.size() - 2));
  return unit;
}

bool is_number(std::string_view cell) {
  if (parse_number(cell)) return true;
  std::string point(cell);
  std::replace(point.begin(), point.end(), ',', '.');
  return parse_number(point).has_value();
}

bool says_nothing(std::string_view unit) { return unit.empty() || unit == "-"; }

/// True if the cells contain numbers. A cell "1" may also be the unit of plain numbers.
bool holds_numbers(const std::vector<std::string>& cells) {
  return std::any_of(cells.begin(), cells.end(), [](const std::string& cell) {
    return cell != "1" && is_number(cell);
  });
}

bool all_units(const std::vector<std::string>& cells) {
  bool any = false;
  for (const std::string& cell : cells) {
    const std::string_view unit = without_square_brackets(cell);
    if (says_nothing(unit) || unit == "1") continue;
    if (!looks_like_unit(unit)) return false;
    any = true;
  }
  return any;
}

/// True if the next line has numbers below the texts of this line, so that this line holds units.
bool stands_above_numbers(const std::vector<std::string>& cells, const CsvFields::Row& next) {
  for (std::size_t i = 0; i < std::min(cells.size(), next.cells.size()); ++i)
    if (!says_nothing(without_square_brackets(cells[i])) && cells[i] != "1" &&
        is_number(next.cells[i]))
      return true;
  return false;
}

void take_units(const std::vector<std::string>& cells,
                int line,
                std::vector<TableColumn>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string_view unit = without_square_brackets(cells[i]);
    columns[i].unit = says_nothing(unit) ? "" : unit;
    columns[i].unit_line = line;
    columns[i].unit_place = UnitPlace::row_below;
  }
}

/// Removes the unit of columns of text, which have none whatever is below their names.
void leave_texts(const CsvFields::Row& next, std::vector<TableColumn>& columns) {
  for (std::size_t i = 0; i < std::min(columns.size(), next.cells.size()); ++i)
    if (!is_number(next.cells[i]) && !is_gap_word(next.cells[i]) && !Unit::find(columns[i].unit))
      columns[i].unit.clear();
}

void read_names(const CsvFields::Row& row, const Place& place, CsvHeader& header) {
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    TableColumn column = column_of_title(row.cells[i]);
    column.line = column.unit_line = row.line;
    column.place = static_cast<int>(i + 1);
    if (column.name.empty())
      throw InputError(place, fmt::format("has a column without a name: column {}", i + 1));
    if (is_number(column.name))
      throw InputError(place,
                       in_quotes(column.name) + " is a number, expected a line of column names");
    const auto [before, is_new] = places.emplace(column.name, i + 1);
    if (!is_new)
      throw InputError(place,
                       fmt::format("column {} comes twice, as column {} and {}",
                                   in_quotes(column.name),
                                   before->second,
                                   i + 1));
    header.columns.push_back(std::move(column));
  }
}

}  // namespace

CsvHeader read_csv_header(CsvFields& fields, const std::string& file) {
  CsvFields::Row row;
  if (!fields.next(row)) throw InputError({file, 0}, "is empty, expected a line of column names");
  CsvHeader header{row.line, {}};
  read_names(row, {file, row.line}, header);
  const bool has_units =
      std::any_of(header.columns.begin(), header.columns.end(), [](const TableColumn& column) {
        return !column.unit.empty();
      });
  const CsvFields::Mark first = fields.mark();
  if (has_units || !fields.next(row) || row.cells.size() != header.columns.size()) {
    fields.go_to(first);
    return header;
  }
  const std::vector<std::string> cells(row.cells.begin(), row.cells.end());
  const int line = row.line;
  const CsvFields::Mark second = fields.mark();
  const bool more = fields.next(row);
  const bool units =
      !holds_numbers(cells) && (all_units(cells) || (more && stands_above_numbers(cells, row)));
  if (units) {
    take_units(cells, line, header.columns);
    if (more) leave_texts(row, header.columns);
  }
  fields.go_to(units ? second : first);
  return header;
}

std::string wrong_number_of_fields(std::size_t found, const CsvHeader& header, char separator) {
  const std::size_t expected = header.columns.size();
  std::string words = fmt::format("has {} {}, expected {} as in the header (line {})",
                                  found,
                                  found == 1 ? "field" : "fields",
                                  expected,
                                  header.line);
  if (separator == ',' && found > expected && found <= 2 * expected)
    words += "; decimal commas need semicolons or tabs between the columns";
  if (expected == 1 && found > 1)
    words += fmt::format("; if line {} is a title, put # before it", header.line);
  return words;
}

}  // namespace latsch::formats
