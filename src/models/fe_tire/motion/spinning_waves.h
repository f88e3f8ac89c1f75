// SPDX-License-Identifier: Apache-2.0
// Waves around the spinning tire as they are found, one circumferential number after the other,
// before they are modes with names (spinning_modes.cpp).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/motion/spinning_harmonics.h"
#include "models/fe_tire/motion/spinning_tire.h"

namespace latsch::fe_tire {

/// Hz; motions of a wheel with a free rim below this frequency are those of the whole wheel.
inline constexpr double kWholeWheel = 0.5;

/// A wave Re(phi exp(i (n theta + omega t))) in axes that stand.
struct FoundWave {
  double omega;            // rad/s, negative: against the spin
  int n;                   // waves around the circumference
  Eigen::VectorXcd phi;    // unknowns of a sector and those of the rim; unit mass
  Eigen::Vector3d energy;  // kinetic, in the directions of the sector frame
};

/// Returns the `count` waves of the lowest magnitude of omega, ascending. A Failure says if no wave
/// is held at this speed.
Result<std::vector<FoundWave>> lowest_waves(const SpinningHarmonics& harmonics,
                                            int count,
                                            double tolerance);

/// Returns waves, ascending in the magnitude of omega, as modes on the section planes of `mesh`.
std::vector<SpinningMode> named_waves(const SpinningHarmonics& harmonics,
                                      const Mesh& mesh,
                                      std::vector<FoundWave> waves,
                                      double speed);

}  // namespace latsch::fe_tire
