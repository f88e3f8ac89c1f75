// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/record_ledger.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "base/text.h"
#include "base/units.h"
#include "correlation/laboratory/channel_names.h"
#include "correlation/laboratory/columns_hint.h"
#include "correlation/laboratory/sign_advice.h"
#include "measurement/meaning/channel_checks.h"
#include "measurement/meaning/channel_sense.h"
#include "measurement/meaning/channel_words.h"
#include "measurement/meaning/filler_numbers.h"

namespace latsch::correlation {
namespace {

/// True if a convention in which the file may be turns the channel; axes of Adams are those of a
/// suspension alone.
bool depends_on_axes(const std::string& channel, bool of_suspension) {
  const ChannelSenses senses = channel_senses(channel);
  const auto turns = [&](AxisConvention axes) { return sign_to_iso(senses, axes) < 0.0; };
  return senses.is_known() && (turns(AxisConvention::sae) || turns(AxisConvention::adapted_sae) ||
                               (of_suspension && turns(AxisConvention::adams)));
}

/// Calls a function for the rows of all files whose columns became this channel.
template <class Action>
void for_rows_of(LabRecord& record, const std::string& channel, const Action& action) {
  const Channel* found = record.find(channel);
  if (!found) return;
  const auto written = record.written.find(found->name);
  if (written == record.written.end()) return;
  for (Ledger& ledger : record.ledgers)
    if (LedgerRow* row = ledger.find_written(written->second.column)) action(*row);
}

bool is_stated(const LabRecord& record, const std::string& column) {
  return std::any_of(record.stated.begin(), record.stated.end(), [&](const auto& one) {
    return one.second.column == column;
  });
}

/// Names what a channel means. A column `t` in mm is no time: a written unit of another dimension
/// contradicts the name, which then means nothing.
void name_meaning(LedgerRow& row) {
  const auto known = recognized(row.taken_as);
  if (!known) return;
  const auto unit = row.unit_written.empty() ? std::nullopt : Unit::find(row.unit_written);
  if (!unit || unit->same_dimension(Unit::of(known->meaning->unit)))
    row.meaning = known->meaning->words;
}

/// Marks the row of a known name as doubtful if its values have no unit or one of another
/// dimension.
void note_dimension(LedgerRow& row) {
  constexpr std::array<std::string_view, 4> kLetters = {"P", "p", "V", "v"};
  std::string expected = dimension_of_name(row.written);
  // A single letter with a unit can mean anything; without a unit it is most likely one of Latsch's
  // own names.
  if (row.unit_written.empty() &&
      std::find(kLetters.begin(), kLetters.end(), row.written) != kLetters.end())
    expected = recognized(row.written)->meaning->unit;
  if (expected.empty() || Unit::of(row.unit).same_dimension(Unit::of(expected))) return;
  row.state = LedgerState::doubtful;
  row.remark = row.unit_written.empty()
                   ? fmt::format("a known name without its dimension: {} is {}",
                                 recognized(row.written)->channel,
                                 words_for(Unit::of(expected)).noun)
                   : fmt::format("a known name of another dimension: {} is {}",
                                 recognized(row.written)->channel,
                                 words_for(Unit::of(expected)).noun);
}

/// Adds a doubt that the minus before a name was applied, and how to undo it.
void note_minus(const formats::TableColumn& column,
                const LabRecord& record,
                LedgerRow& row,
                Ledger& ledger) {
  row.factor = -row.factor;
  row.offset = -row.offset;
  const std::string& channel = row.taken_as.empty() ? row.written : row.taken_as;
  row.remark = "the minus of its name is applied";
  if (row.taken_as.empty() || is_stated(record, row.written)) return;
  ledger.doubts.push_back(
      {row.written,
       fmt::format("column {0} begins with a minus, which is applied: {1} is minus the numbers of "
                   "the column. If it is only a dash, take it off the name, or say columns = "
                   "{{{1} = \"-{2}\"}} in a [measurement.NAME]",
                   in_quotes(column.title),
                   channel,
                   row.written),
       {ledger.file, row.line}});
}

/// Sets factor and offset of a written unit that is known.
void take_unit(LedgerRow& row) {
  if (const auto unit = Unit::find(row.unit_written); unit && !row.unit_written.empty()) {
    row.offset = unit->to_si(0.0L);
    row.factor = unit->to_si(1.0L) - row.offset;
  }
}

/// Returns the row of the table's k-th channel. `ours` is the channel of Latsch that it is taken
/// as; null if there is none.
LedgerRow row_of_channel(const formats::LabTable& table,
                         std::size_t k,
                         const LabRecord& record,
                         const std::string* ours) {
  const Channel& channel = table.channels.all()[k];
  LedgerRow row;
  row.written = channel.name;
  row.line = table.header.line;
  row.column = static_cast<int>(k) + 1;
  if (k < table.columns.size()) {
    if (table.columns[k].line > 0) row.line = table.columns[k].line;
    if (table.columns[k].place > 0) row.column = table.columns[k].place;
    row.remark = table.columns[k].assumed;
  }
  row.unit_written = table.units[k];
  row.unit = channel.unit;
  take_unit(row);
  if (k < table.columns.size()) {
    row.offset += row.factor * table.columns[k].offset;
    row.factor *= table.columns[k].factor;
  }
  if (ours) {
    const double sign = record.written.at(*ours).sign;
    row.taken_as = *ours;
    row.factor *= sign;
    row.offset *= sign;
  }
  if (row.taken_as == row.written && !recognized(row.written) &&
      !channel_senses(row.written).is_known())
    row.taken_as.clear();
  name_meaning(row);
  note_dimension(row);
  return row;
}

/// Returns the row of a column that the reader left out.
LedgerRow row_left_out(const formats::LabTable& table,
                       const std::string& name,
                       const std::string& why) {
  LedgerRow row;
  row.written = name;
  row.line = table.header.line;
  const auto column = std::find_if(table.left_columns.begin(),
                                   table.left_columns.end(),
                                   [&](const auto& one) { return one.name == name; });
  if (column != table.left_columns.end()) {
    if (column->line > 0) row.line = column->line;
    row.column = column->place;
    row.unit_written = column->unit;
  }
  if (const auto known = recognized(name)) row.meaning = known->meaning->words;
  row.state = LedgerState::doubtful;
  row.remark = "left out: it " + why;
  return row;
}

/// Adds the encoding that the reader assumed.
void note_encoding(const formats::LabTable& table, Ledger& ledger) {
  if (table.assumed_encoding.empty()) return;
  LedgerRow row;
  row.taken_as = "encoding";
  row.state = LedgerState::assumed;
  row.remark = table.assumed_encoding;
  ledger.rows.push_back(std::move(row));
  if (table.assumed_encoding.find("Shift-JIS") != std::string::npos)
    ledger.doubts.push_back(
        {"", "the text is taken as " + table.assumed_encoding, {ledger.file, 0}});
}

/// Adds a note to the ledger about the struct that was chosen because it is the only one with known
/// channels, or about several such structs.
void note_structs(const formats::LabTable& table, Ledger& ledger) {
  if (!table.assumed_struct.empty()) {
    LedgerRow row;
    row.taken_as = table.part_word;
    row.state = LedgerState::assumed;
    row.remark = table.assumed_struct + ", because all known channels are in it";
    ledger.rows.push_back(std::move(row));
  }
  if (table.structs.empty()) return;
  const bool is_group = table.part_word == "group";
  ledger.doubts.push_back(
      {"",
       fmt::format("{0}: {1}; a study chooses one by {2} = {3} in its [measurement.NAME]{4}",
                   is_group ? "the file has groups with times of their own"
                            : "known channels are in several structs",
                   list_of(table.structs),
                   table.part_word,
                   in_quotes(table.structs.front()),
                   is_group ? ", or joins them by resample = \"1 ms\"" : ""),
       {ledger.file, 0}});
}

}  // namespace

Ledger ledger_of(const formats::LabTable& table, const LabRecord& record) {
  Ledger ledger{table.file};
  std::map<std::string, std::string> ours_of;  // the file's name -> Latsch's name
  for (const auto& [ours, theirs] : record.written) ours_of[theirs.column] = ours;
  for (std::size_t k = 0; k < table.channels.all().size(); ++k) {
    const auto ours = ours_of.find(table.channels.all()[k].name);
    LedgerRow row =
        row_of_channel(table, k, record, ours == ours_of.end() ? nullptr : &ours->second);
    if (k < table.columns.size() && table.columns[k].is_negative)
      note_minus(table.columns[k], record, row, ledger);
    ledger.rows.push_back(std::move(row));
  }
  for (const auto& [name, why] : table.left_out)
    ledger.rows.push_back(row_left_out(table, name, why));
  note_encoding(table, ledger);
  note_structs(table, ledger);
  ledger.doubts.insert(ledger.doubts.end(), table.doubts.begin(), table.doubts.end());
  for (const LedgerRow& row : ledger.rows)
    if (row.state == LedgerState::doubtful)
      ledger.doubts.push_back({row.written,
                               "column " + in_quotes(row.written) + " is in doubt: " + row.remark,
                               {ledger.file, row.line}});
  return ledger;
}

void note_use(LabRecord& record, const std::string& channel, const std::string& by) {
  for_rows_of(record, channel, [&](LedgerRow& row) { Ledger::use(row, by); });
}

namespace {

/// Angles of a suspension whose signs no convention of axes defines, and the positive direction
/// that is assumed.
struct SuspensionSign {
  const char *channel, *positive;
};
constexpr SuspensionSign kSuspensionSigns[] = {{"toe", "front inboard"},
                                               {"camber", "top outboard"},
                                               {"caster", "top of the kingpin rearward"}};

const SuspensionSign* suspension_sign(const std::string& channel) {
  for (const SuspensionSign& sign : kSuspensionSigns)
    if (channel == sign.channel || channel.starts_with(std::string(sign.channel) + "_"))
      return &sign;
  return nullptr;
}

/// True for a table of a suspension; the camber of a tire test has the signs of its axes.
bool is_of_suspension(const Ledger& ledger) {
  constexpr std::array<std::string_view, 6> kMoved = {"toe", "caster", "dx", "dy", "dz", "travel"};
  return std::any_of(ledger.rows.begin(), ledger.rows.end(), [&](const LedgerRow& row) {
    const std::string& channel = row.taken_as.empty() ? row.written : row.taken_as;
    return std::any_of(kMoved.begin(), kMoved.end(), [&](std::string_view name) {
      return channel == name || channel.starts_with(std::string(name) + "_");
    });
  });
}

/// Adds the signs that are assumed for the angles of a suspension, because no file states them.
void note_suspension_signs(Ledger& ledger) {
  if (!is_of_suspension(ledger)) return;
  std::vector<std::string> assumed;
  for (const SuspensionSign& sign : kSuspensionSigns)
    if (std::any_of(ledger.rows.begin(), ledger.rows.end(), [&](const LedgerRow& row) {
          return suspension_sign(row.taken_as.empty() ? row.written : row.taken_as) == &sign;
        }))
      assumed.push_back(fmt::format("{} {}", sign.channel, sign.positive));
  if (assumed.empty()) return;
  LedgerRow row;
  row.taken_as = "positive";
  row.state = LedgerState::assumed;
  row.remark = fmt::format("is {}", fmt::join(assumed, ", "));
  ledger.rows.push_back(std::move(row));
}

}  // namespace

void note_axes(LabRecord& record, AxisConvention axes, bool are_stated) {
  const std::string name = axis_convention_names()[static_cast<std::size_t>(axes)];
  for (Ledger& ledger : record.ledgers) {
    bool matters = false;
    const bool of_suspension = is_of_suspension(ledger);
    for (LedgerRow& row : ledger.rows) {
      const std::string& channel = row.taken_as.empty() ? row.written : row.taken_as;
      const ChannelSenses senses = channel_senses(channel);
      matters = matters || depends_on_axes(channel, of_suspension);
      if (!senses.is_known())
        row.axes = are_stated ? "not turned" : "";
      else if (depends_on_axes(channel, of_suspension))
        row.axes = fmt::format(
            "{}{}, {:+.0f}", name, are_stated ? "" : " (assumed)", sign_to_iso(senses, axes));
      else
        row.axes = "the same in all";
    }
    note_suspension_signs(ledger);
    if (are_stated || !matters) continue;
    LedgerRow row;
    row.taken_as = "axes";
    row.state = LedgerState::assumed;
    row.remark = "iso, because none are stated: x forward, y to the left, z up";
    ledger.rows.push_back(std::move(row));
  }
}

std::string ambiguity(const LabRecord& record, const std::string& channel) {
  const auto others = record.ambiguous.find(channel);
  const auto first = record.written.find(channel);
  if (others == record.ambiguous.end() || first == record.written.end()) return "";
  std::vector<std::string> columns = {first->second.column};
  columns.insert(columns.end(), others->second.begin(), others->second.end());
  std::string named;
  for (const std::string& column : columns)
    named += (named.empty() ? "" : " and ") + in_quotes(column);
  return fmt::format("columns {} both are {}; say which by {} of a [measurement.NAME]",
                     named,
                     channel,
                     columns_hint(record.stated, channel, {columns.front(), ""}));
}

namespace {

/// Returns the samples that have a suspect number and are still selected.
std::vector<std::size_t> samples_left(const LabRecord& record, const SuspectSamples& suspect) {
  std::vector<std::size_t> left;
  for (const double number : suspect.samples) {
    const auto at = std::lower_bound(record.numbers.begin(), record.numbers.end(), number);
    if (at != record.numbers.end() && *at == number)
      left.push_back(static_cast<std::size_t>(at - record.numbers.begin()));
  }
  return left;
}

/// Returns the first sample of each file but the first one.
std::vector<std::size_t> first_samples(const LabRecord& record) {
  std::vector<std::size_t> first;
  for (std::size_t i = 1; i < record.places.size(); ++i)
    if (record.places[i].file != record.places[i - 1].file) first.push_back(i);
  return first;
}

/// Returns the record with gaps instead of suspect numbers.
LabRecord without_suspects(const LabRecord& record) {
  LabRecord plain;
  plain.channels = record.channels;
  plain.places = record.places;
  for (const SuspectSamples& suspect : record.suspects)
    for (Channel& channel : plain.channels)
      if (channel.name == suspect.channel)
        for (const std::size_t i : samples_left(record, suspect)) channel.values[i] = std::nan("");
  return plain;
}

/// Returns in words the places of samples: `lines 12, 40 to 49`, or the sample numbers if the file
/// has no lines.
std::string rows_in_words(const LabRecord& record, const std::vector<std::size_t>& samples) {
  std::vector<long> lines, numbers;
  for (const std::size_t i : samples) {
    if (record.places[i].line > 0) lines.push_back(record.places[i].line);
    numbers.push_back(static_cast<long>(record.numbers[i]));
  }
  const bool have_lines = lines.size() == samples.size();
  return (have_lines ? "line" : "sample") + std::string(samples.size() == 1 ? " " : "s ") +
         runs_in_words(have_lines ? lines : numbers);
}

/// Returns a range for `select` that contains all other values of a channel: `Fy = "-10 N .. 10
/// N"`.
std::string window_around(const Channel& channel) {
  constexpr double kMargin = 0.01;  // share of the span, so that no value lies exactly at an end
  constexpr int kDigits = 6;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : channel.values)
    if (!std::isnan(value)) low = std::min(low, value), high = std::max(high, value);
  if (low > high) return "";
  const Unit unit = Unit::of(read_unit(channel.unit));
  const double from = unit.from_si(low), to = unit.from_si(high);
  const double margin = kMargin * (to > from ? to - from : std::max(std::abs(to), 1.0));
  return fmt::format("{} = \"{} .. {}{}\"",
                     toml_key(channel.name),
                     format_number(from - margin, kDigits),
                     format_number(to + margin, kDigits),
                     channel.unit == "1" ? "" : " " + read_unit(channel.unit));
}

}  // namespace

std::vector<LedgerDoubt> suspect_numbers(const LabRecord& record,
                                         const std::string& table,
                                         const std::vector<std::string>& selected,
                                         bool was_filtered) {
  std::vector<LedgerDoubt> doubts;
  if (record.suspects.empty()) return doubts;
  const LabRecord plain = without_suspects(record);
  for (const SuspectSamples& suspect : record.suspects) {
    const auto left = samples_left(record, suspect);
    const Channel* found = plain.find(suspect.channel);
    const auto written = record.written.find(suspect.channel);
    if (left.empty() || !found || written == record.written.end()) continue;
    const bool was_seen = std::any_of(selected.begin(), selected.end(), [&](const auto& name) {
      return same_channel(name, suspect.channel);
    });
    const std::string& column = written->second.column;
    Channel others = *found;  // without gaps, which are the suspect numbers themselves
    std::erase_if(others.values, [](double value) { return std::isnan(value); });
    const std::string window = window_around(others);
    const bool is_refused = suspect.is_certain && !was_seen;
    std::string way_out;
    if (was_filtered)
      way_out = "low_pass has spread it over its neighbors: cut the rows off in the file";
    else if (window.empty())
      way_out = "no other value is left: this is no measured channel";
    else
      way_out = fmt::format(
          "leave the rows out by [measurement.{}.select] {}, or cut them off in "
          "the file",
          table.empty() ? "NAME" : table,
          window);
    doubts.push_back({column,
                      fmt::format("column {}{} is {} in {} of {} samples ({}), {}; the other "
                                  "values: {}. {}: {}",
                                  in_quotes(column),
                                  column == suspect.channel ? "" : " (" + suspect.channel + ")",
                                  suspect.number,
                                  left.size(),
                                  record.samples(),
                                  rows_in_words(record, left),
                                  suspect.reason,
                                  window.empty() ? "none" : range_in_words(others),
                                  is_refused ? "A study that uses the column is refused"
                                             : "The rows count as they are",
                                  way_out),
                      record.places[left.front()],
                      is_refused});
  }
  return doubts;
}

namespace {

/// Returns advice on how to remove a contradiction of signs, to follow the sentence about it.
std::string advice_in_words(const std::vector<std::string>& advice,
                            bool axes_are_stated,
                            const std::string& where) {
  if (advice.empty()) return "";
  return fmt::format("; {}the signs agree with {}: say {}{}",
                     axes_are_stated ? "" : "no axes are stated, so iso is taken, but ",
                     advice.size() == 1 ? "one statement" : "each of several statements",
                     fmt::join(advice, ", or "),
                     where);
}

/// Returns the channels `plain` with the names and statements of the record from which they come.
LabRecord with_names_of(const LabRecord& record, LabRecord plain) {
  plain.written = record.written;
  plain.stated = record.stated;
  plain.turned_from = record.turned_from;
  return plain;
}

}  // namespace

void check_channels(LabRecord& record, std::optional<AxisConvention> stated_axes, bool is_stated) {
  if (record.ledgers.empty()) return;
  const LabRecord plain = without_suspects(record);
  const auto file_of = [&](const Place& place) -> Ledger& {
    for (Ledger& ledger : record.ledgers)
      if (ledger.file == place.file) return ledger;
    return record.ledgers.front();
  };
  for (const auto& [channel, others] : record.ambiguous)
    record.ledgers.front().doubts.push_back(
        {others.front(), ambiguity(record, channel), record.header});
  const auto doubts = doubts_about(plain.table(), first_samples(record));
  const bool is_of_sign = std::any_of(
      doubts.begin(), doubts.end(), [](const ChannelDoubt& doubt) { return doubt.is_of_sign; });
  const std::string where = is_stated ? "" : " in a [measurement.NAME] of the file";
  const std::string way_out =
      is_of_sign ? advice_in_words(signs_that_agree(with_names_of(record, plain), stated_axes),
                                   stated_axes.has_value(),
                                   where)
                 : "";
  for (const ChannelDoubt& doubt : doubts) {
    const auto written = record.written.find(doubt.channel);
    const std::string column =
        written == record.written.end() ? doubt.channel : written->second.column;
    const Place place =
        doubt.sample < record.places.size() ? record.places[doubt.sample] : record.header;
    Ledger& ledger = file_of(place);
    std::string out = doubt.is_of_sign ? way_out : "";
    if (doubt.all_loads_negative && out.empty())
      out = fmt::format("; turn the column by {}{}", turned(record, doubt.channel), where);
    ledger.doubts.push_back({column,
                             fmt::format("column {}{} {}{}",
                                         in_quotes(column),
                                         column == doubt.channel ? "" : " (" + doubt.channel + ")",
                                         doubt.sentence,
                                         out),
                             place,
                             doubt.is_error});
    if (LedgerRow* row = ledger.find_written(column)) {
      row->state = LedgerState::doubtful;
      row->remark = doubt.sentence;
    }
  }
}

}  // namespace latsch::correlation
