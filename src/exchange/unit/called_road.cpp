// SPDX-License-Identifier: Apache-2.0
#include "exchange/unit/called_road.h"

#include <fmt/format.h>

#include "base/error.h"

namespace latsch::exchange {

CalledRoad::Answer CalledRoad::ask(double x, double y, double time, int with_slopes) const {
  const double place[2] = {x, y};
  const int running = 0, property_count = 1;
  int kind = 0, derivatives = 0, error = 0;
  double height = 0.0, slope[2] = {}, curvature[3] = {}, properties[1] = {};
  road_(&time,
        place,
        &with_slopes,
        &running,
        idtyre_,
        idroad_,
        nropar_,
        ropar_,
        nchrds_,
        chrdst_,
        &property_count,
        &kind,
        &height,
        slope,
        curvature,
        &derivatives,
        properties,
        &error,
        *nchrds_);
  if (error > 1)
    throw InputError(
        fmt::format("ROAD answers IERR = {} at x = {} m, y = {} m, {} s", error, x, y, time));
  return {height,
          slope[0],
          slope[1],
          properties[0] > 0.0 ? properties[0] : 1.0,
          with_slopes != 0 && derivatives > 0};
}

road::GroundPoint CalledRoad::at(double x, double y, double time) const {
  constexpr double kReach = 1e-3;  // m, half the distance between the two points of a difference
  Answer here = ask(x, y, time, 1);
  if (!here.has_slopes) {
    here.slope_x = (height(x + kReach, y, time) - height(x - kReach, y, time)) / (2.0 * kReach);
    here.slope_y = (height(x, y + kReach, time) - height(x, y - kReach, time)) / (2.0 * kReach);
  }
  road::GroundPoint ground;
  ground.height = here.height;
  ground.normal = Eigen::Vector3d(-here.slope_x, -here.slope_y, 1.0).normalized();
  ground.friction = here.friction;
  return ground;
}

}  // namespace latsch::exchange
