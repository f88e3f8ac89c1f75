// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/tdms_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/text.h"
#include "base/unit_reading.h"
#include "formats/recorders/tdms_segments.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kMostTdmsFacts = 12;

/// Time of a channel: first instant and step, in the unit of its abscissa.
struct TdmsWave {
  double first = 0.0, step = 0.0;
  std::optional<TdmsStamp> start;
  std::string unit = "s", name;
};

std::string text_of_property(const TdmsObject& object, const char* name) {
  const auto found = object.properties.find(name);
  return found == object.properties.end() ? std::string() : found->second.text;
}

std::optional<double> number_of_property(const TdmsObject& object, const char* name) {
  const auto found = object.properties.find(name);
  return found == object.properties.end() ? std::nullopt : found->second.number;
}

/// Returns the time of a channel; nothing if its properties state none.
std::optional<TdmsWave> tdms_wave(const TdmsObject& object) {
  const auto step = number_of_property(object, "wf_increment");
  if (!step || !(*step > 0.0) || !std::isfinite(*step)) return std::nullopt;
  TdmsWave wave;
  wave.step = *step;
  const double first = number_of_property(object, "wf_start_offset").value_or(0.0);
  if (std::isfinite(first)) wave.first = first;
  wave.name = text_of_property(object, "wf_xname");
  if (const std::string unit = text_of_property(object, "wf_xunit_string"); !unit.empty())
    wave.unit = unit;
  const auto start = object.properties.find("wf_start_time");
  // a recorder that knows no instant writes 0
  if (start != object.properties.end() && start->second.stamp != TdmsStamp())
    wave.start = start->second.stamp;
  return wave;
}

/// Returns the seconds from one instant to a later one.
double seconds_between(const TdmsStamp& from, const TdmsStamp& to) {
  constexpr double kUnit = 0x1p-64;  // s
  return static_cast<double>(to.seconds) - static_cast<double>(from.seconds) +
         (static_cast<double>(to.fraction) - static_cast<double>(from.fraction)) * kUnit;
}

/// True if the numbers are those of a converter, and a scale that turns them into quantities is
/// stated beside them.
bool is_unscaled(const TdmsObject& object) {
  const auto scales = number_of_property(object, "NI_Number_Of_Scales");
  return scales && *scales > 0.0 && text_of_property(object, "NI_Scaling_Status") == "unscaled";
}

class TdmsGroups {
 public:
  TdmsGroups(std::vector<TdmsObject>& objects, RecordedFile& file, NumberBudget& budget)
      : objects_(objects), file_(file), budget_(budget) {}

  void run() {
    for (const TdmsObject& object : objects_)
      if (const auto wave = tdms_wave(object); wave && wave->start && object.count > 0)
        first_start_ = first_start_ ? std::min(*first_start_, *wave->start) : *wave->start;
    for (TdmsObject& object : objects_) {
      if (object.names.empty()) take_facts(object);
      if (object.names.size() == 2) doubt_step(object);
      if (object.names.size() == 2) take_channel(object);
    }
    for (RecordedGroup& group : file_.groups)
      if (!group.has_abscissa) take_time_channel(group);
  }

 private:
  void take_facts(const TdmsObject& root) {
    for (const auto& [name, property] : root.properties)
      if (!property.text.empty() && file_.facts.size() < kMostTdmsFacts)
        file_.facts.push_back(recorded_text(name, file_.file) + ": " + property.text);
  }

  /// Doubts a channel whose step of time is no step: it has no time then.
  void doubt_step(const TdmsObject& object) {
    const auto step = number_of_property(object, "wf_increment");
    if (!step || object.count == 0 || tdms_wave(object)) return;
    file_.doubts.push_back(fmt::format(
        "channel {} of group {} states a step of {} (wf_increment), which is no step of "
        "time: its time is not known",
        in_quotes(recorded_text(object.names[1], file_.file)),
        in_quotes(recorded_text(object.names[0], file_.file)),
        *step));
  }

  void take_channel(TdmsObject& object) {
    const std::string group = recorded_text(object.names[0], file_.file);
    RecordedChannel channel{recorded_text(object.names[1], file_.file)};
    if (is_unscaled(object) && object.fault.empty())
      object.fault = "has the numbers of a converter, whose scale (NI_Scale) is not applied";
    if (!object.fault.empty()) {
      file_.left_out[channel.name] = object.fault;
      return;
    }
    if (object.values.empty()) {
      file_.doubts.push_back(fmt::format(
          "channel {} of group {} has no sample", in_quotes(channel.name), in_quotes(group)));
      return;
    }
    channel.unit = text_of_property(object, "unit_string");
    channel.values = std::move(object.values);
    constexpr double kExact = 9007199254740992.0;  // 2^53
    const bool is_wide = object.index->type == 4 || object.index->type == 8;
    if (is_wide && std::any_of(channel.values.begin(), channel.values.end(), [](double value) {
          return std::abs(value) > kExact;
        }))
      channel.remark = "has integers above 2^53, which are rounded";
    for (double& value : channel.values)
      if (!std::isfinite(value)) value = std::nan("");
    group_of(object, group, channel.values.size()).channels.push_back(std::move(channel));
  }

  /// Returns the group of channels with this time; makes one if there is none.
  RecordedGroup& group_of(const TdmsObject& object, const std::string& name, std::size_t samples) {
    const auto wave = tdms_wave(object);
    const double shift =
        wave && wave->start && first_start_ ? seconds_between(*first_start_, *wave->start) : 0.0;
    const auto key = std::tuple(
        name, samples, wave ? wave->first : 0.0, wave ? wave->step : 0.0, wave ? shift : 0.0);
    const auto [found, is_new] = groups_.try_emplace(key, file_.groups.size());
    if (!is_new) return file_.groups[found->second];
    file_.groups.push_back({name, {}, wave.has_value()});
    if (wave) file_.groups.back().channels.push_back(abscissa_of(*wave, shift, samples));
    return file_.groups.back();
  }

  RecordedChannel abscissa_of(const TdmsWave& wave, double shift, std::size_t samples) {
    const auto unit = find_unit(wave.unit, Unit::of("s"));
    const bool is_time = unit && unit->same_dimension(Unit::of("s"));
    RecordedChannel abscissa{is_time || wave.name.empty() ? "time" : wave.name, wave.unit};
    if (!is_time && wave.name.empty()) abscissa.name = "abscissa";
    const double begin = is_time ? unit->from_si(shift) : 0.0;
    budget_.take(samples);
    abscissa.values.reserve(samples);
    for (std::size_t i = 0; i < samples; ++i)
      abscissa.values.push_back(begin + wave.first + static_cast<double>(i) * wave.step);
    if (is_time && shift > 0.0)
      abscissa.remark =
          fmt::format("begins {:g} s after the first channel of the file (wf_start_time)", shift);
    return abscissa;
  }

  /// Makes the channel "time" of a group without waveforms its abscissa.
  static void take_time_channel(RecordedGroup& group) {
    const auto time = std::find_if(
        group.channels.begin(), group.channels.end(), [](const RecordedChannel& channel) {
          return lower(channel.name) == "time";
        });
    if (time == group.channels.end()) return;
    RecordedChannel channel = std::move(*time);
    group.channels.erase(time);
    if (channel.name != "time") channel.remark = "is called " + in_quotes(channel.name);
    channel.name = "time";
    group.channels.insert(group.channels.begin(), std::move(channel));
    group.has_abscissa = true;
  }

  std::vector<TdmsObject>& objects_;
  RecordedFile& file_;
  NumberBudget& budget_;
  std::optional<TdmsStamp> first_start_;
  std::map<std::tuple<std::string, std::size_t, double, double, double>, std::size_t> groups_;
};

}  // namespace

RecordedFile parse_tdms(std::string_view bytes, std::string file) {
  RecordedFile result;
  result.file = std::move(file);
  result.kind = "TDMS";
  TdmsSegments segments(bytes, result);
  TdmsGroups(segments.objects(), result, segments.budget()).run();
  check_recorded(result);
  return result;
}

}  // namespace latsch::formats
