// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/text.h"
#include "base/unit_reading.h"
#include "correlation/laboratory/measurement_twin.h"
#include "correlation/laboratory/stated_difference.h"
#include "correlation/observable/channel_value.h"
#include "correlation/observable/compared_frame.h"
#include "correlation/observable/compared_kinds.h"
#include "correlation/observable/known_channels.h"
#include "experiment/rigs/mode_record.h"
#include "report/report.h"

namespace latsch::correlation {
namespace {

/// Returns TEST of "TEST/CHANNEL".
std::string test_part(const std::string& channel) { return channel.substr(0, channel.find('/')); }

ComparedValues compared_single_values(const Values::Measurement& m) {
  ComparedValues values{.kind = "values",
                        .compared = m.of.empty() ? m.channel : m.of + " " + m.channel,
                        .asks = {m.channel},
                        .rows = m.modes,
                        .is_sweep = false,
                        .passes_slopes = true,
                        .unit = m.unit,
                        .shown = m.shown,
                        .measured = m.values,
                        .scales = m.scales};
  for (std::size_t i = values.rows.size(); i < m.values.size(); ++i) {
    values.rows.push_back(m.values.size() == 1
                              ? values.compared
                              : fmt::format("{}, value {}", values.compared, i + 1));
  }
  return values;
}

}  // namespace

Values::Values(Measurement measured)
    : Observable(compared_single_values(measured)), m_(std::move(measured)) {}

Result<SimulatedValues> Values::simulated(const Channels& trial) const {
  const Channel* channel = trial.find(m_.channel);
  if (!channel)
    return Failure{"channel " + in_quotes(m_.channel) + " is missing", Cause::bad_output};
  if (!m_.modes.empty()) return of_modes(trial);
  SimulatedValues found{channel->values, channel->slopes};
  if (!m_.of.empty() && !channel->values.empty()) {
    found.values = {value_of(m_.of, channel->values)};
    if (!channel->slopes.empty()) found.slopes = slopes_of(m_.of, *channel);
  }
  if (found.values.size() != m_.values.size()) {
    return Failure{
        fmt::format("channel {} has {} values, expected {} as measured{}",
                    in_quotes(m_.channel),
                    found.values.size(),
                    m_.values.size(),
                    m_.values.size() == 1 ? "; of = \"largest\" takes one of several" : ""),
        Cause::bad_output};
  }
  return found;
}

SimulatedValues Values::of_modes(const Channels& trial) const {
  const Channels recording = recording_of(test_part(m_.channel), trial);
  const std::vector<double>& values = recording[channel_part(m_.channel)];
  const auto modes = experiment::mode_records(recording);
  std::vector<int> partner;
  const std::vector<ModeRecord> named = named_modes();
  for (const ModeRecord& mode : named) partner.push_back(experiment::find_mode(modes, mode));
  const bool are_frequencies = channel_part(m_.channel) == "frequency";
  SimulatedValues found;
  if (are_frequencies) {
    const std::vector<int> by_name = partner;
    take_mixed(named, modes, partner);
    for (std::size_t i = 0; i < named.size(); ++i)
      if (by_name[i] != partner[i]) found.mixed.push_back(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < named.size(); ++i) {
    const int mode = static_cast<int>(i);
    if (partner[i] < 0) found.missing.push_back(mode);
    found.values.push_back(partner[i] < 0 ? 0.0 : values[static_cast<std::size_t>(partner[i])]);
    if (are_frequencies && partner[i] >= 0)
      found.compared.push_back({mode, found.values.back(), {}});
  }
  order_close(named, {}, /*needs_waves=*/true, found.compared);
  for (const ComparedFrequency& one : found.compared)
    found.values[static_cast<std::size_t>(one.measured)] = one.frequency;
  return found;
}

std::vector<ModeRecord> Values::named_modes() const {
  std::vector<ModeRecord> named;
  for (std::size_t i = 0; i < m_.modes.size(); ++i) {
    named.push_back(*experiment::mode_of_label(m_.modes[i]));
    named.back().frequency = m_.values[i];
  }
  return named;
}

std::vector<std::string> Values::remarks(const Comparison& comparison) const {
  const std::vector<ModeRecord> named = named_modes();
  std::vector<std::string> all = remarks_on_close(named, {}, comparison.compared);
  for (const ModePair& pair : comparison.pairing.pairs)
    all.push_back(remark_on_mixed(named[static_cast<std::size_t>(pair.measured)]));
  for (const int i : comparison.pairing.missing)
    all.push_back(fmt::format(
        "The model has no mode {} among those that the test computes; it counts as an error of "
        "100 %. A larger count in the test computes more.",
        in_quotes(m_.modes[static_cast<std::size_t>(i)])));
  return all;
}

Result<Comparison> Values::compare(const Channels& trial, const ObjectiveSettings& settings) const {
  const auto found = simulated(trial);
  if (!found) return found.failure();
  return compare_values(m_.values, *found, m_.scales, settings);
}

std::vector<std::filesystem::path> Values::write(const Channels& trial,
                                                 const MeasurementFiles& files) const {
  if (!files.measurement) return {};
  if (!m_.of.empty())
    throw InputError(files.measurement->place(),
                     "cannot be written by a twin: " + m_.channel + " is compared by its " + m_.of +
                         " value alone");
  if (!m_.modes.empty() && files.measurement->samples() != m_.values.size())
    throw InputError(files.measurement->place(),
                     "cannot be written by a twin: it records all modes, of which " + m_.channel +
                         " compares some; expected a file with a row for each of them");
  const auto found = simulated(trial);
  if (!found) throw InputError(files.measurement->place(), found.failure().reason);
  std::map<std::string, std::vector<double>> values{{channel_part(m_.channel), found->values}};
  if (files.measurement->is_turned(channel_part(m_.channel)))
    for (const std::string& name : forces_beside(m_.channel))
      if (const Channel* beside = trial.find(name)) values[channel_part(name)] = beside->values;
  return {write_twin(*files.measurement, values, files.comment)};
}

void Values::draw(const ShownExperiment& shown, report::StudyReport& page) const {
  const auto found = simulated(shown.found);
  const auto start = shown.initial ? std::optional(simulated(*shown.initial)) : std::nullopt;
  for (std::size_t i = 0; found && i < found->values.size(); ++i) {
    report::MeasuredValue value;
    value.name = found->values.size() == 1 ? shown.name : shown.name + ", " + rows()[i];
    if (found->values.size() == 1) value.compared = compared({});
    value.unit = m_.shown;
    value.fitted = shown.fitted;
    value.weight = shown.weight;
    value.measured = m_.values[i];
    value.found = found->values[i];
    if (start && *start) value.initial = (*start)->values[i];
    if (shown.band) {
      value.lower = shown.band->lower[i];
      value.upper = shown.band->upper[i];
    }
    page.values.push_back(std::move(value));
  }
}

std::string Values::table(const Channels& trial, const Comparison& comparison) const {
  const auto found = simulated(trial);
  std::string text =
      fmt::format("  {:<32} {:>16} {:>16} {:>9}\n", "value", "measured", "simulated", "error %");
  const auto names = rows();
  for (std::size_t i = 0; found && i < found->values.size(); ++i) {
    text += fmt::format("  {:<32} {:>16} {:>16} {:9.2f}\n",
                        names[i],
                        format_quantity(m_.values[i], m_.shown, 5),
                        format_quantity(found->values[i], m_.shown, 5),
                        100.0 * comparison.errors[i]);
  }
  return text;
}

std::pair<std::string, nlohmann::ordered_json> Values::answer(const Channels& trial,
                                                              const Comparison& comparison) const {
  const auto found = simulated(trial);
  return {"values",
          {{"of", compared({})},
           {"unit", m_.unit},
           {"measured", json_of(m_.values)},
           {"simulated", found ? json_of(found->values) : nlohmann::ordered_json(nullptr)},
           {"error", json_of(comparison.errors)}}};
}

namespace {

std::vector<std::string> read_mode_names(const Node& table,
                                         const Values::Measurement& m,
                                         const std::vector<std::string>& channels) {
  std::vector<std::string> modes = table.texts("modes");
  const std::string n = test_part(m.channel) + "/n";
  if (std::find(channels.begin(), channels.end(), n) == channels.end())
    table.reject("modes",
                 "is given, but the test of " + in_quotes(m.channel) + " records no modes");
  if (!m.of.empty()) table.reject("modes", "is given beside of, expected one of them");
  for (const std::string& mode : modes) {
    if (!experiment::mode_of_label(mode))
      table.reject("modes",
                   "has " + in_quotes(mode) +
                       ", expected torsional, lateral or radial and the number of waves, such as "
                       "\"radial n=2\"");
  }
  if (modes.size() != m.values.size())
    table.reject("modes",
                 fmt::format("names {}, but there are {} values", modes.size(), m.values.size()));
  return modes;
}

/// Takes the values of the named modes from a recording of all modes, as a test of kind "modes"
/// makes it, with their numbers n and types. Leaves the values of other measurements as they are.
void take_named_modes(const Node& table,
                      const latsch::correlation::Measurement& measurement,
                      Values::Measurement& m) {
  Channels recording;
  for (const auto& [name, unit] : {std::pair{"frequency", "Hz"}, {"n", "1"}, {"type", "1"}}) {
    if (!measurement.has(name)) return;
    recording.add({name, unit, measurement.values(name, unit)});
  }
  recording.add({"phase",
                 "1",
                 measurement.has("phase") ? measurement.values("phase", "1")
                                          : std::vector<double>(m.values.size(), 0.0)});
  const auto modes = experiment::mode_records(recording);
  std::vector<double> named;
  for (const std::string& label : table.texts("modes")) {
    const auto mode = experiment::mode_of_label(label);
    if (!mode) return;  // read_mode_names() says so
    const int found = experiment::find_mode(modes, *mode);
    if (found < 0)
      table.reject("modes", "has " + in_quotes(label) + ", which the measurement does not have");
    named.push_back(m.values[static_cast<std::size_t>(found)]);
  }
  m.values = named;
}

/// Returns the measured values of the channel's column. If the channel is a slope that was not
/// recorded as a column, it is computed from the recorded channels by the regression of the test.
std::vector<double> measured_values(const Node& table,
                                    const KnownChannel& known,
                                    const Values::Measurement& m,
                                    const latsch::correlation::Measurement& measurement) {
  const std::string name = channel_part(m.channel);
  if (!known.regression || measurement.has(name)) return measurement.values(name, m.unit);
  const auto& [of, unit, slopes] = *known.regression;
  const Eigen::VectorXd w = slopes.weights(measurement.values(slopes.by, slopes.unit));
  if (w.size() == 0)
    table.reject(
        "measurement",
        "does not vary in " + slopes.by + " within the window, so no slope can be computed");
  const std::vector<double>& y = measurement.values(of, unit);
  return {w.dot(Eigen::Map<const Eigen::VectorXd>(y.data(), w.size()))};
}

}  // namespace

std::shared_ptr<const Values> read_values(const Node& table,
                                          const std::vector<KnownChannel>& channels,
                                          const Measurement* measurement) {
  Values::Measurement m;
  m.channel = table.text("channel");
  std::vector<std::string> names;
  for (const KnownChannel& one : channels) names.push_back(one.name);
  const KnownChannel* known =
      measurement
          ? &channel_in_measured_frame(table, "channel", m.channel, "", channels, *measurement)
          : &named_channel(table, "channel", m.channel, channels);
  m.channel = known->name;
  m.shown = known->unit;
  m.unit = si_unit(Unit::of(known->unit).dimension());
  if (table.has("value") + table.has("values") + (measurement != nullptr) != 1)
    table.reject("value", "or values or measurement is required, exactly one of them");
  if (measurement) {
    m.values = measured_values(table, *known, m, *measurement);
    if (table.has("of")) {
      m.of = table.choice("of", names_of_values());
      m.values = {value_of(m.of, m.values)};
    }
  } else if (table.has("value")) {
    m.values = {table.quantity("value", m.unit)};
    if (m.unit != "1") {
      const auto written = parse_quantity(table.text("value"), Unit::of(m.unit));
      m.shown = written->unit.text();
    }
    if (table.has("of")) m.of = table.choice("of", names_of_values());
  } else {
    m.values = table.quantities("values", m.unit);
    if (m.values.empty()) table.reject("values", "is empty, expected at least one");
  }
  if (measurement && table.has("modes")) take_named_modes(table, *measurement, m);
  if (table.has("modes")) m.modes = read_mode_names(table, m, names);
  for (const double value : m.values) m.scales.push_back(std::abs(value));
  if (table.has("scale")) m.scales.assign(m.values.size(), read_difference(table, "scale", m.unit));
  for (const double scale : m.scales) {
    if (!(scale > 0.0)) table.reject("scale", "is missing: a measured value of 0 gives no scale");
  }
  return std::make_shared<Values>(std::move(m));
}

extern const ComparedKind kValuesKind;
const experiment::KeySection& values_keys();

const ComparedKind kValuesKind = {
    "values",
    false,
    [](const Node& table, const std::vector<KnownChannel>& channels, const Measurement* measurement)
        -> std::shared_ptr<const Observable> { return read_values(table, channels, measurement); },
    values_keys};

}  // namespace latsch::correlation
