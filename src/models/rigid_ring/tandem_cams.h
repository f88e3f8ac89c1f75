// SPDX-License-Identifier: Apache-2.0
// Enveloping: the road as the contact patch experiences it, from two cams that roll one behind the
// other.
//
//   |x/a_e|^c + |z/b_e|^c = 1     outline of a cam: ELLIPS_LENGTH, ELLIPS_HEIGHT (times R0),
//                                 ELLIPS_ORDER
//   l_s = ELLIPS_SHIFT 2a         their distance; a: half length of the patch
//   Z   = least height of a cam's middle on the road [cam_contact.h]
//   w   = (Z_f + Z_r)/2 - b_e     effective height
//   tan beta_y = (Z_r - Z_f)/l_s  effective slope, positive downhill
// [Schmeitz 2004; Pacejka 2012, 10.1.6]
//
// On a plane slope a cam touches uphill of its middle, so by this definition w is above the slope
// there: 0.5 mm at 8 %. Over the width there are ELLIPS_NWIDTH pairs side by side; w and beta_y are
// their means, and their lateral inclination is the effective camber.
#pragma once

#include <Eigen/Core>

#include "models/magic_formula/parameters.h"
#include "models/magic_formula/wheel_contact.h"
#include "models/rigid_ring/cam_outline.h"
#include "models/road/road.h"

namespace latsch::rigid_ring {

class TandemCams {
 public:
  explicit TandemCams(const magic_formula::Parameters& parameters);

  /// Returns the effective plane under a wheel at `center` with heading `forward`. `a`, `b`: half
  /// length and half width of the patch.
  magic_formula::RoadPlane plane(const Eigen::Vector3d& center,
                                 const Eigen::Vector3d& forward,
                                 double a,
                                 double b,
                                 const road::Road& road,
                                 double time) const;
  /// Returns the number of pairs side by side.
  int tracks() const { return tracks_; }

 private:
  CamOutline cam_;
  double shift_;
  int tracks_;
};

}  // namespace latsch::rigid_ring
