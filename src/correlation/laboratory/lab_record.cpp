// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/lab_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/text.h"
#include "base/units.h"
#include "correlation/laboratory/channel_names.h"
#include "correlation/laboratory/record_ledger.h"
#include "formats/tables/lab_table.h"
#include "formats/text/letter_case.h"
#include "measurement/meaning/channel_sense.h"
#include "measurement/meaning/channel_words.h"
#include "measurement/meaning/filler_numbers.h"
#include "numerics/signals/butterworth.h"

namespace latsch::correlation {
namespace {

/// Moves a unit in a name, such as "SA_deg" or "P_kPa", to the unit of a column that states none,
/// if the unit suits the quantity that the rest of the name means.
void take_units_of_names(formats::LabTable& table) {
  Channels read;
  for (std::size_t k = 0; k < table.channels.all().size(); ++k) {
    Channel channel = table.channels.all()[k];
    const auto known = recognized(channel.name);
    const auto unit = known && table.units[k].empty() && !known->unit.empty()
                          ? Unit::find(known->unit)
                          : std::nullopt;
    if (unit && unit->same_dimension(Unit::of(known->meaning->unit))) {
      for (double& value : channel.values) value = unit->to_si(value);
      channel.unit = known->meaning->unit;
      table.units[k] = known->unit;
    }
    read.add(std::move(channel));
  }
  table.channels = std::move(read);
}

/// Finds filler numbers and limits of sensors among the numbers as they are written in the file.
void note_suspects(LabRecord& record) {
  for (const Channel& channel : record.channels) {
    const StatedColumn& written = record.written.at(channel.name);
    const auto known = written.unit.empty() ? std::nullopt : Unit::find(written.unit);
    const Unit unit = known.value_or(Unit::of(channel.unit));
    std::vector<double> numbers = channel.values;
    const auto source = record.sources.find(channel.name);
    const bool is_negative = source != record.sources.end() && source->second.is_negative;
    const double sign = is_negative ? -written.sign : written.sign;
    for (double& value : numbers) value = unit.from_si(sign * value);
    const bool is_force = !force_without_frame(channel.name).empty();
    for (const FillerNumber& filler : filler_numbers(numbers, is_force)) {
      SuspectSamples suspect{channel.name, "", filler.reason, {}, filler.is_certain};
      const std::string text = written.unit.empty() ? "" : " " + written.unit;
      suspect.number = format_number(filler.number, 10) + text;
      for (const std::size_t i : filler.samples)
        suspect.samples.push_back(static_cast<double>(i + 1));
      record.suspects.push_back(std::move(suspect));
    }
  }
}

/// Turns the height of the wheel center of a TYDEX file, DSTGRWHC, into the loaded radius in the
/// wheel's plane, height / cos gamma, unless the study itself states that the column is the loaded
/// radius. Returns a remark for the ledger; empty if there is no such column.
std::string radius_of_height(LabRecord& record) {
  Channel* radius = record.find("loaded_radius");
  if (!radius) return "";
  const std::string& column = record.written.at(radius->name).column;
  if (!is_height_of_center(column)) return "";
  if (record.stated.contains(radius->name)) return "is the loaded radius itself, as stated";
  const Channel* gamma = record.find("gamma");
  constexpr const char* kHeight = "is the height of the wheel center above the ground; ";
  if (!gamma || gamma->unit != "rad")
    return std::string(kHeight) +
           "the loaded radius is equal to it, because no inclination is in "
           "the file";
  double most = 1.0;
  for (std::size_t i = 0; i < radius->values.size(); ++i) {
    const double cosine = std::cos(gamma->values[i]);
    radius->values[i] /= cosine;
    if (std::isfinite(cosine)) most = std::max(most, 1.0 / cosine);
  }
  return fmt::format(
      "{}the loaded radius in the wheel's plane is it over the cosine of {}, up to {:.2g} % more; "
      "if the column is that radius already, say columns = {{loaded_radius = \"{}\"}}",
      kHeight,
      record.written.at(gamma->name).column,
      100.0 * (most - 1.0),
      column);
}

/// Puts the remark into the row of the loaded radius. A radius that was computed from a height is
/// an assumption of its own, so that the summary of the file names it.
void note_radius(const std::string& remark, LabRecord& record) {
  const std::string name = record.find("loaded_radius")->name;
  Ledger& ledger = record.ledgers.back();
  if (LedgerRow* row = ledger.find_taken(name)) row->remark = remark;
  if (remark.find("over the cosine") == remark.npos) return;
  LedgerRow computed;
  computed.taken_as = name;
  computed.state = LedgerState::assumed;
  computed.remark = fmt::format("is the height {} of the wheel center over the cosine of {}",
                                record.written.at(name).column,
                                record.written.at(record.find("gamma")->name).column);
  ledger.rows.push_back(std::move(computed));
}

/// Returns the record with Latsch's names. If two columns claim one name, the first one keeps it.
LabRecord record_of(formats::LabTable table, const std::map<std::string, StatedColumn>& columns) {
  take_units_of_names(table);
  std::map<std::string, std::string> stated;  // the file's name -> Latsch's name
  for (const auto& [ours, theirs] : columns) stated[theirs.column] = ours;
  LabRecord record;
  record.stated = columns;
  for (const auto& [theirs, why] : table.left_out) {
    const auto found = stated.find(theirs);
    record.left_out[found == stated.end() ? theirs : found->second] = why;
  }
  record.header = table.header;
  record.structs = table.structs;
  record.part_word = table.part_word;
  std::set<std::string> taken;
  for (const auto& [theirs, ours] : stated) taken.insert(ours);
  for (std::size_t k = 0; k < table.channels.all().size(); ++k) {
    const Channel& channel = table.channels.all()[k];
    const auto found = stated.find(channel.name);
    std::string name = found == stated.end() ? our_name(channel.name, channel.unit) : found->second;
    if (found == stated.end() && !taken.insert(name).second) {
      if (!columns.contains(name)) record.ambiguous[name].push_back(channel.name);
      name = channel.name;  // another column already has the name in the vocabulary
      if (!taken.insert(name).second) continue;
    }
    const double sign = found == stated.end() ? 1.0 : columns.at(name).sign;
    record.channels.push_back({name, channel.unit, channel.values});
    if (sign < 0.0)
      for (double& value : record.channels.back().values) value = -value;
    record.written[name] = {channel.name, table.units[k], sign};
    if (k < table.columns.size()) record.sources[name] = table.columns[k];
  }
  const std::size_t samples = record.channels.empty() ? 0 : record.channels[0].values.size();
  for (std::size_t i = 0; i < samples; ++i) record.places.push_back(table.place(i));
  note_suspects(record);
  const std::string remark = radius_of_height(record);
  record.ledgers.push_back(ledger_of(table, record));
  if (!remark.empty()) note_radius(remark, record);
  return record;
}

void append(const LabRecord& more, const std::string& file, LabRecord& record) {
  std::erase_if(record.channels, [&](const Channel& channel) {
    const Channel* other = more.find(channel.name);
    if (other && other->name == channel.name && other->unit == channel.unit) return false;
    record.left_out[channel.name] = "is not in " + file;
    return true;
  });
  for (Channel& channel : record.channels) {
    const auto& values = more.find(channel.name)->values;
    channel.values.insert(channel.values.end(), values.begin(), values.end());
  }
  for (SuspectSamples suspect : more.suspects) {
    for (double& sample : suspect.samples) sample += static_cast<double>(record.samples());
    record.suspects.push_back(std::move(suspect));
  }
  record.places.insert(record.places.end(), more.places.begin(), more.places.end());
  record.ledgers.insert(record.ledgers.end(), more.ledgers.begin(), more.ledgers.end());
  record.ambiguous.insert(more.ambiguous.begin(), more.ambiguous.end());
}

/// Filters between gaps; stretches shorter than `least` become gaps.
void filter_stretch(const std::vector<numerics::FilterSection>& sections,
                    const Stretch& stretch,
                    std::size_t least,
                    std::vector<double>& values) {
  std::size_t first = stretch.first;
  while (first < stretch.end) {
    std::size_t end = first;
    while (end < stretch.end && !std::isnan(values[end])) ++end;
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
    const auto until = values.begin() + static_cast<std::ptrdiff_t>(end);
    if (end - first > least) {
      const std::vector<double> part(begin, until);
      const auto smooth = numerics::filter_forward_backward(sections, part);
      std::copy(smooth.begin(), smooth.end(), begin);
    } else {
      std::fill(begin, until, std::nan(""));
    }
    first = end + 1;
  }
}

}  // namespace

bool is_height_of_center(const std::string& column) { return formats::lower(column) == "dstgrwhc"; }

std::vector<std::string> LabRecord::names() const {
  std::vector<std::string> names;
  for (const Channel& channel : channels) names.push_back(channel.name);
  return names;
}

const Channel* LabRecord::find(const std::string& name) const {
  const std::string found = find_named(names(), name).name;
  const auto channel = std::find_if(
      channels.begin(), channels.end(), [&](const Channel& one) { return one.name == found; });
  return found.empty() || channel == channels.end() ? nullptr : &*channel;
}

Channel* LabRecord::find(const std::string& name) {
  return const_cast<Channel*>(std::as_const(*this).find(name));
}

std::vector<double> LabRecord::time() const {
  const Channel* time = find("time");
  return time && time->unit == "s" ? time->values : std::vector<double>{};
}

Channels LabRecord::table() const {
  Channels table;
  for (const Channel& channel : channels) table.add(channel);
  return table;
}

LabRecord join_files(const std::vector<std::filesystem::path>& files,
                     const std::map<std::string, StatedColumn>& columns,
                     const std::string& part,
                     double resampled,
                     std::vector<std::string>& words) {
  std::map<std::string, std::string> units;
  std::map<std::string, std::string> ours_of;
  for (const auto& [ours, theirs] : columns) {
    units[theirs.column] = theirs.unit;
    ours_of[theirs.column] = ours;
    if (theirs.sign < 0.0)
      words.push_back(ours + " is " + theirs.column + " with its sign changed");
  }
  const auto expected = [&](const std::string& theirs) {
    const auto ours = ours_of.find(theirs);
    return dimension_of_name(ours == ours_of.end() ? theirs : ours->second);
  };
  // Recordings in different folders often have the same file name.
  const auto name_of = [&](const std::filesystem::path& file) {
    const auto same = std::count_if(files.begin(), files.end(), [&](const auto& other) {
      return other.filename() == file.filename();
    });
    return same == 1 ? file.filename().string()
                     : (file.parent_path().filename() / file.filename()).string();
  };
  LabRecord record;
  for (const std::filesystem::path& file : files) {
    LabRecord more =
        record_of(formats::read_lab_table(file, units, expected, part, resampled), columns);
    words.push_back(fmt::format(
        "{}: {} samples of {} channels", name_of(file), more.samples(), more.channels.size()));
    if (record.channels.empty()) {
      record = std::move(more);
    } else {
      append(more, name_of(file), record);
    }
  }
  for (std::size_t i = 0; i < record.samples(); ++i)
    record.numbers.push_back(static_cast<double>(i + 1));
  record.stated = columns;
  return record;
}

std::string fault_of_axes(const Channels& channels, AxisConvention axes) {
  if (axes != AxisConvention::adams) return "";
  for (const Channel& channel : channels.all())
    if (channel_senses(channel.name).of == ChannelSense::slip)
      return fmt::format(
          "is \"adams\" (x rearward, y to the right, z up), which are axes of a car and do not "
          "define {}: say the axes of the tire test (iso, adapted_sae or sae), or turn single "
          "columns by columns = {{Fx = \"-Fx\"}}",
          channel.name);
  return "";
}

void turn_axes(LabRecord& record, AxisConvention axes) {
  if (const std::string fault = fault_of_axes(record.table(), axes); !fault.empty())
    throw InputError(record.header, "the convention of axes " + fault);
  record.channels = to_iso(record.table(), axes).all();
}

std::vector<std::string> conventions_that_fit(const LabRecord& record) {
  constexpr double kMost = 0.9;     // share of the samples, because a wheel may leave the road
  constexpr double kClearly = 0.5;  // correlation of side force and slip angle
  const auto fits = [&](const LabRecord& one) {
    const Channel *Fz = one.find("Fz"), *Fy = one.find("Fy"), *alpha = one.find("alpha");
    if (Fz) {
      const auto pulls = std::count_if(
          Fz->values.begin(), Fz->values.end(), [](double value) { return value < 0.0; });
      if (static_cast<double>(pulls) > kMost * static_cast<double>(one.samples())) return false;
    }
    if (!Fy || !alpha) return true;
    // about zero, not about the means, because the force has the sign of the slip
    double yy = 0.0, aa = 0.0, ya = 0.0;
    for (std::size_t i = 0; i < one.samples(); ++i) {
      const double y = Fy->values[i], a = alpha->values[i];
      if (std::isnan(y * a)) continue;
      yy += y * y, aa += a * a, ya += y * a;
    }
    return !(ya > kClearly * std::sqrt(yy * aa));
  };
  std::vector<std::string> names;
  for (const std::string& name : axis_convention_names()) {
    if (!fault_of_axes(record.table(), axis_convention_of(name)).empty()) continue;
    LabRecord turned = record;
    turn_axes(turned, axis_convention_of(name));
    if (fits(turned)) names.push_back(name);
  }
  return names;
}

std::optional<TakenZero> take_zero(Channel& channel, const std::vector<bool>& mask) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (!mask[i] || std::isnan(channel.values[i])) continue;
    sum += channel.values[i];
    ++count;
  }
  if (count == 0) return std::nullopt;
  const double mean = sum / static_cast<double>(count);
  for (double& value : channel.values) value -= mean;
  return TakenZero{mean, count};
}

std::string low_pass(LabRecord& record, double frequency, const Place& place) {
  constexpr int kOrder = 2;
  const auto time = record.time();
  if (time.empty()) throw InputError(place, "low_pass needs a channel time, and there is none");
  const auto stretches = stretches_of(time, record.samples());
  const auto longest =
      std::max_element(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) {
        return a.end - a.first < b.end - b.first;
      });
  if (longest->end - longest->first < 2)
    throw InputError(place, "low_pass needs rising times, and no two samples have them");
  const double rate = static_cast<double>(longest->end - longest->first - 1) /
                      (time[longest->end - 1] - time[longest->first]);
  if (!(frequency < 0.5 * rate))
    throw InputError(place,
                     fmt::format("low_pass is {:g} Hz, but at {:.4g} samples a second it has to "
                                 "be below {:.4g} Hz",
                                 frequency,
                                 rate,
                                 0.5 * rate));
  const double lasts = static_cast<double>(longest->end - longest->first) / rate;
  if (frequency * lasts < 1.0)
    throw InputError(place,
                     fmt::format("low_pass is {:g} Hz, which needs a record of {:.4g} s, but this "
                                 "one has {:.4g} s without a gap",
                                 frequency,
                                 1.0 / frequency,
                                 lasts));
  const auto sections = numerics::sections_of(
      numerics::butterworth(kOrder, numerics::FilterBand::low_pass, {frequency}, rate));
  const auto least = static_cast<std::size_t>(numerics::forward_backward_padding(sections));
  std::vector<bool> kept(record.samples(), true);
  std::size_t left_out = 0;
  for (const Stretch& stretch : stretches) {
    if (stretch.end - stretch.first <= least) {
      std::fill(kept.begin() + static_cast<std::ptrdiff_t>(stretch.first),
                kept.begin() + static_cast<std::ptrdiff_t>(stretch.end),
                false);
      left_out += stretch.end - stretch.first;
      continue;
    }
    for (Channel& channel : record.channels)
      if (channel.name != "time") filter_stretch(sections, stretch, least, channel.values);
  }
  keep(record, kept);
  std::string words = fmt::format("low pass {:g} Hz at {:.4g} samples a second, {} {}",
                                  frequency,
                                  rate,
                                  stretches.size(),
                                  stretches.size() == 1 ? "stretch" : "stretches");
  if (left_out > 0)
    words += fmt::format("; {} samples are left out, in stretches of {} at most", left_out, least);
  return words;
}

void keep(LabRecord& record, const std::vector<bool>& kept) {
  const auto filter = [&](auto& values) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (kept[i]) values[count++] = values[i];
    values.resize(count);
  };
  for (Channel& channel : record.channels) filter(channel.values);
  filter(record.places);
  filter(record.numbers);
}

std::string read_unit(const std::string& unit) {
  static const std::map<std::string, std::string> kRead = {
      {"rad", "deg"}, {"Pa", "kPa"}, {"K", "degC"}, {"m/s", "km/h"}};
  const auto read = kRead.find(unit);
  return read == kRead.end() ? unit : read->second;
}

std::string range_in_words(const Channel& channel) {
  const std::string unit = read_unit(channel.unit);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::size_t gaps = 0;
  for (const double value : channel.values) {
    if (std::isnan(value)) ++gaps;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  const std::string in_gaps = gaps == 0 ? "" : fmt::format(", {} gaps", gaps);
  if (gaps == channel.values.size()) return "nothing but gaps";
  const Unit shown = Unit::of(unit);
  return fmt::format("from {} to {}{}{}",
                     format_number(shown.from_si(low), 4),
                     format_number(shown.from_si(high), 4),
                     unit == "1" ? "" : " " + unit,
                     in_gaps);
}

}  // namespace latsch::correlation
