// SPDX-License-Identifier: Apache-2.0
#include "optimization/region/conforming_set.h"

#include "optimization/region/generating_set.h"
#include "optimization/region/tangent_cone.h"

namespace latsch {
namespace {

// Length below which a projected normal counts as zero: it is a combination of the equations'
// normals.
constexpr double kAlong = 1e-9;

std::vector<Eigen::VectorXd> in_cube(const Eigen::VectorXd& x, int turn) {
  std::vector<Bound> at;
  for (const double u : x) {
    at.push_back(u <= 0.0 ? Bound::lower : u >= 1.0 ? Bound::upper : Bound::none);
  }
  return generating_set(at, turn);
}

}  // namespace

std::vector<Eigen::VectorXd> conforming_set(const FeasibleRegion& region,
                                            const Eigen::VectorXd& x,
                                            double epsilon,
                                            int turn) {
  if (region.is_cube()) return in_cube(x, turn);
  const Eigen::MatrixXd V = region.normals_within(x, epsilon);
  const Eigen::MatrixXd E = region.E().transpose();
  ConeGenerators cone = tangent_cone(V, E);
  std::vector<Eigen::VectorXd> directions = std::move(cone.rays);
  const auto free = static_cast<size_t>(cone.lines.cols());
  for (const Eigen::VectorXd& d : generating_set(std::vector<Bound>(free, Bound::none), turn)) {
    directions.push_back(cone.lines * d);
  }
  const Eigen::MatrixXd along = tangent_cone(Eigen::MatrixXd(x.size(), 0), E).lines;
  for (Eigen::Index i = 0; i < V.cols(); ++i) {
    const Eigen::VectorXd normal = along * (along.transpose() * V.col(i));
    if (normal.norm() > kAlong) directions.push_back(normal.normalized());
  }
  return directions;
}

}  // namespace latsch
