// SPDX-License-Identifier: Apache-2.0
// Enveloping: the road as the patch feels it, from two cams that roll behind one another.
//
//   |x/a_e|^c + |z/b_e|^c = 1     outline of a cam: ELLIPS_LENGTH, ELLIPS_HEIGHT (times R0),
//                                 ELLIPS_ORDER
//   l_s = ELLIPS_SHIFT 2a         their distance; a: half length of the patch
//   Z   = least height of a cam's center on the road
//   w   = (Z_f + Z_r)/2 - b_e     effective height
//   tan beta_y = (Z_r - Z_f)/l_s  effective slope, positive downhill
// [Schmeitz 2004; Pacejka 2012, 10.1.6]
//
// Over the width, ELLIPS_NWIDTH pairs stand side by side; their mean counts, and their inclination
// as effective camber. A kerb that is thinner than the spacing of the samples is not seen.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/magic_formula/parameters.h"
#include "models/magic_formula/wheel_contact.h"
#include "models/road/road.h"

namespace latsch::rigid_ring {

class TandemCams {
 public:
  explicit TandemCams(const magic_formula::Parameters& parameters);

  /// Under a wheel that stands at `center` and heads along `forward`; `a`, `b`: half length and
  /// half width of the patch.
  magic_formula::RoadPlane plane(const Eigen::Vector3d& center,
                                 const Eigen::Vector3d& forward,
                                 double a,
                                 double b,
                                 const road::Road& road,
                                 double time) const;

 private:
  double lowest(double x,
                double y,
                const Eigen::Vector2d& heading,
                const road::Road& road,
                double time) const;

  double shift_, b_e_;
  int tracks_;
  std::vector<double> x_, z_;  // points of the outline, z above the lowest
};

}  // namespace latsch::rigid_ring
