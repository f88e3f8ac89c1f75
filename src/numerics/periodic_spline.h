// SPDX-License-Identifier: Apache-2.0
// Closed cubic spline: a periodic curve with continuous second derivatives through given points at
// unequal distances. Its errors fall with the fourth power of the distances, those of its first and
// second derivative with the third and the second [de Boor, A Practical Guide to Splines, 1978].
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::numerics {

class PeriodicSpline {
 public:
  /// Takes ascending places `t`, at least 3, all within one `period`, and the points' values there
  /// [components x places].
  PeriodicSpline(std::vector<double> t, double period, Eigen::MatrixXd values);

  /// Value and derivatives at a place.
  struct At {
    Eigen::VectorXd value, first, second;
  };
  /// Evaluates the curve at any place; places a period apart are the same.
  At at(double t) const;

 private:
  std::vector<double> t_;
  double period_;
  Eigen::MatrixXd y_, second_;  // values and second derivatives at t_
};

}  // namespace latsch::numerics
