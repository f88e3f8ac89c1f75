// SPDX-License-Identifier: Apache-2.0
// Chooses the channel of a test with which a measured force or moment is compared: the one in the
// frame that the measurement states (measurement/axes.h). A test that records several frames has
// "sweep/FyC" and "sweep/FyW" for "sweep/Fy". This file converts no values; in_frame of a
// [measurement.NAME] does that.
#pragma once

#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/laboratory/measurement.h"
#include "correlation/observable/known_channels.h"

namespace latsch::correlation {

/// Returns the channel that the experiment `table` calls `named` under `key`. `stated` is the
/// experiment's key `frame`, for a measurement that does not state its frame; "": not given. Throws
/// InputError if there is no such channel, or only one in another frame.
const KnownChannel& channel_in_measured_frame(const Node& table,
                                              const char* key,
                                              const std::string& named,
                                              const std::string& stated,
                                              const std::vector<KnownChannel>& channels,
                                              const Measurement& measurement);

/// Returns the six forces and moments of a test in the frame of one of them: "sweep/FxC" to
/// "sweep/MzC" for "sweep/FyC".
std::vector<std::string> forces_beside(const std::string& channel);

/// True if a force or moment has the same value in both frames, as a force in the frames W and H
/// has.
bool is_same_in(const std::string& channel, const std::string& frame, const std::string& other);

}  // namespace latsch::correlation
