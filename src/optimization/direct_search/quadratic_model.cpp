// SPDX-License-Identifier: Apache-2.0
#include "optimization/direct_search/quadratic_model.h"

#include <algorithm>
#include <utility>

#include "numerics/dense/orthogonal_factors.h"
#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch {
namespace {

// Number of samples beyond the number of coefficients. More samples average over kinks; fewer
// samples make the model more local.
constexpr int kSpareSamples = 4;
// Largest number of samples of a model (or 2 n + 2 for n variables, if that is larger). Further
// samples would be far away and would make the fit slow.
constexpr int kMostSamples = 100;
// Distance, as a share of the larger of the radius and the median distance of the samples, below
// which samples have equal weights.
constexpr double kNearest = 1.0 / 32.0;
// Weight of the terms that make H small. They decide about H only if the samples do not determine
// it.
constexpr double kRidge = 1e-3;

int coefficients(int n) { return (n + 1) * (n + 2) / 2; }

/// Returns the monomials 1, z_i, 1/2 z_i^2 and z_i z_j.
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

/// Returns the ratio of the weighted sum of squared residuals to that of the best constant. The
/// first column of A holds the weights.
double unexplained(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& x) {
  const Eigen::VectorXd weights = A.col(0);
  const double mean = weights.dot(b) / weights.squaredNorm();
  const double spread = (b - mean * weights).squaredNorm();
  return spread > 0.0 ? (A * x - b).squaredNorm() / spread : 0.0;
}

/// Samples in coordinates z = (u - center) / scale with their weights.
struct Weighted {
  Eigen::MatrixXd Z;  // sample points, one in each row
  Eigen::VectorXd w, y;
};

/// Finds all coefficients by linear least squares, with one equation for each sample and one for
/// each coefficient of H, which is to be small.
QuadraticModel by_coefficients(const Weighted& data) {
  const auto n = static_cast<int>(data.Z.cols()), rows = static_cast<int>(data.Z.rows());
  const int count = coefficients(n), ridge_rows = count - n - 1;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows + ridge_rows, count);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows + ridge_rows);
  for (int r = 0; r < rows; ++r) A.row(r) = data.w[r] * monomials(data.Z.row(r)).transpose();
  b.head(rows) = data.w.cwiseProduct(data.y);
  for (int k = 0; k < ridge_rows; ++k) A(rows + k, n + 1 + k) = kRidge;
  const Eigen::VectorXd x = numerics::least_squares_solution(A, b);
  QuadraticModel model{x.segment(1, n), Eigen::MatrixXd(n, n), 0.0};
  if (rows > count) model.misfit = unexplained(A.topRows(rows), b.head(rows), x);
  int k = n + 1;
  for (int i = 0; i < n; ++i) {
    for (int j = i; j < n; ++j) model.H(i, j) = model.H(j, i) = x[k++];
  }
  return model;
}

/// Solves the same least-squares problem as by_coefficients() if there are fewer samples than
/// coefficients, with one unknown for each sample instead of one for each coefficient of H. With
/// the weighted monomials Q of order two and P of order zero and one,
///   (Q Q' + ridge^2 I) alpha + P p = W y,   P' alpha = 0,   h = Q' alpha
/// Q Q' is w w' (1/2 (z'z)^2 - 1/4 sum z_i^2 z_i^2).
QuadraticModel by_samples(const Weighted& data) {
  const auto n = data.Z.cols(), rows = data.Z.rows();
  const Eigen::ArrayXXd inner = (data.Z * data.Z.transpose()).array();
  const Eigen::MatrixXd squares = data.Z.cwiseAbs2();
  const Eigen::ArrayXXd kernel =
      0.5 * inner.square() - 0.25 * (squares * squares.transpose()).array();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(rows + n + 1, rows + n + 1);
  K.topLeftCorner(rows, rows) = data.w.asDiagonal() * kernel.matrix() * data.w.asDiagonal();
  K.diagonal().head(rows).array() += kRidge * kRidge;
  Eigen::MatrixXd P(rows, n + 1);
  P << data.w, data.w.asDiagonal() * data.Z;
  K.topRightCorner(rows, n + 1) = P;
  K.bottomLeftCorner(n + 1, rows) = P.transpose();
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows + n + 1);
  b.head(rows) = data.w.cwiseProduct(data.y);
  const Eigen::VectorXd x = numerics::least_squares_solution(K, b);
  const Eigen::VectorXd alpha = data.w.cwiseProduct(x.head(rows));
  QuadraticModel model{x.tail(n), data.Z.transpose() * alpha.asDiagonal() * data.Z, 0.0};
  model.H.diagonal() *= 0.5;
  return model;
}

}  // namespace

std::vector<Sample> nearest_samples(const SharedHistory<Sample>& samples,
                                    const Eigen::VectorXd& center) {
  const int n = static_cast<int>(center.size());
  const int most = std::max(kMostSamples, 2 * (n + 1));
  std::vector<std::pair<double, int>> order;  // points at equal distances are ordered by age
  order.reserve(static_cast<std::size_t>(samples.size()));
  for (int i = 0; i < samples.size(); ++i) {
    order.emplace_back((samples[i].u - center).squaredNorm(), i);
  }
  const auto count =
      std::min<std::ptrdiff_t>(std::min(coefficients(n) + kSpareSamples, most), std::ssize(order));
  std::partial_sort(order.begin(), order.begin() + count, order.end());
  std::vector<Sample> chosen;
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    chosen.push_back(samples[order[static_cast<std::size_t>(k)].second]);
  }
  return chosen;
}

std::optional<QuadraticModel> fit_quadratic(const std::vector<Sample>& chosen,
                                            const Eigen::VectorXd& center,
                                            double radius) {
  const int n = static_cast<int>(center.size());
  const auto rows = std::ssize(chosen);
  if (rows < n + 2) return std::nullopt;
  const double middle = (chosen[static_cast<std::size_t>(rows / 2)].u - center).norm();
  const double scale = std::max(radius, middle);
  Weighted data{Eigen::MatrixXd(rows, n), Eigen::VectorXd(rows), Eigen::VectorXd(rows)};
  for (std::ptrdiff_t r = 0; r < rows; ++r) {
    const Sample& sample = chosen[static_cast<std::size_t>(r)];
    const Eigen::VectorXd z = (sample.u - center) / scale;
    data.Z.row(r) = z.transpose();
    data.w[r] = 1.0 / std::max(z.norm(), kNearest);
    data.y[r] = sample.value;
  }
  const bool is_large = coefficients(n) > std::max(kMostSamples, 2 * (n + 1));
  QuadraticModel model = is_large ? by_samples(data) : by_coefficients(data);
  model.g /= scale;
  model.H /= scale * scale;
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
  // On this interval of mu, the length |s(mu)| falls from infinity, or from a value above the
  // radius, to a value below the radius. In the hard case (g orthogonal to the lowest eigenvector)
  // the step remains shorter than the radius but still leads downhill.
  double low = std::max(0.0, -smallest) + 1e-12 * scale;
  double high = low + 2.0 * scale;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (step(middle).norm() > radius ? low : high) = middle;
  }
  return {eigen.vectors * step(high), high};
}

}  // namespace latsch
