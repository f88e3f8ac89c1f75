// SPDX-License-Identifier: Apache-2.0
// The tire as a linear structure on ground that is not: what Newton's method asks at every
// iteration.
//
// With the residual split into g of elements and pressure and c of the ground in the window
// (contact_window.h), and the tangent K of g factorized at this or an earlier state,
//
//   solve    g - K d + c(z(x - d)) = 0                                                        (L.1)
//
// exactly, points that come down or lift off included. Everything but the heights of the window is
// eliminated once a factor:  S w = g' + c(z - w),  S dense, as large as the window has nodes. That
// is piecewise linear, so Newton's method on it ends after finitely many iterations, each a small
// Cholesky factor. An equilibrium then needs as many passes over the elements as the elements need:
// contact costs none.
//
// Where the ground is part of K (friction, no window) the same factor takes K whole.
#pragma once

#include <Eigen/Core>

#include "models/fe_tire/ring/contact_window.h"
#include "numerics/sparse/factorization.h"

namespace latsch::fe_tire {

class LinearTire {
 public:
  /// `window` must outlive it.
  LinearTire(const numerics::SymmetricPattern& pattern, const ContactWindow& window);

  /// Takes K; `ground_apart`: without the ground in the window. False where K (without the ground:
  /// where heights cannot move) is not positive definite.
  bool factorize(const numerics::SymmetricMatrix& K, bool ground_apart);

  /// d of (L.1) on this ground at the state x with the residual f = g + c. False where tire and
  /// ground together are not positive definite.
  bool step(const GroundContact& contact,
            const Eigen::VectorXd& x,
            const Eigen::VectorXd& f,
            Eigen::VectorXd& d);

  /// What is left of (L.1) at the last step's d with another K, and the linear equations of its
  /// correction, (K + dc/dx) e = r: the points in contact are those of the last step.
  Eigen::VectorXd residual(const numerics::SymmetricMatrix& K, const Eigen::VectorXd& d) const;
  void multiply(const numerics::SymmetricMatrix& K,
                const Eigen::VectorXd& v,
                Eigen::VectorXd& Kv) const;
  /// v <- (K + dc/dx)^-1 v of the factor's K
  void precondition(Eigen::VectorXd& v) const;

  /// Order of elimination.
  const numerics::Factorization& factor() const { return factor_; }

 private:
  void condense_to_heights();
  Eigen::VectorXd reduce(Eigen::VectorXd& v) const;
  void expand(const Eigen::VectorXd& w, Eigen::VectorXd& v) const;
  bool touch(const GroundContact& contact, const Eigen::VectorXd& g);

  const ContactWindow& window_;
  numerics::Factorization factor_;
  bool ground_apart_ = false;
  int n_;              // nodes of the window
  Eigen::MatrixXd A_;  // of its unknowns, two across the vertical a node, then the heights: factor
                       // of the former, and what couples them with the latter
  Eigen::MatrixXd S_;  // of the heights
  Eigen::MatrixXd C_, L_;      // dc/dz of the last step, factor of S + C
  Eigen::VectorXd z_, w_, g_;  // of the last step: heights, how far down they go, g
  Eigen::VectorXd c_;          // of the ground at its end
};

}  // namespace latsch::fe_tire
