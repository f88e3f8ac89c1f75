// SPDX-License-Identifier: Apache-2.0
// Where a tire touches the road, as a pressure-measuring plate sees it: an outline and what stands
// in it. Axes x along the wheel's heading on the ground, y to its left, from below the axle.
#pragma once

#include <vector>

namespace latsch {

/// A rectangle of the tread with force.
struct FootprintElement {
  double x = 0.0, y = 0.0;              // m, its middle
  double length = 0.0, width = 0.0;     // m
  double pressure = 0.0;                // Pa, over all of it, grooves included
  double shear_x = 0.0, shear_y = 0.0;  // Pa, on the tire
  double friction = 0.0;  // 1: it slides where its shear is so many times the pressure
  /// Share of its length and width over which its force fades at the edges; its middle gives what
  /// they gain, so that neighbors alike make an even pressure.
  double blur = 0.0;

  double area() const { return length * width; }
};

struct Footprint {
  double length = 0.0, width = 0.0;  // m, longest and widest
  double area = 0.0;                 // m^2, grooves included
  double load = 0.0;                 // N
  std::vector<FootprintElement> elements;

  double mean_pressure() const { return area > 0.0 ? load / area : 0.0; }
  /// Pa, what a square sensor of this side (m) measures where its middle is at x, y.
  double pressure_at(double x, double y, double side) const;
  /// The most that such a sensor measures wherever it lies: searched in steps of a sixth
  /// of it, then around the highest.
  double peak_pressure(double side) const;
  /// How much of the friction is used, of all of the patch: 1 where all of it slides; 0 without
  /// friction.
  double grip_level() const;
  /// Of a tire that knows its patch as a rectangle under one pressure.
  static Footprint rectangle(double load, double length, double width) {
    const double area = length * width;
    return {length, width, area, load, {{0.0, 0.0, length, width, load / area}}};
  }
};

}  // namespace latsch
