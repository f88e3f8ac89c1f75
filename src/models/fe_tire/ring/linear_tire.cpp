// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/ring/linear_tire.h"

#include <Eigen/Geometry>

#include "numerics/sparse/elimination.h"
#include "numerics/sparse/front_algebra.h"

namespace latsch::fe_tire {
namespace {

// Points come down or lift off between iterations; where they repeat the solution is exact.
constexpr int kMostContactChanges = 30;
constexpr double kExact = 1e-8;  // relative to g: single precision is behind S

/// Two directions across `up`, then `up`: columns.
Eigen::Matrix3d across_and_up(const Eigen::Vector3d& up) {
  Eigen::Matrix3d Q;
  Q.col(0) = up.unitOrthogonal();
  Q.col(1) = up.cross(Q.col(0));
  Q.col(2) = up;
  return Q;
}

}  // namespace

LinearTire::LinearTire(const numerics::SymmetricPattern& pattern, const ContactWindow& window)
    : window_(window),
      factor_(pattern,
              numerics::Precision::single,
              std::make_shared<const numerics::Elimination>(
                  numerics::eliminate(pattern, window.block_rows()))),
      n_(window.nodes()) {}

bool LinearTire::factorize(const numerics::SymmetricMatrix& K, bool ground_apart) {
  ground_apart_ = ground_apart && n_ > 0;
  if (!ground_apart_) return factor_.factorize(K).definite();
  if (!factor_.condense(K).definite()) return false;
  condense_to_heights();
  return A_.size() > 0;
}

/// Takes the window's unknowns across and along the vertical, and eliminates those across.
void LinearTire::condense_to_heights() {
  const Eigen::MatrixXd interface = factor_.condensed();
  A_.resize(3 * n_, 3 * n_);
  const auto place = [this](int node, int k) { return k < 2 ? 2 * node + k : 2 * n_ + node; };
  std::vector<Eigen::Matrix3d> Q(n_);
  for (int a = 0; a < n_; ++a) Q[a] = across_and_up(window_.up(a));
  for (int b = 0; b < n_; ++b) {
    for (int a = 0; a < n_; ++a) {
      const Eigen::Matrix3d block = Q[a].transpose() * interface.block<3, 3>(3 * a, 3 * b) * Q[b];
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) A_(place(a, i), place(b, j)) = block(i, j);
      }
    }
  }
  const int across = 2 * n_, ld = 3 * n_;
  S_.resize(n_, n_);
  if (!numerics::cholesky(across, A_.data(), ld)) {
    A_.resize(0, 0);
    return;
  }
  numerics::solve_right_transposed(n_, across, A_.data(), ld, A_.data() + across);
  numerics::negative_square(n_, across, A_.data() + across, ld, S_.data());
  S_ += A_.bottomRightCorner(n_, n_);
  S_.triangularView<Eigen::StrictlyUpper>() = S_.transpose();
}

/// Forward elimination of a right-hand side; what is left of it at the heights.
Eigen::VectorXd LinearTire::reduce(Eigen::VectorXd& v) const {
  factor_.reduce(v);
  Eigen::VectorXd across(2 * n_), heights(n_), coupled(n_);
  for (int a = 0; a < n_; ++a) {
    const int row = 3 * window_.block_rows()[a];
    const Eigen::Vector3d turned = across_and_up(window_.up(a)).transpose() * v.segment<3>(row);
    across.segment<2>(2 * a) = turned.head<2>();
    heights[a] = turned[2];
  }
  const int ld = 3 * n_;
  numerics::solve_lower(2 * n_, 1, A_.data(), ld, across.data(), 2 * n_);
  numerics::multiply(n_, 1, 2 * n_, A_.data() + 2 * n_, ld, across.data(), 2 * n_, coupled.data());
  for (int a = 0; a < n_; ++a) {
    v.segment<2>(3 * window_.block_rows()[a]) = across.segment<2>(2 * a);
  }
  return heights - coupled;
}

/// Back substitution from the heights w.
void LinearTire::expand(const Eigen::VectorXd& w, Eigen::VectorXd& v) const {
  Eigen::VectorXd across(2 * n_);
  for (int a = 0; a < n_; ++a) {
    across.segment<2>(2 * a) = v.segment<2>(3 * window_.block_rows()[a]);
  }
  const int ld = 3 * n_;
  numerics::subtract_transposed(
      2 * n_, 1, n_, A_.data() + 2 * n_, ld, w.data(), across.data(), 2 * n_);
  numerics::solve_lower_transposed(2 * n_, 1, A_.data(), ld, across.data(), 2 * n_);
  for (int a = 0; a < n_; ++a) {
    const Eigen::Vector3d turned(across[2 * a], across[2 * a + 1], w[a]);
    v.segment<3>(3 * window_.block_rows()[a]) = across_and_up(window_.up(a)) * turned;
  }
  factor_.expand(v);
}

/// w with S w = g + c(z - w): C_ and L_ are those of its points in contact.
bool LinearTire::touch(const GroundContact& contact, const Eigen::VectorXd& g) {
  w_.setZero(n_);
  double smallest = std::numeric_limits<double>::infinity();
  for (int change = 0; change < kMostContactChanges; ++change) {
    Eigen::MatrixXd stiffness;
    c_ = window_.forces(contact, z_ - w_, &stiffness);
    Eigen::VectorXd left = g + c_ - S_ * w_;
    const bool same = change > 0 && stiffness == C_;
    if (same && left.norm() <= kExact * (g.norm() + c_.norm())) return true;
    smallest = std::min(smallest, left.norm());
    if (!same) {
      C_ = stiffness;
      L_ = S_ + C_;
      if (!numerics::cholesky(n_, L_.data(), n_)) return false;
    }
    numerics::solve_lower(n_, 1, L_.data(), n_, left.data(), n_);
    numerics::solve_lower_transposed(n_, 1, L_.data(), n_, left.data(), n_);
    w_ += left;
  }
  c_ = window_.forces(contact, z_ - w_, nullptr);
  return true;  // the residual of the elements' forces judges it
}

bool LinearTire::step(const GroundContact& contact,
                      const Eigen::VectorXd& x,
                      const Eigen::VectorXd& f,
                      Eigen::VectorXd& d) {
  z_ = window_.heights(x);
  const Eigen::VectorXd c = window_.forces(contact, z_, nullptr);
  d = f;
  for (int a = 0; a < n_; ++a) d.segment<3>(3 * window_.block_rows()[a]) -= c[a] * window_.up(a);
  g_ = d;
  const Eigen::VectorXd heights = reduce(d);
  if (!touch(contact, heights)) return false;
  expand(w_, d);
  return true;
}

Eigen::VectorXd LinearTire::residual(const numerics::SymmetricMatrix& K,
                                     const Eigen::VectorXd& d) const {
  Eigen::VectorXd Kd(d.size());
  K.multiply(d.data(), Kd.data());
  Eigen::VectorXd left = g_ - Kd;
  for (int a = 0; a < n_; ++a) {
    left.segment<3>(3 * window_.block_rows()[a]) += c_[a] * window_.up(a);
  }
  return left;
}

void LinearTire::multiply(const numerics::SymmetricMatrix& K,
                          const Eigen::VectorXd& v,
                          Eigen::VectorXd& Kv) const {
  K.multiply(v.data(), Kv.data());
  if (!ground_apart_) return;
  Eigen::VectorXd down(n_);
  for (int a = 0; a < n_; ++a) {
    down[a] = window_.up(a).dot(v.segment<3>(3 * window_.block_rows()[a]));
  }
  const Eigen::VectorXd force = C_ * down;
  for (int a = 0; a < n_; ++a) {
    Kv.segment<3>(3 * window_.block_rows()[a]) += force[a] * window_.up(a);
  }
}

void LinearTire::precondition(Eigen::VectorXd& v) const {
  if (!ground_apart_) {
    factor_.solve(v);
    return;
  }
  Eigen::VectorXd w = reduce(v);
  numerics::solve_lower(n_, 1, L_.data(), n_, w.data(), n_);
  numerics::solve_lower_transposed(n_, 1, L_.data(), n_, w.data(), n_);
  expand(w, v);
}

}  // namespace latsch::fe_tire
