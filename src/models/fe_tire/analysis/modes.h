// SPDX-License-Identifier: Apache-2.0
// Vibration modes of the tire with the rim clamped: (K - omega^2 M) phi = 0 at an equilibrium.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "numerics/sparse/davidson.h"
#include "numerics/sparse/factorization.h"

namespace latsch::fe_tire {

/// Returns the Failure for a state that has no tangent because an element is inverted. Elements are
/// counted sector by sector.
Failure no_tangent(const Ring& ring, int element);

/// Computes modes of the inflated ring by circumferential harmonics n = 0, 1, ..., each a small
/// Hermitian problem, until no further n can hold one of the `count` lowest. Modes with n > 0 are
/// returned as orthogonal pairs. Sectors of the ring are equally wide; shapes are given on the
/// planes of `mesh`, which is the same tire with any division into sectors. `tolerance`:
/// SolverSettings::mode_tolerance.
Result<std::vector<Mode>> harmonic_modes(const RingElements& elements,
                                         const Mesh& mesh,
                                         const Inflated& inflated,
                                         int count,
                                         double tolerance);

/// Computes the `count` lowest modes, without names, of the motions that `assembly` represents
/// (all, even or odd). `factor` is the factorized tangent. Shapes are mass-normalized over the
/// whole ring.
Result<std::vector<Mode>> ring_modes(const RingAssembly& assembly,
                                     const numerics::Factorization& factor,
                                     const numerics::SymmetricMatrix& M,
                                     int count,
                                     double tolerance);
/// Computes modes about a state on the ground. Lanczos' method with inexact solves finds
/// approximate modes; Davidson's method then corrects the requested ones to modes of the tangent K.
/// If this does not converge, the solves are refined.
class LoadedModes {
 public:
  /// `factor`: the factorization of the tangent K, with refinement. All arguments must outlive this
  /// object.
  LoadedModes(const RingAssembly& assembly,
              const numerics::SymmetricMatrix& K,
              const numerics::Factorization& factor,
              const numerics::SymmetricMatrix& M,
              const SolverSettings& settings);

  /// Largest relative error of a frequency returned by approach(), which is usually too high.
  static constexpr double kNearby = 0.01;
  /// Returns approximate frequencies of the `count` lowest modes, ascending, Hz. The last `spare`
  /// of them are the least accurate.
  Result<std::vector<double>> approach(int count, int spare);
  /// Returns the `count` lowest of the modes that approach() found, corrected to the full accuracy.
  Result<std::vector<Mode>> find(int count);
  /// Returns the search with which find() found the modes. It can improve them further as long as
  /// K, M and the factorization stay the same. Not set if the solves were refined.
  std::optional<numerics::Davidson> search() && { return std::move(search_); }

 private:
  const RingAssembly& assembly_;
  const numerics::SymmetricMatrix &K_, &M_;
  const numerics::Factorization& factor_;
  double tolerance_;
  std::optional<numerics::Davidson> search_;
};

/// Returns the mass of each node of the ring, kg: sums over the rows of the mass matrix.
Eigen::VectorXd nodal_masses(const RingElements& elements);

}  // namespace latsch::fe_tire
