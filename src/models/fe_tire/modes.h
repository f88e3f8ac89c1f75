// SPDX-License-Identifier: Apache-2.0
// Vibration modes of the tire: (K - omega^2 M) phi = 0 at an equilibrium, rim clamped.
#pragma once

#include <vector>

#include "base/result.h"
#include "models/fe_tire/equilibrium.h"
#include "models/fe_tire/fe_tire.h"
#include "models/fe_tire/ring.h"

namespace latsch::fe_tire {

/// Modes of the inflated ring by circumferential harmonics n = 0, 1, ...: one small Hermitian
/// problem each, until no further n can hold one of the `count` lowest. A mode of n > 0 comes as an
/// orthogonal pair.
Result<std::vector<Mode>> harmonic_modes(const Ring& ring,
                                         const Materials& materials,
                                         const Inflated& inflated,
                                         int count);

/// Modes of the whole ring with the tangent K, factorized in `factor`; `start` [unknowns x any]
/// spans a first guess and may be empty. Shapes come as columns of `shapes`, M-orthonormal.
Result<std::vector<double>> ring_frequencies(const numerics::Factorization& factor,
                                             const numerics::SymmetricMatrix& M,
                                             int count,
                                             const Eigen::MatrixXd& start,
                                             Eigen::MatrixXd& shapes);

/// Columns of ring unknowns of the shapes of `modes`.
Eigen::MatrixXd shape_columns(const Ring& ring, const std::vector<Mode>& modes);

}  // namespace latsch::fe_tire
