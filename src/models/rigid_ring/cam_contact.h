// SPDX-License-Identifier: Apache-2.0
// Height of a cam on a road: the least height of its middle at which no part of the road is inside
// its outline,
//
//   Z = max over |x| <= a of h(x) + depth(x),     h: height of the road along the cam
//
// exact to a tenth of a micrometer. [-a, a] is halved until each piece meets one of these
// conditions: it cannot hold the maximum (Road::bounds); it is a plane (the point where the outline
// has its slope, in closed form); it is a smooth curve (a parabola through it, exact to kSmooth);
// or it is so short that a flank or corner is located to within kShortest.
//
// Limits: if a road gives no bounds, an obstacle shorter than kFirst may be missed; if its bounds
// are wider than the road itself, one shorter than kFine.
#pragma once

#include <Eigen/Core>

#include "models/rigid_ring/cam_outline.h"
#include "models/road/road.h"

namespace latsch::rigid_ring {

class CamContact {
 public:
  /// Takes a cam with its middle over `middle`, along the unit vector `heading`.
  CamContact(const CamOutline& cam,
             const Eigen::Vector2d& middle,
             const Eigen::Vector2d& heading,
             const road::Road& road,
             double time);

  /// Returns Z, m.
  double height() const { return best_; }

 private:
  /// A piece with h at l, r and at the quarters between.
  struct Piece {
    double l, r;
    double h[5];

    double width() const { return r - l; }
    double highest() const;
    double roughest() const;  // largest change between neighbors of the five
    bool smooth() const;
  };

  double ground(double x) const;
  road::GroundBounds bounds(double l, double r) const;
  void improve(double x, double h) { best_ = std::max(best_, h + cam_.depth(x)); }
  void look(double l, double h_l, double r, double h_r);
  void halve(double l, double h_l, double r, double h_r);
  void touch_line(double l, double h_l, double r, double h_r);
  void touch_parabola(const Piece& piece);

  const CamOutline& cam_;
  Eigen::Vector2d middle_, heading_;
  const road::Road& road_;
  double time_;
  double best_;
};

}  // namespace latsch::rigid_ring
