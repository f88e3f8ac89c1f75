// SPDX-License-Identifier: Apache-2.0
// A road with one profile for the wheels on the left (y > 0) and another for those on the right.
#pragma once

#include "models/road/profile.h"
#include "models/road/road.h"

namespace latsch::road {

class TwoTrackRoad final : public Road {
 public:
  TwoTrackRoad(Profile left, Profile right, double friction);

  GroundPoint at(double x, double y, double time) const override;

 private:
  Profile left_, right_;
  double friction_;
};

}  // namespace latsch::road
