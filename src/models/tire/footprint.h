// SPDX-License-Identifier: Apache-2.0
// The footprint of a tire on the road, as measured by a pressure plate: an outline and the
// pressures in it. Axes: x along the wheel's heading on the ground, y to its left, from the point
// below the axle.
#pragma once

#include <vector>

namespace latsch {

/// A loaded rectangle of the tread, with uniform pressure and shear.
struct FootprintElement {
  double x = 0.0, y = 0.0;              // m, its center
  double length = 0.0, width = 0.0;     // m
  double pressure = 0.0;                // Pa, mean over the whole rectangle, grooves included
  double shear_x = 0.0, shear_y = 0.0;  // Pa, shear stress on the tire
  /// The element slides if its shear stress is `friction` times its pressure.
  double friction = 0.0;
  /// Share of the rectangle's length and width over which its pressure fades at the edges. The
  /// pressure of the neighbors fills the gap, so that equal neighbors give a uniform pressure.
  double blur = 0.0;

  /// Area of the rectangle, m^2.
  double area() const { return length * width; }
};

struct Footprint {
  double length = 0.0, width = 0.0;        // m, largest dimensions of the footprint
  double area = 0.0;                       // m^2, grooves included
  double load = 0.0;                       // N
  std::vector<FootprintElement> elements;  // rectangles of which the footprint consists

  /// Mean pressure: load divided by area, Pa.
  double mean_pressure() const { return area > 0.0 ? load / area : 0.0; }
  /// Returns the pressure, Pa, that a square sensor with sides of length `side` (m) measures if its
  /// center is at x, y.
  double pressure_at(double x, double y, double side) const;
  /// Returns the largest pressure that a square sensor with sides of length `side` measures at any
  /// position. The search has steps of a sixth of the side, then refines around the highest value.
  double peak_pressure(double side) const;
  /// Returns the utilized share of the friction over the whole footprint: 1 if all of it slides, 0
  /// without friction.
  double grip_level() const;
  /// Returns a footprint that consists of one rectangle with uniform pressure.
  static Footprint rectangle(double load, double length, double width) {
    const double area = length * width;
    return {length, width, area, load, {{0.0, 0.0, length, width, load / area}}};
  }
};

}  // namespace latsch
