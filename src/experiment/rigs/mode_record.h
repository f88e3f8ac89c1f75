// SPDX-License-Identifier: Apache-2.0
// A vibration mode as a laboratory reports it and as the virtual rig records it.
//
// Channels of a modal run: "frequency" Hz, "n" 1, "type" 1, "phase" 1, one value for each mode, and
// "shape" 1 with the displacements of all sensor points (x y z of point 0, x y z of point 1 ...),
// one mode after the other.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "measurement/channels.h"
#include "measurement/mode_table.h"
#include "models/fe_tire/analysis/fe_tire.h"

namespace latsch::experiment {

struct ModeRecord {
  double frequency = 0.0;                 // Hz
  std::optional<int> n;                   // circumferential number, if known
  std::optional<fe_tire::ModeType> type;  // if known
  char phase = ' ';                       // 's', 'a' or ' ': unknown or none, see fe_tire::Mode
  Eigen::VectorXd shape;  // [3 x points] wheel frame, any scale; empty: not measured

  /// Returns "lateral n=1 s", with "?" for unknown parts.
  std::string label() const;
};

/// Inverse of label() for a known type and n; nullopt for any other text.
std::optional<ModeRecord> mode_of_label(const std::string& label);

/// Returns the index of the lowest mode with the type and n of `named`, and its phase unless
/// unknown. -1: there is none.
int find_mode(const std::vector<ModeRecord>& modes, const ModeRecord& named);

Channels to_channels(const std::vector<ModeRecord>& modes);
/// Reads modes from channels; asserts that the channels come from a modal run.
std::vector<ModeRecord> mode_records(const Channels& channels);

/// Returns measured modes. Throws InputError for a type that this program does not know.
std::vector<ModeRecord> mode_records(const ModeTable& table);
/// Returns the sensor points [3 x points], m.
Eigen::Matrix3Xd sensor_points(const ModeTable& table);
/// Inverse of the two functions above, for a twin.
ModeTable mode_table(const std::vector<ModeRecord>& modes, const Eigen::Matrix3Xd& points);

}  // namespace latsch::experiment
