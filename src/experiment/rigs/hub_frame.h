// SPDX-License-Identifier: Apache-2.0
// The frames in which a rig hands out forces: W, H or C of TYDEX (measurement/axes.h), ISO signs.
//
//   frame = "W"                      # in the file of a test: that of the measurement it stands for
//   frame = ["C", "W"]               # in several, each with its letter behind: "FyC", "FyW"
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/document.h"
#include "measurement/axes.h"
#include "measurement/channels.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

/// Of a test's file; throws InputError naming the place.
std::vector<AxisFrame> read_frames(const Node& test, std::vector<AxisFrame> fallback);
/// "W", "C W".
std::string names_of(const std::vector<AxisFrame>& frames);
/// "Fx" .. "Mz", or "FxC" .. "MzW".
std::vector<std::string> force_names(const std::vector<AxisFrame>& frames);

/// What a tire does to the hub, from C. `motion`: of a wheel on ground that is level at z = 0 under
/// it; the cleat or kerb on it is no part of the frame.
Wrench in_frame(const HubForces& hub, const WheelMotion& motion, AxisFrame to);

/// Forces and moments of a run, sample by sample, in each of some frames.
class ForceRecord {
 public:
  explicit ForceRecord(std::vector<AxisFrame> frames)
      : frames_(std::move(frames)), values_(6 * frames_.size()) {}
  void add(const HubForces& hub, const WheelMotion& motion);
  void add_to(Channels& channels) const;

 private:
  std::vector<AxisFrame> frames_;
  std::vector<std::vector<double>> values_;  // as force_names() has them
};

}  // namespace latsch::experiment
