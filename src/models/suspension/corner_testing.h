// SPDX-License-Identifier: Apache-2.0
// Returns the front left corner of a student race car (published hardpoints of the set
// "fsae_parametrica", push-rod on the upper wishbone). All bushings are equal, as in the statics of
// corner_test.cpp.
#pragma once

#include "models/suspension/double_wishbone.h"

namespace latsch::suspension {

inline DoubleWishbone race_corner() {
  DoubleWishbone corner;
  corner.points = {{{1.648347, 0.273206, 0.303434},
                    {1.406764, 0.273327, 0.309890},
                    {1.698576, 0.262926, 0.126153},
                    {1.442210, 0.263181, 0.150828},
                    {1.510800, 0.527786, 0.350000},
                    {1.539399, 0.563477, 0.148512},
                    {1.507720, 0.191715, 0.544030},
                    {1.507720, 0.499027, 0.366606},
                    {1.490000, 0.266310, 0.119872},
                    {1.490000, 0.553400, 0.118540}}};
  corner.bushings.fill({Eigen::Vector3d::Constant(3e7), Eigen::Vector3d::Constant(200.0)});
  corner.wheel_center = {1.55, 0.6125, 0.235};
  corner.contact = {1.55, 0.6125, 0.0};
  return corner;
}

}  // namespace latsch::suspension
