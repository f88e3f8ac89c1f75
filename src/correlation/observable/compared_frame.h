// SPDX-License-Identifier: Apache-2.0
// Which channel of a test a measured force or moment is compared with: that in the frame the
// measurement states (measurement/axes.h). A test that records several frames has "sweep/FyC" and
// "sweep/FyW" for "sweep/Fy". Nothing is turned here: [measurement.NAME] does that, with in_frame.
#pragma once

#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/laboratory/measurement.h"
#include "correlation/observable/known_channels.h"

namespace latsch::correlation {

/// Of the `channels` the one that the experiment `table` calls `named` under `key`. `stated`: its
/// key `frame`, for a measurement that does not say in which axes it is; "": not given. InputError
/// where there is no such channel, or only in other axes.
const KnownChannel& channel_in_measured_frame(const Node& table,
                                              const char* key,
                                              const std::string& named,
                                              const std::string& stated,
                                              const std::vector<KnownChannel>& channels,
                                              const Measurement& measurement);

/// The six forces and moments of a test in the frame of one of them: "sweep/FxC" to "sweep/MzC" of
/// "sweep/FyC".
std::vector<std::string> forces_beside(const std::string& channel);

/// Whether a force or moment is the same in both: a force in W and H.
bool is_same_in(const std::string& channel, const std::string& frame, const std::string& other);

}  // namespace latsch::correlation
