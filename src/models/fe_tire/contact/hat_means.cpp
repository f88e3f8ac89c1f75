// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/contact/hat_means.h"

namespace latsch::fe_tire {
namespace {

/// Returns the weights of three values in the derivative, at the middle value, of the parabola
/// through them. h0 and h1 are the distances between them.
Eigen::Vector3d middle_slope(double h0, double h1) {
  return {-h1 / (h0 * (h0 + h1)), (h1 - h0) / (h0 * h1), h0 / (h1 * (h0 + h1))};
}

/// Returns the weights of three values in the derivative, at the first value, of the parabola
/// through them. h0 and h1 are the distances between them.
Eigen::Vector3d end_slope(double h0, double h1) {
  return {-(2.0 * h0 + h1) / (h0 * (h0 + h1)), (h0 + h1) / (h0 * h1), -h0 / (h1 * (h0 + h1))};
}

}  // namespace

Cubic hermite(std::optional<double> h0, double h, std::optional<double> h2, double u) {
  Eigen::Vector4d m1 = Eigen::Vector4d::Zero(), m2 = Eigen::Vector4d::Zero();
  if (h0) {
    m1.head<3>() = middle_slope(*h0, h);
  } else if (h2) {
    m1.tail<3>() = end_slope(h, *h2);
  } else {
    m1.segment<2>(1) = Eigen::Vector2d(-1.0, 1.0) / h;
  }
  if (h2) {
    m2.tail<3>() = middle_slope(h, *h2);
  } else if (h0) {
    m2.head<3>() = -end_slope(h, *h0).reverse();
  } else {
    m2.segment<2>(1) = Eigen::Vector2d(-1.0, 1.0) / h;
  }
  const double t = 0.5 * (u + 1.0), r = 1.0 - t;
  Cubic cubic;
  cubic.value = h * (t * r * r * m1 - t * t * r * m2);
  cubic.value[1] += r * r * (1.0 + 2.0 * t);
  cubic.value[2] += t * t * (1.0 + 2.0 * r);
  cubic.slope = h * (r * (r - 2.0 * t) * m1 + t * (t - 2.0 * r) * m2);
  cubic.slope[1] -= 6.0 * t * r;
  cubic.slope[2] += 6.0 * t * r;
  cubic.slope *= 0.5;  // factor dt/du
  return cubic;
}

double share_of_uniform(const std::array<std::optional<double>, 4>& h) {
  // Weight of the slope at a node in the integral: the difference of the squared lengths of its two
  // faces, divided by 12.
  const auto weight = [&h](int left) {
    return (*h[left + 1] * *h[left + 1] - *h[left] * *h[left]) / 12.0;
  };
  double more = 0.0;
  for (const int left : {0, 1, 2}) {  // face before a node whose slope depends on the middle node
    if (!h[left] || !h[left + 1]) continue;
    more += weight(left) * middle_slope(*h[left], *h[left + 1])[2 - left];
  }
  return 1.0 - more / (0.5 * (h[1].value_or(0.0) + h[2].value_or(0.0)));
}

Cubic linear(double u) {
  return {{0.0, 0.5 * (1.0 - u), 0.5 * (1.0 + u), 0.0}, {0.0, -0.5, 0.5, 0.0}};
}

}  // namespace latsch::fe_tire
