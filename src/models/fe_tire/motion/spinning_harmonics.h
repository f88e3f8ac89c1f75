// SPDX-License-Identifier: Apache-2.0
// The equations of small motions about the inflated, spinning tire, one circumferential number at a
// time, with the rim held or moving:
//   (K(n) - Omega^2 W(n) + omega Omega (iG)(n) - omega^2 M(n)) phi = 0                        (W.2)
// in axes that stand, exp(i (n theta + omega t)), from the matrices in axes that spin along. omega
// > 0 travels with the spin, because forward rolling carries material toward decreasing theta.
//
// A rim that moves adds two unknowns to n = 0 and n = 1 (rim_motion.h). What it exerts on the tire
// follows from the fact that a wheel on which nothing acts can be moved as a whole without force,
// pressure and centrifugal forces included: with T the motions of the tire's nodes in a motion of
// the whole, the rim's columns of K are -K T and its corner is T* K T.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/motion/rim_motion.h"
#include "models/fe_tire/motion/spin.h"
#include "numerics/sparse/gyroscopic.h"

namespace latsch::fe_tire {

class SpinningHarmonics {
 public:
  /// Evaluates the elements about the state. The elements must outlive this object. A Failure says
  /// which element has no tangent.
  static Result<SpinningHarmonics> about(const RingElements& elements,
                                         const Inflated& state,
                                         const Rim& rim);

  /// Matrices and factorization for one n. `soft` is the part of K that keeps a free wheel in its
  /// place: springs on the rim's motions on which it has 0.1 Hz, N/m and N m/rad a sector.
  struct Equations {
    numerics::GyroscopicProblem problem;
    numerics::BorderedCholesky K_factor;
    Eigen::VectorXd soft;
  };
  /// A wave that (W.2) loses too early has the inertia (W.1), see standing_wave.h. Returns nothing
  /// if that leaves K(n) - Omega^2 W(n) not positive definite, too: the speed is above that of a
  /// standing wave, or the tire buckles.
  std::optional<Equations> equations(int n) const;

  /// Returns the displacements [3 x nodes_per_sector] of a vector of unknowns, the rim's included.
  Eigen::Matrix3Xcd displacements(int n, const Eigen::VectorXcd& phi) const;

  const Ring& ring() const { return elements_->ring(); }
  const Rim& rim() const { return rim_; }

 private:
  SpinningHarmonics(const RingElements& elements, const Rim& rim, double speed);
  Status evaluate(const Inflated& state);
  std::optional<Equations> with_inertia(int n, const SectorSpin::Harmonic& at) const;
  /// Returns the displacements of the tire's unknowns by the motions of the whole wheel.
  Eigen::MatrixXcd motions_of_whole(int n) const;
  void add_rim(int n, Equations& equations) const;

  const RingElements* elements_;
  Rim rim_;
  double speed_;  // rad/s
  SectorSpin spin_;
  SectorFlow flow_;
  SectorBlocks K_;
  struct RimElement {
    int element;
    Matrix24 M, C;
  };
  std::vector<RimElement> rim_elements_;
  Eigen::Matrix3Xd u_;  // m, displacements in the state
  MassProperties mass_;
};

}  // namespace latsch::fe_tire
