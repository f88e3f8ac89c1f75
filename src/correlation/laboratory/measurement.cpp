// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/document_record.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "correlation/laboratory/columns_hint.h"
#include "correlation/laboratory/frame_conversion.h"
#include "correlation/laboratory/lab_record.h"
#include "correlation/laboratory/measurement_zero.h"
#include "correlation/laboratory/record_ledger.h"
#include "correlation/laboratory/sign_advice.h"
#include "measurement/meaning/channel_checks.h"
#include "measurement/meaning/channel_words.h"
#include "measurement/meaning/natural_unit.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

constexpr long kMostThinned = 1'000'000;

std::vector<std::string> names_of(const Channels& channels) {
  std::vector<std::string> names;
  for (const Channel& channel : channels.all()) names.push_back(channel.name);
  return names;
}

/// Reads one window or several.
std::vector<std::string> windows_of(const Node& table, const std::string& key) {
  DocumentRecord::expects(table, key, R"(a window such as "900 N .. 1200 N" or a list of windows)");
  try {
    return {table.text(key)};
  } catch (const InputError&) {
  }
  try {
    return table.texts(key);
  } catch (const InputError&) {
    table.reject(key, "is not a window such as \"900 N .. 1200 N\", nor a list of them");
  }
}

std::vector<fs::path> read_files(const Node& table, const fs::path& folder) {
  if (table.has("file") == table.has("files"))
    table.reject("file", "or files is required, exactly one of the two");
  const char* key = table.has("file") ? "file" : "files";
  std::vector<std::string> names =
      table.has("file") ? std::vector<std::string>{table.text("file")} : table.texts("files");
  if (names.empty()) table.reject("files", "is empty, expected at least one");
  std::vector<fs::path> files;
  for (const std::string& name : names) {
    const fs::path file = folder / name;
    if (!fs::exists(file)) table.reject(key, "is " + in_quotes(name) + ", which does not exist");
    for (const fs::path& other : files)
      if (fs::equivalent(file, other))
        table.reject(key,
                     "names " + in_quotes(name) +
                         " twice: its samples would count as two measurements of the same; "
                         "expected each file once");
    files.push_back(file);
  }
  return files;
}

/// Reads "P_kPa [kPa]" as "P_kPa", "kPa"; a "-" before the name changes the sign.
std::map<std::string, StatedColumn> read_columns(const Node& table) {
  std::map<std::string, StatedColumn> columns;
  const auto stated = table.find_table("columns");
  if (!stated) return columns;
  for (const std::string& ours : stated->keys()) {
    const std::string text = stated->text(ours);
    const auto bracket = text.ends_with(']') ? text.rfind('[') : text.npos;
    StatedColumn column{std::string(trimmed(std::string_view(text).substr(0, bracket))), ""};
    column.place = stated->place(ours);
    if (column.column.starts_with('-')) {
      column.sign = -1.0;
      column.column = trimmed(std::string_view(column.column).substr(1));
    }
    if (column.column.empty())
      stated->reject(ours, "is " + in_quotes(text) + ", a column without a name");
    if (bracket != text.npos) {
      column.unit = trimmed(std::string_view(text).substr(bracket + 1, text.size() - bracket - 2));
      const UnitReading reading = reading_of_unit(column.unit);
      if (!reading.unit)
        stated->reject(ours, "is " + in_quotes(text) + ", which has " + reading.fault);
    }
    for (const auto& [other, before] : columns) {
      if (before.column == column.column)
        stated->reject(ours, "is " + in_quotes(text) + ", the column that " + other + " is, too");
      if (same_channel(other, ours))
        stated->reject(ours,
                       "is " + in_quotes(text) + ", but " + other + " is the same channel and is " +
                           in_quotes(before.column));
    }
    columns[ours] = column;
  }
  return columns;
}

/// Returns advice for a record whose axes are stated but whose loads alone have the opposite sign.
std::string loads_of_other_sign(const LabRecord& record, const std::string& axes) {
  LabRecord turned_loads = record;
  Channel* Fz = turned_loads.find("Fz");
  if (!Fz) return "";
  for (double& value : Fz->values) value = -value;
  const auto fitting = conventions_that_fit(turned_loads);
  if (std::find(fitting.begin(), fitting.end(), axes) == fitting.end()) return "";
  return fmt::format("; or the loads alone have the other sign: then say {} beside axes = {}",
                     turned(record, Fz->name),
                     in_quotes(axes));
}

/// True if the record holds motions of a wheel on a K&C rig.
bool holds_motions(const LabRecord& record) {
  return std::any_of(record.channels.begin(), record.channels.end(), [](const Channel& channel) {
    return channel.name.starts_with("dx") || channel.name.starts_with("toe") ||
           channel.name.starts_with("caster");
  });
}

void check_signs(const Node& table, const LabRecord& record, const std::string& axes) {
  auto fitting = conventions_that_fit(record);
  if (std::find(fitting.begin(), fitting.end(), axes) != fitting.end()) return;
  if (!holds_motions(record)) std::erase(fitting, "adams");  // axes of cars, not of tires
  std::string found;
  for (const char* name : {"Fz", "Fy", "alpha"})
    if (const Channel* channel = record.find(name))
      found += fmt::format(
          "{}{} goes {}", found.empty() ? "" : ", ", channel->name, range_in_words(*channel));
  table.reject(
      "axes",
      fmt::format("is {}, but these signs are not: {}, where a load has to be {} and a side "
                  "force against its slip angle; {}{}",
                  in_quotes(axes),
                  found,
                  axes == "sae" ? "negative" : "positive",
                  fitting.empty() ? "no convention has such signs: is a column of another "
                                    "sign than the others?"
                                  : "they are as in " + list_of(fitting),
                  loads_of_other_sign(record, axes)));
}

/// Turns the record into the axes that the table states.
void turn_frames(const Node& table, LabRecord& record, Measurement::Told& told) {
  const std::string to = table.choice("in_frame", {"W", "H", "C"});
  const std::string fault = turn_into_frame(record, told.frame, axis_frame_of(to), told.words);
  if (!fault.empty()) table.reject("in_frame", "is " + in_quotes(to) + ", but " + fault);
  told.frame = to;
}

void read_shift(const Node& table, LabRecord& record, std::vector<std::string>& words) {
  if (!table.has("shift")) return;
  const double shift = table.quantity("shift", "s");
  Channel* time = record.find("time");
  if (!time) table.reject("shift", "needs a channel time, and there is none");
  note_use(record, "time", "shift");
  for (double& value : time->values) value += shift;
  words.push_back("time shifted by " + format_quantity(shift, "s"));
}

/// Keeps the samples that a mask selects and reports their number; throws InputError for `key` if
/// none is left.
void narrow(const Node& table,
            const std::string& key,
            const std::string& what,
            const std::vector<bool>& mask,
            const LabRecord& record,
            std::vector<bool>& kept,
            std::vector<std::string>& words) {
  const std::vector<bool> before = kept;
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = kept[i] && mask[i];
  const auto count = [](const std::vector<bool>& one) {
    return std::count(one.begin(), one.end(), true);
  };
  if (count(kept) == 0) {
    LabRecord left = record;
    keep(left, before);
    table.reject(
        key,
        fmt::format("is {}, which leaves none of {} samples, where {} goes {} (before: {})",
                    in_quotes(what),
                    count(before),
                    key,
                    range_in_words(*left.find(key)),
                    words.back()));
  }
  words.push_back(fmt::format("{} {}: {} of {} samples", key, what, count(kept), count(before)));
}

/// Adds a doubt about a sweep whose direction changes every few samples: such a channel is constant
/// except for noise.
void doubt_sweep(const std::vector<int>& directions,
                 const Channel& channel,
                 const Place& place,
                 LabRecord& record) {
  // least number of samples between turning points; with a larger value coarse sweeps would be
  // doubted
  constexpr double kFewest = 4.0;
  double changes = 0.0, samples = 0.0;
  int last = 0;
  for (const int direction : directions) {
    if (direction == 0) continue;
    ++samples;
    changes += last != 0 && direction != last;
    last = direction;
  }
  if (changes < 2.0 || samples >= kFewest * (changes + 1.0)) return;
  record.ledgers.front().doubts.push_back(
      {record.written.at(channel.name).column,
       fmt::format(
           "sweep keeps samples by the direction of {}, which changes every {} samples: the "
           "channel goes {} and may be constant but for noise; expected a channel that is "
           "swept",
           channel.name,
           format_number(samples / (changes + 1.0), 2),
           range_in_words(channel)),
       place});
}

void read_sweeps(const Node& table,
                 LabRecord& record,
                 std::vector<bool>& kept,
                 std::vector<std::string>& words) {
  const auto sweep = table.find_table("sweep");
  if (!sweep) return;
  const auto stretches = stretches_of(record.time(), record.samples());
  note_use(record, "time", "sweep");
  for (const std::string& key : sweep->keys()) {
    const Channel& channel = channel_of(*sweep, key, record);
    const std::string way = sweep->choice(key, {"rising", "falling"});
    note_use(record, key, "sweep");
    const auto directions = directions_of(channel.values, stretches);
    doubt_sweep(directions, channel, sweep->place(key), record);
    std::vector<bool> mask;
    for (const int one : directions) mask.push_back(one == (way == "rising" ? 1 : -1));
    narrow(*sweep, key, way, mask, record, kept, words);
  }
}

void read_selection(const Node& table,
                    LabRecord& record,
                    std::vector<bool>& kept,
                    std::vector<std::string>& words) {
  const auto select = table.find_table("select");
  if (!select) return;
  for (const std::string& key : select->keys()) {
    const Channel& channel = channel_of(*select, key, record);
    note_use(record, key, "select");
    std::vector<bool> mask(record.samples(), false);
    std::string what;
    for (const std::string& text : windows_of(*select, key)) {
      const auto [window, fault] = parse_window(text, channel.unit);
      if (!window) select->reject(key, "is " + in_quotes(text) + ", " + fault);
      for (std::size_t i = 0; i < mask.size(); ++i)
        mask[i] = mask[i] || (channel.values[i] >= window->from && channel.values[i] <= window->to);
      what += (what.empty() ? "" : " or ") + text;
    }
    narrow(*select, key, what, mask, record, kept, words);
  }
}

void read_every(const Node& table, std::vector<bool>& kept, std::vector<std::string>& words) {
  if (!table.has("every")) return;
  const long every = table.integer("every", 1, kMostThinned);
  long count = 0, left = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) continue;
    kept[i] = count++ % every == 0;
    left += kept[i] ? 1 : 0;
  }
  words.push_back(fmt::format("one of every {}: {} of {} samples", every, left, count));
}

std::map<std::string, MeasurementNoise> read_noises(const Node& table, LabRecord& record) {
  std::map<std::string, MeasurementNoise> noises;
  const auto noise = table.find_table("noise");
  if (!noise) return noises;
  for (const std::string& key : noise->keys()) {
    const Channel& channel = channel_of(*noise, key, record);
    noises[channel.name] = *read_noise(*noise, channel.unit, key);
  }
  return noises;
}

void tell_what_is_left(const LabRecord& record, std::vector<std::string>& words) {
  for (const Channel& channel : record.channels)
    words.push_back(channel.name + " " + range_in_words(channel));
  for (const auto& [name, why] : record.left_out) words.push_back(name + " is left out: it " + why);
}

/// Returns the columns as the file calls them, with the channel that each became:
/// `"Einfederung" (deflection), "TSTX"`.
std::string columns_in_words(const Measurement::Told& told) {
  constexpr std::size_t kMost = 30;
  std::string text;
  std::size_t count = 0;
  for (const Channel& channel : told.channels.all()) {
    if (++count > kMost) continue;
    const std::string& column = told.written.at(channel.name).column;
    text += (text.empty() ? "" : ", ") + in_quotes(column) +
            (column == channel.name ? "" : " (" + channel.name + ")");
  }
  return count > kMost ? text + fmt::format(" and {} more", count - kMost) : text;
}

/// Returns what a channel of another dimension most likely is if an angle is expected.
std::string about_angle(const std::string& channel,
                        const std::string& written,
                        const std::string& si_unit_read,
                        const std::string& expected) {
  if (expected != "rad") return "";
  if (written == "min") return " (minutes of arc are \"arcmin\")";
  if (written == "s" || written == "sec") return " (seconds of arc are \"arcsec\")";
  const bool is_toe = channel.starts_with("toe") || channel.starts_with("Toe");
  if (!is_toe || si_unit_read != "m") return "";
  return " (a toe in millimeters depends on the diameter d at which it was measured: its angle is "
         "asin(toe / d), or half of that for the toe of both wheels)";
}

/// Returns the struct or group that the measurement names; empty if it names none.
std::string read_part(const Node& table) {
  if (!table.has("group")) return table.has("struct") ? table.text("struct") : "";
  if (table.has("struct")) table.reject("group", "is given beside struct, expected one of them");
  if (table.has("resample"))
    table.reject("group", "is given beside resample, which joins all groups; expected one of them");
  return table.text("group");
}

void take(LabRecord record, Measurement::Told& told) {
  told.channels = record.table();
  told.left_out = std::move(record.left_out);
  for (const auto& [channel, others] : record.ambiguous)
    told.ambiguous[channel] = ambiguity(record, channel);
  told.ledgers = std::make_shared<std::vector<Ledger>>(std::move(record.ledgers));
  told.structs = std::move(record.structs);
  told.part_word = std::move(record.part_word);
  told.written = std::move(record.written);
  told.stated = std::move(record.stated);
  told.sources = std::move(record.sources);
  told.turned_from = std::move(record.turned_from);
  told.places = std::move(record.places);
  told.numbers = std::move(record.numbers);
}

}  // namespace

Measurement read_measurement(const Node& table, const fs::path& folder) {
  Measurement::Told told;
  told.name = table.name();
  told.place = table.place();
  // A virtual recording is a file like another; laboratory/virtual_recording.h writes it.
  if (const auto source = table.find_table("virtual")) {
    told.words.push_back("virtual: test " + source->text("test") + " of " + source->text("model"));
  }
  told.files = read_files(table, folder);
  if (table.has("frame")) told.frame = table.choice("frame", {"W", "H", "C"});
  const std::string part = read_part(table);
  const double resampled =
      table.has("resample") ? table.quantity("resample", "s", Range::positive()) : 0.0;
  LabRecord record = join_files(told.files, read_columns(table), part, resampled, told.words);
  if (record.samples() == 0) table.reject("file", "holds no sample");
  if (table.has("axes")) {
    const std::string axes = table.choice("axes", axis_convention_names());
    told.axes = axis_convention_of(axes);
    if (const auto fault = fault_of_axes(record.table(), told.axes); !fault.empty())
      table.reject("axes", fault);
    check_signs(table, record, axes);
    turn_axes(record, told.axes);
    told.words.push_back("signs of " + axes + (axes == "iso" ? "" : ", turned to iso"));
  }
  note_axes(record, told.axes, table.has("axes"));
  told.recorded = record.table();
  read_zero(table, record, told.words);
  if (table.has("in_frame")) turn_frames(table, record, told);
  if (table.has("low_pass")) note_use(record, "time", "low_pass");
  if (table.has("low_pass"))
    told.words.push_back(low_pass(
        record, table.quantity("low_pass", "Hz", Range::positive()), table.place("low_pass")));
  read_shift(table, record, told.words);
  std::vector<bool> kept(record.samples(), true);
  read_sweeps(table, record, kept, told.words);
  read_selection(table, record, kept, told.words);
  read_every(table, kept, told.words);
  keep(record, kept);
  told.noise = read_noises(table, record);
  tell_what_is_left(record, told.words);
  std::vector<std::string> selected;
  if (const auto select = table.find_table("select")) selected = select->keys();
  told.suspects = suspect_numbers(record, told.name, selected, table.has("low_pass"));
  check_channels(record, table.has("axes") ? std::optional(told.axes) : std::nullopt, true);
  for (const char* step : {"zero", "low_pass", "sweep", "every", "select"})
    if (table.has(step)) told.one_way.emplace_back(step);
  take(std::move(record), told);
  return Measurement(std::move(told));
}

Measurement read_measurement(const fs::path& file, std::optional<AxisConvention> axes) {
  Measurement::Told told;
  told.name = file.filename().string();
  told.is_stated = false;
  told.files = {file};
  LabRecord record = join_files(told.files, {}, "", 0.0, told.words);
  told.place = record.header;
  told.axes = axes.value_or(AxisConvention::iso);
  turn_axes(record, told.axes);
  note_axes(record, told.axes, axes.has_value());
  told.recorded = record.table();
  told.suspects = suspect_numbers(record, "", {}, false);
  check_channels(record, axes, false);
  take(std::move(record), told);
  return Measurement(std::move(told));
}

MeasuredFile read_measured_file(const fs::path& file, std::optional<AxisConvention> axes) {
  const Measurement measurement = read_measurement(file, axes);
  if (measurement.samples() == 0)
    throw InputError({file.string(), 0},
                     "has names of columns and no row of numbers: was its end cut off?");
  MeasuredFile read{measurement.channels(), measurement.ledgers().front()};
  for (const ChannelDoubt& gap : gaps_in(read.channels))
    read.ledger.doubts.push_back({gap.channel,
                                  "column " + in_quotes(gap.channel) + " " + gap.sentence,
                                  measurement.place(gap.sample)});
  return read;
}

NamedChannel Measurement::named(const std::string& channel) const {
  const NamedChannel found = find_named(names_of(told_.channels), channel);
  const std::string force = force_without_frame(channel);
  if (!found.name.empty() || told_.frame.empty() || force.empty() ||
      force.substr(0, 2) + told_.frame + force.substr(2) != channel)
    return found;
  return find_named(names_of(told_.channels), force);  // the table states the frame
}

bool Measurement::has(const std::string& channel) const { return !named(channel).name.empty(); }

std::string Measurement::name_of(const std::string& channel) const { return named(channel).name; }

bool Measurement::is_turned(const std::string& channel) const {
  return told_.turned_from.contains(named(channel).name);
}

std::string Measurement::frame(const std::string& channel) const {
  const NamedChannel found = named(channel);
  if (!found.frame.empty()) return found.frame;
  const std::string force = force_without_frame(found.name);
  if (force.empty()) return "";
  return force == found.name ? told_.frame : found.name.substr(2, 1);
}

const std::string& Measurement::unit(const std::string& channel) const {
  return told_.channels.find(named(channel).name)->unit;
}

const StatedColumn& Measurement::written(const std::string& channel) const {
  return told_.written.at(named(channel).name);
}

const MeasurementNoise* Measurement::noise(const std::string& channel) const {
  const auto found = told_.noise.find(named(channel).name);
  return found == told_.noise.end() ? nullptr : &found->second;
}

std::string Measurement::other_dimension(const std::string& found,
                                         const std::string& wanted,
                                         const std::string& unit) const {
  const StatedColumn& column = told_.written.at(found);
  const std::string key = key_for(wanted, column.column);
  const std::string noun = words_for(Unit::of(unit)).noun;
  const std::string table = "[measurement." + (told_.is_stated ? told_.name : "NAME") + "]";
  if (column.unit.empty()) {
    const std::string hint =
        columns_hint(told_.stated, key, with_natural_unit(column, unit)) + " in " + table;
    const auto source = told_.sources.find(found);
    const bool in_file = !told_.is_stated && source != told_.sources.end();
    return fmt::format(
        "column {} has no unit, expected {}, such as {}{}",
        in_quotes(column.column),
        noun,
        in_file ? formats::unit_in_file(source->second, natural_unit(unit)) + " in its file, or "
                : "",
        hint);
  }
  std::vector<std::string> others;  // columns that are not recognized as any other channel
  for (const Channel& other : told_.channels.all()) {
    const StatedColumn& theirs = told_.written.at(other.name);
    const bool is_other = recognized(theirs.column) && !same_channel(theirs.column, found);
    const bool fits =
        !is_other && (theirs.unit.empty() ? other.unit == "1" && !recognized(theirs.column)
                                          : Unit::of(other.unit).same_dimension(Unit::of(unit)));
    if (fits) others.push_back(theirs.column);
  }
  std::string text = fmt::format("column {} is in {}, expected {}: correct the unit in its file",
                                 in_quotes(column.column),
                                 in_quotes(column.unit),
                                 noun) +
                     about_angle(found, column.unit, told_.channels.find(found)->unit, unit);
  if (others.empty()) return text;
  const auto first = std::find_if(told_.written.begin(), told_.written.end(), [&](auto& one) {
    return one.second.column == others.front();
  });
  return text + ", or take another column, such as " +
         columns_hint(told_.stated, key, with_natural_unit(first->second, unit)) + " in " + table +
         (others.size() == 1 ? "" : " (columns that may be it: " + list_of(others) + ")");
}

const std::vector<double>& Measurement::values(const std::string& channel,
                                               const std::string& unit) const {
  const std::string of = told_.is_stated ? "measurement." + told_.name + ": " : "";
  const NamedChannel found = named(channel);
  const auto names = names_of(told_.channels);
  if (found.name.empty()) {
    std::vector<std::string> left_out;
    for (const auto& [name, why] : told_.left_out) left_out.push_back(name);
    const auto reason = told_.left_out.find(find_named(left_out, channel).name);
    if (reason != told_.left_out.end())
      throw InputError(told_.place,
                       of + "column " + in_quotes(channel) + " " + reason->second + " (" +
                           told_.files.front().filename().string() + ")");
    throw InputError(told_.place,
                     of + "column " + in_quotes(channel) + " is missing" +
                         did_you_mean(channel, names) + " (columns: " + columns_in_words(told_) +
                         ")" + way_out_of_missing(channel, unit));
  }
  if (const auto both = told_.ambiguous.find(found.name); both != told_.ambiguous.end())
    throw InputError(told_.place, of + both->second);
  const Channel& values = *told_.channels.find(found.name);
  if (!Unit::of(values.unit).same_dimension(Unit::of(unit)))
    throw InputError(told_.place, of + other_dimension(found.name, channel, unit));
  const auto is_gap = [](double value) { return std::isnan(value); };
  const auto gap = std::find_if(values.values.begin(), values.values.end(), is_gap);
  if (gap != values.values.end())
    throw InputError(
        told_.places[static_cast<std::size_t>(gap - values.values.begin())],
        fmt::format("{}{} is no finite number here, the first of {} gaps in {} samples: fill them, "
                    "cut them off, or leave them out by a [measurement.NAME.select] of the time",
                    of,
                    found.name,
                    std::count_if(gap, values.values.end(), is_gap),
                    values.values.size()));
  return values.values;
}

bool Measurement::could_be(const std::string& channel, const std::string& unit) const {
  std::vector<std::string> left_out;
  for (const auto& [name, why] : told_.left_out) left_out.push_back(name);
  const NamedChannel found = named(channel);
  if (found.name.empty()) return !find_named(left_out, channel).name.empty();
  const Channel& values = *told_.channels.find(found.name);
  const bool is_code = written(channel).column.size() == 1;  // "V" may be a voltage
  return !is_code || Unit::of(values.unit).same_dimension(Unit::of(unit)) ||
         written(channel).unit.empty();
}

Laboratory read_laboratory(const Node& study, const fs::path& folder) {
  Laboratory laboratory;
  for (const Node& table : study.named_tables("measurement"))
    laboratory.push_back(std::make_shared<Measurement>(read_measurement(table, folder)));
  return laboratory;
}

std::shared_ptr<const Measurement> find(const Laboratory& laboratory, const std::string& name) {
  for (const auto& measurement : laboratory)
    if (measurement->name() == name) return measurement;
  return nullptr;
}

}  // namespace latsch::correlation
