// SPDX-License-Identifier: Apache-2.0
// Length, width and area of a footprint, resolved finer than the elements.
//
// The gap between a cylinder and the ground beside a patch from -a to a grows as
//   g(s) ~ f(s / a),   f(t) = t sqrt(t^2 - 1) - arcosh t                                      (F.1)
// [Johnson, Contact Mechanics, Cambridge 1985, section 4.2, for line contact], near the edge with
// the distance from it to the power 3/2, as at any free edge, and farther away with its square. The
// edge on a line of samples, around the tire or across, is therefore that of the curve (F.1) which
// passes through two points of the surface at given heights. Both heights lie above the distance
// that penalty, interpolation and the offset of (T.1) leave in the patch. If the surface ends or
// descends before the second height is reached, the first of the two points is the edge. If no line
// around the tire has a length, there is no patch: a gap growing slower than (F.1) is no contact.
//
// On a smooth surface the ground acts on averages around nodes. Beside a column of elements that
// nearly touches, the surface between two columns may therefore bulge into the ground, by 0.2 mm if
// columns are 16 mm wide. Means of the gap across the tread, weighted by a hat function that
// reaches one column to both sides, do not bulge; but on a round tread they lie above its lowest
// line. Lines around the tire therefore use
//   g <- (g + mean of g across) / 2                                                           (F.2)
// with half of the difference, as half of the sag counts in (T.2). Facets are used unchanged.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/contact/tread_surface.h"

namespace latsch::fe_tire {

struct FootprintSize {
  double length = 0.0, width = 0.0;  // m, extent around the tire and across
  double area = 0.0;                 // m^2
};

/// Computes the footprint of the whole ring. `at`: positions of all samples of the tread in axes of
/// the ground, x along the road, z the distance from the ground. `area`, m^2: area of each sample.
/// `rest`, m: largest distance from the ground within the patch.
FootprintSize footprint_size(const TreadSurface& tread,
                             const Eigen::Matrix3Xd& at,
                             const Eigen::VectorXd& area,
                             double rest);

}  // namespace latsch::fe_tire
