// SPDX-License-Identifier: Apache-2.0
#include "models/car/aero_loaders.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace latsch::car {

using Eigen::Matrix;
using Eigen::Vector3d;
using Eigen::Vector4d;

namespace {

Vector4d as_vector(const std::array<double, kCorners>& forces) {
  return {forces[0], forces[1], forces[2], forces[3]};
}

/// Normal to three columns of four: by cofactors.
Vector4d normal_of(const Matrix<double, 4, 3>& S) {
  Vector4d n;
  for (int i = 0; i < 4; ++i) {
    Eigen::Matrix3d minor;
    for (int row = 0, k = 0; row < 4; ++row)
      if (row != i) minor.row(k++) = S.row(row);
    n[i] = (i % 2 == 0 ? 1.0 : -1.0) * minor.determinant();
  }
  return n.normalized();
}

/// The least-squares solution of S x = b: what is along the normal stays.
Vector3d solve_three(const Matrix<double, 4, 3>& S, const Vector4d& b) {
  return (S.transpose() * S).inverse() * (S.transpose() * b);
}

}  // namespace

std::vector<multibody::Load> AeroLoaders::loads(const Car& car, const Vector3d& downforce) const {
  std::vector<multibody::Load> loads;
  for (int i = 0; i < 3; ++i) {
    const auto& bodies = car.mechanism().bodies();
    const CarParts& parts = car.parts();
    // Of a chassis of two halves, the half whose center is nearer.
    const auto away = [&](int body) {
      return std::abs(bodies[static_cast<std::size_t>(body)].origin.x() - points(0, i));
    };
    const int body =
        away(parts.chassis) <= away(parts.chassis_rear) ? parts.chassis : parts.chassis_rear;
    loads.push_back({body, points.col(i), {0.0, 0.0, -downforce[i]}});
  }
  return loads;
}

std::pair<Vector3d, Vector4d> LoaderSolution::near(const Vector4d& wanted) const {
  const Vector4d more = wanted - pushrods;
  const Vector3d step = solve_three(slopes, more);
  return {downforce + step, more - slopes * step};
}

Result<LoaderSolution> solve_loaders(Car& car,
                                     const AeroLoaders& loaders,
                                     const Vector4d& wanted,
                                     const road::Road& road,
                                     double speed,
                                     const CarInputs& inputs) {
  constexpr int kMost = 8;
  constexpr double kProbe = 200.0;  // N: large against what settling leaves
  const auto pushrods = [&](const Vector3d& downforce, CarState& state) -> std::string {
    CarInputs with = inputs;
    for (multibody::Load& load : loaders.loads(car, downforce)) with.loads.push_back(load);
    auto settled = car.settle(road, speed, with);
    if (!settled) return settled.failure().reason;
    state = std::move(*settled);
    return {};
  };
  LoaderSolution found;
  found.downforce.setZero();
  for (int i = 0; i < kMost; ++i) {
    if (std::string trouble = pushrods(found.downforce, found.state); !trouble.empty())
      return Failure{trouble};
    found.pushrods = as_vector(car.pushrod_forces(found.state, inputs));
    if (i < 2)
      for (int k = 0; k < 3; ++k) {
        Vector3d more = found.downforce;
        more[k] += kProbe;
        CarState there;
        if (std::string trouble = pushrods(more, there); !trouble.empty()) return Failure{trouble};
        found.slopes.col(k) =
            (as_vector(car.pushrod_forces(there, inputs)) - found.pushrods) / kProbe;
      }
    found.unreachable = normal_of(found.slopes);
    // Three columns that are not two: their volume against their length.
    const Eigen::Matrix3d squares = found.slopes.transpose() * found.slopes;
    if (!(squares.determinant() > 1e-6 * std::pow(squares.trace() / 3.0, 3)))
      return Failure{"the loaders stand in one line: three points of a triangle are needed"};
    const Vector3d step = solve_three(found.slopes, wanted - found.pushrods);
    found.left = wanted - found.pushrods;
    if (step.norm() < 1e-5 * (1.0 + found.downforce.norm())) return found;
    found.downforce += step;
  }
  return Failure{fmt::format("no loaders' forces were found for these push-rods: {:.3g} N are left",
                             found.left.norm())};
}

}  // namespace latsch::car
