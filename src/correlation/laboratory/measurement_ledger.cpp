// SPDX-License-Identifier: Apache-2.0
// Ledgers of a measurement: what its columns were taken for, who uses them, what is missing and
// what is doubtful. They are complete after all users of the measurement were read.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "base/units.h"
#include "correlation/laboratory/columns_hint.h"
#include "correlation/laboratory/measurement.h"
#include "measurement/meaning/absent_channel.h"
#include "measurement/meaning/channel_words.h"

namespace latsch::correlation {

void Measurement::note_use(const std::string& channel, const std::string& by) const {
  const NamedChannel found = named(channel);
  if (found.name.empty()) return;
  const std::string& column = told_.written.at(found.name).column;
  for (Ledger& ledger : *told_.ledgers)
    if (LedgerRow* row = ledger.find_written(column)) Ledger::use(*row, by);
}

void Measurement::note_ignored(const std::string& channel,
                               const std::string& by,
                               const std::string& why) const {
  const NamedChannel found = named(channel);
  if (found.name.empty()) return;
  const std::string& column = told_.written.at(found.name).column;
  for (Ledger& ledger : *told_.ledgers)
    if (LedgerRow* row = ledger.find_written(column)) {
      row->remark = "not used by " + by + ": " + why;
      const auto& values = told_.channels.find(found.name)->values;
      if (std::all_of(values.begin(), values.end(), [](double x) { return x == 0.0; })) continue;
      ledger.doubts.push_back(
          {column,
           fmt::format(
               "{}: column {} ({}) is not used: {}", by, in_quotes(column), found.name, why),
           told_.place});
    }
}

void Measurement::note_absent(const Absent& absent) const {
  const bool is_noted = std::any_of(absent_->begin(), absent_->end(), [&](const Absent& one) {
    return one.channel == absent.channel && one.by == absent.by;
  });
  if (!is_noted) absent_->push_back(absent);
}

std::vector<std::string> Measurement::columns_like(const std::string& channel,
                                                   const std::string& unit) const {
  std::vector<std::string> columns;
  for (const Channel& one : told_.channels.all()) {
    const StatedColumn& column = told_.written.at(one.name);
    const bool fits = column.unit.empty() || Unit::of(one.unit).same_dimension(Unit::of(unit));
    if (one.name == column.column && fits) columns.push_back(one.name);
  }
  for (const auto& [name, why] : told_.left_out) columns.push_back(name);
  return look_like(channel, columns);
}

namespace {

// largest number of columns in a message that may be a missing channel
constexpr std::size_t kMostNamed = 12;

/// Returns the name of a channel in the vocabulary of channels, without the suffixes of frame and
/// wheel.
std::string meaning_of(const std::string& channel) {
  const auto known = recognized(channel);
  return known && !known->keeps_name ? std::string(known->meaning->name) : channel;
}

/// Returns the ledger of a file; the first one if none is of that file.
Ledger& ledger_of_file(std::vector<Ledger>& ledgers, const std::string& file) {
  for (Ledger& ledger : ledgers)
    if (ledger.file == file) return ledger;
  return ledgers.front();
}

/// True if the numbers have both signs and magnitudes below 1.5, like the slip of a tire.
bool is_slip_like(const std::vector<double>& values) {
  constexpr double kMostSlip = 1.5;
  double low = 0.0, high = 0.0;
  for (const double value : values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low < 0.0 && high > 0.0 && low > -kMostSlip && high < kMostSlip;
}

std::vector<OtherColumn> columns_in(const Ledger& ledger, const Measurement::Told& told) {
  std::map<std::string, const Channel*> read;
  for (const Channel& channel : told.channels.all())
    read[told.written.at(channel.name).column] = &channel;
  std::vector<OtherColumn> columns;
  for (const LedgerRow& row : ledger.rows) {
    if (row.written.empty() || row.unit.empty())
      continue;  // the unit of a column left out is empty
    columns.push_back(
        {row.written, row.unit, !row.unit_written.empty(), row.taken_as, !row.used_by.empty()});
    const auto values = read.find(row.written);
    columns.back().is_slip_like = values != read.end() && is_slip_like(values->second->values);
  }
  return columns;
}

/// True for a load that a user did not need: a load of one wheel beside those of an axle, or a load
/// of an axle beside those of its wheels, which the user takes from the recording.
bool is_needless(const Measurement::Absent& absent, const Ledger& ledger) {
  const std::string force = force_without_frame(absent.channel);
  if (force.empty()) return false;
  const bool is_of_wheel = force.size() > 2;
  bool others = false;
  for (const LedgerRow& row : ledger.rows) {
    const std::string load = force_without_frame(row.taken_as.empty() ? row.written : row.taken_as);
    if (load.empty() || row.written.empty() ||
        std::find(row.used_by.begin(), row.used_by.end(), absent.by) == row.used_by.end())
      continue;
    if ((load.size() > 2) == is_of_wheel) return false;
    others = true;
  }
  return others;
}

}  // namespace

std::vector<LedgerDoubt> Measurement::unknown_keys() const {
  std::vector<LedgerDoubt> errors;
  for (const auto& [key, column] : told_.stated) {
    if (recognized(key)) continue;
    const bool is_used = std::any_of(
        told_.ledgers->begin(), told_.ledgers->end(), [&column = column](const Ledger& ledger) {
          const LedgerRow* row = ledger.find_written(column.column);
          return !row || !row->used_by.empty();
        });
    if (is_used) continue;
    std::vector<std::string> known = channel_names();
    for (const Absent& absent : *absent_) known.push_back(absent.channel);
    errors.push_back({column.column,
                      fmt::format("columns has {} = {}, which is no channel that is known, and "
                                  "nothing in the study uses it{} (channels: {})",
                                  key,
                                  in_quotes(column.column),
                                  did_you_mean(key, known),
                                  list_of(channel_names())),
                      column.place,
                      true});
  }
  return errors;
}

std::string Measurement::hint_for(const std::string& channel,
                                  const std::string& column,
                                  const std::string& unit) const {
  StatedColumn theirs{column, ""};
  for (const auto& [ours, written] : told_.written)
    if (written.column == column && written.unit.empty()) theirs = with_natural_unit(written, unit);
  return columns_hint(told_.stated, key_for(channel, channel), theirs);
}

std::string Measurement::way_out_of_missing(const std::string& channel,
                                            const std::string& unit) const {
  if (!told_.structs.empty())
    return fmt::format(
        "; the channels are in {0}s: say {0} = {1} in {2} ({3})",
        told_.part_word,
        in_quotes(told_.structs.front()),
        told_.is_stated ? "[measurement." + told_.name + "]" : "a [measurement.NAME] of the file",
        list_of(told_.structs));
  const auto may_be =
      told_.ledgers->empty()
          ? std::vector<MayBe>()
          : columns_that_may_be(
                meaning_of(channel), unit, columns_in(told_.ledgers->front(), told_));
  if (may_be.empty()) return "";
  return fmt::format("; columns that may be it: {}. Did you mean {}? Then {}",
                     list_in_words(may_be, kMostNamed),
                     may_be.size() == 1 ? "it" : "one of them",
                     advice_for(channel, unit, may_be.front()));
}

std::string Measurement::advice_for(const std::string& channel,
                                    const std::string& unit,
                                    const MayBe& column) const {
  if (!column.is_as_it_stands) return "add a column " + channel + " to the file";
  return "say " + hint_for(channel, column.column, unit) +
         (told_.is_stated ? "" : " in a [measurement.NAME] of the file");
}

std::vector<Ledger> Measurement::ledgers() const {
  std::vector<Ledger> ledgers = *told_.ledgers;
  if (ledgers.empty()) return ledgers;
  for (const Absent& absent : *absent_) {
    if (is_needless(absent, ledgers.front())) continue;
    const std::string instead =
        absent.otherwise.empty() ? "left out" : "taken as " + absent.otherwise;
    LedgerRow row;
    row.taken_as = absent.channel;
    row.state = LedgerState::assumed;
    row.used_by = {absent.by};
    row.remark = "is " + instead + " by " + absent.by;
    ledgers.front().rows.push_back(std::move(row));
    const auto may_be =
        columns_that_may_be(absent.channel, absent.unit, columns_in(ledgers.front(), told_));
    if (may_be.empty()) continue;
    const std::string& first = may_be.front().column;
    ledgers.front().doubts.push_back(
        {first,
         fmt::format("{}: {} is {}: no column is called {}; columns that may be it: {}. Did you "
                     "mean {}? Then "
                     "{}; if it is {} on purpose, say without = [\"{}\"] beside from",
                     absent.by,
                     absent.channel,
                     instead,
                     spellings_of(absent.channel),
                     list_in_words(may_be, kMostNamed),
                     may_be.size() == 1 ? "it" : "one of them",
                     advice_for(absent.channel, absent.unit, may_be.front()),
                     instead,
                     absent.channel),
         told_.place});
  }
  for (LedgerDoubt doubt : told_.suspects) {
    Ledger& ledger = ledger_of_file(ledgers, doubt.place.file);
    LedgerRow* row = ledger.find_written(doubt.name);
    doubt.is_error = doubt.is_error && row && !row->used_by.empty();
    if (row) row->state = LedgerState::doubtful;
    ledger.doubts.push_back(std::move(doubt));
  }
  for (LedgerDoubt& error : unknown_keys()) ledgers.front().doubts.push_back(std::move(error));
  return ledgers;
}

}  // namespace latsch::correlation
