// SPDX-License-Identifier: Apache-2.0
#include "correlation/rig_data/rig_tydex.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "correlation/laboratory/channel_names.h"
#include "correlation/rig_data/rig_tables.h"

namespace latsch::correlation {
namespace {

formats::TydexRecord tydex_of(const ProcessedRun& run,
                              const ProcessedPlateau& p,
                              const std::string& frame) {
  formats::TydexRecord record;
  record.measurement = plateau_name(run.name, p.plateau.target);
  record.comments = {
      fmt::format("Mean of {} passages of a cleat, and their standard deviation (names in SPREAD).",
                  p.passages.starts.size()),
      "Recording: " + run.record.source,
      fmt::format("Axes {} of the forces and signs of ISO 8855: as stated to latsch process.",
                  frame)};
  record.constants = {
      {"TRAJVELW", "velocity of the surface", "m/s", formats::nine_characters(p.plateau.target)}};
  Channel time{"time", "s", {}};
  for (int i = 0; i < p.passages.length; ++i) time.values.push_back(i / run.record.rate);
  record.channels.add(std::move(time));
  record.frames.emplace_back();
  for (const ChannelAverage& channel : p.channels) {
    record.channels.add({channel.name, channel.unit, channel.average.mean});
    record.channels.add({channel.name + "_spread", channel.unit, channel.average.spread});
    record.frames.push_back(frame);
    record.frames.emplace_back();
  }
  return record;
}

/// Throws InputError if the mean load of a passage is below 0: the signs are then not those of
/// ISO 8855, which the file would state.
void expect_pressed(const ProcessedPlateau& plateau) {
  for (const ChannelAverage& channel : plateau.channels) {
    if (force_without_frame(channel.name) != "Fz") continue;
    const auto& mean = channel.average.mean;
    const double load = std::accumulate(mean.begin(), mean.end(), 0.0) /
                        std::max<double>(1.0, static_cast<double>(mean.size()));
    if (load < 0.0)
      throw InputError(
          fmt::format("Fz is {:.0f} N in the mean, so the signs of the recordings are not those of "
                      "ISO 8855, which a file of --tydex states; turn the signs of the recordings "
                      "before, or leave --tydex out",
                      load));
  }
}

}  // namespace

std::vector<NamedTydex> averages_in_tydex(const RigResults& results, const std::string& frame) {
  std::vector<NamedTydex> records;
  for (const ProcessedRun& run : results.runs)
    for (const ProcessedPlateau& plateau : run.plateaus) {
      expect_pressed(plateau);
      records.push_back({"average_" + plateau_name(run.name, plateau.plateau.target) + ".tdx",
                         tydex_of(run, plateau, frame)});
    }
  return records;
}

}  // namespace latsch::correlation
