// SPDX-License-Identifier: Apache-2.0
#include "optimization/problem/quadratic_program.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "numerics/dense/cholesky.h"
#include "numerics/dense/orthogonal_factors.h"
#include "optimization/problem/infinity.h"

namespace latsch {
namespace {

// Violation of a constraint that is attributed to rounding, relative to the size of its terms.
constexpr double kViolated = 1e-11;
// Smallest share of a normal that must be independent of the active normals.
constexpr double kDependent = 1e-10;

/// The dual active-set method in the notation of the paper: constraints n_j'x >= b_j, the normals
/// of the active ones in N, their multipliers u.
class DualActiveSet {
 public:
  explicit DualActiveSet(const QuadraticProgram& qp)
      : qp_(qp),
        equations_(static_cast<int>(qp.E.rows())),
        count_(equations_ + static_cast<int>(qp.A.rows())),
        sign_(static_cast<size_t>(count_), 1.0),
        cholesky_(qp.G) {
    assert(cholesky_.is_positive_definite());
    x_ = -cholesky_.solve(qp.g);
  }

  QuadraticSolution run(int most_steps) {
    QuadraticSolution solution;
    for (long steps = 0;; ++steps) {
      const int p = most_violated();
      if (p == kNone) break;
      if (steps == long{most_steps} * (count_ + 1)) {
        solution.is_out_of_steps = true;
        break;
      }
      if (!take_in(p)) {
        solution.contradiction = contradiction(p);
        break;
      }
    }
    solution.x = x_;
    solution.lambda = Eigen::VectorXd::Zero(equations_);
    solution.mu = Eigen::VectorXd::Zero(count_ - equations_);
    for (size_t k = 0; k < active_.size(); ++k) {
      const int j = active_[k];
      if (j < equations_) {
        solution.lambda[j] = -sign_[j] * u_[k];
      } else {
        solution.mu[j - equations_] = u_[k];
      }
    }
    return solution;
  }

 private:
  static constexpr int kNone = -1;

  bool is_equation(int j) const { return j < equations_; }

  Eigen::VectorXd normal(int j) const {
    if (is_equation(j)) return sign_[j] * qp_.E.row(j).transpose();
    return -qp_.A.row(j - equations_).transpose();
  }

  double slack(int j) const {
    const double bound = is_equation(j) ? sign_[j] * qp_.f[j] : -qp_.b[j - equations_];
    return normal(j).dot(x_) - bound;
  }

  double tolerance(int j) const {
    const double bound = is_equation(j) ? qp_.f[j] : qp_.b[j - equations_];
    return kViolated * (1.0 + std::abs(bound) + normal(j).cwiseAbs().dot(x_.cwiseAbs()));
  }

  /// Returns the index of the most violated constraint, equations first. If h > 0 for an equation h
  /// = 0, its sign is reversed.
  int most_violated() {
    int worst = kNone;
    double least = 0.0;
    for (int j = 0; j < count_; ++j) {
      if (worst != kNone && is_equation(worst) && !is_equation(j)) break;
      if (std::find(active_.begin(), active_.end(), j) != active_.end()) continue;
      double s = slack(j);
      if (is_equation(j) && s > 0.0) {
        sign_[j] = -sign_[j];
        s = -s;
      }
      if (s < -tolerance(j) && s < least) {
        worst = j;
        least = s;
      }
    }
    return worst;
  }

  /// Computes z = H n, the motion of x along the active constraints that fulfills constraint n, and
  /// r = N* n, the motion of their multipliers.
  void directions(const Eigen::VectorXd& n) {
    const Eigen::VectorXd d = cholesky_.solve_lower(n);
    Eigen::VectorXd rest = d;
    r_.resize(0);
    if (!active_.empty()) {
      Eigen::MatrixXd N(n.size(), active_.size());
      for (size_t k = 0; k < active_.size(); ++k) N.col(k) = normal(active_[k]);
      const numerics::HouseholderQr qr(cholesky_.solve_lower(N));
      const int q = static_cast<int>(active_.size());
      Eigen::VectorXd rotated = qr.times_Q_transposed(d);
      r_ = qr.solve_R(rotated);
      rotated.head(q).setZero();
      rest = qr.times_Q(rotated);
    }
    is_dependent_ = rest.norm() <= kDependent * d.norm();
    z_ = cholesky_.solve_upper(rest);
  }

  /// Performs steps 2a to 2c of the paper. Returns false if constraint p cannot be fulfilled.
  bool take_in(int p) {
    double u_p = 0.0;
    while (true) {
      const Eigen::VectorXd n = normal(p);
      directions(n);
      double t1 = kInfinity;
      int leaving = kNone;
      for (int k = 0; k < static_cast<int>(active_.size()); ++k) {
        if (is_equation(active_[k]) || !(r_[k] > kDependent)) continue;
        if (u_[k] / r_[k] < t1) {
          t1 = u_[k] / r_[k];
          leaving = k;
        }
      }
      const double t2 = is_dependent_ ? kInfinity : -slack(p) / z_.dot(n);
      const double t = std::min(t1, t2);
      if (t == kInfinity) return false;
      for (int k = 0; k < static_cast<int>(active_.size()); ++k) u_[k] -= t * r_[k];
      u_p += t;
      if (!is_dependent_) x_ += t * z_;
      if (t == t2) {
        active_.push_back(p);
        u_.push_back(u_p);
        return true;
      }
      active_.erase(active_.begin() + leaving);
      u_.erase(u_.begin() + leaving);
    }
  }

  /// Returns the indices of constraints that contradict each other, by Farkas' lemma: n_p is a
  /// combination of active normals, none of which can be released.
  std::vector<int> contradiction(int p) const {
    std::vector<int> rows;
    for (size_t k = 0; k < active_.size(); ++k) {
      if (std::abs(r_[k]) > kDependent) rows.push_back(active_[k]);
    }
    rows.push_back(p);
    std::sort(rows.begin(), rows.end());
    return rows;
  }

  const QuadraticProgram& qp_;
  int equations_, count_;
  std::vector<double> sign_;     // sign of each equation, -1 if it is reversed
  numerics::Cholesky cholesky_;  // G = L L'
  Eigen::VectorXd x_;
  std::vector<int> active_;
  std::vector<double> u_;
  Eigen::VectorXd z_, r_;
  bool is_dependent_ = false;
};

}  // namespace

QuadraticSolution solve(const QuadraticProgram& program, int most_steps) {
  assert(program.E.rows() == program.f.size() && program.A.rows() == program.b.size());
  return DualActiveSet(program).run(most_steps);
}

}  // namespace latsch
