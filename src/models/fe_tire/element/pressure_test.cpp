// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/element/pressure.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace latsch::fe_tire {
namespace {

Matrix34 face() {
  Matrix34 x;
  x << 0.0, 1.0, 1.1, -0.1, 0.0, 0.1, 1.0, 0.9, 0.0, 0.05, 0.2, -0.1;
  return x;
}

TEST(Pressure, ForceOnAFlatFaceIsPressureTimesArea) {
  Matrix34 x = face();
  x.row(2).setZero();
  Vector12 f = Vector12::Zero();
  add_pressure(x, 2.0, f, nullptr);
  const Eigen::Vector3d d1 = x.col(2) - x.col(0), d2 = x.col(3) - x.col(1);
  const double area = 0.5 * d1.cross(d2).norm();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int a = 0; a < 4; ++a) sum += f.segment<3>(3 * a);
  EXPECT_NEAR(sum[2], -2.0 * area, 1e-14);  // the internal force is minus the load along the normal
  EXPECT_LT(sum.head<2>().norm(), 1e-15);
}

TEST(Pressure, LoadStiffnessIsTheSymmetricPartOfTheDerivative) {
  const Matrix34 x = face();
  Vector12 f = Vector12::Zero();
  Matrix12 K = Matrix12::Zero(), difference;
  add_pressure(x, 3.0, f, &K);
  const double h = 1e-3;  // f is quadratic in x, so the central difference is exact
  for (int j = 0; j < 12; ++j) {
    Matrix34 plus = x, minus = x;
    plus(j % 3, j / 3) += h;
    minus(j % 3, j / 3) -= h;
    Vector12 fp = Vector12::Zero(), fm = Vector12::Zero();
    add_pressure(plus, 3.0, fp, nullptr);
    add_pressure(minus, 3.0, fm, nullptr);
    difference.col(j) = (fp - fm) / (2.0 * h);
  }
  EXPECT_LT((K - 0.5 * (difference + difference.transpose())).norm(), 1e-11 * K.norm());
}

}  // namespace
}  // namespace latsch::fe_tire
