// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/tydex_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/mapped_file.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "formats/text/cut_end.h"
#include "formats/text/file_marks.h"
#include "formats/text/letter_case.h"
#include "formats/text/text_encoding.h"
#include "measurement/meaning/natural_unit.h"

namespace latsch::formats {
namespace {

// largest size of a file, bytes; more than an hour of ten channels at 1 kHz
constexpr std::size_t kLargestTydex = 512u << 20;
constexpr std::size_t kMostTydexChannels = 1000;
constexpr std::size_t kNameEnd = 10, kCommentEnd = 40, kUnitEnd = 50, kField = 10;
constexpr double kNotAvailable = std::numeric_limits<double>::quiet_NaN();

const std::vector<std::string> kKeywords = {"**HEADER",
                                            "**COMMENTS",
                                            "**CONSTANTS",
                                            "**MEASURCHANNELS",
                                            "**MEASURDATA",
                                            "**MODELDEFINITION",
                                            "**MODELPARAMETERS",
                                            "**MODELCOEFFICIENTS",
                                            "**MODELCHANNELS",
                                            "**MODELOUTPUTS",
                                            "**MODELEND",
                                            "**END"};

void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  for (std::size_t at = 0;;) {
    at = line.find_first_not_of(" \t", at);
    if (at == line.npos) return;
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  split_words(line, words);
  return words;
}

/// Parses a number in C or Fortran notation, with decimal point or comma. Returns NaN if the text
/// says so, nothing if it is no number.
std::optional<long double> number_of(std::string_view text) {
  text = trimmed(text);
  if (const auto parts = split_number(text); parts && parts->rest.empty()) return parts->number;
  const std::string word = capitals(trimmed(text));
  if (word == "NOTAVAIL" || word == "NAN") return kNotAvailable;
  std::string plain(text);
  std::replace(plain.begin(), plain.end(), ',', '.');
  for (char& c : plain)
    if (c == 'D' || c == 'd') c = 'e';
  const auto parts = split_number(plain);
  if (!parts || !parts->rest.empty()) return std::nullopt;
  return parts->number;
}

class Reading {
 public:
  Reading(std::string_view text, TydexFile& result) : text_(text), file_(result) {}

  void run() {
    std::string_view line;
    while (next(line)) {
      if (line.starts_with("**")) {
        take_keyword(line);
      } else if (keyword_ == "**END") {
        if (line.starts_with('!') || trimmed(line).empty()) continue;
        if (lines_behind_end_++ == 0) first_behind_end_ = line_;
      } else if (keyword_ == "**COMMENTS") {
        file_.comments.emplace_back(trimmed(line.starts_with('!') ? line.substr(1) : line));
      } else if (!line.starts_with('!') && !trimmed(line).empty()) {
        take_line(line);
      }
    }
    if (!seen_.contains("**HEADER")) fail(0, "has no line **HEADER, expected a TYDEX file");
    if (keyword_ != "**END") {
      fail(line_, "is the end of the file, expected **END: the file is incomplete");
    }
    finish();
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const {
    throw InputError({file_.file, line}, message);
  }

  bool next(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    return true;
  }

  void take_keyword(std::string_view line) {
    const std::string word = capitals(words_of(line).front());
    if (std::find(kKeywords.begin(), kKeywords.end(), word) == kKeywords.end()) {
      fail(line_, "unknown keyword " + in_quotes(word) + did_you_mean(word, kKeywords));
    }
    if (keyword_ == "**END")
      fail(line_,
           in_quotes(word) +
               " stands behind **END, which ends the file: move **END behind the "
               "last section, or delete what follows it");
    if (word.starts_with("**MODEL")) {
      file_.model.push_back({word, {}});
    } else if (!seen_.insert(word).second) {
      fail(line_, word + " comes twice");
    }
    if (word == "**MEASURDATA" && raw_.empty()) {
      fail(line_, "has **MEASURDATA, expected the channels in **MEASURCHANNELS before them");
    }
    keyword_ = word;
    if (word == "**MEASURDATA") take_count(line);
  }

  /// Reads the number of samples if it follows the keyword.
  void take_count(std::string_view line) {
    const auto words = words_of(line);
    if (words.size() < 2) return;
    const auto count = number_of(words[1]);
    if (!count || !std::isfinite(static_cast<double>(*count))) return;
    stated_samples_ = static_cast<double>(*count);
    line_of_data_ = line_;
  }

  void take_line(std::string_view line) {
    if (keyword_.empty()) {
      fail(line_, "is " + in_quotes(line) + ", expected **HEADER as the first line");
    }
    if (keyword_ == "**HEADER") {
      add(file_.header, line);
    } else if (keyword_ == "**CONSTANTS") {
      add(file_.constants, line);
    } else if (keyword_ == "**MEASURCHANNELS") {
      take_channel(line);
    } else if (keyword_ == "**MEASURDATA") {
      take_sample(line);
    } else {
      file_.model.back().entries.push_back(entry_of(line));
    }
  }

  /// Parses an entry. If there is no value from column 51 on, the last word is the value, and the
  /// word before it may be the unit.
  TydexFile::Entry entry_of(std::string_view line) const {
    TydexFile::Entry entry;
    entry.line = line_;
    entry.name = capitals(trimmed(columns_of(line, 0, kNameEnd)));
    entry.comment = trimmed(columns_of(line, kNameEnd, kCommentEnd - kNameEnd));
    entry.unit = trimmed(columns_of(line, kCommentEnd, kUnitEnd - kCommentEnd));
    entry.text = trimmed(columns_of(line, kUnitEnd, line.size()));
    const auto words = words_of(line);
    if (entry.name.find_first_of(" \t") != entry.name.npos) entry.name = capitals(words.front());
    if (entry.text.empty() && line.find('\t') != line.npos && words.size() >= 2) {
      entry.text = words.back();
      const bool unit = words.size() >= 3 && looks_like_unit(words[words.size() - 2]);
      entry.unit = unit ? words[words.size() - 2] : std::string_view();
      entry.comment.clear();
    } else if (entry.text.empty() && number_of(entry.unit)) {
      std::swap(entry.text, entry.unit);
    }
    return entry;
  }

  void add(std::vector<TydexFile::Entry>& entries, std::string_view line) {
    TydexFile::Entry entry = entry_of(line);
    if (entry.name.empty()) {
      fail(line_, "is " + in_quotes(line) + ", expected a name in columns 1 to 10");
    }
    const auto [same, is_first] = lines_[&entries].emplace(entry.name, entry.line);
    if (!is_first)
      fail(line_, fmt::format("{} comes twice, first in line {}", entry.name, same->second));
    const auto number = number_of(entry.text);
    const TydexName* known = find_tydex_name(entry.name);
    if (known && !known->si_unit.empty() && !number && is_stated(entry.text))
      file_.doubts.push_back({entry.name,
                              "constant " + entry.name + " is " + in_quotes(entry.text) +
                                  ", expected a number: it is not used",
                              {file_.file, entry.line}});
    if (number && std::isfinite(static_cast<double>(*number)) &&
        !(known && known->si_unit.empty())) {
      if (const std::string fault = fault_of_own(entry.name, entry.unit); !fault.empty()) {
        leave_out(entry, fault);
        entries.push_back(std::move(entry));
        return;
      }
      const Unit unit = unit_of(entry.name, entry.unit, !entry.unit.empty());
      entry.number = unit.to_si(*number);
      entry.si_unit = si_unit(unit.dimension());
    }
    entries.push_back(std::move(entry));
  }

  /// Returns false for a text that says that there is no value.
  static bool is_stated(const std::string& text) {
    return !text.empty() && capitals(text) != "NOTAVAIL" && text != "-";
  }

  void leave_out(const TydexFile::Entry& entry, const std::string& why) {
    file_.left_out[entry.name] = why;
    file_.left_units[entry.name] = {entry.line, entry.unit};
  }

  /// Returns an error text such as `has unknown unit "grC"` if TYDEX does not define the channel's
  /// name, because such a channel may be omitted. Returns nothing if the unit is known or if TYDEX
  /// defines the name.
  std::string fault_of_own(const std::string& name, const std::string& written) const {
    const TydexName* known = find_tydex_name(name);
    if (known && !known->si_unit.empty()) return "";
    const UnitReading reading = reading_of_unit(written);
    return reading.unit ? "" : "has " + reading.fault;
  }

  /// Returns the unit of a channel. Throws InputError if the unit is missing, or if its dimension
  /// is not the one that the channel's name requires.
  Unit unit_of(const std::string& name, const std::string& written, bool strict) const {
    const TydexName* known = find_tydex_name(name);
    const bool told = known && !known->si_unit.empty();
    const Unit expected = Unit::of(told ? known->si_unit : "1");
    const UnitReading reading =
        told ? reading_of_unit(written, expected) : reading_of_unit(written);
    if (!reading.unit)
      fail(line_,
           name +
               (told ? fmt::format(" ({}, such as \"{}\")",
                                   words_for(expected).noun,
                                   natural_unit(known->si_unit))
                     : "") +
               " has " + reading.fault);
    if (!strict || !told || reading.unit->same_dimension(expected)) return *reading.unit;
    fail(line_,
         name + (written.empty() ? " has no unit" : " is in " + in_quotes(written)) +
             ", expected " + words_for(expected).noun + " (" + std::string(known->meaning) +
             "), such as " + in_quotes(natural_unit(known->si_unit)));
  }

  /// Reads name, comment, unit and three numbers that are separated by tabs; returns nullopt for
  /// any other line.
  std::optional<TydexFile::Entry> entry_between_tabs(std::string_view line) const {
    std::vector<std::string_view> fields;
    for (line = trimmed(line); line.find('\t') != line.npos;
         line = trimmed(line.substr(line.find('\t'))))
      fields.push_back(trimmed(line.substr(0, line.find('\t'))));
    fields.push_back(line);
    constexpr std::size_t kFields = 6;
    if (fields.size() != kFields || !number_of(fields[3]) || !number_of(fields[4]) ||
        !number_of(fields[5]))
      return std::nullopt;
    TydexFile::Entry entry;
    entry.line = line_;
    entry.name = capitals(fields[0]);
    entry.comment = fields[1];
    entry.unit = fields[2];
    entry.text = fmt::format("{} {} {}", fields[3], fields[4], fields[5]);
    return entry;
  }

  /// Fails if the last words of a line are a unit and three numbers, but are not in the columns of
  /// the format.
  void expect_columns(const TydexFile::Entry& entry, std::string_view line) const {
    const auto words = words_of(line);
    constexpr std::size_t kFewest = 5;  // name, unit, factor, two offsets
    if (words.size() < kFewest || !looks_like_unit(words[words.size() - 4])) return;
    const bool are_numbers = std::all_of(words.end() - 3, words.end(), [](std::string_view word) {
      return number_of(word).has_value();
    });
    if (!are_numbers || words_of(entry.text).size() >= 3) return;
    fail(line_,
         fmt::format("channel {} has its fields beside their columns: the name is in columns 1 to "
                     "10, the comment in 11 to 40, the unit in 41 to 50, factor and offsets from "
                     "51; or name, comment, unit and the three numbers between tabs",
                     entry.name));
  }

  void take_channel(std::string_view line) {
    TydexFile::Description about;
    const TydexFile::Entry entry = entry_between_tabs(line).value_or(entry_of(line));
    expect_columns(entry, line);
    about.comment = entry.comment;
    about.unit = entry.unit;
    about.line = line_;
    if (entry.name.empty()) {
      fail(line_, "is " + in_quotes(line) + ", expected the name of a channel in columns 1 to 10");
    }
    if (!names_.insert(entry.name).second) fail(line_, "channel " + entry.name + " comes twice");
    if (raw_.size() == kMostTydexChannels)
      fail(line_, fmt::format("more than {} channels", kMostTydexChannels));
    const std::string fault = fault_of_own(entry.name, about.unit);
    if (!fault.empty()) leave_out(entry, fault);
    units_.push_back(fault.empty() ? unit_of(entry.name, about.unit, true) : Unit::of("1"));
    double* const values[] = {&about.factor, &about.measured_offset, &about.physical_offset};
    const auto words = words_of(entry.text);
    for (std::size_t i = 0; i < std::min<std::size_t>(3, words.size()); ++i) {
      const auto number = number_of(words[i]);
      if (!number || !std::isfinite(static_cast<double>(*number))) {
        fail(line_,
             "channel " + entry.name + " has " + in_quotes(words[i]) +
                 ", expected factor and offsets as numbers from column 51");
      }
      *values[i] = static_cast<double>(*number);
    }
    raw_.push_back({entry.name, si_unit(units_.back().dimension()), {}});
    file_.descriptions.push_back(std::move(about));
  }

  void take_sample(std::string_view line) {
    split_words(line, words_);
    if (words_.size() != raw_.size() && !split_by_columns(line)) {
      const bool is_cut = at_ > text_.size();  // the last line, without a line end
      fail(line_,
           fmt::format("{}has {} numbers, expected one for each of the {} channels",
                       is_cut ? kCutWithin : "",
                       words_.size(),
                       raw_.size()));
    }
    for (std::size_t i = 0; i < raw_.size(); ++i) {
      const auto number = words_[i].empty() ? kNotAvailable : number_of(words_[i]);
      if (!number || std::isinf(static_cast<double>(*number))) {
        fail(line_,
             raw_[i].name + " is " + in_quotes(words_[i]) + ", expected a number or NOTAVAIL");
      }
      const TydexFile::Description& about = file_.descriptions[i];
      const double value =
          units_[i].to_si(about.factor * (*number + about.measured_offset) + about.physical_offset);
      if (std::isinf(value)) {
        fail(line_, raw_[i].name + " is " + in_quotes(words_[i]) + ", which is too large");
      }
      raw_[i].values.push_back(value);
    }
    file_.lines.push_back(line_);
  }

  /// Splits a line into fixed columns of 10 characters, because numbers may touch and columns may
  /// be empty.
  bool split_by_columns(std::string_view line) {
    const std::size_t count = raw_.size();
    if (line.size() <= kField * (count - 1) || line.size() > kField * count) return false;
    if (line.find('\t') != line.npos) return false;
    words_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      words_.push_back(trimmed(line.substr(i * kField, kField)));
    }
    return true;
  }

  void finish() {
    if (lines_behind_end_ > 0)
      file_.doubts.push_back(
          {"",
           fmt::format("{} behind **END {} not read: is a part of the data there? Move **END "
                       "behind it, or delete the text",
                       lines_behind_end_ == 1 ? std::string("1 line")
                                              : fmt::format("{} lines", lines_behind_end_),
                       lines_behind_end_ == 1 ? "is" : "are"),
           {file_.file, first_behind_end_}});
    if (seen_.contains("**MEASURDATA") && file_.lines.empty()) {
      fail(line_, "ends **MEASURDATA without a sample");
    }
    if (stated_samples_ && *stated_samples_ != static_cast<double>(file_.lines.size())) {
      fail(line_of_data_,
           fmt::format(
               "**MEASURDATA states {:g} samples, but {} follow: is a part of the file lost? "
               "If the file is whole, correct the number or leave it out",
               *stated_samples_,
               file_.lines.size()));
    }
    std::vector<TydexFile::Description> kept;
    for (std::size_t i = 0; i < raw_.size(); ++i) {
      if (file_.left_out.contains(raw_[i].name)) continue;
      file_.channels.add(std::move(raw_[i]));
      kept.push_back(std::move(file_.descriptions[i]));
    }
    if (kept.empty() && !raw_.empty())
      fail(file_.descriptions.front().line,
           raw_.front().name + " " + file_.left_out.at(raw_.front().name) +
               ", and no other channel is left");
    file_.descriptions = std::move(kept);
  }

  std::string_view text_;
  TydexFile& file_;
  std::size_t at_ = 0;
  int line_ = 0;
  std::string keyword_;
  std::optional<double> stated_samples_;  // behind **MEASURDATA
  int line_of_data_ = 0;
  int lines_behind_end_ = 0, first_behind_end_ = 0;
  std::set<std::string> seen_, names_;
  // lines of the entries of header and constants, by list and name
  std::map<const std::vector<TydexFile::Entry>*, std::map<std::string, int>> lines_;
  std::vector<Unit> units_;
  std::vector<Channel> raw_;
  std::vector<std::string_view> words_;
};

}  // namespace

TydexFile TydexFile::read(const std::filesystem::path& file) {
  std::string text = read_settled_file(file, kLargestTydex);
  expect_content_of_ending(file, text);
  return parse(std::move(text), file.string());
}

TydexFile TydexFile::parse(std::string text, std::string file_name) {
  TydexFile result;
  result.file = std::move(file_name);
  const std::string utf8 = utf8_text(std::move(text), result.file);
  Reading(utf8, result).run();
  return result;
}

const TydexFile::Entry* TydexFile::find(std::string_view name) const {
  for (const auto* entries : {&header, &constants}) {
    for (const Entry& entry : *entries)
      if (entry.name == name) return &entry;
  }
  return nullptr;
}

double TydexFile::constant(std::string_view name, std::string_view unit) const {
  const Unit expected = Unit::of(unit);
  const Entry* entry = find(name);
  if (entry && entry->number && Unit::of(entry->si_unit).same_dimension(expected)) {
    return *entry->number;
  }
  const Channel* channel = channels.find(name);
  if (!entry && channel && Unit::of(channel->unit).same_dimension(expected)) {
    double sum = 0.0;
    for (const double value : channel->values) sum += value;
    return sum / static_cast<double>(channel->values.size());
  }
  const std::string wanted = words_for(expected).noun;
  if (!entry)
    throw InputError({file, 0}, "has no constant " + in_quotes(name) + ", expected " + wanted);
  throw InputError({file, entry->line},
                   std::string(name) + " is " + in_quotes(entry->text + " " + entry->unit) +
                       ", expected " + wanted);
}

}  // namespace latsch::formats
