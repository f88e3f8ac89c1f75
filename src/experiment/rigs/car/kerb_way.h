// SPDX-License-Identifier: Apache-2.0
// The road that the wheels of a car meet in a kerb test, found without driving.
//
// Each wheel is taken as a rigid disk of radius R that rolls over the highest of nine lines over
// the width of its tread, 0.2 m unless its file states one. Its axle then follows the envelope
//   a(x) = max over |d| < R of z(x + d) + sqrt(R² - d²) - R
// The rise of a over a length R is that of an obstacle which the tire has to swallow: an edge of
// height h counts whole, a hill of the same height over some meters counts little, and a slot that
// is narrower than the disk is not seen. A tire that feels less than its tread's width, such as one
// with a single contact point, does not feel what stands beside that.
#pragma once

#include "experiment/rigs/car/kerb_rig.h"

namespace latsch::experiment {

/// Widths of a car's tires, m, each to either side of the wheel's middle.
struct TreadWidth {
  double felt = 0.0;   // over which the tire's model feels the road; 0: one line
  double tread = 0.1;  // half of a real tread
};

/// A place at which a tread would stand on something that the tire's model does not feel.
struct Unfelt {
  double rise = 0.0;    // m: above the highest of what is felt; 0: there is no such place
  double beside = 0.0;  // m: from the middle of the wheel to its edge
  int corner = car::kFL;
  double place = 0.0;  // m: in x of the test, as KerbWay::place
};

struct KerbWay {
  bool meets = false;              // a tire feels the kerb of the test
  Unfelt unfelt = {};              // the highest one
  bool varies_across = false;      // the height differs across the width of a wheel
  double rise = 0.0;               // m: greatest rise of an axle over a length R
  double radius = 0.0;             // m: R of that wheel
  int corner = car::kFL;           // the wheel that rises most
  double place = 0.0;              // m: where, in x of the test, 0 at the front axle at time 0
  double first = 0.0, last = 0.0;  // m: range of x of the wheels, likewise
};

/// Follows the wheels along the line and at the speed of the test.
KerbWay way_of(const KerbTest& test, const car::Car& car, const TreadWidth& width = {});

}  // namespace latsch::experiment
