// SPDX-License-Identifier: Apache-2.0
// Implements `latsch show` for the measurements of a study: in words what was read and how many
// samples each step left, and in plots the used samples over the recorded ones.
#include <algorithm>

#include "base/document.h"
#include "base/text.h"
#include "base/units.h"
#include "cli/verbs/shown_file.h"
#include "correlation/laboratory/measurement.h"

namespace latsch::cli {
namespace {

using correlation::Measurement;

/// Converts values from SI to `unit`.
std::vector<double> read_in(const std::string& unit, std::vector<double> values) {
  const Unit shown = Unit::of(unit);
  for (double& value : values) value = shown.from_si(value);
  return values;
}

std::string title_of(const Channel& channel) {
  const std::string unit = correlation::read_unit(channel.unit);
  return channel.name + (unit == "1" ? "" : " [" + unit + "]");
}

/// Returns the time or, if there is none, the sample numbers.
std::vector<double> abscissa(const Measurement& measurement, const Channels& channels) {
  if (const Channel* time = channels.find("time")) return time->values;
  const bool all = &channels == &measurement.recorded();
  std::vector<double> numbers;
  const std::size_t count = channels.all().front().values.size();
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(all ? static_cast<double>(i + 1) : measurement.numbers()[i]);
  return numbers;
}

void add_measurement(const Measurement& measurement, bool alone, ShownFile& shown) {
  const std::string of = alone ? "" : measurement.name() + ": ";
  for (const std::string& words : measurement.words()) shown.facts.push_back(of + words);
  const bool timed = measurement.recorded().find("time") != nullptr;
  const auto x_recorded = abscissa(measurement, measurement.recorded());
  const auto x_counts = abscissa(measurement, measurement.channels());
  const char* x_title = timed ? "time [s]" : "sample";
  const auto counts = [&](const Channel& channel, const std::string& unit) {
    report::PlotLine line{"counts", x_counts, read_in(unit, channel.values), 1, {}};
    line.are_dots = true;
    return line;
  };
  for (const Channel& channel : measurement.recorded().all()) {
    if (channel.name == "time") continue;
    const std::string unit = correlation::read_unit(channel.unit);
    const std::string y_title = title_of(channel);
    report::PlotLine recorded{"recorded", x_recorded, read_in(unit, channel.values), 0, {}};
    shown.plots.push_back({of + y_title, x_title, y_title, {std::move(recorded)}});
    if (const Channel* counting = measurement.channels().find(channel.name))
      shown.plots.back().lines.push_back(counts(*counting, unit));
  }
  for (const Channel& channel : measurement.channels().all()) {
    // the recorded channel was converted to other axes
    if (measurement.recorded().find(channel.name)) continue;
    const std::string y_title = title_of(channel);
    shown.plots.push_back(
        {of + y_title, x_title, y_title, {counts(channel, correlation::read_unit(channel.unit))}});
  }
}

}  // namespace

ShownFile shown_measurements(const std::filesystem::path& study, const std::string& only) {
  const Document document = Document::read(study);
  const Node root = document.root();
  std::vector<std::string> names;
  for (const Node& table : root.named_tables("measurement")) names.push_back(table.name());
  if (names.empty()) throw InputError({study.string(), 0}, "has no [measurement.NAME]");
  if (!only.empty() && std::find(names.begin(), names.end(), only) == names.end())
    throw InputError({study.string(), 0},
                     "has no [measurement." + only + "]" + did_you_mean(only, names) +
                         "; there are " + list_of(names));
  ShownFile shown;
  shown.kind = only.empty() ? "Measurements of a study" : "Measurement " + only;
  for (const Node& table : root.named_tables("measurement")) {
    if (!only.empty() && table.name() != only) continue;
    const Measurement measurement = correlation::read_measurement(table, study.parent_path());
    table.close();
    add_measurement(measurement, names.size() == 1 || !only.empty(), shown);
    const std::vector<Ledger> ledgers = measurement.ledgers();
    for (const Ledger& ledger : ledgers) show_ledger(ledger, true, shown, ledgers);
  }
  return shown;
}

}  // namespace latsch::cli
