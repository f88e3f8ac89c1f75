// SPDX-License-Identifier: Apache-2.0
// Vibration modes of the tire: (K - omega^2 M) phi = 0 at an equilibrium, rim clamped.
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

/// What is said where a state has no tangent because an element (sector by sector) fails.
Failure no_tangent(const Ring& ring, int element);

/// Modes of the inflated ring by circumferential harmonics n = 0, 1, ...: one small Hermitian
/// problem each, until no further n can hold one of the `count` lowest. A mode of n > 0 comes as an
/// orthogonal pair. Sectors of the ring are equally wide; shapes are given on the planes of `mesh`,
/// which is the same tire, however divided. `tolerance`: SolverSettings::mode_tolerance.
Result<std::vector<Mode>> harmonic_modes(const RingElements& elements,
                                         const Mesh& mesh,
                                         const Inflated& inflated,
                                         int count,
                                         double tolerance);

/// The `count` lowest modes of the states that `assembly` can hold (all, even or odd ones), without
/// names. `factor` holds the tangent. Shapes are mass-normalized over the whole ring.
Result<std::vector<Mode>> ring_modes(const RingAssembly& assembly,
                                     const numerics::Factorization& factor,
                                     const numerics::SymmetricMatrix& M,
                                     int count,
                                     double tolerance);
/// The same of a state on the ground: Lanczos' method finds the modes with rough solutions,
/// Davidson's makes those that are asked for modes of K; where that does not succeed, solutions are
/// refined.
class LoadedModes {
 public:
  /// `factor`: a refined one of the tangent K. All of them must outlive it.
  LoadedModes(const RingAssembly& assembly,
              const numerics::SymmetricMatrix& K,
              const numerics::Factorization& factor,
              const numerics::SymmetricMatrix& M,
              const SolverSettings& settings);

  /// A frequency of approach() errs by less than this share, and is too high rather than too low.
  static constexpr double kNearby = 0.01;
  /// Frequencies of the `count` lowest modes, ascending, Hz, roughly: of the last `spare` worst.
  Result<std::vector<double>> approach(int count, int spare);
  /// The `count` lowest of these.
  Result<std::vector<Mode>> find(int count);
  /// How find() found them, for whoever wants them sharper while K, M and the factor stay as they
  /// are; none where solutions were refined.
  std::optional<numerics::Davidson> search() && { return std::move(search_); }

 private:
  const RingAssembly& assembly_;
  const numerics::SymmetricMatrix &K_, &M_;
  const numerics::Factorization& factor_;
  double tolerance_;
  std::optional<numerics::Davidson> search_;
};

/// Mass of each node of the ring, kg: rows of the mass matrix summed.
Eigen::VectorXd nodal_masses(const RingElements& elements);

}  // namespace latsch::fe_tire
