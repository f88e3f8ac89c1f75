// SPDX-License-Identifier: Apache-2.0
// The footprint of a tire on the road, as measured by a pressure plate: an outline and the
// pressures in it. Axes: x along the wheel's heading on the ground, y to its left, from the point
// below the axle.
#pragma once

#include <vector>

namespace latsch {

/// A loaded rectangle of the tread.
struct FootprintElement {
  double x = 0.0, y = 0.0;              // m, its middle
  double length = 0.0, width = 0.0;     // m
  double pressure = 0.0;                // Pa, over the whole rectangle, grooves included
  double shear_x = 0.0, shear_y = 0.0;  // Pa, on the tire
  double friction = 0.0;                // 1: it slides if its shear is this many times the pressure
  /// Share of its length and width over which its force fades at the edges. The neighbor's force
  /// fills the difference, so that equal neighbors give an even pressure.
  double blur = 0.0;

  /// Area of the rectangle, m^2.
  double area() const { return length * width; }
};

struct Footprint {
  double length = 0.0, width = 0.0;        // m, largest values
  double area = 0.0;                       // m^2, grooves included
  double load = 0.0;                       // N
  std::vector<FootprintElement> elements;  // rectangles of which it consists

  /// Load over area, Pa.
  double mean_pressure() const { return area > 0.0 ? load / area : 0.0; }
  /// Returns the pressure that a square sensor of this side (m) measures with its middle at x, y,
  /// Pa.
  double pressure_at(double x, double y, double side) const;
  /// Returns the largest pressure that such a sensor measures at any position, searched in steps of
  /// a sixth of its side, then around the highest.
  double peak_pressure(double side) const;
  /// Returns the used share of friction over the whole patch: 1 if all of it slides; 0 without
  /// friction.
  double grip_level() const;
  /// Returns the footprint of a tire whose patch is a rectangle with one pressure.
  static Footprint rectangle(double load, double length, double width) {
    const double area = length * width;
    return {length, width, area, load, {{0.0, 0.0, length, width, load / area}}};
  }
};

}  // namespace latsch
