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

/// Returns the normal to three columns of four, by cofactors.
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

/// Returns the least-squares solution of S x = b; the component along the normal remains.
Vector3d solve_three(const Matrix<double, 4, 3>& S, const Vector4d& b) {
  return (S.transpose() * S).inverse() * (S.transpose() * b);
}

}  // namespace

std::vector<multibody::Load> AeroLoaders::loads(const Car& car, const Vector3d& downforce) const {
  std::vector<multibody::Load> loads;
  for (int i = 0; i < 3; ++i) {
    const auto& bodies = car.mechanism().bodies();
    const CarParts& parts = car.parts();
    // If the chassis has two halves, the half with the nearer center is used.
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
  constexpr int kHalvings = 6;      // halvings of a step toward a state in which the car finds no
                                    // rest
  constexpr double kProbe = 200.0;  // N: large against the residual of settling
  constexpr double kEnough =
      1e-4;  // share of the forces, for a step: rolling tires settle to some newtons
  bool rolls = false;
  const auto pushrods = [&](const Vector3d& downforce, CarState& state) -> Status {
    CarInputs with = inputs;
    if (!rolls && with.guide) with.guide->speed = 0.0;
    for (multibody::Load& load : loaders.loads(car, downforce)) with.loads.push_back(load);
    auto settled = car.settle(road, rolls ? speed : 0.0, with);
    if (!settled) return settled.failure();
    state = std::move(*settled);
    return {};
  };
  LoaderSolution found;
  found.downforce.setZero();
  Vector3d step = Vector3d::Zero();
  for (int i = 0; i < kMost; ++i) {
    Status settled = pushrods(found.downforce, found.state);
    for (int k = 0; k < kHalvings && i > 0 && !settled; ++k) {
      step *= 0.5;
      found.downforce -= step;
      settled = pushrods(found.downforce, found.state);
    }
    if (!settled) return settled.failure();
    found.pushrods = as_vector(car.pushrod_forces(found.state, inputs));
    if (i < 2)
      for (int k = 0; k < 3; ++k) {
        // At a kink of a bump stop there may be no rest just there; other probes are then tried.
        for (const double probe : {kProbe, -kProbe, 0.5 * kProbe, -0.5 * kProbe}) {
          Vector3d more = found.downforce;
          more[k] += probe;
          CarState there;
          settled = pushrods(more, there);
          if (!settled) continue;
          found.slopes.col(k) =
              (as_vector(car.pushrod_forces(there, inputs)) - found.pushrods) / probe;
          break;
        }
        if (!settled) return settled.failure();
      }
    found.unreachable = normal_of(found.slopes);
    // The condition requires three independent columns: their volume relative to their length.
    const Eigen::Matrix3d squares = found.slopes.transpose() * found.slopes;
    if (!(squares.determinant() > 1e-6 * std::pow(squares.trace() / 3.0, 3)))
      return Failure{"the loaders are in one line: three points of a triangle are needed"};
    step = solve_three(found.slopes, wanted - found.pushrods);
    found.left = wanted - found.pushrods;
    const bool is_near = step.norm() < kEnough * (1.0 + found.downforce.norm());
    if (is_near && (rolls || speed == 0.0)) return found;
    // Slopes are those of the standing car with nearly these forces, because rolling tires are
    // expensive.
    if (i > 0) rolls = speed > 0.0;
    found.downforce += step;
  }
  return Failure{fmt::format("no loaders' forces were found for these push-rods: {:.3g} N are left",
                             found.left.norm())};
}

}  // namespace latsch::car
