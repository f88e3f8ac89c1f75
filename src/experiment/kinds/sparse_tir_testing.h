// SPDX-License-Identifier: Apache-2.0
// For tests: a Magic Formula 6.1 with little more than its radius, load and vertical stiffness.
#pragma once

#include <string>

namespace latsch::experiment {

/// Returns the text of a .tir file in SI units. `more` continues [VERTICAL]: further keys, then
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

/// Returns the text of a sparse Magic Formula with the additional data of a rigid ring; its
/// frequencies are those of section 2 of Pacejka's chapter 9.
inline std::string tir_with_a_belt() {
  return sparse_tir(std::string(R"([INERTIA]
BELT_MASS = 7
BELT_IXX = 0.33
BELT_IYY = 0.6
[STRUCTURAL]
LONGITUDINAL_STIFFNESS = 300000
LATERAL_STIFFNESS = 110000
YAW_STIFFNESS = 5000
FREQ_LONG = 77
FREQ_LAT = 42
FREQ_YAW = 53
FREQ_WINDUP = 58
DAMP_LONG = 0.05
DAMP_LAT = 0.05
DAMP_YAW = 0.05
DAMP_WINDUP = 0.05
DAMP_RESIDUAL = 0.002
)") + kLongitudinalForce +
                    kSideForce);
}

}  // namespace latsch::experiment
