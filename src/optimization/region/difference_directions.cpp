// SPDX-License-Identifier: Apache-2.0
#include "optimization/region/difference_directions.h"

#include "numerics/dense/orthogonal_factors.h"
#include "optimization/region/tangent_cone.h"

namespace latsch {
namespace {

// Smallest angle between directions (as a sine); more nearly parallel ones give no separate
// information.
constexpr double kIndependent = 1e-3;

/// Returns the axes as unit columns, each with the sign for which a step stays inside. An axis
/// along which neither sign has room is left out.
Eigen::MatrixXd axes(const FeasibleRegion& region, const Eigen::VectorXd& u, double step) {
  const auto n = u.size();
  Eigen::MatrixXd D(n, 0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double inward = u[i] > 0.5 ? -1.0 : 1.0;
    for (const double sign : {inward, -inward}) {
      const Eigen::VectorXd d = sign * Eigen::VectorXd::Unit(n, i);
      if (!region.contains(u + step * d)) continue;
      D.conservativeResize(Eigen::NoChange, D.cols() + 1);
      D.col(D.cols() - 1) = d;
      break;
    }
  }
  return D;
}

/// Returns the generators of the tangent cone of all constraints that are nearer than `step`.
Eigen::MatrixXd generators(const FeasibleRegion& region, const Eigen::VectorXd& u, double step) {
  const ConeGenerators cone = tangent_cone(region.normals_within(u, step), region.E().transpose());
  Eigen::MatrixXd all(u.size(), cone.lines.cols() + std::ssize(cone.rays));
  all.leftCols(cone.lines.cols()) = cone.lines;
  for (size_t k = 0; k < cone.rays.size(); ++k) {
    all.col(cone.lines.cols() + static_cast<Eigen::Index>(k)) = cone.rays[k];
  }
  return all;
}

}  // namespace

Eigen::MatrixXd difference_directions(const FeasibleRegion& region,
                                      const Eigen::VectorXd& u,
                                      double step) {
  const Eigen::MatrixXd along_axes = axes(region, u, step);
  if (along_axes.cols() == u.size()) return along_axes;
  const Eigen::MatrixXd all = generators(region, u, step);
  if (all.cols() == 0) return all;
  const numerics::PivotedQr qr = numerics::pivoted_qr(all, kIndependent);
  Eigen::MatrixXd D(u.size(), qr.rank);
  for (int k = 0; k < qr.rank; ++k) D.col(k) = all.col(qr.order[static_cast<size_t>(k)]);
  return D;
}

}  // namespace latsch
