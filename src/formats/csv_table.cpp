// SPDX-License-Identifier: Apache-2.0
#include "formats/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <set>

#include "base/file.h"
#include "base/text.h"
#include "base/units.h"
#include "formats/csv_fields.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLargestTable = 16u << 20;  // bytes
constexpr std::size_t kMostCells = 1000000;

/// "force [N]" -> "force", "N".
std::pair<std::string_view, std::string_view> split_unit(std::string_view cell) {
  cell = trimmed(cell);
  if (!cell.ends_with(']')) return {cell, {}};
  const auto bracket = cell.rfind('[');
  if (bracket == cell.npos) return {cell, {}};
  return {trimmed(cell.substr(0, bracket)),
          trimmed(cell.substr(bracket + 1, cell.size() - bracket - 2))};
}

std::string_view without_square_brackets(std::string_view unit) {
  unit = trimmed(unit);
  if (unit.size() >= 2 && unit.front() == '[' && unit.back() == ']')
    unit = trimmed(unit.substr(1, unit.size() - 2));
  return unit;
}

std::string called(std::string_view column) { return "column " + in_quotes(column); }

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& file) {
  return parse(read_text_file(file, kLargestTable), file.string());
}

CsvTable CsvTable::parse(std::string text, std::string file_name) {
  CsvTable table;
  table.file_ = std::move(file_name);
  CsvFields fields(std::move(text), table.file_, kLargestTable);
  table.decimal_comma_ = fields.separator() != ',';
  CsvFields::Row row;
  if (!fields.next(row))
    throw InputError({table.file_, 0}, "is empty, expected a line of column names");
  table.read_header(row);
  for (bool first = true; fields.next(row); first = false) {
    if (row.cells.size() != table.columns_.size())
      throw InputError({table.file_, row.line},
                       fmt::format("has {} {}, expected {} as in the header (line {})",
                                   row.cells.size(),
                                   row.cells.size() == 1 ? "field" : "fields",
                                   table.columns_.size(),
                                   table.header_line_));
    if (first && table.take_units(row)) continue;
    if (table.cells_.size() + row.cells.size() > kMostCells)
      throw InputError({table.file_, row.line}, fmt::format("more than {} cells", kMostCells));
    table.lines_.push_back(row.line);
    table.cells_.insert(table.cells_.end(), row.cells.begin(), row.cells.end());
  }
  table.source_ = fields.source();
  return table;
}

void CsvTable::read_header(const CsvFields::Row& row) {
  header_line_ = row.line;
  std::set<std::string_view> names;
  for (const std::string_view cell : row.cells) {
    const auto [name, unit] = split_unit(cell);
    if (name.empty()) throw InputError(header_place(), "has a column without a name");
    if (!names.insert(name).second) throw InputError(header_place(), called(name) + " comes twice");
    columns_.push_back({std::string(name), std::string(unit)});
  }
}

bool CsvTable::take_units(const CsvFields::Row& row) {
  for (const Column& column : columns_)
    if (!column.unit.empty()) return false;
  bool any = false;
  for (const std::string_view cell : row.cells) {
    const std::string_view unit = without_square_brackets(cell);
    if (unit.empty() || unit == "-") continue;
    if (unit != "1" && parse_number(unit)) return false;
    if (!Unit::find(unit)) return false;
    any = any || unit != "1";
  }
  if (!any) return false;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::string_view unit = without_square_brackets(row.cells[i]);
    columns_[i].unit = unit == "-" ? "" : unit;
  }
  return true;
}

bool CsvTable::has(std::string_view column) const {
  return std::any_of(
      columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == column; });
}

bool CsvTable::has_unit(std::string_view column) const {
  return !columns_[index(column)].unit.empty();
}

std::vector<std::string> CsvTable::columns() const {
  std::vector<std::string> names;
  for (const Column& column : columns_) names.push_back(column.name);
  return names;
}

int CsvTable::index(std::string_view column) const {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].name == column) return static_cast<int>(i);
  throw InputError(header_place(),
                   called(column) + " is missing" + did_you_mean(column, columns()) +
                       " (columns: " + list_of(columns()) + ")");
}

std::string_view CsvTable::cell(int column, int row) const {
  return cells_[static_cast<std::size_t>(row) * columns_.size() + column];
}

double CsvTable::number(int column, int row, const Unit& unit) const {
  std::string digits(trimmed(cell(column, row)));
  if (decimal_comma_ && digits.find('.') == digits.npos)
    std::replace(digits.begin(), digits.end(), ',', '.');
  const auto parts = split_number(digits);
  const double si = parts && parts->rest.empty() ? unit.to_si(parts->number) : std::nan("");
  if (std::isfinite(si)) return si;
  const std::string found =
      digits.empty() ? "is empty" : "is " + in_quotes(trimmed(cell(column, row)));
  throw InputError(place(row), columns_[column].name + " " + found + ", expected a finite number");
}

std::vector<double> CsvTable::numbers(std::string_view column, std::string_view unit) const {
  const int at = index(column);
  const Unit expected = Unit::of(unit);
  const std::string& given = columns_[at].unit;
  const auto written = Unit::find(given.empty() ? "1" : given);
  if (!written) throw InputError(header_place(), called(column) + " has " + unknown_unit(given));
  if (!written->same_dimension(expected)) {
    const DimensionWords words = words_for(expected);
    throw InputError(header_place(),
                     called(column) +
                         (given.empty() ? " has no unit" : " is in " + in_quotes(given)) +
                         ", expected " + words.noun + ", such as " +
                         in_quotes(std::string(column) + " [" + std::string(unit) + "]"));
  }
  std::vector<double> values;
  values.reserve(lines_.size());
  for (int row = 0; row < rows(); ++row) values.push_back(number(at, row, *written));
  return values;
}

std::vector<double> CsvTable::si_numbers(std::string_view column, std::string_view unit) const {
  return numbers(column, has_unit(column) ? unit : "1");
}

std::vector<int> CsvTable::integers(std::string_view column) const {
  constexpr double kLargest = 1e9;
  std::vector<int> integers;
  for (const double value : numbers(column, "1")) {
    if (value != std::floor(value) || std::abs(value) > kLargest)
      throw InputError(
          place(static_cast<int>(integers.size())),
          std::string(column) + " is " + format_number(value) + ", expected an integer");
    integers.push_back(static_cast<int>(value));
  }
  return integers;
}

std::vector<std::string> CsvTable::texts(std::string_view column) const {
  const int at = index(column);
  std::vector<std::string> texts;
  texts.reserve(lines_.size());
  for (int row = 0; row < rows(); ++row) texts.emplace_back(cell(at, row));
  return texts;
}

std::string CsvTable::text(std::string_view column, int row) const {
  return std::string(cell(index(column), row));
}

Channels CsvTable::channels() const {
  Channels channels;
  for (const Column& column : columns_) {
    const auto unit = Unit::find(column.unit.empty() ? "1" : column.unit);
    const std::string si = unit ? si_unit(unit->dimension()) : "1";
    channels.add({column.name, si, numbers(column.name, si)});
  }
  return channels;
}

void CsvTable::expect_only(const std::vector<std::string>& known) const {
  for (const Column& column : columns_)
    if (std::find(known.begin(), known.end(), column.name) == known.end())
      throw InputError(header_place(),
                       "unknown " + called(column.name) + did_you_mean(column.name, known));
}

std::string csv_field(std::string_view text) {
  const bool plain = text == trimmed(text) && !text.empty() && text.front() != '#' &&
                     text.find_first_of(",;\t\"\r\n") == text.npos;
  if (plain) return std::string(text);
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + "\"";
}

std::string csv_text(const Channels& channels, const std::vector<std::string>& units) {
  assert(units.empty() || units.size() == channels.all().size());
  std::vector<Unit> written;
  std::string text;
  for (std::size_t i = 0; i < channels.all().size(); ++i) {
    const Channel& channel = channels.all()[i];
    assert(channel.values.size() == channels.all()[0].values.size());
    written.push_back(Unit::of(units.empty() ? channel.unit : units[i]));
    assert(written[i].same_dimension(Unit::of(channel.unit)));
    if (i > 0) text += ',';
    text += csv_field(fmt::format("{} [{}]", channel.name, written[i].text()));
  }
  text += '\n';
  const std::size_t rows = channels.empty() ? 0 : channels.all()[0].values.size();
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < written.size(); ++i) {
      if (i > 0) text += ',';
      text += written[i].exact_number(channels.all()[i].values[row]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace latsch::formats
