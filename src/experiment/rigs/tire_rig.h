// SPDX-License-Identifier: Apache-2.0
// Virtual tire rig: drives the finite-element tire as the laboratory drove the specimen.
//
// Channels of a load-deflection test, one value a deflection in the order asked for: "deflection"
// m, "loaded_radius" m, "force" N, "patch_length" m, "patch_width" m, "patch_area" m^2. A loaded
// radius larger than the radius of the inflated tire is no contact: force and patch are 0. Channels
// of a modal test: those of mode_record.h, and of a loaded one "deflection", "loaded_radius",
// "force" (one value).
//
// Load cases of one pressure and one ground share the inflation and the loading: the tire is
// pressed once through all their deflections, ascending. With friction the way there is part of the
// result, so it is the same for all of them.
#pragma once

#include <vector>

#include "base/result.h"
#include "experiment/rigs/load_case.h"
#include "measurement/channels.h"
#include "models/fe_tire/ring/fe_tire.h"

namespace latsch::experiment {

/// One result a load case, in their order. A Failure names its experiment.
std::vector<Result<Channels>> run(fe_tire::FeTire& tire, const std::vector<LoadCase>& cases);

/// Points for shapes where no laboratory prescribes them: up to 3 sensors across the outer surface
/// at up to 24 places around, [3 x points], m, wheel frame.
Eigen::Matrix3Xd default_points(const fe_tire::Mesh& mesh);

/// The node (of the whole ring) of the sensor nearest to every point, and how far off it is, m.
struct NearestSensors {
  std::vector<int> nodes;
  double largest_distance = 0.0;
};
NearestSensors nearest_sensors(const fe_tire::Mesh& mesh, const Eigen::Matrix3Xd& points);

}  // namespace latsch::experiment
