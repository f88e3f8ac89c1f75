// SPDX-License-Identifier: Apache-2.0
#include "optimization/problem/feasible_region.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "optimization/problem/quadratic_program.h"

namespace latsch {
namespace {

// Rounding errors of coordinates in the unit cube after some thousand operations.
constexpr double kRoundingInCube = 1e-9;
constexpr double kOnFace = 1e-11;
// Smallest component of a step toward a face, as a share of the step. A step with less is parallel
// to the face.
constexpr double kParallel = 1e-10;

QuadraticProgram projection(const Eigen::VectorXd& u, const FeasibleRegion& region) {
  const auto n = u.size();
  return {Eigen::MatrixXd::Identity(n, n), -u, region.E(), region.f(), region.A(), region.b()};
}

/// Sets values on the faces of the cube to exactly 0 or 1.
Eigen::VectorXd on_faces(Eigen::VectorXd u) {
  for (double& value : u) {
    if (value < kOnFace) value = 0.0;
    if (value > 1.0 - kOnFace) value = 1.0;
  }
  return u;
}

/// One constraint as a row in the unit cube: a'x = a'lower + sum_i a_i (upper_i - lower_i) u_i,
/// divided by the length of the row.
struct ScaledRow {
  Eigen::VectorXd a;
  double offset;
  double length;

  ScaledRow(const LinearConstraint& constraint, const DesignSpace& space)
      : a(space.size()), offset(0.0) {
    for (int i = 0; i < space.size(); ++i) {
      a[i] = constraint.coefficients[i] * (space[i].upper - space[i].lower);
      offset += constraint.coefficients[i] * space[i].lower;
    }
    length = a.norm();
    a /= length;
  }
  double scaled(double bound) const { return (bound - offset) / length; }
};

void append(Eigen::MatrixXd& rows,
            Eigen::VectorXd& bounds,
            const Eigen::VectorXd& a,
            double bound) {
  rows.conservativeResize(rows.rows() + 1, a.size());
  rows.row(rows.rows() - 1) = a.transpose();
  bounds.conservativeResize(bounds.size() + 1);
  bounds[bounds.size() - 1] = bound;
}

std::string quoted(const LinearConstraint& constraint) {
  const std::string at =
      constraint.place.file.empty() ? "" : fmt::format(" ({})", constraint.place.text());
  return fmt::format("constraint \"{}\"{}", constraint.name, at);
}

}  // namespace

FeasibleRegion::FeasibleRegion(const DesignSpace& space,
                               const std::vector<LinearConstraint>& constraints)
    : is_cube_(constraints.empty()), E_(0, space.size()), A_(0, space.size()) {
  for (const LinearConstraint& constraint : constraints) {
    if (!constraint.is_equation()) continue;
    const ScaledRow row(constraint, space);
    append(E_, f_, row.a, row.scaled(constraint.lower));
    names_.push_back(quoted(constraint));
  }
  for (const LinearConstraint& constraint : constraints) {
    if (constraint.is_equation()) continue;
    const ScaledRow row(constraint, space);
    if (std::isfinite(constraint.lower)) {
      append(A_, b_, -row.a, -row.scaled(constraint.lower));
      names_.push_back("the lower bound of " + quoted(constraint));
    }
    if (std::isfinite(constraint.upper)) {
      append(A_, b_, row.a, row.scaled(constraint.upper));
      names_.push_back("the upper bound of " + quoted(constraint));
    }
  }
  for (int i = 0; i < space.size(); ++i) {
    const auto face = Eigen::VectorXd::Unit(space.size(), i);
    append(A_, b_, face, 1.0);
    append(A_, b_, -face, 0.0);
    const DesignVariable& v = space[i];
    names_.push_back(fmt::format("{} of at most {}", v.name, format_quantity(v.upper, v.unit)));
    names_.push_back(fmt::format("{} of at least {}", v.name, format_quantity(v.lower, v.unit)));
  }
}

double FeasibleRegion::violation(const Eigen::VectorXd& u) const {
  double worst = 0.0;
  if (E_.rows() > 0) worst = (E_ * u - f_).cwiseAbs().maxCoeff();
  return std::max(worst, (A_ * u - b_).maxCoeff());
}

bool FeasibleRegion::contains(const Eigen::VectorXd& u) const {
  return violation(u) <= kRoundingInCube;
}

Eigen::MatrixXd FeasibleRegion::normals_within(const Eigen::VectorXd& u, double distance) const {
  const Eigen::VectorXd away = b_ - A_ * u;
  Eigen::MatrixXd V(u.size(), 0);
  for (Eigen::Index i = 0; i < away.size(); ++i) {
    if (away[i] > distance) continue;
    V.conservativeResize(Eigen::NoChange, V.cols() + 1);
    V.col(V.cols() - 1) = A_.row(i).transpose();
  }
  return V;
}

Eigen::VectorXd FeasibleRegion::cut_off(const Eigen::VectorXd& x, const Eigen::VectorXd& u) const {
  if (is_cube_) return u.cwiseMax(0.0).cwiseMin(1.0);
  const Eigen::VectorXd toward = A_ * (u - x);
  const Eigen::VectorXd distance = (b_ - A_ * x).cwiseMax(0.0);
  double share = 1.0;
  for (Eigen::Index i = 0; i < toward.size(); ++i) {
    const bool leads_out = toward[i] > kParallel * (u - x).norm();
    if (leads_out) share = std::min(share, distance[i] / toward[i]);
  }
  return on_faces(x + share * (u - x));
}

Eigen::VectorXd FeasibleRegion::snapped(const Eigen::VectorXd& u, double distance) const {
  if (is_cube_) return u;
  QuadraticProgram qp = projection(u, *this);
  const Eigen::VectorXd away = b_ - A_ * u;
  if (away.minCoeff() >= distance) return u;
  for (Eigen::Index i = 0; i < away.size(); ++i) {
    if (away[i] < distance) append(qp.E, qp.f, A_.row(i), b_[i]);
  }
  const QuadraticSolution onto = solve(qp);
  return onto.is_feasible() ? on_faces(onto.x) : u;
}

Eigen::VectorXd FeasibleRegion::nearest(const Eigen::VectorXd& u) const {
  if (is_cube_) return u.cwiseMax(0.0).cwiseMin(1.0);
  return on_faces(solve(projection(u, *this)).x);
}

std::string FeasibleRegion::contradiction() const {
  const Eigen::VectorXd middle = Eigen::VectorXd::Constant(A_.cols(), 0.5);
  std::vector<std::string> names;
  for (const int row : solve(projection(middle, *this)).contradiction) names.push_back(names_[row]);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace latsch
