// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "base/file.h"
#include "base/text.h"
#include "base/units.h"
#include "formats/text/csv_fields.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLargestTable = 1u << 30;  // bytes
constexpr int kStride = 1024;                    // rows between two places that are kept

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
  return parse(std::make_shared<const MappedFile>(file, kLargestTable), file.string());
}

CsvTable CsvTable::parse(std::string text, std::string file_name) {
  return parse(std::make_shared<const MappedFile>(std::move(text)), std::move(file_name));
}

CsvTable CsvTable::parse(std::shared_ptr<const MappedFile> source, std::string file_name) {
  CsvTable table;
  table.file_ = std::move(file_name);
  table.source_ = std::move(source);
  CsvFields fields(table.source_, table.file_);
  fields.expect_text();
  table.decimal_comma_ = fields.separator() != ',';
  CsvFields::Row row;
  if (!fields.next(row))
    throw InputError({table.file_, 0}, "is empty, expected a line of column names");
  table.read_header(row);
  CsvFields::Mark mark = fields.mark();
  for (bool first = true; fields.next(row); first = false) {
    if (row.cells.size() != table.columns_.size())
      throw InputError({table.file_, row.line},
                       fmt::format("has {} {}, expected {} as in the header (line {})",
                                   row.cells.size(),
                                   row.cells.size() == 1 ? "field" : "fields",
                                   table.columns_.size(),
                                   table.header_line_));
    const bool units = first && table.take_units(row);
    if (!units && table.rows_++ % kStride == 0) table.marks_.push_back(mark);
    mark = fields.mark();
  }
  return table;
}

CsvFields CsvTable::data() const {
  CsvFields fields(source_, file_);
  if (!marks_.empty()) fields.go_to(marks_.front());
  return fields;
}

Place CsvTable::place(int wanted) const {
  CsvFields fields = data();
  return {file_, row_of(fields, wanted).line};
}

CsvFields::Row CsvTable::row_of(CsvFields& fields, int wanted) const {
  assert(wanted >= 0 && wanted < rows_);
  fields.go_to(marks_[static_cast<std::size_t>(wanted / kStride)]);
  CsvFields::Row row;
  for (int i = wanted / kStride * kStride; i <= wanted; ++i) fields.next(row);
  return row;
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

const std::string& CsvTable::unit(std::string_view column) const {
  return columns_[index(column)].unit;
}

bool CsvTable::has_unit(std::string_view column) const { return !unit(column).empty(); }

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

double CsvTable::number_or_gap(const CsvFields::Row& row, int column, const Unit& unit) const {
  const std::string_view cell = trimmed(row.cells[static_cast<std::size_t>(column)]);
  const auto read = [&](std::string_view digits) {
    const auto parts = split_number(digits);
    return parts && parts->rest.empty() ? unit.to_si(parts->number) : std::nan("");
  };
  double si = std::nan("");
  if (decimal_comma_ && cell.find('.') == cell.npos) {
    std::string digits(cell);
    std::replace(digits.begin(), digits.end(), ',', '.');
    si = read(digits);
  } else {
    si = read(cell);
  }
  return std::isfinite(si) ? si : std::nan("");
}

double CsvTable::number(const CsvFields::Row& row, int column, const Unit& unit) const {
  const double si = number_or_gap(row, column, unit);
  if (std::isfinite(si)) return si;
  const std::string_view cell = trimmed(row.cells[static_cast<std::size_t>(column)]);
  throw InputError({file_, row.line},
                   columns_[static_cast<std::size_t>(column)].name + " " +
                       (cell.empty() ? "is empty" : "is " + in_quotes(cell)) +
                       ", expected a finite number");
}

Unit CsvTable::unit_of(int column, std::string_view unit) const {
  const Unit expected = Unit::of(unit);
  const auto& [name, given] = columns_[static_cast<std::size_t>(column)];
  const auto written = Unit::find(given.empty() ? "1" : given);
  if (!written) throw InputError(header_place(), called(name) + " has " + unknown_unit(given));
  if (written->same_dimension(expected)) return *written;
  const DimensionWords words = words_for(expected);
  throw InputError(header_place(),
                   called(name) + (given.empty() ? " has no unit" : " is in " + in_quotes(given)) +
                       ", expected " + words.noun + ", such as " +
                       in_quotes(name + " [" + std::string(unit) + "]"));
}

void CsvTable::for_blocks(
    const std::vector<Wanted>& wanted,
    int most,
    const std::function<void(std::vector<std::vector<double>>&)>& block) const {
  std::vector<int> places;
  std::vector<Unit> units;
  for (const Wanted& one : wanted) {
    places.push_back(index(one.column));
    units.push_back(unit_of(places.back(), one.unit));
  }
  std::vector<std::vector<double>> values(wanted.size());
  const auto expected = static_cast<std::size_t>(std::min(most, rows_));
  for (auto& column : values) column.reserve(expected);
  CsvFields fields = data();
  CsvFields::Row row;
  for (int i = 0; i < rows_; ++i) {
    fields.next(row);
    for (std::size_t k = 0; k < places.size(); ++k)
      values[k].push_back(number(row, places[k], units[k]));
    if ((i + 1) % most != 0 && i + 1 < rows_) continue;
    block(values);
    for (auto& column : values) column.clear();
  }
}

std::vector<std::vector<double>> CsvTable::numbers(const std::vector<Wanted>& wanted) const {
  std::vector<std::vector<double>> all(wanted.size());
  for_blocks(wanted, std::max(rows_, 1), [&](auto& block) { all.swap(block); });
  return all;
}

std::vector<std::vector<double>> CsvTable::numbers_and_gaps(const std::vector<Wanted>& wanted,
                                                            std::vector<int>& lines) const {
  std::vector<int> places;
  std::vector<Unit> units;
  for (const Wanted& one : wanted) {
    places.push_back(index(one.column));
    units.push_back(one.unit.empty() ? Unit::of("1") : unit_of(places.back(), one.unit));
  }
  std::vector<std::vector<double>> values(wanted.size());
  for (auto& column : values) column.reserve(static_cast<std::size_t>(rows_));
  CsvFields fields = data();
  CsvFields::Row row;
  for (int i = 0; i < rows_ && fields.next(row); ++i) {
    lines.push_back(row.line);
    for (std::size_t k = 0; k < places.size(); ++k)
      values[k].push_back(number_or_gap(row, places[k], units[k]));
  }
  return values;
}

std::vector<double> CsvTable::numbers(std::string_view column, std::string_view unit) const {
  return numbers({{std::string(column), std::string(unit)}}).front();
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
  const auto at = static_cast<std::size_t>(index(column));
  std::vector<std::string> texts;
  texts.reserve(static_cast<std::size_t>(rows_));
  CsvFields fields = data();
  CsvFields::Row row;
  for (int i = 0; i < rows_ && fields.next(row); ++i) texts.emplace_back(row.cells[at]);
  return texts;
}

std::string CsvTable::text(std::string_view column, int wanted) const {
  const auto at = static_cast<std::size_t>(index(column));
  CsvFields fields = data();  // the cells live as long as it stands there
  return std::string(row_of(fields, wanted).cells[at]);
}

Channels CsvTable::channels() const {
  std::vector<Wanted> wanted;
  for (const Column& column : columns_) {
    const auto unit = Unit::find(column.unit.empty() ? "1" : column.unit);
    wanted.push_back({column.name, unit ? si_unit(unit->dimension()) : "1"});
  }
  auto values = numbers(wanted);
  Channels channels;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    channels.add({wanted[i].column, wanted[i].unit, std::move(values[i])});
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

namespace {

Unit unit_written(const Channels& channels, const std::vector<std::string>& units, std::size_t i) {
  assert(units.empty() || units.size() == channels.all().size());
  const Channel& channel = channels.all()[i];
  const Unit written = Unit::of(units.empty() ? channel.unit : units[i]);
  assert(written.same_dimension(Unit::of(channel.unit)));
  return written;
}

}  // namespace

std::string csv_header(const Channels& channels, const std::vector<std::string>& units) {
  std::string text;
  for (std::size_t i = 0; i < channels.all().size(); ++i) {
    if (i > 0) text += ',';
    text += csv_field(
        fmt::format("{} [{}]", channels.all()[i].name, unit_written(channels, units, i).text()));
  }
  return text + '\n';
}

std::string csv_rows(const Channels& channels, const std::vector<std::string>& units) {
  constexpr std::size_t kUsualCell = 18;  // bytes
  std::vector<Unit> written;
  std::size_t rows = 0;
  for (std::size_t i = 0; i < channels.all().size(); ++i) {
    rows = std::max(rows, channels.all()[i].values.size());
    written.push_back(unit_written(channels, units, i));
  }
  std::string text;
  text.reserve(rows * written.size() * kUsualCell);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < written.size(); ++i) {
      if (i > 0) text += ',';
      const std::vector<double>& values = channels.all()[i].values;
      if (row < values.size()) written[i].append_exact_number(values[row], text);
    }
    text += '\n';
  }
  return text;
}

std::string csv_text(const Channels& channels, const std::vector<std::string>& units) {
  return csv_header(channels, units) + csv_rows(channels, units);
}

}  // namespace latsch::formats
