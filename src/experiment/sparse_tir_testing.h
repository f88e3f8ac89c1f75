// SPDX-License-Identifier: Apache-2.0
// For tests: a Magic Formula 6.1 of little else than its radius, load and vertical stiffness.
#pragma once

#include <string>

namespace latsch::experiment {

/// The text of a .tir file in SI units. `more` goes on in [VERTICAL]: further keys of it, then
/// sections of coefficients.
inline std::string sparse_tir(const std::string& more) {
  return R"([UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radians'
MASS = 'kg'
TIME = 'second'
PRESSURE = 'pascal'
[MODEL]
FITTYP = 61
[DIMENSION]
UNLOADED_RADIUS = 0.316
WIDTH = 0.205
[VERTICAL]
FNOMIN = 4000
VERTICAL_STIFFNESS = 190000
)" + more;
}

inline constexpr const char* kSideForce = R"([LATERAL_COEFFICIENTS]
PCY1 = 1.3
PDY1 = 1.0
PKY1 = -18
PKY2 = 1.8
)";

inline constexpr const char* kLongitudinalForce = R"([LONGITUDINAL_COEFFICIENTS]
PCX1 = 1.6
PDX1 = 1.1
PKX1 = 22
)";

}  // namespace latsch::experiment
