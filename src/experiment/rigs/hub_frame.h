// SPDX-License-Identifier: Apache-2.0
// The frames in which a rig records forces: W, H or C of TYDEX (measurement/axes.h), ISO signs.
//
//   frame = "W"                      # in the file of a test: that of its measurement
//   frame = ["C", "W"]               # several, each letter ends the names: "FyC", "FyW"
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/document.h"
#include "measurement/axes.h"
#include "measurement/channels.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

/// Reads the frames of a test's file; throws InputError naming the place.
std::vector<AxisFrame> read_frames(const Node& test, std::vector<AxisFrame> fallback);
/// Returns the letters: "W", "C W".
std::string names_of(const std::vector<AxisFrame>& frames);
/// Returns "Fx" .. "Mz", or "FxC" .. "MzW".
std::vector<std::string> force_names(const std::vector<AxisFrame>& frames);

/// Converts the load of the tire on the hub from C. `motion` is that of a wheel on ground that is
/// level at z = 0 below it; a cleat or kerb does not affect the frame.
Wrench in_frame(const HubForces& hub, const WheelMotion& motion, AxisFrame to);

/// Forces and moments of a run in some frames, sample by sample.
class ForceRecord {
 public:
  explicit ForceRecord(std::vector<AxisFrame> frames)
      : frames_(std::move(frames)), values_(6 * frames_.size()) {}
  void add(const HubForces& hub, const WheelMotion& motion);
  void add_to(Channels& channels) const;
  /// Returns the values of one of force_names().
  const std::vector<double>& of(const std::string& name) const;

 private:
  std::vector<AxisFrame> frames_;
  std::vector<std::vector<double>> values_;  // ordered like force_names()
};

}  // namespace latsch::experiment
