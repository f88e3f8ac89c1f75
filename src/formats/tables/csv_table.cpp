// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/file.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "formats/tables/csv_header.h"
#include "formats/text/csv_fields.h"
#include "formats/text/cut_end.h"
#include "formats/text/fortran_number.h"
#include "formats/text/text_encoding.h"
#include "measurement/meaning/channel_words.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLargestTable = 1u << 30;  // bytes
// number of rows between two stored positions; a larger number saves memory and makes access to
// single rows slower
constexpr int kStride = 1024;

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
  table.source_ = utf8_file(std::move(source), table.file_);
  CsvFields fields(table.source_, table.file_);
  table.decimal_comma_ = fields.separator() != ',';
  CsvHeader header = read_csv_header(fields, table.file_);
  CsvFields::Row row;
  CsvFields::Mark mark = fields.mark();
  while (fields.next(row)) {
    if (row.cells.size() != header.columns.size()) {
      const bool is_cut = row.cells.size() < header.columns.size() &&
                          CutEnd::lacks_line_end(table.source_->text(), fields.mark().at);
      throw InputError({table.file_, row.line},
                       (is_cut ? kCutWithin : "") +
                           wrong_number_of_fields(row.cells.size(), header, fields.separator()));
    }
    if (table.rows_++ % kStride == 0) table.marks_.push_back(mark);
    mark = fields.mark();
  }
  table.header_line_ = header.line;
  table.columns_ = std::move(header.columns);
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

bool CsvTable::has(std::string_view column) const { return place_of(column) >= 0; }

const std::string& CsvTable::unit(std::string_view column) const {
  return columns_[index(column)].unit;
}

bool CsvTable::has_unit(std::string_view column) const { return !unit(column).empty(); }

std::vector<std::string> CsvTable::columns() const {
  std::vector<std::string> names;
  for (const TableColumn& column : columns_) names.push_back(column.name);
  return names;
}

int CsvTable::place_of(std::string_view column) const {
  for (const auto text : {&TableColumn::name, &TableColumn::title})
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (columns_[i].*text == column) return static_cast<int>(i);
  return -1;
}

int CsvTable::index(std::string_view column) const {
  const int place = place_of(column);
  if (place < 0)
    throw InputError(header_place(), missing_columns({std::string(column)}, columns()));
  return place;
}

void CsvTable::expect_columns(const std::vector<std::string>& needed) const {
  std::vector<std::string> missing;
  for (const std::string& column : needed)
    if (!has(column)) missing.push_back(column);
  if (!missing.empty()) throw InputError(header_place(), missing_columns(missing, columns()));
}

double CsvTable::number_or_gap(const CsvFields::Row& row, int column, const Unit& unit) const {
  const std::string_view cell = trimmed(row.cells[static_cast<std::size_t>(column)]);
  const auto read = [&](std::string_view digits) {
    const auto parts = split_number(digits);
    if (parts && parts->rest.empty()) return unit.to_si(parts->number);
    const auto fortran = parts ? parse_fortran_number(digits) : std::nullopt;
    return fortran ? unit.to_si(*fortran) : std::nan("");
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

double CsvTable::number(const CsvFields::Row& row,
                        int column,
                        const Unit& unit,
                        DecimalMarks& marks) const {
  const double si = number_or_gap(row, column, unit);
  const std::string_view cell = trimmed(row.cells[static_cast<std::size_t>(column)]);
  if (std::isfinite(si)) {
    if (decimal_comma_) marks.take(cell, row.line);
    return si;
  }
  throw InputError({file_, row.line},
                   columns_[static_cast<std::size_t>(column)].name + " " +
                       (cell.empty() ? "is empty, expected a finite number"
                                     : "is " + in_quotes(cell) +
                                           reason_of_no_number(cell, "files with commas")));
}

Unit CsvTable::unit_of(int column, std::string_view unit) const {
  TableColumn one = columns_[static_cast<std::size_t>(column)];
  take_unit_of_name(one, std::string(unit));
  return unit_of_column(one, std::string(unit), {file_, one.unit_line});
}

void CsvTable::for_blocks(
    const std::vector<Wanted>& wanted,
    int most,
    const std::function<void(std::vector<std::vector<double>>&)>& block) const {
  std::vector<std::string> needed;
  for (const Wanted& one : wanted) needed.push_back(one.column);
  expect_columns(needed);
  std::vector<int> places;
  std::vector<Unit> units;
  for (const Wanted& one : wanted) {
    places.push_back(index(one.column));
    units.push_back(unit_of(places.back(), one.unit));
  }
  DecimalMarks marks(file_);
  std::vector<std::vector<double>> values(wanted.size());
  const auto expected = static_cast<std::size_t>(std::min(most, rows_));
  for (auto& column : values) column.reserve(expected);
  CsvFields fields = data();
  CsvFields::Row row;
  for (int i = 0; i < rows_; ++i) {
    fields.next(row);
    for (std::size_t k = 0; k < places.size(); ++k)
      values[k].push_back(number(row, places[k], units[k], marks));
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

CsvTable::Gaps CsvTable::numbers_and_gaps(const std::vector<Wanted>& wanted) const {
  std::vector<int> places;
  std::vector<Unit> units;
  for (const Wanted& one : wanted) {
    places.push_back(index(one.column));
    units.push_back(one.unit.empty() ? Unit::of("1") : unit_of(places.back(), one.unit));
  }
  Gaps gaps{std::vector<std::vector<double>>(wanted.size()), {}, {}};
  gaps.texts.resize(wanted.size());
  for (auto& column : gaps.values) column.reserve(static_cast<std::size_t>(rows_));
  std::vector<bool> has_number(wanted.size(), false);
  DecimalMarks marks(file_);
  CsvFields fields = data();
  CsvFields::Row row;
  for (int i = 0; i < rows_ && fields.next(row); ++i) {
    gaps.lines.push_back(row.line);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double value = number_or_gap(row, places[k], units[k]);
      gaps.values[k].push_back(value);
      const std::string_view cell = trimmed(row.cells[static_cast<std::size_t>(places[k])]);
      if (std::isfinite(value)) {
        has_number[k] = true;
        if (decimal_comma_) marks.take(cell, row.line);
      } else if (gaps.texts[k].empty() && !parse_number(cell) && !is_gap_word(cell)) {
        gaps.texts[k] = fmt::format("is {} in line {}{}",
                                    in_quotes(cell),
                                    row.line,
                                    reason_of_no_number(cell, "files with commas"));
      }
    }
  }
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (!has_number[k] && wanted[k].unit.empty()) gaps.texts[k].clear();
  return gaps;
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
  CsvFields fields = data();  // must outlive the cells, which refer to it
  return std::string(row_of(fields, wanted).cells[at]);
}

Channels CsvTable::channels() const {
  std::vector<Wanted> wanted;
  for (TableColumn column : columns_) {
    const auto known = recognized(column.name);  // a name such as "SA_deg" states the unit
    if (known && column.unit.empty()) take_unit_of_name(column, std::string(known->meaning->unit));
    const Unit unit = unit_of_column(column, "", {file_, column.unit_line});
    wanted.push_back({column.name, si_unit(unit.dimension())});
  }
  auto values = numbers(wanted);
  Channels channels;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    channels.add({wanted[i].column, wanted[i].unit, std::move(values[i])});
  return channels;
}

void CsvTable::expect_only(const std::vector<std::string>& known) const {
  for (const TableColumn& column : columns_)
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
  // bytes; estimate of the length of a cell, for reserving memory
  constexpr std::size_t kUsualCell = 18;
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
      // The sum with 0.0 turns -0 into 0.
      if (row < values.size()) written[i].append_exact_number(0.0 + values[row], text);
    }
    text += '\n';
  }
  return text;
}

std::string csv_text(const Channels& channels, const std::vector<std::string>& units) {
  return csv_header(channels, units) + csv_rows(channels, units);
}

}  // namespace latsch::formats
