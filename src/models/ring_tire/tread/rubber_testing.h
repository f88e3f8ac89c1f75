// SPDX-License-Identifier: Apache-2.0
// For rubber_law_test.cpp: a kernel with eight equal cells.
#include "models/ring_tire/tread/rubber_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

/// Returns share, depth, moment and slope of a cell of rubber that bottoms out, or is linear.
void touch_of(double depth, double g, double bottom, double touch[4]) {
  const Touch found = bottom > 0.0 ? BottomingRubber(bottom).touch(all(depth), all(g))
                                   : LinearRubber(bottom).touch(all(depth), all(g));
  touch[0] = found.share.at(7);
  touch[1] = found.depth.at(7);
  touch[2] = found.moment.at(7);
  touch[3] = found.slope.at(7);
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
