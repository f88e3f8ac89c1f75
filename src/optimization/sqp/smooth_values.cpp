// SPDX-License-Identifier: Apache-2.0
#include "optimization/sqp/smooth_values.h"

#include <algorithm>

#include "numerics/dense/orthogonal_factors.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
double SmoothValues::violation() const {
  double worst = 0.0;
  for (const double value : c) worst = std::max(worst, value);
  for (const double value : h) worst = std::max(worst, std::abs(value));
  return worst;
}

std::optional<SmoothValues> smooth_values(const Score& score) {
  SmoothValues values{score.value,
                      to_vector(score.residuals),
                      to_vector(score.constraints),
                      to_vector(score.equations)};
  if (values.r.size() > 0) values.f = values.r.squaredNorm();
  if (!all_values(values).allFinite()) return std::nullopt;
  return values;
}

bool same_shape(const SmoothValues& a, const SmoothValues& b) {
  return a.r.size() == b.r.size() && a.c.size() == b.c.size() && a.h.size() == b.h.size();
}

Eigen::VectorXd all_values(const SmoothValues& values) {
  const Eigen::VectorXd first =
      values.r.size() > 0 ? values.r : Eigen::VectorXd::Constant(1, values.f);
  Eigen::VectorXd all(first.size() + values.c.size() + values.h.size());
  all << first, values.c, values.h;
  return all;
}

SmoothSlopes slopes_at(const SmoothValues& values, const Eigen::MatrixXd& J) {
  SmoothSlopes slopes;
  slopes.c = J.middleRows(J.rows() - values.c.size() - values.h.size(), values.c.size());
  slopes.h = J.bottomRows(values.h.size());
  if (values.r.size() > 0) {
    slopes.r = J.topRows(values.r.size());
    slopes.g = 2.0 * slopes.r.transpose() * values.r;
  } else {
    slopes.g = J.row(0).transpose();
  }
  return slopes;
}

Eigen::MatrixXd jacobian_of(const Eigen::MatrixXd& S, const Eigen::MatrixXd& D) {
  const Eigen::MatrixXd values = S.transpose();
  return numerics::shortest_solution(D.transpose(), values).transpose();
}

}  // namespace latsch
