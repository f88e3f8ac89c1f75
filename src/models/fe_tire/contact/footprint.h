// SPDX-License-Identifier: Apache-2.0
// Length, width and area of a footprint, finer than the elements that leave it.
//
// A free surface leaves the ground with a horizontal tangent: beside the contact its height grows
// as the square of the way, g = c (s - s_0)^2. So along lines of samples around the tire and
// across, the edge s_0 is where the root of the height goes to zero, extrapolated from where it
// passes two heights that lie above what penalty and interpolation leave in the patch,
//   s_0 = s_1 - (s_2 - s_1) sqrt(g_1) / (sqrt(g_2) - sqrt(g_1))                               (F.1)
// Where the surface ends or comes down again before the second of them, the first is the edge.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/contact/tread_surface.h"

namespace latsch::fe_tire {

struct FootprintSize {
  double length = 0.0, width = 0.0;  // m, extent around the tire and across
  double area = 0.0;                 // m^2
};

/// Of all the ring. `at`: every sample of the tread in axes of the ground, x along the road, z the
/// distance from it; `area`, m^2, what it stands for.
FootprintSize footprint_size(const TreadSurface& tread,
                             const Eigen::Matrix3Xd& at,
                             const Eigen::VectorXd& area);

}  // namespace latsch::fe_tire
