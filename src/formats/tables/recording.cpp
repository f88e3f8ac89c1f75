// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/file.h"
#include "base/text.h"
#include "base/units.h"
#include "formats/tables/csv_header.h"
#include "formats/tables/lab_table.h"
#include "formats/tables/mat_file.h"
#include "formats/tables/tydex_file.h"
#include "formats/text/csv_fields.h"
#include "formats/text/cut_end.h"
#include "formats/text/file_marks.h"
#include "formats/text/letter_case.h"
#include "formats/text/text_encoding.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLargestRecording = std::size_t{2} << 30;  // bytes

struct Column {
  TableColumn source;
  Unit read = Unit::of("1");
  bool is_si = true;       // no conversion
  std::string fault = {};  // error of the unit for which the column is left out
  std::vector<double> values = {};
};

/// Returns the columns. Units that the caller states apply to columns without a unit in the file.
std::vector<Column> columns_of(const CsvHeader& header,
                               const std::map<std::string, std::string>& units,
                               const std::string& file) {
  std::vector<Column> columns;
  for (TableColumn source : header.columns) {
    const auto stated = units.find(source.name);
    if (stated != units.end()) take_stated_unit(source, stated->second, {file, source.unit_line});
    const std::string fault = fault_of_unit(source, "");
    if (!fault.empty() && stated == units.end()) {
      columns.push_back({std::move(source)});
      columns.back().fault = fault;
      continue;
    }
    const Unit unit = unit_of_column(source, "", {file, source.unit_line});
    const bool is_si = unit.to_si(0.0L) == 0.0 && unit.to_si(1.0L) == 1.0;
    columns.push_back({std::move(source), unit, is_si});
  }
  return columns;
}

/// Returns the whole cell as a number; NaN if it is none.
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
  const std::string reason = reason_of_no_number(cell, "files with commas");
  const bool is_gap = is_gap_word(cell) || parse_number(cell);
  throw InputError(
      place,
      column.source.name + (cell.empty() ? " is empty" : " is " + in_quotes(cell)) +
          (is_gap ? ", expected a finite number: fill the gap or cut the file there" : reason));
}

void take_row(const CsvFields::Row& row,
              bool decimal_comma,
              const std::string& file,
              std::vector<Column>& columns,
              DecimalMarks& marks,
              std::string& scratch) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!columns[i].fault.empty()) continue;
    double value = number(row.cells[i], decimal_comma, scratch);
    if (!columns[i].is_si) value = columns[i].read.to_si(value);
    if (!std::isfinite(value)) no_number(columns[i], row.cells[i], {file, row.line});
    if (decimal_comma) marks.take(row.cells[i], row.line);
    columns[i].values.push_back(value);
  }
}

Recording parse(std::shared_ptr<const MappedFile> source,
                const std::string& file,
                const std::map<std::string, std::string>& units) {
  const std::size_t size = source->text().size();
  const std::shared_ptr<const MappedFile> text = utf8_file(std::move(source), file);
  CsvFields fields(text, file);
  const bool decimal_comma = fields.separator() != ',';
  const CsvHeader header = read_csv_header(fields, file);
  std::vector<Column> columns = columns_of(header, units, file);
  // estimated length of a cell, bytes, from which the number of rows is estimated so that vectors
  // are allocated once
  constexpr std::size_t kUsualCell = 9;
  for (Column& column : columns) column.values.reserve(size / (kUsualCell * columns.size()));
  DecimalMarks marks(file);
  std::string scratch;
  Recording recording;
  const auto lacks_line_end = [&] {
    return CutEnd::lacks_line_end(text->text(), fields.mark().at);
  };
  CsvFields::Row row;
  CutEnd end;
  while (fields.next(row)) {
    // a recording has no gaps, so an empty cell at the end of the text is the beginning of one
    if (lacks_line_end() && (row.cells.size() < columns.size() || row.cells.back().empty())) {
      recording.doubts.push_back(doubt_of_cut_row({file, row.line}));
      break;
    }
    if (row.cells.size() != columns.size())
      throw InputError({file, row.line},
                       wrong_number_of_fields(row.cells.size(), header, fields.separator()));
    take_row(row, decimal_comma, file, columns, marks, scratch);
    end.take(row.cells.back());
  }
  if (recording.doubts.empty() && lacks_line_end() && end.is_shortened())
    recording.doubts.push_back(doubt_of_cut_number({file, row.line}));
  recording.header_line = header.columns.front().unit_line;
  for (Column& column : columns) {
    if (!column.fault.empty()) {
      recording.left_out[column.source.name] = column.fault;
      continue;
    }
    recording.channels.add(
        {column.source.name, si_unit(column.read.dimension()), std::move(column.values)});
    recording.columns.push_back(std::move(column.source));
  }
  return recording;
}

/// Returns the channels; throws for the first column that was left out, and for a file that was not
/// read whole.
Channels whole(Recording recording, const std::string& file) {
  if (!recording.doubts.empty())
    throw InputError(recording.doubts.front().place, recording.doubts.front().sentence);
  if (!recording.left_out.empty())
    throw InputError({file, recording.header_line}, recording.left_out.begin()->second);
  return std::move(recording.channels);
}

/// Converts a table of a laboratory to a recording. Throws if the table has gaps, which a recording
/// must not have.
Recording recording_of(LabTable table) {
  for (const Channel& channel : table.channels.all())
    for (std::size_t i = 0; i < channel.values.size(); ++i)
      if (!std::isfinite(channel.values[i]))
        throw InputError(table.place(i),
                         fmt::format("{} is no finite number at sample {}, expected a recording "
                                     "without gaps",
                                     channel.name,
                                     i + 1));
  // the reasons of recorders' files follow the name of the channel
  for (auto& [name, why] : table.left_out)
    if (why.find(name) == std::string::npos) why = in_quotes(name) + " " + why;
  const int units = table.columns.empty() ? 0 : table.columns.front().unit_line;
  return {std::move(table.channels),
          std::move(table.columns),
          std::move(table.left_out),
          units,
          std::move(table.doubts),
          std::move(table.assumed_struct),
          std::move(table.structs)};
}

}  // namespace

Channels parse_recording(std::string text, const std::string& file) {
  return whole(parse(std::make_shared<const MappedFile>(std::move(text)), file, {}), file);
}

Channels read_recording(const std::filesystem::path& file,
                        const std::map<std::string, std::string>& units) {
  return whole(read_whole_recording(file, units), file.string());
}

Recording read_whole_recording(const std::filesystem::path& file,
                               const std::map<std::string, std::string>& units,
                               const std::string& group,
                               double resampled) {
  expect_content_of_ending(file);
  const std::string ending = lower(file.extension().string());
  if (!group.empty() || resampled > 0.0)
    return recording_of(read_lab_table(file, units, {}, group, resampled));
  if (ending == ".tdx" || ending == ".tydex" || ending == ".tda" || ending == ".tdb") {
    TydexFile tydex = TydexFile::read(file);
    Recording recording{tydex.channels, {}, tydex.left_out};
    for (std::size_t i = 0; i < tydex.descriptions.size(); ++i) {
      TableColumn column{.name = tydex.channels.all()[i].name, .unit = tydex.descriptions[i].unit};
      column.title = column.name;
      column.line = column.unit_line = tydex.descriptions[i].line;
      column.place = static_cast<int>(i + 1);
      recording.columns.push_back(std::move(column));
    }
    return recording;
  }
  if (ending == ".mat") {
    auto named = MatFile::read(file).named_channels(units);
    return {std::move(named.channels), std::move(named.columns), std::move(named.left_out)};
  }
  if (ending == ".csv" || ending == ".txt")
    return parse(std::make_shared<const MappedFile>(file, kLargestRecording), file.string(), units);
  return recording_of(read_lab_table(file, units));
}

}  // namespace latsch::formats
