// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/reused_factor.h"

#include <algorithm>

#include "numerics/sparse/gmres.h"

namespace latsch::fe_tire {

ReusedFactor::ReusedFactor(const numerics::SymmetricPattern& pattern,
                           const numerics::Elimination& elimination,
                           const TreadSurface& tread,
                           const ReusedFactorOptions& options,
                           SolverCounts& counts)
    : options_(options), counts_(counts), tire_(pattern, elimination, tread), cg_(pattern.size()) {}

void ReusedFactor::begin(const TreadContact* contact) {
  last_shift_ = 0.0;
  if (!tire_.serves(contact)) forget();
}

void ReusedFactor::release() {
  forget();
  tire_.release();
}

bool ReusedFactor::factorize(const numerics::SymmetricMatrix& K, const TreadContact* contact) {
  ++counts_.factorizations;
  forget();
  if (tire_.factorize(K, contact)) age_ = 0;
  return exists();
}

bool ReusedFactor::renew(const LinearizedRing& at,
                         double tolerance,
                         IfIndefinite if_indefinite,
                         Eigen::VectorXd& d) {
  const double largest = at.K.diagonal().maxCoeff();
  double shift = std::max(options_.first_shift * largest, options_.shift_memory * last_shift_);
  while (!factorize(at.K, at.contact) || !find_first(at, d)) {
    const bool helps = shift < options_.largest_shift * largest;
    if (if_indefinite == IfIndefinite::give_up || !helps) return false;
    at.K.add_to_diagonal(shift);
    last_shift_ = shift;
    ++counts_.shifts;
    shift *= options_.shift_growth;
  }
  correct(at, tolerance, IfSlow::take_it, d);
  return true;
}

bool ReusedFactor::find_first(const LinearizedRing& at, Eigen::VectorXd& d) {
  ++counts_.solves;
  return tire_.step(at.contact, at.x, at.f, d);
}

bool ReusedFactor::correct(const LinearizedRing& at,
                           double tolerance,
                           IfSlow if_slow,
                           Eigen::VectorXd& d) {
  r_ = tire_.residual(at.K, d);
  const double wanted = tolerance * at.f.norm(), norm = r_.norm();
  age_ = 0;
  if (norm <= wanted) return true;
  // If a step with the factorization increases the residual, the factorization belongs to a
  // structure that differs too much.
  if (if_slow == IfSlow::give_up && norm > at.f.norm()) return false;
  const auto multiply = [&](const Eigen::VectorXd& v, Eigen::VectorXd& Kv) {
    tire_.multiply(at.K, v, Kv);
  };
  const auto precondition = [this](Eigen::VectorXd& v) {
    ++counts_.solves;
    tire_.precondition(v);
  };
  const auto solve = [&](auto&& method) {
    return method(
        multiply, precondition, r_, wanted / norm, options_.iterations_worth_a_factor, e_);
  };
  const numerics::CgOutcome cg = tire_.is_symmetric()
                                     ? solve([this](auto&&... all) { return cg_.solve(all...); })
                                     : solve([](auto&&... all) { return numerics::gmres(all...); });
  counts_.cg_iterations += cg.iterations;
  age_ = cg.iterations;
  const bool converged = cg.end == numerics::CgOutcome::End::converged;
  if (converged || if_slow == IfSlow::take_it) d += e_;
  return converged;
}

bool ReusedFactor::follow(const numerics::SymmetricMatrix& K,
                          TreadContact& contact,
                          const Eigen::VectorXd& x,
                          const Eigen::VectorXd& g,
                          const std::vector<GroundPose>& poses) {
  if (!factorize(K, &contact) || !tire_.follow(K, contact, x, g, poses)) forget();
  return exists();
}

bool ReusedFactor::solve_nearby(const numerics::SymmetricMatrix& K,
                                double enough,
                                Eigen::VectorXd& x) {
  if (!exists() || !tire_.is_symmetric()) return false;
  const auto multiply = [&K](const Eigen::VectorXd& v, Eigen::VectorXd& Kv) {
    Kv.resize(v.size());
    K.multiply(v.data(), Kv.data());
  };
  const auto precondition = [this](Eigen::VectorXd& v) { tire_.precondition(v); };
  const numerics::CgOutcome cg = cg_.solve(
      multiply, precondition, x, enough, options_.iterations_worth_an_own_factor, e_, true);
  if (cg.end != numerics::CgOutcome::End::converged) return false;
  x = e_;
  return true;
}

}  // namespace latsch::fe_tire
