// SPDX-License-Identifier: Apache-2.0
// A bar on the ground or on a drum, a cleat, over which a tire rolls, as its tread can feel it.
//
// A point of the tread is a mean of the surface by hat functions as wide as the elements
// (tread_surface.h). The ground below it is the same mean of the bar's section h(s),
//   b(s) = int (1 - |r|/w)/w h(s + r) dr,  |r| < w,                                           (G.3)
// with w the length of an element in the direction s across the bar. A vertical flank becomes a
// slope of the length 2 w, and no point is thrown up by the whole height of the bar within one
// step of time. Its volume is kept.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "models/fe_tire/grip/passing_ground.h"

namespace latsch::fe_tire {

class PassingBar {
 public:
  /// Height and length of the bar, m, the 45 degree bevel of its upper edges, m, the angle, rad,
  /// between bar and axle, counterclockwise from above, and w, m.
  struct Size {
    double height = 0.0, length = 0.0, bevel = 0.0, angle = 0.0;
    double smooth = 0.01;
  };
  explicit PassingBar(const Size& size);

  const Size& size() const { return size_; }
  /// Returns how far from its middle the bar is higher than the ground, m.
  double reach() const;

  /// Height over the ground, m, slope db/ds, and the length of the surface's arc less s, m, at the
  /// distance s, m, from the middle across the bar.
  struct Place {
    double height, slope, longer;
  };
  Place at(double s) const;
  /// Returns the distance s at which the arc's length is `arc`, m.
  double across(double arc) const;
  /// Unit vector across the bar in axes along and across the way.
  Eigen::Vector2d direction() const;

 private:
  struct Kink {  // h rises here by a step, m, and a change of slope
    double s, step, slope;
  };
  Size size_;
  std::vector<Kink> kinks_;
  std::vector<double> longer_;  // at even distances from -reach() to reach()
};

/// Ground that is smooth but for one bar, whose middle is at p = 0.
class GroundWithBar final : public PassingGround, public FeltGround {
 public:
  explicit GroundWithBar(const PassingBar::Size& size) : bar_(size) {}

  std::shared_ptr<const FeltGround> below(const WheelPlace&) const override {
    return {std::shared_ptr<const void>(), this};
  }
  Place at(const Eigen::Vector2d& p) const override;
  Eigen::Vector2d at_arc(const Eigen::Vector2d& arc) const override;

 private:
  PassingBar bar_;
};

}  // namespace latsch::fe_tire
