// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/lab_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/mapped_file.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "base/utf8.h"
#include "formats/recorders/recorded_file.h"
#include "formats/tables/csv_table.h"
#include "formats/tables/lab_columns.h"
#include "formats/tables/mat_file.h"
#include "formats/tables/mat_runs.h"
#include "formats/tables/recorder_table.h"
#include "formats/tables/tydex_file.h"
#include "formats/text/cut_end.h"
#include "formats/text/file_marks.h"
#include "formats/text/fortran_number.h"
#include "formats/text/letter_case.h"
#include "formats/text/text_encoding.h"
#include "measurement/meaning/channel_words.h"
#include "measurement/meaning/natural_unit.h"

namespace latsch::formats {
namespace {

using Units = std::map<std::string, std::string>;

constexpr std::size_t kMostColumns = 10000;                    // most columns of a .dat
constexpr std::size_t kLargestLabFile = std::size_t{1} << 30;  // bytes

LabTable table_of(const std::filesystem::path& file) {
  LabTable table;
  table.file = file.string();
  table.header = {table.file, 0};
  return table;
}

/// Throws InputError if a part is stated for a file whose channels have no paths.
void expect_no_part(const std::filesystem::path& file, const std::string& part) {
  if (!part.empty())
    throw InputError({file.string(), 0},
                     "has no structs, but struct = " + in_quotes(part) +
                         " is stated; expected a .mat, or a .csv with columns such as " +
                         in_quotes(part + ".Fz"));
}

/// Returns the table. If the file is cut off within its last row, that row is left out and a doubt
/// says so.
CsvTable recorded_csv(const std::filesystem::path& file, std::vector<LedgerDoubt>& doubts) {
  const auto source = std::make_shared<const MappedFile>(file, kLargestLabFile);
  try {
    CsvTable table = CsvTable::parse(source, file.string());
    if (const std::string_view text = source->text(); ends_within_number(text)) {
      const auto line = std::count(text.begin(), text.end(), '\n') + 1;
      doubts.push_back(doubt_of_cut_number({file.string(), static_cast<int>(line)}));
    }
    return table;
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find(kCutWithin) == std::string_view::npos) throw;
    doubts.push_back(doubt_of_cut_row(error.place()));
  }
  const std::string_view text = source->text();
  return CsvTable::parse(std::string(text.substr(0, text.rfind('\n') + 1)), file.string());
}

LabTable read_csv(const std::filesystem::path& file,
                  const Units& units,
                  const ExpectedUnit& expected,
                  const std::string& part) {
  LabTable table = table_of(file);
  const CsvTable csv = recorded_csv(file, table.doubts);
  std::vector<CsvTable::Wanted> wanted;
  std::vector<LabColumn> columns;
  for (TableColumn source : csv.header()) {
    const std::string in_file = source.name;
    if (!part.empty() && !in_file.starts_with(part + ".")) continue;
    if (!part.empty()) source.name.erase(0, part.size() + 1);
    take_minus_of_name(source);
    if (expected && !units.contains(source.name)) take_unit_of_name(source, expected(source.name));
    const std::string known = expected && !source.unit.empty() ? expected(source.name) : "";
    const bool is_si = !source.unit.empty() && fault_of_unit(source, known).empty();
    // The decimal digits are converted in one step, so that the result is exact to the last bit.
    std::string si = known;
    if (is_si && si.empty()) si = si_unit(reading_of_unit(source.unit).unit->dimension());
    wanted.push_back({in_file, is_si ? si : ""});
    columns.push_back({source, {}, is_si});
  }
  if (columns.empty())
    throw InputError(csv.header_place(),
                     "has no column that begins with " + in_quotes(part + ".") +
                         " (columns: " + list_of(csv.columns()) + ")");
  CsvTable::Gaps gaps = csv.numbers_and_gaps(wanted);
  table.lines = std::move(gaps.lines);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    columns[k].values = std::move(gaps.values[k]);
    columns[k].fault = std::move(gaps.texts[k]);
  }
  add_columns(std::move(columns), units, expected, csv.header_place(), table);
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

/// True for names that test consortia use. They distinguish a line of names from a line about the
/// run.
bool is_usual_name(std::string_view word) {
  static constexpr std::array<std::string_view, 22> kNames = {
      "ET", "V",  "N",   "SA",  "IA",  "RL",   "RE",   "P",    "FX",     "FY", "FZ",
      "MX", "MZ", "NFX", "NFY", "RST", "TSTI", "TSTC", "TSTO", "AMBTMP", "SR", "SL"};
  return std::find(kNames.begin(), kNames.end(), capitals(word)) != kNames.end();
}

std::size_t count_units(const std::vector<std::string_view>& fields) {
  return static_cast<std::size_t>(std::count_if(
      fields.begin(), fields.end(), [](std::string_view f) { return looks_like_unit(f); }));
}

/// True if the last line before the numbers contains units of the `names` above it.
bool holds_units(const std::vector<std::string_view>& names,
                 const std::vector<std::string_view>& units) {
  if (names.size() != units.size()) return false;
  const auto named = std::count_if(names.begin(), names.end(), is_usual_name);
  const auto blank = std::count(units.begin(), units.end(), "");
  const std::size_t words = units.size() - static_cast<std::size_t>(blank);
  return words > 0 &&
         (2 * count_units(units) >= words || 2 * static_cast<std::size_t>(named) >= names.size());
}

std::vector<LabColumn> columns_named(const std::vector<std::string_view>& names,
                                     const Line& line,
                                     bool tabs) {
  std::vector<LabColumn> columns;
  for (const std::string_view name : names) {
    LabColumn column{column_of_title(name)};
    column.source.line = column.source.unit_line = line.number;
    column.source.unit_place = tabs ? UnitPlace::title : UnitPlace::title_without_blanks;
    column.source.place = static_cast<int>(columns.size() + 1);
    columns.push_back(std::move(column));
  }
  return columns;
}

/// Finds the line of names and the line of units below it, if any: the last lines before the
/// numbers.
std::vector<LabColumn> header_of(const std::vector<Line>& before, bool tabs) {
  const Line& last = before.back();
  if (before.size() > 1) {
    const Line& names = before[before.size() - 2];
    std::vector<LabColumn> columns =
        columns_named(fields_of(trimmed(names.text), tabs), names, tabs);
    // The last channels may be plain numbers without unit, for which the line of units has blank
    // fields.
    auto units = fields_of(last.text, tabs);
    while (tabs && units.size() < columns.size()) units.emplace_back();
    while (units.size() > columns.size() && units.back().empty()) units.pop_back();
    if (holds_units(fields_of(trimmed(names.text), tabs), units)) {
      for (std::size_t k = 0; k < units.size(); ++k) {
        columns[k].source.unit = units[k];
        columns[k].source.unit_line = last.number;
        columns[k].source.unit_place = UnitPlace::row_below;
      }
      return columns;
    }
  }
  return columns_named(fields_of(trimmed(last.text), tabs), last, tabs);
}

/// True if the line begins with a number. "1" is also the unit of plain numbers; the line is then
/// one of units if other units follow.
bool begins_with_number(const Line& line) {
  const auto fields = fields_of(trimmed(line.text), false);
  if (parse_fortran_number(fields.front())) return true;
  if (!parse_number(fields.front())) return false;
  return fields.front() != "1" || std::none_of(fields.begin(), fields.end(), [](auto field) {
           return !parse_number(field) && !is_gap_word(field) && looks_like_unit(field);
         });
}

/// Throws InputError that states why no line begins with a number.
[[noreturn]] void no_line_of_numbers(const std::vector<Line>& lines, const std::string& file) {
  for (const Line& line : lines) {
    const auto first = trimmed(fields_of(trimmed(line.text), false).front());
    const bool separated = first.find(',') != first.npos || first.find(';') != first.npos;
    if (!separated || first.find_first_of("0123456789") == first.npos) continue;
    throw InputError({file, line.number},
                     "begins with " + in_quotes(first) +
                         ", expected a number: decimal commas are not read in a .dat, and numbers "
                         "with commas or semicolons between them make a .csv");
  }
  throw InputError({file, 0}, "has no line of numbers");
}

/// Returns the number in a cell of a .dat, or NaN for a gap; throws if the cell is neither.
double cell_of_dat(std::string_view field, const LabColumn& column, const Place& place) {
  if (const auto number = parse_number(field))
    return std::isfinite(*number) ? *number : std::nan("");
  if (is_gap_word(field)) return std::nan("");
  if (const auto number = parse_fortran_number(field); number && std::isfinite(*number))
    return *number;
  throw InputError(
      place, column.source.name + " is " + in_quotes(field) + reason_of_no_number(field, "a .dat"));
}

LabTable read_dat(const std::filesystem::path& file,
                  const Units& stated,
                  const ExpectedUnit& expected,
                  const std::string& part) {
  expect_no_part(file, part);
  const std::string text = utf8_text(read_settled_file(file, kLargestLabFile), file.string());
  const std::vector<Line> lines = lines_of(text);
  if (lines.empty()) throw InputError({file.string(), 0}, "is empty, expected a line of names");
  const auto numbers = std::find_if(lines.begin(), lines.end(), begins_with_number);
  if (numbers == lines.end()) no_line_of_numbers(lines, file.string());
  if (numbers == lines.begin())
    throw InputError({file.string(), 0}, "begins with numbers, expected names before them");
  const std::vector<Line> before(lines.begin(), numbers);
  const bool tabs = before.back().text.find('\t') != std::string_view::npos;
  LabTable table = table_of(file);
  for (const Line& line : before)
    if (fields_of(line.text, tabs).size() > kMostColumns)
      throw InputError({table.file, line.number},
                       fmt::format("has more than {} columns", kMostColumns));
  std::vector<LabColumn> columns = header_of(before, tabs);
  const bool has_line_end = text.back() == '\n';
  CutEnd end;
  for (auto line = numbers; line != lines.end(); ++line) {
    const auto fields = fields_of(line->text, tabs);
    const bool ends_in_tab = fields.size() == columns.size() + 1 && fields.back().empty();
    if (fields.size() < columns.size() && line + 1 == lines.end() && !has_line_end &&
        line != numbers) {
      table.doubts.push_back(doubt_of_cut_row({table.file, line->number}));
      break;
    }
    if (fields.size() != columns.size() && !ends_in_tab)
      throw InputError({table.file, line->number},
                       fmt::format("has {} {}, expected {} as in the line of names",
                                   fields.size(),
                                   fields.size() == 1 ? "field" : "fields",
                                   columns.size()));
    table.lines.push_back(line->number);
    for (std::size_t k = 0; k < columns.size(); ++k)
      columns[k].values.push_back(cell_of_dat(fields[k], columns[k], {table.file, line->number}));
    end.take(fields[columns.size() - 1]);
  }
  if (table.doubts.empty() && !has_line_end && end.is_shortened())
    table.doubts.push_back(doubt_of_cut_number({table.file, lines.back().number}));
  const int header = columns.front().source.line;
  add_columns(std::move(columns), stated, expected, {table.file, header}, table);
  return table;
}

/// Returns the number of samples of a recording: the length of the vectors whose names the caller
/// states, if any, else of those with a known name, else of the first vector. Throws InputError if
/// these lengths differ.
std::size_t samples_of(const MatFile::Named& vectors, const std::string& file, const Units& units) {
  const auto counts = [&](const std::string& name) {
    return units.empty() ? recognized(name).has_value() : units.contains(name);
  };
  const Channel* first = nullptr;
  for (const Channel& channel : vectors.channels.all()) {
    if (!counts(channel.name)) continue;
    if (!first) first = &channel;
    if (channel.values.size() != first->values.size())
      throw InputError(
          {file, 0},
          fmt::format("{} has {} values and {} has {}: vectors of one recording have the same "
                      "length; correct the file, or state only those of one length in columns",
                      in_quotes(first->name),
                      first->values.size(),
                      in_quotes(channel.name),
                      channel.values.size()));
  }
  return (first ? *first : vectors.channels.all().front()).values.size();
}

/// Returns the channels of one struct of a MAT file: the stated struct, or the only one with known
/// channels. Returns the whole file if `units` contains whole paths of channels.
MatFile part_of(MatFile mat, const Units& units, const std::string& part, LabTable& table) {
  if (!part.empty()) return run_of(mat, part);
  const std::vector<std::string> runs = runs_in(mat);
  const bool is_by_path = std::any_of(units.begin(), units.end(), [&](const auto& one) {
    return std::any_of(runs.begin(), runs.end(), [&](const std::string& run) {
      return !run.empty() && one.first.starts_with(run + ".");
    });
  });
  if (is_by_path || std::find(runs.begin(), runs.end(), "") != runs.end()) return mat;
  if (runs.size() > 1) table.structs = runs;
  if (runs.size() != 1) return mat;
  table.assumed_struct = runs.front();
  return run_of(mat, runs.front());
}

LabTable read_mat(const std::filesystem::path& file,
                  const Units& units,
                  const ExpectedUnit& expected,
                  const std::string& part) {
  LabTable table = table_of(file);
  MatFile mat = part_of(MatFile::read(file), units, part, table);
  const auto constants = spread_constants(units, mat);
  MatFile::Named vectors = mat.named_channels(units, expected);
  const std::size_t samples = samples_of(vectors, table.file, units);
  table.left_columns = std::move(vectors.left_columns);
  table.left_out = std::move(vectors.left_out);
  for (std::size_t k = 0; k < vectors.columns.size(); ++k) {
    TableColumn& column = vectors.columns[k];
    const Channel& channel = vectors.channels.all()[k];
    if (channel.values.size() != samples) {
      table.left_out[column.name] = fmt::format(
          "has {} values, but the recording {} samples", channel.values.size(), samples);
      table.left_columns.push_back(std::move(column));
      continue;
    }
    if (constants.contains(column.name) && column.assumed.empty())
      column.assumed = "one number for all samples";
    table.channels.add(channel);
    table.units.push_back(column.unit);
    table.columns.push_back(std::move(column));
  }
  for (const MatVariable& variable : mat.variables) {
    if (variable.is_text || variable.values.size() != 1) continue;
    const auto known = recognized(variable.name);
    if (!known || table.channels.find(variable.name)) continue;
    const auto there =
        std::find_if(table.columns.begin(), table.columns.end(), [&](const TableColumn& column) {
          return same_channel(column.name, variable.name);
        });
    const std::string unit = natural_unit(known->meaning->unit);
    table.left_out[variable.name] =
        fmt::format("is a single number, {:g}", variable.values.front()) +
        (there != table.columns.end()
             ? "; the vector " + in_quotes(there->name) + " is used"
             : fmt::format(", without a unit: columns = {{{} = {}}} makes it a channel",
                           known->channel,
                           in_quotes(variable.name + (unit == "1" ? "" : " [" + unit + "]"))));
    table.left_columns.push_back({.name = variable.name, .title = variable.name});
  }
  return table;
}

/// Drops a constant for which the file also has a channel, and adds a doubt if the two contradict
/// each other.
void leave_out_constant(const TydexFile::Entry& constant, const Channel& channel, LabTable& table) {
  double low = INFINITY, high = -INFINITY;
  for (const double value : channel.values) {
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  constexpr double kRounding = 1e-6;
  const double slack = kRounding * std::max(std::abs(low), std::abs(high));
  const bool fits = constant.si_unit == channel.unit && *constant.number >= low - slack &&
                    *constant.number <= high + slack;
  const std::string name = constant.name + " of **CONSTANTS";
  const std::string range = low <= high ? fmt::format(" goes from {} to {}",
                                                      format_quantity(low, channel.unit, 4),
                                                      format_quantity(high, channel.unit, 4))
                                        : std::string(" has no values");
  table.left_out[name] = fits ? "is not used: the channel of that name is"
                              : fmt::format("is {} {}, but the channel {}{}: the channel is used",
                                            constant.text,
                                            constant.unit,
                                            constant.name,
                                            range);
  TableColumn source{.name = name, .unit = constant.unit, .title = name};
  source.line = source.unit_line = constant.line;
  source.unit_place = UnitPlace::field;
  table.left_columns.push_back(std::move(source));
}

LabTable read_tydex(const std::filesystem::path& file,
                    const Units& units,
                    const ExpectedUnit& expected,
                    const std::string& part) {
  expect_no_part(file, part);
  TydexFile tydex = TydexFile::read(file);
  LabTable table = table_of(file);
  table.lines = std::move(tydex.lines);
  table.doubts = std::move(tydex.doubts);
  for (const auto& [name, why] : tydex.left_out) {
    const auto& [line, unit] = tydex.left_units.at(name);
    if (units.contains(name) || (expected && !expected(name).empty()))
      throw InputError({table.file, line}, name + " " + why);
    table.left_out[name] = why;
    TableColumn source{.name = name, .unit = unit, .title = name};
    source.line = source.unit_line = line;
    source.unit_place = UnitPlace::field;
    table.left_columns.push_back(std::move(source));
  }
  std::vector<LabColumn> columns;
  const auto add =
      [&](const std::string& name, const std::string& unit, int line, std::vector<double> values) {
        TableColumn source{.name = name, .unit = unit, .title = name};
        source.line = source.unit_line = line;
        source.place = static_cast<int>(columns.size() + 1);
        source.unit_place = UnitPlace::field;
        columns.push_back({std::move(source), std::move(values), true});
      };
  for (std::size_t k = 0; k < tydex.descriptions.size(); ++k) {
    const auto& about = tydex.descriptions[k];
    const Channel& channel = tydex.channels.all()[k];
    add(channel.name, about.unit, about.line, channel.values);
    TableColumn& source = columns.back().source;
    source.factor = about.factor;
    source.offset = about.factor * about.measured_offset + about.physical_offset;
    if (source.factor != 1.0 || source.offset != 0.0)
      source.assumed = "factor and offsets of the file are applied";
  }
  for (const TydexFile::Entry& constant : tydex.constants) {
    if (!constant.number) continue;
    if (const Channel* channel = tydex.channels.find(constant.name)) {
      leave_out_constant(constant, *channel, table);
      continue;
    }
    add(constant.name,
        constant.unit,
        constant.line,
        std::vector<double>(table.lines.size(), *constant.number));
  }
  // The values are already in SI, in the dimension that the reader of TYDEX has chosen.
  std::map<std::string, std::string> taken;
  for (const Channel& channel : tydex.channels.all()) taken[channel.name] = channel.unit;
  for (const TydexFile::Entry& constant : tydex.constants)
    taken.insert({constant.name, constant.si_unit});
  const auto in_file = [&](const std::string& name) {
    const auto unit = taken.find(name);
    return unit == taken.end() ? std::string() : unit->second;
  };
  for (LabColumn& column : columns) {
    const std::string wanted = expected ? expected(column.source.name) : std::string();
    const std::string si = in_file(column.source.name);
    if (wanted.empty() || column.source.unit.empty() ||
        Unit::of(si).same_dimension(Unit::of(wanted)))
      continue;
    column.source.unit =
        Unit::find(column.source.unit)->same_dimension(Unit::of(si)) ? column.source.unit : si;
    throw InputError({table.file, column.source.line}, fault_of_unit(column.source, wanted));
  }
  add_columns(std::move(columns), units, in_file, {table.file, 0}, table);
  return table;
}

/// Throws InputError if a step of time is stated for a file that has one time for all channels.
void expect_no_resampling(const std::filesystem::path& file, double step) {
  if (step > 0.0)
    throw InputError(
        {file.string(), 0},
        "has one time for all channels, but resample is stated, which brings groups of "
        "different rates to one time; expected " +
            list_of(recorder_endings()));
}

using LabReader = LabTable (*)(const std::filesystem::path&,
                               const Units&,
                               const ExpectedUnit&,
                               const std::string&);

/// Returns the readers with the file extensions for which they are used.
const std::vector<std::pair<std::string, LabReader>>& lab_readers() {
  static const std::vector<std::pair<std::string, LabReader>> readers = {{".csv", read_csv},
                                                                         {".txt", read_csv},
                                                                         {".dat", read_dat},
                                                                         {".mat", read_mat},
                                                                         {".tdx", read_tydex},
                                                                         {".tydex", read_tydex},
                                                                         {".tda", read_tydex},
                                                                         {".tdb", read_tydex}};
  return readers;
}

}  // namespace

Place LabTable::place(std::size_t sample) const {
  return {file, sample < lines.size() ? lines[sample] : 0};
}

LabTable read_lab_table(const std::filesystem::path& file,
                        const Units& units,
                        const ExpectedUnit& expected,
                        const std::string& part,
                        double resampled) {
  expect_content_of_ending(file);
  const std::string ending = lower(file.extension().string());
  const auto recorders = recorder_endings();
  if (std::find(recorders.begin(), recorders.end(), ending) != recorders.end())
    return recorder_table(read_recorded_file(file), units, expected, part, resampled);
  expect_no_resampling(file, resampled);
  for (const auto& [known, reader] : lab_readers()) {
    if (known != ending) continue;
    LabTable table = reader(file, units, expected, part);
    if (known != ".mat")
      table.assumed_encoding = assumed_encoding(MappedFile(file, kLargestLabFile).text());
    return table;
  }
  throw InputError({file.string(), 0},
                   "ends in " + in_quotes(ending) + ", expected " + list_of(lab_endings()));
}

std::vector<std::string> lab_endings() {
  std::vector<std::string> endings;
  for (const auto& [ending, reader] : lab_readers()) endings.push_back(ending);
  for (const std::string& ending : recorder_endings()) endings.push_back(ending);
  return endings;
}

}  // namespace latsch::formats
