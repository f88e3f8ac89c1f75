// SPDX-License-Identifier: Apache-2.0
#include "optimization/direct_search/model_step.h"

#include <algorithm>

#include "numerics/dense/self_adjoint_eigen.h"
#include "optimization/problem/quadratic_program.h"

namespace latsch {
namespace {

// A model counts as clearly better if its misfit is below this share of the other model's misfit.
constexpr double kClearlyBetter = 0.1;
// Smallest curvature in the quadratic program, as a share of the largest one.
constexpr double kConvex = 1e-8;

std::optional<QuadraticModel> model(const SharedHistory<Sample>& samples,
                                    const Eigen::VectorXd& x,
                                    double reach) {
  const std::vector<Sample> chosen = nearest_samples(samples, x);
  auto of_f = fit_quadratic(chosen, x, reach);
  for (int i = 0; i < samples.size(); ++i) {
    if (samples[i].value < 0.0) return of_f;
  }
  std::vector<Sample> squares = chosen;
  for (Sample& sample : squares) sample.value *= sample.value;
  auto of_square = fit_quadratic(squares, x, reach);
  if (!of_f || !of_square) return of_f ? of_f : of_square;
  return of_f->misfit < kClearlyBetter * of_square->misfit ? of_f : of_square;
}

/// Minimizes  g's + 1/2 s'(H + mu I)s  inside the region around x.
Eigen::VectorXd among_constraints(const QuadraticModel& model,
                                  double mu,
                                  const FeasibleRegion& region,
                                  const Eigen::VectorXd& x) {
  const auto n = x.size();
  const Eigen::VectorXd curvature = numerics::self_adjoint_eigenvalues(model.H);
  const double size = std::max(curvature.cwiseAbs().maxCoeff(), model.g.norm());
  if (!(size > 0.0)) return Eigen::VectorXd::Zero(n);
  const double shift = std::max(mu, kConvex * size - curvature[0]);
  QuadraticProgram program;
  program.G = (model.H + shift * Eigen::MatrixXd::Identity(n, n)) / size;
  program.g = model.g / size;
  program.E = region.E();
  program.f = region.f() - region.E() * x;
  program.A = region.A();
  program.b = region.b() - region.A() * x;
  return solve(program).x;
}

}  // namespace

std::optional<Eigen::VectorXd> model_step(const SharedHistory<Sample>& samples,
                                          const FeasibleRegion& region,
                                          const Eigen::VectorXd& x,
                                          double reach) {
  const auto m = model(samples, x, reach);
  if (!m) return std::nullopt;
  const BallStep ball = minimize_in_ball(*m, reach);
  if (region.is_cube() || region.contains(x + ball.s)) return ball.s;
  const Eigen::VectorXd s = among_constraints(*m, ball.mu, region, x);
  const double length = s.norm();
  return length > reach ? Eigen::VectorXd(reach / length * s) : s;
}

}  // namespace latsch
