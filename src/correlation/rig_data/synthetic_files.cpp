// SPDX-License-Identifier: Apache-2.0
#include "correlation/rig_data/synthetic_files.h"

#include <fmt/format.h>

#include <numbers>

#include "base/file.h"
#include "correlation/rig_data/rig_file.h"

namespace latsch::correlation {
namespace {

std::vector<SyntheticMode> read_modes(const Node& table) {
  std::vector<SyntheticMode> modes;
  for (const auto& row : table.rows("modes", {"Hz", "1", "N"})) {
    modes.push_back({row[0], row[1], row[2]});
  }
  return modes;
}

/// Writes numbers with as many digits as a recorder usually has: the file is a third as long and
/// loses nothing above its noise.
std::string recording_text(const Channels& channels, const std::vector<int>& decimals) {
  std::string text;
  for (const Channel& channel : channels.all()) {
    text += fmt::format("{}{} [{}]", text.empty() ? "" : ",", channel.name, channel.unit);
  }
  text += '\n';
  const std::size_t samples = channels.all()[0].values.size();
  for (std::size_t i = 0; i < samples; ++i) {
    for (std::size_t c = 0; c < channels.all().size(); ++c) {
      fmt::format_to(std::back_inserter(text),
                     "{}{:.{}f}",
                     c == 0 ? "" : ",",
                     channels.all()[c].values[i],
                     decimals[c]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

SyntheticTruth read_truth(const Node& table,
                          const std::vector<std::string>& runs,
                          const std::vector<double>& speeds) {
  SyntheticTruth truth;
  truth.rig.circumference = table.quantity("circumference", "m", Range::positive());
  truth.rig.rate = table.quantity("rate", "Hz", Range::positive(), truth.rig.rate);
  truth.rig.seed = static_cast<std::uint64_t>(table.integer("seed", 0, 1L << 40, 1));
  const double f = 2.0 * std::numbers::pi * table.quantity("frequency", "Hz", Range::positive());
  truth.rig.response = RigResponse::of(table.quantity("gain", "1"),
                                       f,
                                       table.quantity("damping", "1", Range::positive()),
                                       table.quantity("direct", "1"));
  truth.hits = static_cast<int>(table.integer("hits", 1, 1000, truth.hits));
  truth.hammer_noise =
      table.quantity("hammer_noise", "N", Range::not_negative(), truth.hammer_noise);
  SyntheticRun same;
  same.speeds = speeds;
  same.hold = table.quantity("hold", "s", {0.0, 3600.0, true}, same.hold);
  same.drift = table.quantity("drift", "1", Range::between(0.0, 0.1), same.drift);
  const Node all = table.table("run");
  for (const std::string& name : runs) {
    const Node own = all.table(name);
    SyntheticRun run = same;
    run.dummy_rim = own.choice("rim", {"real", "dummy"}) == "dummy";
    run.load = own.quantity("load", "N", Range::positive(), run.load);
    run.noise = own.quantity("noise", "N", Range::not_negative(), run.noise);
    run.modes = read_modes(own);
    run.number = truth.runs.size();
    truth.runs.push_back(run);
  }
  return truth;
}

std::vector<std::string> write_synthetic_files(const RigFile& rig) {
  const SyntheticTruth& truth = *rig.truth;
  std::vector<std::string> files;
  for (std::size_t i = 0; i < rig.runs.size(); ++i) {
    const Channels channels = synthetic_run(truth.rig, truth.runs[i]);
    write_text_file(rig.runs[i].file, recording_text(channels, {4, 4, 2, 2}));
    files.push_back(rig.runs[i].file.string());
  }
  if (rig.hammer) {
    const Channels channels = synthetic_hammer(truth.rig, truth.hits, truth.hammer_noise);
    write_text_file(rig.hammer->file, recording_text(channels, {4, 2, 3}));
    files.push_back(rig.hammer->file.string());
  }
  return files;
}

}  // namespace latsch::correlation
