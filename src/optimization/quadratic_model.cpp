// SPDX-License-Identifier: Apache-2.0
#include "optimization/quadratic_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/orthogonal_factors.h"
#include "numerics/self_adjoint_eigen.h"

namespace latsch {
namespace {

constexpr int kSpareSamples = 4;  // beyond as many as coefficients: smooths kinks, stays local
constexpr double kNearest = 1.0 / 32.0;  // of the scale; points nearer than this weigh alike
constexpr double kRidge = 1e-3;          // prefers a small H where samples leave it open

std::vector<const Sample*> nearest(const std::vector<Sample>& samples,
                                   const Eigen::VectorXd& center,
                                   int count) {
  std::vector<std::pair<double, const Sample*>> order;  // samples lie in a row: ties by their age
  order.reserve(samples.size());
  for (const Sample& sample : samples) {
    order.emplace_back((sample.u - center).squaredNorm(), &sample);
  }
  const auto end = order.begin() + std::min<std::ptrdiff_t>(count, std::ssize(order));
  std::partial_sort(order.begin(), end, order.end());
  std::vector<const Sample*> chosen;
  for (auto it = order.begin(); it != end; ++it) chosen.push_back(it->second);
  return chosen;
}

/// The monomials 1, z_i, 1/2 z_i^2 and z_i z_j.
Eigen::VectorXd monomials(const Eigen::VectorXd& z) {
  const int n = static_cast<int>(z.size());
  Eigen::VectorXd row((n + 1) * (n + 2) / 2);
  int k = 0;
  row[k++] = 1.0;
  for (int i = 0; i < n; ++i) row[k++] = z[i];
  for (int i = 0; i < n; ++i) {
    for (int j = i; j < n; ++j) row[k++] = (i == j ? 0.5 : 1.0) * z[i] * z[j];
  }
  return row;
}

/// Weighted residual sum of squares over that of a constant; the first column of A are the weights.
double unexplained(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& x) {
  const Eigen::VectorXd weights = A.col(0);
  const double mean = weights.dot(b) / weights.squaredNorm();
  const double spread = (b - mean * weights).squaredNorm();
  return spread > 0.0 ? (A * x - b).squaredNorm() / spread : 0.0;
}

}  // namespace

std::optional<QuadraticModel> fit_quadratic(const std::vector<Sample>& samples,
                                            const Eigen::VectorXd& center,
                                            double radius) {
  const int n = static_cast<int>(center.size());
  const int coefficients = (n + 1) * (n + 2) / 2;
  if (std::ssize(samples) < n + 2) return std::nullopt;
  const auto chosen = nearest(samples, center, coefficients + kSpareSamples);
  const int rows = static_cast<int>(chosen.size());
  const double middle = (chosen[rows / 2]->u - center).norm();
  const double scale = std::max(radius, middle);

  const int ridge_rows = coefficients - n - 1;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows + ridge_rows, coefficients);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows + ridge_rows);
  for (int r = 0; r < rows; ++r) {
    const Eigen::VectorXd z = (chosen[r]->u - center) / scale;
    const double weight = 1.0 / std::max(z.norm(), kNearest);
    A.row(r) = weight * monomials(z).transpose();
    b[r] = weight * chosen[r]->value;
  }
  for (int k = 0; k < ridge_rows; ++k) A(rows + k, n + 1 + k) = kRidge;
  const Eigen::VectorXd x = numerics::least_squares_solution(A, b);

  QuadraticModel model{x.segment(1, n) / scale, Eigen::MatrixXd(n, n), 0.0};
  if (rows > coefficients) model.misfit = unexplained(A.topRows(rows), b.head(rows), x);
  int k = n + 1;
  for (int i = 0; i < n; ++i) {
    for (int j = i; j < n; ++j) model.H(i, j) = model.H(j, i) = x[k++] / (scale * scale);
  }
  if (!model.g.allFinite() || !model.H.allFinite()) return std::nullopt;
  return model;
}

BallStep minimize_in_ball(const QuadraticModel& model, double radius) {
  const auto eigen = numerics::self_adjoint_eigen(model.H);
  const Eigen::VectorXd& lambda = eigen.values;
  const Eigen::VectorXd g = eigen.vectors.transpose() * model.g;
  const auto step = [&](double mu) -> Eigen::VectorXd {
    return -(g.array() / (lambda.array() + mu)).matrix();
  };
  const double scale = std::max(lambda.cwiseAbs().maxCoeff(), g.norm() / radius);
  if (!(scale > 0.0)) return {Eigen::VectorXd::Zero(g.size()), 0.0};
  const double smallest = lambda[0];
  const bool convex = smallest > 1e-12 * scale;
  if (convex && step(0.0).norm() <= radius) return {eigen.vectors * step(0.0), 0.0};
  // |s(mu)| falls from infinity (or from too long) to below the radius on this interval. In the
  // hard case, g orthogonal to the lowest eigenvector, the step stays short: still downhill.
  double low = std::max(0.0, -smallest) + 1e-12 * scale;
  double high = low + 2.0 * scale;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (step(middle).norm() > radius ? low : high) = middle;
  }
  return {eigen.vectors * step(high), high};
}

}  // namespace latsch
