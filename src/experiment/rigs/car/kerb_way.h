// SPDX-License-Identifier: Apache-2.0
// The road that the wheels of a car meet in a kerb test, determined without simulating the car.
//
// Each wheel is taken as a rigid disk of radius R that rolls over the highest of nine lines across
// the width of its tread, 0.2 m unless its file states one. Its axle then follows the envelope
//   a(x) = max over |d| < R of z(x + d) + sqrt(R² - d²) - R
// The rise of a over a length R measures the obstacle that the tire has to absorb: an edge of
// height h counts fully, a hill of the same height over some meters counts little, and a slot that
// is narrower than the disk has no effect. A tire model that follows the road over less than its
// tread's width, such as one with a single contact point, misses obstacles beside that width.
#pragma once

#include "experiment/rigs/car/kerb_rig.h"

namespace latsch::experiment {

/// Half widths, m, of a car's tires.
struct TreadWidth {
  double felt = 0.0;   // half of the width over which the tire model follows the road; 0: one line
  double tread = 0.1;  // half of a real tread
};

/// A position at which a real tread would stand on something that the tire model misses.
struct Unfelt {
  /// m, height above the highest line that the model follows; 0: there is no such position
  double rise = 0.0;
  double beside = 0.0;  // m, distance from the middle of the wheel to the edge of the obstacle
  int corner = car::kFL;
  double place = 0.0;  // m, x as for KerbWay::place
};

struct KerbWay {
  bool meets = false;              // true if a tire model meets the kerb of the test
  Unfelt unfelt = {};              // the highest one
  bool varies_across = false;      // true if the height differs across the width of a wheel
  double rise = 0.0;               // m, largest rise of an axle over a length R
  double radius = 0.0;             // m, radius R of that wheel
  int corner = car::kFL;           // the wheel that rises most
  double place = 0.0;              // m, x of that rise in the test; 0 is the front axle at time 0
  double first = 0.0, last = 0.0;  // m, range of x that the wheels cover
};

/// Returns what the wheels meet along the line and at the speed of the test.
KerbWay way_of(const KerbTest& test, const car::Car& car, const TreadWidth& width = {});

}  // namespace latsch::experiment
