// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/ccx_cords.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/fe_tire/element/cord_law.h"

namespace latsch::formats {
namespace {

using fe_tire::Element;
using Corners = Eigen::Matrix<double, 3, 8>;

constexpr double kXi[8] = {-1, 1, 1, -1, -1, 1, 1, -1}, kEta[8] = {-1, -1, 1, 1, -1, -1, 1, 1},
                 kZeta[8] = {-1, -1, -1, -1, 1, 1, 1, 1};
/// Coordinate of the Gauss points of the two-point rule.
constexpr double kGauss = 0.5773502691896257;
/// Half the length of a spring in the local coordinate along which it is longer. Any value gives
/// the same stretch; with this one the masses are at the points of the two-point Gauss rule.
constexpr double kHalfLength = kGauss;

/// Strains at which the force is tabulated, in tension and compression. Linear interpolation
/// between them has an error below 0.1 % of the force.
constexpr double kStrains[] = {0.0,  5e-5,  1e-4, 2e-4, 4e-4, 7e-4, 1e-3,  1.5e-3,
                               2e-3, 3e-3,  4e-3, 6e-3, 8e-3, 0.01, 0.013, 0.016,
                               0.02, 0.025, 0.03, 0.04, 0.05, 0.07, 0.1,   0.2};

}  // namespace

CordSurface::CordSurface(const Corners& X, double zeta) {
  X0 = X1 = X2 = X12 = Eigen::Vector3d::Zero();
  for (int a = 0; a < 8; ++a) {
    const Eigen::Vector3d part = 0.125 * (1.0 + kZeta[a] * zeta) * X.col(a);
    X0 += part;
    X1 += kXi[a] * part;
    X2 += kEta[a] * part;
    X12 += kXi[a] * kEta[a] * part;
  }
}

double CordSurface::area() const {
  double sum = 0.0;
  for (const double xi : {-kGauss, kGauss})
    for (const double eta : {-kGauss, kGauss}) sum += (X1 + eta * X12).cross(X2 + xi * X12).norm();
  return sum;
}

Eigen::Matrix<double, 3, 2> CordSurface::tangents() const {
  Eigen::Matrix<double, 3, 2> columns;
  columns << X1, X2;
  return columns;
}

Eigen::Matrix<double, 3, 2> CordSurface::axes() const {
  const Eigen::Vector3d n = X1.cross(X2).normalized();
  Eigen::Vector3d circle(-X0.z(), 0.0, X0.x());
  circle = (circle - n * n.dot(circle)).normalized();
  Eigen::Matrix<double, 3, 2> columns;
  columns << circle, n.cross(circle);
  return columns;
}

Eigen::Vector2d CordSurface::cord(double angle) const {
  const Eigen::Vector3d d = axes() * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  const Eigen::Matrix2d metric = tangents().transpose() * tangents();
  const Eigen::Vector2d components = metric.inverse() * (tangents().transpose() * d);
  return components / components.cwiseAbs().maxCoeff();
}

namespace {

CordSpring::End end_at(const Element& element, const Corners& X, const Eigen::Vector3d& at) {
  CordSpring::End end{Eigen::Vector3d::Zero(), {}};
  std::array<double, 8> weight;
  for (int a = 0; a < 8; ++a) {
    weight[a] = 0.125 * (1.0 + kXi[a] * at[0]) * (1.0 + kEta[a] * at[1]) * (1.0 + kZeta[a] * at[2]);
    end.x += weight[a] * X.col(a);
  }
  if (element.tie.eta != 0)  // the corners on this side lie on the line between two nodes
    for (const auto& [lower, upper] : element.tie.pairs()) {
      const double up = weight[lower] * element.tie.lower + weight[upper] * element.tie.upper;
      weight[lower] += weight[upper] - up;
      weight[upper] = up;
    }
  for (int a = 0; a < 8; ++a)
    if (weight[a] != 0.0) end.weights[element.node[a]] += weight[a];
  return end;
}

CordSpring spring_of(const Element& element,
                     const Corners& X,
                     const fe_tire::RebarPlacement& rebar,
                     const fe_tire::CordLayer& layer) {
  const CordSurface surface(X, rebar.zeta);
  const Eigen::Vector2d half = kHalfLength * surface.cord(layer.angle);
  CordSpring spring;
  spring.layer = rebar.layer;
  spring.ends = {end_at(element, X, {-half[0], -half[1], rebar.zeta}),
                 end_at(element, X, {half[0], half[1], rebar.zeta})};
  spring.length = (spring.ends[1].x - spring.ends[0].x).norm();
  const double volume = layer.thickness * surface.area();
  spring.area = volume / spring.length;
  spring.mass = volume * layer.density;
  return spring;
}

}  // namespace

std::vector<CordSpring> cord_springs(const fe_tire::Mesh& mesh,
                                     const fe_tire::Materials& materials,
                                     int sector) {
  std::vector<CordSpring> springs;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const Element& element = mesh.elements[e];
    if (element.rebars.empty()) continue;
    const Corners X = mesh.coordinates(element, sector);
    for (const fe_tire::RebarPlacement& rebar : element.rebars)
      springs.push_back(spring_of(element, X, rebar, materials.layers[rebar.layer]));
  }
  return springs;
}

std::vector<std::pair<double, double>> force_law(const fe_tire::CordLayer& layer,
                                                 const CordSpring& spring) {
  std::vector<std::pair<double, double>> points;
  const auto add = [&](double strain) {
    const double lambda = 1.0 + strain;
    const double S = fe_tire::stress(layer, 0.5 * (lambda * lambda - 1.0)).S;
    points.emplace_back(spring.area * S * lambda, spring.length * strain);
  };
  for (auto strain = std::rbegin(kStrains); strain != std::rend(kStrains); ++strain)
    if (*strain > 0.0) add(-*strain);
  for (const double strain : kStrains) add(strain);
  return points;
}

double first_loose_mode(const fe_tire::Mesh& mesh) {
  constexpr double kPerSector = 1.6;  // Hz
  double widest = 0.0;
  for (int s = 0; s < mesh.sectors; ++s)
    widest = std::max(widest, mesh.angle(s + 1) - mesh.angle(s));
  return kPerSector * 2.0 * std::numbers::pi / widest;
}

}  // namespace latsch::formats
