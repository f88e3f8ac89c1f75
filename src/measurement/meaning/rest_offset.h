// SPDX-License-Identifier: Apache-2.0
// Finds motions of a K&C table that are not 0 without load.
//
// A rig may record toe, camber and displacements as they are, or their changes from the unloaded
// wheel. The tests of a K&C rig compute changes, so a table of absolute values has to lose its
// values at rest before it is compared. The value at rest is the mean over the samples in which
// every load, travel and rack is below 5 % of its largest value; without such samples it is the
// constant of a plane through all samples (the partial regression of Frisch and Waugh), which a
// curved table may shift by a third of its range.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "measurement/channels.h"

namespace latsch {

struct RestOffset {
  std::string channel;
  double offset = 0.0, range = 0.0;  // SI: value at rest, largest minus smallest value
  std::size_t samples = 0;           // samples at rest; 0: from the plane
};

/// Returns those of the `moved` channels whose value at rest exceeds half of their range. Loads,
/// travel and rack are the channels of these names, also of one wheel ("Fy_L").
std::vector<RestOffset> offsets_at_rest(const Channels& channels,
                                        const std::vector<std::string>& moved);

/// Returns windows around rest, as a table of a study: `{Fy = "0 N +- 200 N"}`. Empty if no sample
/// is at rest.
std::string rest_windows(const Channels& channels);

}  // namespace latsch
