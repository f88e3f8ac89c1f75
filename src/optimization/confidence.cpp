// SPDX-License-Identifier: Apache-2.0
#include "optimization/confidence.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "numerics/singular_values.h"
#include "numerics/student_t.h"
#include "optimization/infinity.h"

namespace latsch {
namespace {

constexpr double kNearBound = 1e-6;          // of the range: a variable so near lies on its bound
constexpr double kRoundingOfValues = 1e-13;  // of the largest singular value: less is zero

/// On a bound, with S growing inward.
Bound held_at(double u, double gradient) {
  if (u < kNearBound && gradient > 0.0) return Bound::lower;
  if (u > 1.0 - kNearBound && gradient < 0.0) return Bound::upper;
  return Bound::none;
}

struct Spectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd directions;
};

/// n of each, also where there are fewer rows than columns.
Spectrum spectrum(const Eigen::MatrixXd& J) {
  const Eigen::Index n = J.cols();
  const auto [values, V] = numerics::singular_values(J);
  Spectrum s{Eigen::VectorXd::Zero(n), V};
  s.values.head(values.size()) = values;
  return s;
}

/// (J' J)^-1, with directions that J does not feel as wide as rounding allows to say.
Eigen::MatrixXd inverse_normal_matrix(const Eigen::MatrixXd& J) {
  if (J.cols() == 0) return {};
  const Spectrum s = spectrum(J);
  const double least =
      std::max(kRoundingOfValues * s.values[0], std::numeric_limits<double>::min());
  const Eigen::VectorXd scale = s.values.cwiseMax(least).cwiseInverse();
  const Eigen::MatrixXd W = s.directions * scale.asDiagonal();
  return W * W.transpose();
}

/// The part of column j that the columns of A cannot imitate.
Eigen::VectorXd beside(const Eigen::MatrixXd& A, const Eigen::VectorXd& j) {
  if (A.cols() == 0) return j;
  return j - A * (inverse_normal_matrix(A) * (A.transpose() * j));
}

/// How far inward, from a bound where S grows as 2 g d + h d^2, it stays below the threshold.
double reach(double g, double h, double threshold) {
  const double root = std::sqrt(g * g + h * threshold);
  const double d = threshold / (g + root);  // the root without cancellation
  return std::isfinite(d) ? d : kInfinity;
}

}  // namespace

Confidence confidence(const Linearization& at, const ConfidenceOptions& options) {
  const Eigen::Index m = at.r.size(), n = at.u.size();
  assert(m > 0 && at.J.rows() == m && at.J.cols() == n);
  Confidence c;
  const Eigen::VectorXd gradient = at.J.transpose() * at.r;
  std::vector<int> free;
  for (int i = 0; i < n; ++i) {
    c.held.push_back(held_at(at.u[i], gradient[i]));
    if (c.held.back() == Bound::none) free.push_back(i);
  }
  const auto nu = static_cast<double>(m) - static_cast<double>(free.size());
  c.sigma = options.sigma ? *options.sigma
            : nu > 0.0    ? std::max(options.least_sigma, std::sqrt(at.sum_of_squares() / nu))
                          : std::numeric_limits<double>::quiet_NaN();
  c.t = numerics::student_t_quantile(0.5 + 0.5 * options.level,
                                     options.sigma || nu <= 0.0 ? kInfinity : nu);
  const Spectrum all = spectrum(at.J);
  c.singular_values = all.values;
  c.directions = all.directions;

  const Eigen::MatrixXd J_free = at.J(Eigen::all, free);
  const Eigen::MatrixXd inverse = inverse_normal_matrix(J_free);
  const Eigen::VectorXd left = -inverse * gradient(free);  // to the least S
  c.covariance = Eigen::MatrixXd::Zero(n, n);
  c.correlation = Eigen::MatrixXd::Zero(n, n);
  c.intervals.resize(n);
  for (size_t a = 0; a < free.size(); ++a) {
    for (size_t b = 0; b < free.size(); ++b) {
      c.covariance(free[a], free[b]) = c.sigma * c.sigma * inverse(a, b);
      c.correlation(free[a], free[b]) = inverse(a, b) / std::sqrt(inverse(a, a) * inverse(b, b));
    }
    double half = c.t * c.sigma * std::sqrt(inverse(a, a)) + std::abs(left[a]);
    if (!std::isfinite(half)) half = kInfinity;
    c.intervals[free[a]] = {at.u[free[a]] - half, at.u[free[a]] + half};
  }
  for (int i = 0; i < n; ++i) {
    if (c.held[i] == Bound::none) continue;
    const double h = beside(J_free, at.J.col(i)).squaredNorm();
    const double inward = reach(std::abs(gradient[i]), h, c.threshold());
    c.intervals[i] = c.held[i] == Bound::lower ? Interval{-kInfinity, at.u[i] + inward}
                                               : Interval{at.u[i] - inward, kInfinity};
  }
  return c;
}

std::vector<DesignPoint> difference_points(const DesignSpace& space,
                                           const DesignPoint& center,
                                           double step) {
  std::vector<DesignPoint> points{center};
  const std::vector<double> u = space.to_unit(center);
  for (int i = 0; i < space.size(); ++i) {
    const auto stepped = [&](double side) {
      std::vector<double> moved = u;
      moved[i] += side;
      DesignPoint point = center;  // the exact bits of the other variables
      point.values[i] = space.from_unit(moved).values[i];
      return point;
    };
    const double inward = u[i] + step <= 1.0 ? step : -step;
    const DesignPoint first = stepped(inward), other = stepped(-inward);
    const double behind = u[i] - inward;
    const bool has_room_behind = behind >= 0.0 && behind <= 1.0 && space.contains(other);
    points.push_back(space.contains(first) || !has_room_behind ? first : other);
  }
  return points;
}

std::vector<Eigen::Index> known_residuals(const std::vector<Eigen::VectorXd>& residuals) {
  std::vector<Eigen::Index> known;
  for (Eigen::Index row = 0; row < residuals.front().size(); ++row) {
    const auto finite = [row](const Eigen::VectorXd& r) { return std::isfinite(r[row]); };
    if (std::all_of(residuals.begin(), residuals.end(), finite)) known.push_back(row);
  }
  return known;
}

Linearization differences(const DesignSpace& space,
                          const std::vector<DesignPoint>& points,
                          const std::vector<Eigen::VectorXd>& residuals) {
  const int n = space.size();
  assert(static_cast<int>(points.size()) == n + 1 && residuals.size() == points.size());
  const auto unit = [&](const DesignPoint& point) -> Eigen::VectorXd {
    const std::vector<double> u = space.to_unit(point);
    return Eigen::Map<const Eigen::VectorXd>(u.data(), n);
  };
  Linearization at{unit(points[0]), residuals[0], Eigen::MatrixXd(residuals[0].size(), n)};
  for (int i = 0; i < n; ++i) {
    const double h = unit(points[i + 1])[i] - at.u[i];
    at.J.col(i) = (residuals[i + 1] - at.r) / h;
  }
  return at;
}

}  // namespace latsch
