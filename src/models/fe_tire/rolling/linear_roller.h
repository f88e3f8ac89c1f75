// SPDX-License-Identifier: Apache-2.0
// The tire, linear about an iterate, that rolls on flat ground: the problem that each iteration of
// Newton's method on (R.1) of rolling_tire.h solves.
//
//   g - K d = c(u - d)                                                                       (R.2)
// K is eliminated down to the nodes of the tread, where tread_roller.h solves the contact. The
// factor of K is in single precision: g is not, and iterations converge to it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/rolling/tread_roller.h"
#include "numerics/sparse/factorization.h"

namespace latsch::fe_tire {

class LinearRoller {
 public:
  /// The state that solves (R.2); d and c belong to all unknowns.
  using Found = TreadRoller::Found;

  /// All must outlive the roller.
  LinearRoller(const RingAssembly& assembly, const TreadSurface& tread, const TreadLines& lines);

  /// Factorizes K. Returns false if it is not positive definite.
  bool factorize(const numerics::SymmetricMatrix& K);
  bool has_factor() const { return has_factor_; }
  void forget();
  /// Returns K condensed to the tread's nodes [3 nodes x 3 nodes], in the axes of their unknowns.
  const Eigen::MatrixXd& at_tread() const { return nodes_.stiffness(); }
  /// Limits of the active sets (TreadRoller).
  void begin() { nodes_.begin(); }
  void be_careful(bool careful) { nodes_.be_careful(careful); }
  bool is_spent() const { return nodes_.is_spent(); }

  /// Solves (R.2) about the unknowns x with the forces g (TreadRoller::solve).
  Result<Found> solve(const RollingCase& of,
                      const Eigen::VectorXd& x,
                      const Eigen::VectorXd& g,
                      double load,
                      double enough,
                      GripState& states,
                      int& passes,
                      const PassingMoment* moment = nullptr);
  /// Returns the instant of the tread in a steady state with the unknowns x.
  TreadPast::Instant instant(const RollingCase& of, const Eigen::VectorXd& x) const;

 private:
  friend class RollingTangent;
  Eigen::VectorXd reduced(const Eigen::VectorXd& g, Eigen::VectorXd& at) const;
  void expand(const Eigen::VectorXd& at, Eigen::VectorXd& d) const;
  Eigen::VectorXd at_nodes(const Eigen::VectorXd& v) const;
  Eigen::VectorXd at_unknowns(const Eigen::VectorXd& at, Eigen::Index size) const;

  const TreadSurface& tread_;
  numerics::Factorization factor_;
  bool has_factor_ = false;
  TreadRoller nodes_;
};

}  // namespace latsch::fe_tire
