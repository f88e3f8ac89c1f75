// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/belt_curve.h"

#include <cmath>
#include <numbers>

namespace latsch::ring_tire {

NodeValues at_knots(const NodeValues& x) {
  const Eigen::Index N = x.cols();
  NodeValues knots(4, N);
  const auto mean = [&](Eigen::Index before, Eigen::Index k, Eigen::Index after) {
    knots.col(k) = (4.0 / 6.0) * x.col(k) + (1.0 / 6.0) * (x.col(before) + x.col(after));
  };
  mean(N - 1, 0, 1);
  for (Eigen::Index k = 1; k + 1 < N; ++k) mean(k - 1, k, k + 1);
  mean(N - 2, N - 1, 0);
  return knots;
}

void add_at_knot(const Eigen::Matrix4d& k, int knot, CyclicBand& K) {
  const int N = K.nodes(), before = knot > 0 ? knot - 1 : N - 1,
            after = knot + 1 < N ? knot + 1 : 0;
  const Eigen::Matrix4d share = k / 36.0;
  K.block(before, 0) += share;
  K.block(before, 1) += 4.0 * share;
  K.block(before, 2) += share;
  K.block(knot, 0) += 16.0 * share;
  K.block(knot, 1) += 4.0 * share;
  K.block(after, 0) += share;
}

double node_radius_over_knot_radius(int nodes) {
  return 3.0 / (2.0 + std::cos(2.0 * std::numbers::pi / nodes));
}

CurveWeights curve_weights(double s) {
  const double s2 = s * s, s3 = s2 * s, r = 1.0 - s;
  return {
      .place = {r * r * r / 6.0,
                (3.0 * s3 - 6.0 * s2 + 4.0) / 6.0,
                (-3.0 * s3 + 3.0 * s2 + 3.0 * s + 1.0) / 6.0,
                s3 / 6.0},
      .slope = {
          -0.5 * r * r, (3.0 * s2 - 4.0 * s) / 2.0, (-3.0 * s2 + 2.0 * s + 1.0) / 2.0, 0.5 * s2}};
}

}  // namespace latsch::ring_tire
