// SPDX-License-Identifier: Apache-2.0
// Length, width and area of a footprint, finer than the elements that leave it.
//
// Beside a patch from -a to a around its middle the gap between a cylinder and the ground grows as
//   g(s) ~ f(s / a),   f(t) = t sqrt(t^2 - 1) - arcosh t                                      (F.1)
// [Johnson, Contact Mechanics, Cambridge 1985, section 4.2: of a line contact], first as the power
// 3/2 of the way from the edge, as at any free edge, then as the square. So along lines of samples
// around the tire and across, the edge is where (F.1) has it that passes two heights where the
// surface does. Both lie above what penalty, interpolation and the offset of (T.1) leave in the
// patch. Where the surface ends or comes down again before the second of them, the first is the
// edge. No line around that has a length, no patch: a gap that grows slower than (F.1) is none.
//
// Of a smooth surface the ground feels means around nodes: between two columns it may bulge into
// the ground beside one that just does not touch, by 0.2 mm where columns are 16 mm wide. Means
// across of lines around, weighted by a hat a column wide to both sides, bulge not; but where the
// tread is round they lie behind its lowest line. Lines around have
//   g <- (g + mean of g across) / 2                                                           (F.2)
// half of the difference, as half of the sag is what counts in (T.2). Facets are as they are.
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
/// distance from it; `area`, m^2, what it stands for. `rest`, m: how far from the ground they may
/// be in the patch.
FootprintSize footprint_size(const TreadSurface& tread,
                             const Eigen::Matrix3Xd& at,
                             const Eigen::VectorXd& area,
                             double rest);

}  // namespace latsch::fe_tire
