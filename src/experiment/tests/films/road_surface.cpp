// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/films/road_surface.h"

#include <algorithm>
#include <cmath>

namespace latsch::experiment {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSpacingAlong = 0.02, kSpacingAcross = 0.04;  // m
constexpr int kMostSamplesAcross = 4000;                       // most samples in either direction
constexpr std::size_t kMostPoints = 12000;

VectorXd evenly(double from, double to, double spacing) {
  const auto count = std::clamp<Eigen::Index>(
      static_cast<Eigen::Index>(std::ceil((to - from) / spacing)) + 1, 2, kMostSamplesAcross);
  return VectorXd::LinSpaced(count, from, to);
}

/// Marks further columns as kept between two kept columns if a straight line between these deviates
/// too much from the heights.
void keep(const MatrixXd& heights,
          const VectorXd& at,
          Eigen::Index from,
          Eigen::Index to,
          double tolerance,
          std::vector<bool>& kept) {
  double worst = tolerance;
  Eigen::Index where = -1;
  for (Eigen::Index k = from + 1; k < to; ++k) {
    const double part = (at[k] - at[from]) / (at[to] - at[from]);
    const double miss = (heights.col(k) - (1.0 - part) * heights.col(from) - part * heights.col(to))
                            .lpNorm<Eigen::Infinity>();
    if (miss <= worst) continue;
    worst = miss;
    where = k;
  }
  if (where < 0) return;
  kept[static_cast<std::size_t>(where)] = true;
  keep(heights, at, from, where, tolerance, kept);
  keep(heights, at, where, to, tolerance, kept);
}

std::vector<Eigen::Index> needed(const MatrixXd& heights, const VectorXd& at, double tolerance) {
  std::vector<bool> kept(static_cast<std::size_t>(at.size()), false);
  kept.front() = kept.back() = true;
  keep(heights, at, 0, at.size() - 1, tolerance, kept);
  std::vector<Eigen::Index> columns;
  for (std::size_t k = 0; k < kept.size(); ++k)
    if (kept[k]) columns.push_back(static_cast<Eigen::Index>(k));
  return columns;
}

}  // namespace

report::Scene::Mesh road_surface(const road::Road& road, const RoadArea& area, double tolerance) {
  const VectorXd x = evenly(area.x0, area.x1, kSpacingAlong),
                 y = evenly(area.y0, area.y1, kSpacingAcross);
  MatrixXd heights(y.size(), x.size());  // [lines x columns]
  for (Eigen::Index i = 0; i < x.size(); ++i)
    for (Eigen::Index j = 0; j < y.size(); ++j) heights(j, i) = road.height(x[i], y[j], 0.0);
  std::vector<Eigen::Index> columns = needed(heights, x, tolerance),
                            rows = needed(heights.transpose(), y, tolerance);
  while (columns.size() * rows.size() > kMostPoints) {
    tolerance *= 2.0;
    columns = needed(heights, x, tolerance);
    rows = needed(heights.transpose(), y, tolerance);
  }
  const auto across = static_cast<std::uint32_t>(rows.size());
  report::Scene::Mesh mesh{
      "road", Eigen::Matrix3Xd(3, std::ssize(columns) * std::ssize(rows)), {}, {}, {}};
  Eigen::Index at = 0;
  for (const Eigen::Index i : columns)
    for (const Eigen::Index j : rows) mesh.points.col(at++) << x[i], y[j], heights(j, i);
  for (std::uint32_t i = 0; i + 1 < columns.size(); ++i)
    for (std::uint32_t j = 0; j + 1 < across; ++j) {
      const std::uint32_t a = i * across + j, b = a + across;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  mesh.parts = {{"road", 0, static_cast<std::uint32_t>(mesh.triangles.size() / 3)}};
  return mesh;
}

}  // namespace latsch::experiment
