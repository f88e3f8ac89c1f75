// SPDX-License-Identifier: Apache-2.0
// History of a viscoelastic stress along the streamlines of a tire that rolls through a mesh at
// rest.
//
// Streamlines are circles of the undeformed section: the points of one place of the section in all
// sectors. Forward rolling (Omega > 0) carries material toward decreasing theta. In the order of
// flow, points k = 0 ... m-1 are Delta t_k = Delta theta_k/|Omega| apart, unequally in general. In
// the steady state a term of the Prony series (H.1) obeys
//   h_{k+1} = e^(-a_k) h_k + c_k beta (S_{k+1} - S_k),  a = Delta t/tau, c = (1 - e^(-a))/a  (H.2)
// and for harmonic motions e^(i omega t) about it, with lambda = 1/tau + i omega and
// z = lambda Delta t,
//   h_{k+1} = e^(-z_k) h_k + beta [phi_1 Delta S + i omega Delta t_k (phi_1 S_k + phi_2 Delta S)],
//   phi_1 = (1 - e^(-z))/z, phi_2 = (1 - phi_1)/z;                                            (H.3)
// After a full turn h must be h_0 again: with b = prod e^(-z_k), h_0 is the value that (H.3)
// reaches after a turn from h = 0, divided by 1 - b. (H.2) and (H.3) are exact for S linear between
// points, stable for any step and of second order. They are computed as h = beta S + g, for which
// (H.3) reads
//   g_{k+1} = e^(-z_k) g_k - beta a_k [phi_1 S_k + phi_2 Delta S].
// The terms of g_0 are ratios of numbers of the same order as 1 - b, so no digits are lost from
// Omega -> 0, where h is beta i omega tau/(1 + i omega tau) S (relaxed at omega = 0), to Omega ->
// infinity, where h = beta (S - mean of S) at omega = 0.
//
// S must be in axes that turn with the sectors; stress in axes of the wheel would turn every sector
// and show a loss that is not there.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/history/prony.h"

namespace latsch::fe_tire {

class Streamline {
 public:
  /// Takes the angles of the points (rad, NOTATION.md) in any order, at least two, no two alike.
  explicit Streamline(const std::vector<double>& theta);

  int points() const { return static_cast<int>(order_.size()); }
  /// Indices of the points in the order in which material passes them in forward rolling.
  const std::vector<int>& order() const { return order_; }
  /// Angles from each point, in that order, to the next, rad, positive, 2 pi together.
  const Eigen::VectorXd& steps() const { return steps_; }

  /// Returns the history stress h of a term by (H.2), for stresses S [components x points], in the
  /// order of the constructor's points. Omega in rad/s, of any sign and size.
  Eigen::MatrixXd history(const PronyTerm& term, double Omega, const Eigen::MatrixXd& S) const;
  /// Returns the complex amplitude of h by (H.3), for amplitudes S of motions with the angular
  /// frequency omega, rad/s.
  Eigen::MatrixXcd history(const PronyTerm& term,
                           double Omega,
                           double omega,
                           const Eigen::MatrixXcd& S) const;
  /// Returns, for every point k, the derivative dh_k/dS_k in (H.2) while h and S of the points
  /// upstream are constant. It is beta times c of the step that ends at k.
  Eigen::VectorXd local_tangent(const PronyTerm& term, double Omega) const;

  /// Returns the power that is lost by the stress H on the strains E [components x points], in W,
  /// divided by the volume of one radian of the streamline's material. It is |Omega| times the
  /// integral of H : dE along the flow by the trapezoidal rule. Shear strains are engineering
  /// strains.
  double power(double Omega, const Eigen::MatrixXd& H, const Eigen::MatrixXd& E) const;
  /// Returns the same power of one term, whose history h is that of the stresses S, with the exact
  /// mean of h over every step in place of the trapezoidal rule:
  ///   mean of h from k to k+1 = phi_1 h_k + phi_2 beta (S_{k+1} - S_k),
  /// by which a stress that is a positive multiple of its strain never gains energy.
  double power(const PronyTerm& term,
               double Omega,
               const Eigen::MatrixXd& S,
               const Eigen::MatrixXd& h,
               const Eigen::MatrixXd& E) const;

 private:
  template <class Scalar>
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> history_of(
      const PronyTerm& term,
      double Omega,
      double omega,
      const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& S) const;
  /// Index in the order of flow of the point before step k, and of the point after it.
  int from(int k, bool forward) const;
  int to(int k, bool forward) const { return from(k + 1, forward); }
  double step(int k, bool forward) const { return steps_[forward ? k : points() - 1 - k]; }

  std::vector<int> order_;
  Eigen::VectorXd steps_;
};

}  // namespace latsch::fe_tire
