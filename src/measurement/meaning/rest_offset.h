// SPDX-License-Identifier: Apache-2.0
// Finds motions of a K&C table that are not 0 without load.
//
// A rig may record toe, camber and displacements as absolute values or as changes relative to the
// unloaded wheel. The tests of a K&C rig compute changes, so the values at rest have to be
// subtracted from a table of absolute values before it is compared with a test. The value at rest
// is the mean over the samples in which every load, travel and rack position is below 5 % of its
// largest value. If there are no such samples, it is the constant of a plane that is fitted to all
// samples by least squares (partial regression of Frisch and Waugh); if the motion is a curved
// function of the load, this constant has an error of up to a third of the motion's range.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "measurement/channels.h"

namespace latsch {

struct RestOffset {
  std::string channel;
  double offset = 0.0, range = 0.0;  // SI: value at rest, largest minus smallest value
  std::size_t samples = 0;  // number of samples at rest; 0: the offset is the constant of the plane
};

/// Returns the offsets of those channels of `moved` whose value at rest exceeds half of their
/// range. Loads, travel and rack position are the channels with these names, also those of one
/// wheel ("Fy_L").
std::vector<RestOffset> offsets_at_rest(const Channels& channels,
                                        const std::vector<std::string>& moved);

/// Returns windows of the prescribed channels around rest, as a table of a study: `{Fy = "0 N +-
/// 200 N"}`. Empty if no sample is at rest.
std::string rest_windows(const Channels& channels);

}  // namespace latsch
