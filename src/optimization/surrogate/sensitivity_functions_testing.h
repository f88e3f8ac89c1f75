// SPDX-License-Identifier: Apache-2.0
// Functions over the unit cube whose shares of variance are known in closed form, for tests and the
// bench [T. Ishigami, T. Homma, Int. Symp. on Uncertainty Modeling and Analysis (1990) 398; g: A.
// Saltelli, I. Sobol, Reliab. Eng. Syst. Saf. 50 (1995) 225].
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace latsch {

using ResponseOfCube = std::function<double(const Eigen::VectorXd&)>;

/// First and total shares of a function.
struct ClosedShares {
  std::vector<double> first, total;  // one for each variable
};

/// sin x1 + 7 sin^2 x2 + 0.1 x3^4 sin x1 over -pi .. pi.
inline double ishigami(const Eigen::VectorXd& u) {
  const Eigen::VectorXd x = (2.0 * u.array() - 1.0) * std::numbers::pi;
  return std::sin(x[0]) + 7.0 * std::pow(std::sin(x[1]), 2) +
         0.1 * std::pow(x[2], 4) * std::sin(x[0]);
}

inline ClosedShares shares_of_ishigami() {
  const double pi4 = std::pow(std::numbers::pi, 4), a = 7.0, b = 0.1;
  const double one = 0.5 * std::pow(1.0 + b * pi4 / 5.0, 2), two = a * a / 8.0,
               both = b * b * pi4 * pi4 * 8.0 / 225.0, all = one + two + both;
  return {{one / all, two / all, 0.0}, {(one + both) / all, two / all, both / all}};
}

inline const std::vector<double>& weights_of_g() {
  static const std::vector<double> a{0.0, 1.0, 4.5, 9.0, 99.0, 99.0, 99.0, 99.0};
  return a;
}

/// Product of (|4 u_i - 2| + a_i) / (1 + a_i) over eight variables: it has kinks.
inline double sobols_g(const Eigen::VectorXd& u) {
  double product = 1.0;
  for (std::size_t i = 0; i < weights_of_g().size(); ++i)
    product *= (std::abs(4.0 * u[static_cast<Eigen::Index>(i)] - 2.0) + weights_of_g()[i]) /
               (1.0 + weights_of_g()[i]);
  return product;
}

inline ClosedShares shares_of_g() {
  double product = 1.0;
  std::vector<double> alone;
  for (const double a : weights_of_g()) {
    alone.push_back(1.0 / 3.0 / std::pow(1.0 + a, 2));
    product *= 1.0 + alone.back();
  }
  ClosedShares shares;
  for (const double one : alone) {
    shares.first.push_back(one / (product - 1.0));
    shares.total.push_back(one * product / (1.0 + one) / (product - 1.0));
  }
  return shares;
}

}  // namespace latsch
