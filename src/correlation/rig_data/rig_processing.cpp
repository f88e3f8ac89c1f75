// SPDX-License-Identifier: Apache-2.0
#include "correlation/rig_data/rig_processing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"
#include "formats/tables/recording.h"
#include "measurement/bootstrap.h"
#include "measurement/meaning/channel_words.h"
#include "measurement/meaning/wheel_load.h"
#include "measurement/pulse_speed.h"
#include "numerics/signals/sample_count.h"

namespace latsch::correlation {
namespace {

constexpr double kAroundPeriod = 0.2;     // share of the period that a known circumference gives
constexpr double kShortestPeriod = 0.05;  // s, if the circumference is not known: 20 hits a second
constexpr int kFewestPeriods = 3;

std::string at_speed(const Plateau& plateau) {
  return "at " + format_quantity(plateau.target, "km/h", 4);
}

Period period_of(const RigFile& rig, const DrumRecord& record, const Plateau& plateau) {
  const auto force = record.channel(rig.force).subspan(plateau.first, plateau.samples());
  double shortest = kShortestPeriod * record.rate;
  double longest = static_cast<double>(force.size()) / kFewestPeriods;
  if (rig.circumference) {
    const double expected = *rig.circumference / plateau.mean * record.rate;
    shortest = (1.0 - kAroundPeriod) * expected;
    longest = std::min(longest, (1.0 + kAroundPeriod) * expected);
  }
  const auto period = find_period(force, shortest, longest);
  if (!period) {
    throw InputError({record.source, 0},
                     fmt::format("{} does not repeat itself on the plateau {} between {:.4g} and "
                                 "{:.4g} s: was there a cleat on the drum, is {} the right channel"
                                 "{}?",
                                 rig.force,
                                 at_speed(plateau),
                                 shortest / record.rate,
                                 longest / record.rate,
                                 rig.force,
                                 rig.circumference ? " and the circumference right" : ""));
  }
  return *period;
}

ProcessedPlateau process_plateau(const RigFile& rig,
                                 const DrumRecord& record,
                                 const Plateau& plateau) {
  ProcessedPlateau result;
  result.plateau = plateau;
  result.period = period_of(rig, record, plateau);
  const auto part = [&](const std::string& name) {
    return record.channel(name).subspan(plateau.first, plateau.samples());
  };
  result.passages =
      find_passages(part(rig.force), record.rate, result.period.samples, rig.passages);
  if (result.passages.starts.size() < 2) {
    throw InputError({record.source, 0},
                     fmt::format("of {} passages on the plateau {} no two are alike: is the cleat "
                                 "fixed, is the force {} the right one?",
                                 result.passages.left_out + 1,
                                 at_speed(plateau),
                                 rig.force));
  }
  std::vector<std::string> names{rig.force};
  names.insert(names.end(), rig.also.begin(), rig.also.end());
  for (const std::string& name : names) {
    const auto rows = cut(part(name), result.passages);
    result.channels.push_back({name, record.channels.find(name)->unit, average(rows)});
    if (name == rig.force) result.coherence = ensemble_coherence(rows, record.rate);
  }
  result.density = density_of(rig, result.force(), record.rate);
  return result;
}

/// Returns the unit assumed for a channel that states none; empty: a plain number.
std::string unit_without_statement(const RigFile& rig, const std::string& name) {
  if (name == rig.time) return "s";
  if (name == rig.speed) return "m/s";
  if (name == rig.force) return "N";
  const bool is_averaged = std::ranges::find(rig.also, name) != rig.also.end();
  const auto known = recognized(name);
  return is_averaged && known && known->meaning->unit != std::string_view("1")
             ? std::string(known->meaning->unit)
             : "";
}

/// Returns a sentence on a channel whose unit does not fit its name, such as a force in psi; empty
/// for any other one.
std::string fault_of_unit(const RigFile& rig, const std::string& name, const std::string& written) {
  const std::string expected = unit_without_statement(rig, name);
  const auto unit = Unit::find(written);
  if (expected.empty() || written.empty() || !unit || unit->same_dimension(Unit::of(expected)))
    return "";
  return fmt::format(
      "column {} is in {}, which is not {}, as the name says; it is averaged as it "
      "is written",
      in_quotes(name),
      in_quotes(written),
      words_for(Unit::of(expected)).noun);
}

/// Adds which group of a recorder's file was taken, if the rig file names none.
void note_group(const formats::Recording& recording,
                const std::filesystem::path& file,
                Ledger& ledger) {
  if (!recording.assumed_group.empty()) {
    LedgerRow row;
    row.taken_as = "group";
    row.state = LedgerState::assumed;
    row.remark = recording.assumed_group + ", because all known channels are in it";
    ledger.rows.push_back(std::move(row));
  }
  if (!recording.groups.empty())
    ledger.doubts.push_back(
        {"",
         fmt::format("the file has groups with times of their own: {}; group {} is read; the rig "
                     "file chooses one by group in [channels], or joins them by resample",
                     list_of(recording.groups),
                     in_quotes(recording.groups.front())),
         {file.string(), 0}});
}

/// Returns a row for each column of a recording: time, speed or pulses, forces, and unused columns.
Ledger ledger_of_recording(const RigFile& rig,
                           const std::filesystem::path& file,
                           const formats::Recording& recording,
                           const std::vector<std::string>& needed,
                           const std::string& by) {
  Ledger ledger{file.string()};
  for (std::size_t k = 0; k < recording.columns.size(); ++k) {
    const formats::TableColumn& column = recording.columns[k];
    LedgerRow row;
    row.written = column.name;
    row.line = column.line;
    row.column = column.place;
    row.unit_written = column.unit;
    row.unit = recording.channels.all()[k].unit;
    row.remark = column.assumed;
    if (const auto unit = Unit::find(column.unit); unit && !column.unit.empty()) {
      row.offset = unit->to_si(0.0L);
      row.factor = unit->to_si(1.0L) - row.offset;
    }
    const bool is_time = column.name == rig.time;
    if (is_time || std::find(needed.begin(), needed.end(), column.name) != needed.end()) {
      row.taken_as = is_time ? "time" : column.name == rig.speed ? "speed" : column.name;
      Ledger::use(row, by);
      if (const std::string fault = fault_of_unit(rig, column.name, column.unit); !fault.empty())
        ledger.doubts.push_back({column.name, fault, {file.string(), column.line}});
      const std::string assumed = unit_without_statement(rig, column.name);
      if (column.unit.empty() && !assumed.empty()) {
        row.remark = "no unit: " + assumed + " is taken";
        ledger.doubts.push_back(
            {column.name,
             fmt::format("column \"{0}\" has no unit and is taken in {1}; say its unit by "
                         "units = {{\"{0}\" = \"{1}\"}} in [channels] of the rig file",
                         column.name,
                         assumed),
             {file.string(), column.line}});
      }
    }
    ledger.rows.push_back(std::move(row));
  }
  for (const auto& [name, why] : recording.left_out) {
    LedgerRow row;
    row.written = name;
    row.line = recording.header_line;
    row.state = LedgerState::doubtful;
    row.remark = "left out: " + why;
    ledger.rows.push_back(std::move(row));
  }
  note_group(recording, file, ledger);
  ledger.doubts.insert(ledger.doubts.end(), recording.doubts.begin(), recording.doubts.end());
  return ledger;
}

/// Throws if a channel is missing in the group that was taken without being named.
void expect_in_group(const formats::Recording& recording,
                     const std::filesystem::path& file,
                     const std::vector<std::string>& needed) {
  if (recording.groups.empty()) return;
  for (const std::string& name : needed)
    if (!recording.channels.find(name))
      throw InputError({file.string(), 0},
                       fmt::format("has no channel {} in its group {}, which is read because none "
                                   "is named; expected group = one of {} in [channels] of the rig "
                                   "file, or resample, which joins them",
                                   in_quotes(name),
                                   in_quotes(recording.groups.front()),
                                   list_of(recording.groups)));
}

/// Returns the channels that have as many samples as the time, and the requested ones. A MAT file
/// may contain others.
DrumRecord read_record(const RigFile& rig,
                       const std::filesystem::path& file,
                       const std::vector<std::string>& needed,
                       const std::string& by,
                       std::vector<Ledger>& ledgers) {
  const formats::Recording recording =
      formats::read_whole_recording(file, rig.units, rig.group, rig.resampled);
  ledgers.push_back(ledger_of_recording(rig, file, recording, needed, by));
  expect_in_group(recording, file, needed);
  for (const std::string& name : needed)
    if (const auto why = recording.left_out.find(name); why != recording.left_out.end())
      throw InputError({file.string(), recording.header_line}, why->second);
  const Channels& all = recording.channels;
  const Channel* time = all.find(rig.time);
  Channels channels;
  for (const Channel& channel : all.all()) {
    const bool asked_for = std::find(needed.begin(), needed.end(), channel.name) != needed.end();
    if (!asked_for && time && channel.values.size() != time->values.size()) continue;
    Channel taken = channel;
    // The ledger says which unit is taken for a channel that states none.
    if (const std::string assumed = unit_without_statement(rig, channel.name);
        asked_for && channel.unit == "1" && !assumed.empty())
      taken.unit = assumed;
    channels.add(std::move(taken));
  }
  return drum_record(channels, rig.time, file.string());
}

void add_speed(const RigFile& rig, DrumRecord& record) {
  record.channels.add({rig.speed,
                       "m/s",
                       speed_of_pulses(record.channel(rig.pulses),
                                       record.rate,
                                       *rig.circumference / rig.teeth,
                                       rig.pulses,
                                       record.source)});
}

/// Throws if the recording is too short for the segment or too slow for the band.
void expect_spectrum(const RigFile& rig, const DrumRecord& record) {
  constexpr double kFewestSamples = 16.0;
  const Place place{rig.file.string(), 0};
  if (rig.segment && *rig.segment * record.rate < kFewestSamples)
    throw InputError(place,
                     fmt::format("spectrum.segment is {:g} s, which is {:.3g} samples of {}; "
                                 "expected {:.0f} samples at least, and better {:.3g} s for the "
                                 "lower end of the band",
                                 *rig.segment,
                                 *rig.segment * record.rate,
                                 record.source,
                                 kFewestSamples,
                                 1.0 / rig.band.lower));
  if (rig.band.lower >= 0.5 * record.rate)
    throw InputError(place,
                     fmt::format("spectrum.band begins at {:g} Hz, but the {:g} samples a second "
                                 "of {} contain nothing above {:g} Hz",
                                 rig.band.lower,
                                 record.rate,
                                 record.source,
                                 0.5 * record.rate));
}

}  // namespace

numerics::Density density_of(const RigFile& rig, const std::vector<double>& force, double rate) {
  const int samples = static_cast<int>(force.size());
  std::optional<int> segment;
  if (rig.segment) segment = numerics::sample_count(*rig.segment, rate);
  if (segment > samples)
    throw InputError(
        {rig.file.string(), 0},
        fmt::format("spectrum.segment is {:g} s, but the average of the passages lasts "
                    "{:.4g} s; expected a part of it",
                    *rig.segment,
                    samples / rate));
  return numerics::power_density(
      force, rate, numerics::welch_settings(rig.convention, samples, segment));
}

ProcessedRun process_run(const RigFile& rig, const std::string& name, DrumRecord record) {
  expect_quantity(record, rig.speed, "m/s");
  expect_quantity(record, rig.force, "N");
  expect_varying(record, rig.force);
  if (const auto reason = impossible_load(record.channel(rig.force)))
    throw InputError({record.source, 0}, "channel " + rig.force + " " + *reason);
  expect_spectrum(rig, record);
  for (const std::string& channel : rig.also) (void)record.channel(channel);
  ProcessedRun run{name, std::move(record), {}};
  for (const Plateau& plateau : find_plateaus(run.record, rig.speed, rig.speeds, rig.plateaus)) {
    run.plateaus.push_back(process_plateau(rig, run.record, plateau));
  }
  return run;
}

HammerResult process_hammer(const RigFile& rig, const DrumRecord& record) {
  const RigHammer& test = *rig.hammer;
  const auto hammer = record.channel(test.input), force = record.channel(test.output);
  const auto hits = find_hits(hammer, record.rate, test.settings);
  const auto response = [&](const std::vector<int>& chosen) {
    std::vector<int> firsts;
    for (const int k : chosen) firsts.push_back(hits[k]);
    return hammer_response(hammer, force, record.rate, firsts, test.settings, test.estimator);
  };
  std::vector<int> all(hits.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
  HammerResult result;
  result.measured = response(all);
  const auto start = rig.compensation ? rig.compensation->start : std::nullopt;
  result.fit = fit_to_response(result.measured, rig.band, start);
  const int draws = rig.compensation ? rig.compensation->bootstrap : 0;
  if (draws > 0 && hits.size() > 1) {
    const auto d = bootstrap_deviation(
        static_cast<int>(hits.size()), draws, 1, [&](const std::vector<int>& chosen) {
          const auto r = fit_to_response(response(chosen), rig.band, result.fit.response).response;
          return std::vector<double>{r.gain(), r.f, r.zeta, r.c};
        });
    result.over_hits = {d[0], d[1], d[2], d[3]};
  }
  return result;
}

RigResults process(const RigFile& rig, const RigProgress& progress) {
  const long total =
      static_cast<long>(2 * rig.runs.size()) + (rig.hammer ? 1 : 0) + (rig.compensation ? 1 : 0);
  long done = 0;
  std::vector<std::string> needed{rig.pulses.empty() ? rig.speed : rig.pulses, rig.force};
  needed.insert(needed.end(), rig.also.begin(), rig.also.end());
  RigResults results;
  for (const RigRun& run : rig.runs) {
    progress(done++, total, "reading " + run.file.filename().string());
    DrumRecord record = read_record(rig, run.file, needed, "run " + run.name, results.ledgers);
    if (!rig.pulses.empty()) add_speed(rig, record);
    progress(done++, total, "passages of " + run.name);
    results.runs.push_back(process_run(rig, run.name, std::move(record)));
  }
  if (rig.hammer) {
    progress(done++, total, "hammer test");
    results.hammer = process_hammer(rig,
                                    read_record(rig,
                                                rig.hammer->file,
                                                {rig.hammer->input, rig.hammer->output},
                                                "hammer test",
                                                results.ledgers));
  }
  if (rig.compensation) {
    progress(done++, total, "compensation");
    results.compensation = compensate(rig, results.runs, results.hammer);
  }
  progress(total, total, "");
  return results;
}

}  // namespace latsch::correlation
