// SPDX-License-Identifier: Apache-2.0
#include "models/car/aero_loaders.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <string>
#include <utility>

namespace latsch::car {

using Eigen::Matrix;
using Eigen::Vector3d;
using Eigen::Vector4d;

namespace {

constexpr int kMostSteps = 8;
// Number of times that a step is halved at most while the car finds no static equilibrium at its
// end.
constexpr int kHalvings = 6;
// Force of a finite difference, N; large against the residual of the static equilibrium.
constexpr double kProbe = 200.0;
// Convergence tolerance: size of a step relative to the loaders' forces. Rolling tires settle to
// some newtons, so a smaller tolerance is not reached.
constexpr double kEnough = 1e-4;
// Smallest volume spanned by the three columns of slopes, relative to their length, at which they
// count as independent.
constexpr double kIndependent = 1e-6;

Vector4d as_vector(const std::array<double, kCorners>& forces) {
  return {forces[0], forces[1], forces[2], forces[3]};
}

/// Returns the unit vector normal to the three columns of S in four dimensions, by cofactors.
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

/// Returns the least-squares solution of S x = b. The component of b normal to the columns of S
/// remains as residual.
Vector3d solve_three(const Matrix<double, 4, 3>& S, const Vector4d& b) {
  return (S.transpose() * S).inverse() * (S.transpose() * b);
}

/// A car with loaders (virtual downforces) on its chassis, standing or rolling.
class LoadedCar {
 public:
  LoadedCar(Car& car,
            const AeroLoaders& loaders,
            const road::Road& road,
            double speed,
            const CarInputs& inputs)
      : car_(car), loaders_(loaders), road_(road), speed_(speed), inputs_(inputs) {}

  bool rolls() const { return rolls_; }
  bool has_speed() const { return speed_ != 0.0; }
  /// Switches settle() from the standing car to the car that rolls at its speed, if it has one.
  void roll() { rolls_ = speed_ > 0.0; }

  Vector4d pushrods(const CarState& state) const {
    return as_vector(car_.pushrod_forces(state, inputs_));
  }

  /// Computes the equilibrium of the car under these downforces of the loaders (N).
  Status settle(const Vector3d& downforce, CarState& state) {
    CarInputs with = inputs_;
    if (!rolls_ && with.guide) with.guide->speed = 0.0;
    for (multibody::Load& load : loaders_.loads(car_, downforce)) with.loads.push_back(load);
    auto settled = car_.settle(road_, rolls_ ? speed_ : 0.0, with);
    if (!settled) return settled.failure();
    state = std::move(*settled);
    return {};
  }

  /// Computes the equilibrium at the end of a step of the downforces. The step is halved while no
  /// equilibrium is found. `refused` states in words why there was none at the end of the whole
  /// step; it is empty if there was one.
  Status settle_after(Vector3d step, LoaderSolution& found, std::string& refused) {
    Status settled = settle(found.downforce, found.state);
    refused.clear();
    if (!settled) refused = settled.failure().reason;
    for (int k = 0; k < kHalvings && !settled; ++k) {
      step *= 0.5;
      found.downforce -= step;
      settled = settle(found.downforce, found.state);
    }
    return settled;
  }

  /// Finds the derivatives of the push-rods' forces with respect to the loaders' forces by finite
  /// differences.
  Status find_slopes(LoaderSolution& found) {
    for (int k = 0; k < 3; ++k) {
      Status settled;
      // If a bump stop has a kink at one probed force, no equilibrium may be found there, so other
      // forces are tried.
      for (const double probe : {kProbe, -kProbe, 0.5 * kProbe, -0.5 * kProbe}) {
        Vector3d more = found.downforce;
        more[k] += probe;
        CarState there;
        settled = settle(more, there);
        if (!settled) continue;
        found.slopes.col(k) = (pushrods(there) - found.pushrods) / probe;
        break;
      }
      if (!settled) return settled;
    }
    return {};
  }

 private:
  Car& car_;
  const AeroLoaders& loaders_;
  const road::Road& road_;
  double speed_;  // m/s
  const CarInputs& inputs_;
  bool rolls_ = false;
};

/// Returns true if the three columns are linearly independent: the volume they span, relative to
/// their length, exceeds a limit.
bool are_independent(const Matrix<double, 4, 3>& slopes) {
  const Eigen::Matrix3d squares = slopes.transpose() * slopes;
  return squares.determinant() > kIndependent * std::pow(squares.trace() / 3.0, 3);
}

/// Returns a failure that states how much the forces would still change after the last step. The
/// forces that no loaders can produce are not an error of the search and are stated separately.
Failure not_found(const LoaderSolution& found,
                  const Vector3d& step,
                  double enough,
                  const std::string& refused) {
  std::string words = fmt::format(
      "no loaders' forces were found for these push-rods: after {} steps they would still change "
      "by "
      "{:.3g} N, expected at most {:.3g} N (no loaders can produce {:.3g} N of the push-rods' "
      "forces)",
      kMostSteps,
      step.norm(),
      enough,
      std::abs(found.unreachable.dot(found.left)));
  if (!refused.empty())
    words += ". The last step was shortened, because at its end the car finds no equilibrium: " +
             refused;
  return {words};
}

}  // namespace

std::vector<multibody::Load> AeroLoaders::loads(const Car& car, const Vector3d& downforce) const {
  std::vector<multibody::Load> loads;
  for (int i = 0; i < 3; ++i) {
    const auto& bodies = car.mechanism().bodies();
    const CarParts& parts = car.parts();
    // The loader acts on the chassis, or on that half of a divided chassis whose origin is nearer
    // along x.
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
  LoadedCar loaded(car, loaders, road, speed, inputs);
  LoaderSolution found;
  found.downforce.setZero();
  Vector3d step = Vector3d::Zero();
  std::string refused;
  double enough = 0.0;
  for (int i = 0; i < kMostSteps; ++i) {
    const Status settled = i > 0 ? loaded.settle_after(step, found, refused)
                                 : loaded.settle(found.downforce, found.state);
    if (!settled) return settled.failure();
    found.pushrods = loaded.pushrods(found.state);
    if (i < 2) {
      if (const Status done = loaded.find_slopes(found); !done) return done.failure();
    }
    found.unreachable = normal_of(found.slopes);
    if (!are_independent(found.slopes))
      return Failure{"the loaders are in one line: three points of a triangle are needed"};
    step = solve_three(found.slopes, wanted - found.pushrods);
    found.left = wanted - found.pushrods;
    enough = kEnough * (1.0 + found.downforce.norm());
    if (step.norm() < enough && (loaded.rolls() || !loaded.has_speed())) return found;
    // The slopes are computed on the standing car under nearly these forces, because rolling tires
    // are expensive.
    if (i > 0) loaded.roll();
    found.downforce += step;
  }
  return not_found(found, step, enough, refused);
}

}  // namespace latsch::car
