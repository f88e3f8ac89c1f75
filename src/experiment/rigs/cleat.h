// SPDX-License-Identifier: Apache-2.0
// A bar that a tire rolls over or stands on.
//
//   [cleat]
//   height = "15 mm"
//   length = "30 mm"                 # along the road if angle is 0
//   bevel = "5 mm"                   # of its upper edges, default 0
//   angle = "30 deg"                 # against the axle, default 0
#pragma once

#include <optional>

#include "base/document.h"

namespace latsch::experiment {

struct Cleat {
  double height = 0.0, length = 0.0, bevel = 0.0;  // m
  double angle = 0.0;                              // rad
};

/// Returns nothing if the test has no cleat; `widest` is the largest angle, rad. Throws InputError.
std::optional<Cleat> read_cleat(const Node& test, double widest);

}  // namespace latsch::experiment
