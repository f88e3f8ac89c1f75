// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/history/sector_spline.h"

#include <numbers>
#include <vector>

#include "numerics/periodic_spline.h"

namespace latsch::fe_tire {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Angles of the middles of sectors, rad, ascending.
std::vector<double> middles(const Mesh& mesh) {
  std::vector<double> theta;
  theta.reserve(mesh.sectors);
  for (int s = 0; s < mesh.sectors; ++s) theta.push_back(0.5 * (mesh.angle(s) + mesh.angle(s + 1)));
  return theta;
}

/// Angles of the places, which divide the way from each middle to the next evenly.
std::vector<double> places(const Mesh& mesh) {
  std::vector<double> theta = middles(mesh), all;
  theta.push_back(theta.front() + kTurn);
  for (std::size_t s = 0; s + 1 < theta.size(); ++s)
    for (int k = 0; k < kPlacesPerSector; ++k)
      all.push_back(theta[s] + (theta[s + 1] - theta[s]) * k / kPlacesPerSector);
  return all;
}

}  // namespace

Streamline sector_line(const Mesh& mesh) { return Streamline(middles(mesh)); }

Streamline spline_line(const Mesh& mesh) { return Streamline(places(mesh)); }

Eigen::MatrixXd sector_spline(const Mesh& mesh) {
  const std::vector<double> at = places(mesh);
  const numerics::PeriodicSpline spline(
      middles(mesh), kTurn, Eigen::MatrixXd::Identity(mesh.sectors, mesh.sectors));
  Eigen::MatrixXd values(mesh.sectors, static_cast<Eigen::Index>(at.size()));
  for (Eigen::Index k = 0; k < values.cols(); ++k) values.col(k) = spline.at(at[k]).value;
  return values;
}

}  // namespace latsch::fe_tire
