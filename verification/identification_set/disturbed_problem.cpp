// SPDX-License-Identifier: Apache-2.0
#include "identification_set/disturbed_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "optimization/design/sobol.h"
#include "optimization/problem/point_vector.h"

namespace latsch::identification_set {
namespace {

constexpr double kRipple = 1e-3, kNoise = 1e-3;
// number of waves over the range of a variable
constexpr double kFewestWaves = 20.0, kMostWaves = 100.0;
// Least distances of start and true values from the edge of the failing corner, in the unit cube.
constexpr double kFromStart = 0.02, kFromTruth = 0.03;
constexpr int kNormals = 64, kPoints = 4096;

double square(const Vector& r) {
  double sum = 0.0;
  for (const double value : r) sum += value * value;
  return sum;
}

/// FNV-1a hash, used because the random numbers for a point must not depend on the standard
/// library.
std::uint64_t number_of(const Vector& x) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : DesignPoint{x}.bits()) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  }
  return hash;
}

/// Returns the depth of the point u inside the failing corner; negative outside it.
double depth(const std::vector<HalfSpace>& corner, const Eigen::VectorXd& u) {
  double least = std::numeric_limits<double>::infinity();
  for (const HalfSpace& half : corner) least = std::min(least, half.a.dot(u) - half.b);
  return least;
}

/// Returns the half space with the normal a that contains the share kCorner of the points, which
/// fill the unit cube.
HalfSpace half_space(Eigen::VectorXd a, const std::vector<Eigen::VectorXd>& points) {
  a.normalize();
  Vector along;
  for (const Eigen::VectorXd& u : points) along.push_back(a.dot(u));
  std::sort(along.begin(), along.end());
  return {a, along[static_cast<std::size_t>((1.0 - kCorner) * kPoints)]};
}

std::vector<std::vector<HalfSpace>> candidates(int n) {
  std::vector<std::vector<HalfSpace>> all;
  std::vector<DesignVariable> variables;
  for (int i = 0; i < n; ++i) variables.push_back({.name = std::to_string(i)});
  std::vector<Eigen::VectorXd> points;
  for (const DesignPoint& point : sobol(DesignSpace(variables), kPoints, 1).points) {
    points.push_back(to_vector(point.values));
  }
  for (int k = 0; k < kNormals; ++k) {
    RandomStream random(29, k);
    Eigen::VectorXd a(n);
    for (double& value : a) value = random.normal();
    all.push_back({half_space(a, points)});
  }
  const auto beyond = [n](int i, bool is_upper, double width) {
    const Eigen::VectorXd e = Eigen::VectorXd::Unit(n, i);
    return is_upper ? HalfSpace{e, 1.0 - width} : HalfSpace{-e, -width};
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) {
      for (const int sides : {0, 1, 2, 3}) {
        for (const double ratio : {0.5, 1.0, 2.0}) {
          const double width = std::sqrt(kCorner * ratio);
          all.push_back({beyond(i, sides & 1, width), beyond(j, sides & 2, kCorner / width)});
        }
      }
    }
  }
  return all;
}

/// Returns the failing corner whose edge is as near to the true values as possible and which does
/// not contain the start.
std::vector<HalfSpace> corner_of(const Problem& problem, int number) {
  const Eigen::VectorXd start = to_vector(problem.space.to_unit(problem.space.initial()));
  const Eigen::VectorXd truth =
      to_vector(problem.space.to_unit({problem.truth})).cwiseMax(0.0).cwiseMin(1.0);
  const double wanted = number % 2 == 0 ? -kFromTruth : kFromTruth;
  std::vector<HalfSpace> best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& corner : candidates(problem.n())) {
    const double off = std::abs(depth(corner, truth) - wanted);
    if (depth(corner, start) > -kFromStart || off >= least) continue;
    least = off;
    best = corner;
  }
  return best;
}

}  // namespace

const char* name(Variant variant) {
  switch (variant) {
    case Variant::smooth:
      return "smooth";
    case Variant::rough:
      return "rough";
    case Variant::noisy:
      return "noisy";
    case Variant::failing:
      return "failing corner";
  }
  return "";
}

DisturbedProblem::DisturbedProblem(const Problem& problem, Variant variant, int number)
    : problem_(problem), variant_(variant) {
  const Vector r = problem.residuals(problem.space.initial().values);
  s_ = std::sqrt(square(r) / static_cast<double>(r.size()));
  if (variant == Variant::failing) corner_ = corner_of(problem, number);
}

bool DisturbedProblem::fails(const Vector& x) const {
  return !corner_.empty() && depth(corner_, to_vector(problem_.space.to_unit({x}))) > 0.0;
}

std::optional<Vector> DisturbedProblem::shown(const Vector& x) const {
  if (fails(x)) return std::nullopt;
  Vector r = problem_.residuals(x);
  if (variant_ == Variant::rough) {
    const Vector u = problem_.space.to_unit({x});
    for (std::size_t i = 0; i < r.size(); ++i) {
      RandomStream random(31, i);
      double phase = random.uniform();
      for (const double value : u) {
        const double waves = kFewestWaves * std::pow(kMostWaves / kFewestWaves, random.uniform());
        phase += (random.uniform() < 0.5 ? -1.0 : 1.0) * waves * value;
      }
      r[i] += kRipple * s_ * std::sin(2.0 * std::numbers::pi * phase);
    }
  } else if (variant_ == Variant::noisy) {
    RandomStream random(37, number_of(x));
    for (double& value : r) value += kNoise * s_ * random.normal();
  }
  return std::isfinite(square(r)) ? std::optional(r) : std::nullopt;
}

double DisturbedProblem::exact(const Vector& x) const {
  const double f = fails(x) ? NAN : square(problem_.residuals(x));
  return std::isfinite(f) ? f : std::numeric_limits<double>::infinity();
}

}  // namespace latsch::identification_set
