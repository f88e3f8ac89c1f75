// SPDX-License-Identifier: Apache-2.0
// Bending of the belt's section across its width. The node's position and torsion move the section
// as a straight piece. In addition it has the shapes of a free beam of width w,
//   u(y) = Σ γ_i q_i(y),  q_i: bending modes of the free-free beam, ∫ q_i^2 dy = w           (23)
// Their energy, per length of the circumference, is that of bending and of the belt's tension T0,
// of which every strip of the width carries its share along the ring:
//   1/2 λ_i γ_i^2 + 1/2 κ T0 γ_i'^2,  λ_i = D β_i^4/w^3                                      (24)
// β_i = 4.730, 7.853, 10.996; D is the bending stiffness per length of the circumference. With
// nodes L0 apart, γ linear between them and f_i the contact's force on mode i at the nodes, (24)
// gives
//   (λ_i L0 + 2 κ T0/L0) γ_k - (κ T0/L0) (γ_(k+1) + γ_(k-1)) = f_k                           (25)
// Its inverse is known in closed form: γ = G f, where G decays as ρ^|k-l| around the ring. Forces
// act only at nodes in contact, so their γ are the only unknowns. The γ have no inertia and are
// solved together with the belt's unknowns in one Newton iteration, in which they border the belt's
// matrix. [Gipser 1999: quasi-static section shapes smoothed along the ring by a cyclic tridiagonal
// system]
//
// Limits: a section bent all around the ring would stretch the belt's edges against its middle.
// That stiffness is not in (24), which is for bends no longer than the patch.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "models/ring_tire/belt/cyclic_band.h"
#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

class SectionBending {
 public:
  static constexpr int kModes = 3;
  using Field = Eigen::Matrix<double, kModes, Eigen::Dynamic>;  // γ of every node, m

  /// If bending_across of the belt is 0, the section stays straight and on() is false.
  SectionBending(const Belt& belt, double width, double chord, double tension, int nodes);

  bool on() const { return on_; }
  /// Returns q_i at y.
  double shape(int mode, double y) const;
  /// Returns γ for forces f on all nodes: (25).
  Field bent_by(const Field& f) const;

  /// Sets all γ to 0.
  void reset();
  /// Returns to the last keep().
  void restart() { field_ = kept_; }
  /// Moves γ along the ring so that it stays in space while the nodes move on by this number of
  /// segments.
  void flow(double segments);
  /// Sets the nodes in contact, whose γ are the unknowns.
  void touch(std::vector<int> nodes);
  const Field& field() const { return field_; }
  /// γ at the last accept(), to which restart() returns.
  const Field& kept() const { return kept_; }
  void keep(const Field& field) { field_ = kept_ = field; }
  const std::vector<int>& contact() const { return contact_; }
  Eigen::Index unknowns() const { return kModes * static_cast<Eigen::Index>(contact_.size()); }

  /// Computes the residual of (25) with the contact's forces on the unknowns, N.
  void set_forces(const Eigen::VectorXd& f);
  const Eigen::VectorXd& residual() const { return residual_; }

  /// Borders a factorized matrix of the belt. B = -df/dq (4 nodes x unknowns), A is the contact's
  /// own stiffness for γ, and `scale` is that of the belt's equations. Returns false if the whole
  /// matrix is not positive definite.
  bool border(const CyclicBandFactor& factor,
              const Eigen::MatrixXd& B,
              const Eigen::MatrixXd& A,
              double scale);
  /// Replaces the belt's residual x by Newton's step of the belt for both residuals; the step of γ
  /// is direction().
  void solve(const CyclicBandFactor& factor, Eigen::Matrix4Xd& x);
  /// Solves for a force on the belt alone.
  void solve_free(const CyclicBandFactor& factor, Eigen::Matrix4Xd& x) const;
  const Eigen::VectorXd& direction() const { return direction_; }
  /// Solves several right-hand sides: rows of the belt, then those of γ, scaled as the belt's.
  void solve_columns(const CyclicBandFactor& factor, Eigen::Ref<SideBySide> x) const;
  /// γ of the unknowns.
  Eigen::VectorXd values() const;
  void set_values(const Eigen::VectorXd& values);
  /// Energy of (24), J.
  double energy() const;
  /// Ends the step: γ beyond the contact follows.
  void accept();

 private:
  void spread();
  /// G of (25) as a function of the distance of two nodes.
  double green(int mode, int distance) const { return green_(mode, distance); }

  bool on_;
  int nodes_;
  double width_;
  Field green_, field_, kept_;
  std::vector<int> contact_;
  Eigen::MatrixXd flexibility_, own_;  // G of the unknowns, its inverse
  Eigen::VectorXd residual_, direction_;
  Eigen::MatrixXd B_, KB_;
  // It begins with an empty matrix, because a copy of a factor that was never made is undefined.
  Eigen::LLT<Eigen::MatrixXd> schur_{Eigen::MatrixXd(0, 0)};
  double scale_ = 1.0;
};

}  // namespace latsch::ring_tire
