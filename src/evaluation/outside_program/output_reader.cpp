// SPDX-License-Identifier: Apache-2.0
#include "evaluation/outside_program/output_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>
#include <sstream>

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "base/units.h"
#include "formats/tables/csv_table.h"
#include "formats/tables/tydex_file.h"
#include "formats/text/fortran_number.h"

namespace latsch {
namespace {

// Longest line that a pattern is applied to, characters. The limit is needed because std::regex
// uses stack in proportion to the length.
constexpr std::size_t kLongestLine = 4096;

const char* word_for(OutputReader::Kind kind) {
  switch (kind) {
    case OutputReader::Kind::table:
      return "table";
    case OutputReader::Kind::columns:
      return "columns";
    case OutputReader::Kind::keys:
      return "keys";
    case OutputReader::Kind::pattern:
      return "pattern";
    case OutputReader::Kind::tydex:
      return "tydex";
  }
  return "";
}

/// Returns the number that a text is, with an exponent behind E or, as Fortran prints it, D.
std::optional<double> number_of(std::string_view text) {
  const auto number = parse_number(text);
  return number ? number : formats::parse_fortran_number(text);
}

/// Returns the first field between blanks, tabs or semicolons that is written as "10,5" and may be
/// one number; empty if there is none. If it is the only field of the line, it may be one number
/// unless `is_comma_between` says that commas separate the columns.
std::string decimal_comma(const std::string& line, bool is_comma_between) {
  static const std::regex kWithComma(R"([+-]?\d+,\d+(?:[eEdD][+-]?\d+)?)");
  std::string found, field;
  int fields = 0;
  for (const char c : line + ' ') {
    if (std::string_view(" \t;").find(c) == std::string_view::npos) {
      field += c;
    } else if (!field.empty()) {
      ++fields;
      if (found.empty() && std::regex_match(field, kWithComma)) found = field;
      field.clear();
    }
  }
  return fields > 1 || !is_comma_between ? found : "";
}

/// Reads one output file. The first error ends the reading.
class Reading {
 public:
  Reading(const OutputReader& reader, std::string text) : reader_(reader), text_(std::move(text)) {
    values_.resize(reader.quantities.size());
  }

  Result<std::vector<Channel>> run() {
    switch (reader_.kind) {
      case OutputReader::Kind::table:
        return from_table();
      case OutputReader::Kind::tydex:
        return from_tydex();
      case OutputReader::Kind::columns:
        each_line([&](int line, const std::string& words) { return take_row(line, words); });
        break;
      case OutputReader::Kind::keys:
        each_line([&](int line, const std::string& words) { return take_key(line, words); });
        break;
      case OutputReader::Kind::pattern:
        take_matches();
        break;
    }
    if (!read_) return read_.failure();
    return channels();
  }

 private:
  Failure wrong(const std::string& what, int line = 0) const {
    return {fmt::format("output \"{}\" ({}): {}{} {}",
                        reader_.name,
                        word_for(reader_.kind),
                        reader_.file.string(),
                        line > 0 ? fmt::format(":{}", line) : "",
                        what),
            Cause::bad_output};
  }

  template <class Action>
  void each_line(Action&& action) {
    std::istringstream lines(text_);
    std::string line;
    for (int number = 1; read_.ok() && std::getline(lines, line); ++number) {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      read_ = action(number, line);
    }
  }

  Status add(std::size_t quantity, double number, int line) {
    if (!std::isfinite(number)) {
      return wrong(
          fmt::format(
              "has {} for {}, expected a finite number", number, reader_.quantities[quantity].name),
          line);
    }
    values_[quantity].push_back(Unit::of(reader_.quantities[quantity].unit).to_si(number));
    return {};
  }

  Status take_row(int number, const std::string& line) {
    std::vector<std::string> cells;
    std::string cell;
    for (const char c : line + ' ') {
      if (std::string_view(" \t,;").find(c) == std::string_view::npos) {
        cell += c;
      } else if (!cell.empty()) {
        cells.push_back(std::exchange(cell, {}));
      }
    }
    if (cells.empty() || cells.front().starts_with('#')) return {};
    std::vector<double> row;
    for (const int column : reader_.columns) {
      const auto value = column <= std::ssize(cells) ? number_of(cells[column - 1]) : std::nullopt;
      if (value) row.push_back(*value);
    }
    if (row.size() == reader_.columns.size()) {
      const bool wants_first_alone = reader_.columns.size() == 1 && reader_.columns.front() == 1;
      if (const std::string field = decimal_comma(line, !wants_first_alone || has_header_);
          !field.empty())
        return wrong(fmt::format("has {}, where the comma may be a decimal point or separate two "
                                 "numbers; expected decimal points, or one separator in the line",
                                 in_quotes(field)),
                     number);
      for (std::size_t i = 0; i < row.size(); ++i) {
        if (const Status done = add(i, row[i], number); !done) return done;
      }
      return {};
    }
    if (values_.front().empty()) {
      has_header_ = has_header_ || line.find(',') != line.npos;
      return {};
    }
    return wrong(fmt::format("is {}, expected numbers in columns {}",
                             in_quotes(line),
                             fmt::join(reader_.columns, ", ")),
                 number);
  }

  Status take_key(int number, const std::string& line) {
    const std::size_t middle = line.find_first_of("=:");
    if (middle == std::string::npos) return {};
    const std::string_view key = trimmed(std::string_view(line).substr(0, middle));
    const std::string_view value = trimmed(std::string_view(line).substr(middle + 1));
    for (std::size_t i = 0; i < reader_.keys.size(); ++i) {
      if (key != reader_.keys[i]) continue;
      const auto parsed = number_of(value);
      if (!parsed) {
        return wrong(
            fmt::format("has {} for {}, expected a number", in_quotes(value), reader_.keys[i]),
            number);
      }
      if (const Status done = add(i, *parsed, number); !done) return done;
    }
    return {};
  }

  void take_matches() {
    const std::regex pattern(reader_.pattern);
    bool there = reader_.after.empty();
    each_line([&](int number, const std::string& line) -> Status {
      if (!there) {
        there = line.find(reader_.after) != std::string::npos;
        return {};
      }
      std::smatch groups;
      if (line.size() > kLongestLine || !std::regex_search(line, groups, pattern)) {
        return {};
      }
      for (std::size_t i = 0; i < values_.size(); ++i) {
        const auto value = number_of(groups[i + 1].str());
        if (!value) {
          return wrong(fmt::format("has {} for {}, expected a number",
                                   in_quotes(groups[i + 1].str()),
                                   reader_.quantities[i].name),
                       number);
        }
        if (const Status done = add(i, *value, number); !done) return done;
      }
      return {};
    });
    if (read_.ok() && !there) read_ = wrong("has no line with " + in_quotes(reader_.after));
  }

  Result<std::vector<Channel>> from_table() {
    try {
      const auto table = formats::CsvTable::parse(text_, reader_.file.string());
      for (std::size_t i = 0; i < values_.size(); ++i) {
        values_[i] = table.numbers(reader_.quantities[i].name, reader_.quantities[i].unit);
      }
    } catch (const InputError& error) {
      return Failure{fmt::format("output \"{}\" (table): {}", reader_.name, error.what()),
                     Cause::bad_output};
    }
    return channels();
  }

  Result<std::vector<Channel>> from_tydex() {
    try {
      const auto file = formats::TydexFile::parse(std::move(text_), reader_.file.string());
      for (std::size_t i = 0; i < values_.size(); ++i) {
        const auto& [name, unit] = reader_.quantities[i];
        const Channel* channel = file.channels.find(name);
        if (!channel) {
          values_[i].push_back(file.constant(name, unit));
          continue;
        }
        if (!Unit::of(channel->unit).same_dimension(Unit::of(unit))) {
          return wrong(fmt::format("has {} in {}, expected {}", name, channel->unit, unit));
        }
        values_[i] = channel->values;
        const auto gap = std::find_if_not(values_[i].begin(), values_[i].end(), [](double value) {
          return std::isfinite(value);
        });
        if (gap != values_[i].end()) {
          return wrong(fmt::format("has no number for {}", name),
                       file.lines[gap - values_[i].begin()]);
        }
      }
    } catch (const InputError& error) {
      return Failure{fmt::format("output \"{}\" (tydex): {}", reader_.name, error.what()),
                     Cause::bad_output};
    }
    return channels();
  }

  Result<std::vector<Channel>> channels() const {
    std::vector<Channel> channels;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const std::string& quantity = reader_.quantities[i].name;
      const long found = std::ssize(values_[i]);
      if (found == 0) return wrong("holds no value of " + quantity);
      if (reader_.samples > 0 && found != reader_.samples) {
        return wrong(
            fmt::format("holds {} values of {}, expected {}", found, quantity, reader_.samples));
      }
      const Unit unit = Unit::of(reader_.quantities[i].unit);
      channels.push_back({reader_.name + "/" + quantity, si_unit(unit.dimension()), values_[i]});
    }
    return channels;
  }

  const OutputReader& reader_;
  std::string text_;
  std::vector<std::vector<double>> values_;  // values in SI, for each quantity
  bool has_header_ = false;                  // a line of names with commas was seen
  Status read_;                              // a Failure once an error has ended the reading
};

}  // namespace

Result<std::vector<Channel>> read_output(const OutputReader& reader,
                                         const std::filesystem::path& folder) {
  const auto file = folder / reader.file;
  if (!std::filesystem::exists(file)) {
    return Failure{
        fmt::format(
            "output \"{}\": the program wrote no file {}", reader.name, reader.file.string()),
        Cause::bad_output};
  }
  try {
    return Reading(reader, read_text_file(file)).run();
  } catch (const InputError& error) {
    return Failure{fmt::format("output \"{}\": {}", reader.name, error.what()), Cause::bad_output};
  }
}

}  // namespace latsch
