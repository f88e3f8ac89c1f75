// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/record_ledger.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "base/text.h"
#include "base/units.h"
#include "correlation/laboratory/channel_names.h"
#include "correlation/laboratory/columns_hint.h"
#include "measurement/meaning/channel_checks.h"
#include "measurement/meaning/channel_sense.h"
#include "measurement/meaning/channel_words.h"

namespace latsch::correlation {
namespace {

bool depends_on_axes(const std::string& channel) {
  const ChannelSenses senses = channel_senses(channel);
  return senses.is_known() && (sign_to_iso(senses, AxisConvention::sae) < 0.0 ||
                               sign_to_iso(senses, AxisConvention::adapted_sae) < 0.0);
}

/// Calls the action for the rows of all files that became this channel.
template <class Action>
void for_rows_of(LabRecord& record, const std::string& channel, const Action& action) {
  const Channel* found = record.find(channel);
  if (!found) return;
  const auto written = record.written.find(found->name);
  if (written == record.written.end()) return;
  for (Ledger& ledger : record.ledgers)
    if (LedgerRow* row = ledger.find_written(written->second.column)) action(*row);
}

void name_meaning(LedgerRow& row) {
  const auto known = recognized(row.taken_as);
  if (known) row.meaning = known->meaning->words;
}

/// Marks a known name whose values have no unit or one of another dimension.
void note_dimension(LedgerRow& row) {
  constexpr std::array<std::string_view, 4> kLetters = {"P", "p", "V", "v"};
  std::string expected = dimension_of_name(row.written);
  // A single letter with a unit may mean anything; without a unit it is most likely Latsch's name.
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

}  // namespace

Ledger ledger_of(const formats::LabTable& table, const LabRecord& record) {
  Ledger ledger{table.file};
  for (std::size_t k = 0; k < table.channels.all().size(); ++k) {
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
    if (const auto unit = Unit::find(row.unit_written); unit && !row.unit_written.empty()) {
      row.offset = unit->to_si(0.0L);
      row.factor = unit->to_si(1.0L) - row.offset;
    }
    for (const auto& [ours, theirs] : record.written)
      if (theirs.column == channel.name) {
        row.taken_as = ours;
        row.factor *= theirs.sign;
        row.offset *= theirs.sign;
      }
    if (row.taken_as == row.written && !recognized(row.written) &&
        !channel_senses(row.written).is_known())
      row.taken_as.clear();
    name_meaning(row);
    note_dimension(row);
    ledger.rows.push_back(std::move(row));
  }
  for (const auto& [name, why] : table.left_out) {
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
    ledger.rows.push_back(std::move(row));
  }
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

/// Angles of a suspension whose signs no axes define, and the positive direction assumed here.
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

/// Says which signs are assumed for the angles of a suspension, because no file states them.
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
    for (LedgerRow& row : ledger.rows) {
      const std::string& channel = row.taken_as.empty() ? row.written : row.taken_as;
      const ChannelSenses senses = channel_senses(channel);
      matters = matters || depends_on_axes(channel);
      if (!senses.is_known())
        row.axes = are_stated ? "not turned" : "";
      else if (depends_on_axes(channel))
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

/// The table `columns` with which a channel has the other sign.
std::string turned(const LabRecord& record, const std::string& channel) {
  StatedColumn column{channel, ""};
  if (const auto written = record.written.find(channel); written != record.written.end())
    column.column = written->second.column;
  const auto stated = record.stated.find(channel);
  if (stated != record.stated.end()) column = stated->second;
  column.sign = -column.sign;
  return columns_hint(record.stated, channel, column);
}

}  // namespace

void check_channels(LabRecord& record, bool axes_are_stated, bool is_stated) {
  if (record.ledgers.empty()) return;
  const auto file_of = [&](const Place& place) -> Ledger& {
    for (Ledger& ledger : record.ledgers)
      if (ledger.file == place.file) return ledger;
    return record.ledgers.front();
  };
  for (const auto& [channel, others] : record.ambiguous)
    record.ledgers.front().doubts.push_back(
        {others.front(), ambiguity(record, channel), record.header});
  const auto fitting = axes_are_stated ? std::vector<std::string>() : conventions_that_fit(record);
  const bool as_iso = std::find(fitting.begin(), fitting.end(), "iso") != fitting.end();
  const std::string where = is_stated ? "" : " in a [measurement.NAME] of the file";
  std::string way_out;
  if (!axes_are_stated && !as_iso && !fitting.empty())
    way_out = fmt::format(
        "; no axes are stated, so iso is taken, but the signs are as in {}: say axes = {}{}",
        list_of(fitting),
        in_quotes(fitting.back()),
        where);
  for (const ChannelDoubt& doubt : doubts_about(record.table())) {
    const auto written = record.written.find(doubt.channel);
    const std::string column =
        written == record.written.end() ? doubt.channel : written->second.column;
    const Place place =
        doubt.sample < record.places.size() ? record.places[doubt.sample] : record.header;
    Ledger& ledger = file_of(place);
    std::string out = way_out;
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
