// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_chain.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "models/fe_tire/element/cord_law.h"
#include "models/fe_tire/element/hex8_shape.h"
#include "models/fe_tire/element/hyperelastic.h"
#include "numerics/periodic_spline.h"

namespace latsch::fe_tire {
namespace {

/// Distance between the faces of two elements, relative to the length of the inner one, below which
/// one lies on the other. Columns that meet share their corners; tied ones differ a little.
constexpr double kOnTop = 0.3;

/// Returns the point of an element on the plane of its own sector, in the middle along the wall and
/// at zeta through it.
Eigen::Vector3d middle(const Eigen::Matrix<double, 3, 8>& corners, double zeta) {
  const Eigen::Vector3d inner = 0.5 * (corners.col(0) + corners.col(3));
  const Eigen::Vector3d outer = 0.5 * (corners.col(4) + corners.col(7));
  return 0.5 * (1.0 - zeta) * inner + 0.5 * (1.0 + zeta) * outer;
}

/// Returns the elements of the inner face from the +y bead to the -y bead.
std::vector<int> inner_face(const Mesh& mesh) {
  std::map<int, int> from;  // first node of an element's inner edge -> element
  std::map<int, bool> ends;
  for (int e = 0; e < std::ssize(mesh.elements); ++e) {
    if (!mesh.elements[e].inner) continue;
    from[mesh.elements[e].node[0]] = e;
    ends[mesh.elements[e].node[3]] = true;
  }
  std::vector<int> face;
  for (const auto& [node, element] : from) {
    if (ends.contains(node)) continue;
    for (auto next = from.find(node); next != from.end();) {
      face.push_back(next->second);
      next = from.find(mesh.elements[next->second].node[3]);
    }
    break;
  }
  return face;
}

/// Returns the element of the inner face at a position.
int inner_at(const Mesh& mesh, double position) {
  const std::vector<int> face = inner_face(mesh);
  std::vector<double> ends{0.0};
  for (const int e : face) {
    const auto X = mesh.coordinates(mesh.elements[e]);
    ends.push_back(ends.back() + (X.col(3) - X.col(0)).norm());
  }
  const double at = 0.5 * (1.0 - position) * ends.back();
  const auto end = std::upper_bound(ends.begin() + 1, ends.end() - 1, at);
  return face[end - ends.begin() - 1];
}

/// Returns the elements through the wall at an element of the inner face, from inside to outside.
std::vector<int> through_wall(const Mesh& mesh, int inner) {
  std::vector<int> stack{inner};
  const auto first = mesh.coordinates(mesh.elements[inner]);
  const double length = (first.col(3) - first.col(0)).norm();
  while (std::ssize(stack) <= std::ssize(mesh.elements)) {
    const Eigen::Vector3d top = middle(mesh.coordinates(mesh.elements[stack.back()]), 1.0);
    int next = -1;
    double least = kOnTop * length;
    for (int e = 0; e < std::ssize(mesh.elements); ++e) {
      if (e == stack.back()) continue;
      const double gap = (middle(mesh.coordinates(mesh.elements[e]), -1.0) - top).norm();
      if (gap >= least) continue;
      least = gap;
      next = e;
    }
    if (next < 0) break;
    stack.push_back(next);
  }
  return stack;
}

}  // namespace

Result<ChainPlace> find_place(const Mesh& mesh,
                              const LossMaterials& materials,
                              double position,
                              const std::string& depth) {
  const std::vector<int> stack = through_wall(mesh, inner_at(mesh, position));
  if (depth == "inner") return ChainPlace{stack.front(), -1.0, -1};
  if (depth == "outer") return ChainPlace{stack.back(), 1.0, -1};
  std::string names;
  for (const int e : stack) {
    const auto& rebars = mesh.elements[e].rebars;
    for (std::size_t k = 0; k < rebars.size(); ++k) {
      if (rebars[k].layer >= std::ssize(materials.layers)) continue;
      const std::string& name = materials.owners[materials.layers[rebars[k].layer].owner].name;
      if (name == "layer." + depth) return ChainPlace{e, rebars[k].zeta, static_cast<int>(k)};
      names += (names.empty() ? "" : ", ") + name.substr(std::string("layer.").size());
    }
  }
  return Failure{fmt::format(
      "depth \"{}\" is no layer that crosses the wall at position {:.3g}: expected inner, outer{}",
      depth,
      position,
      names.empty() ? "; no layer of cords lies there" : " or " + names)};
}

namespace {

/// Rotation about +y from the axes of the plane theta to those of the wheel.
Eigen::Matrix3d turned(double theta) {
  return Eigen::AngleAxisd(-theta, Eigen::Vector3d::UnitY()).toRotationMatrix();
}

/// Sets positions and motion of the points.
void set_motion(const Mesh& mesh,
                const ChainPlace& place,
                const Eigen::Matrix3Xd& u,
                double Omega,
                std::vector<ChainPoint>& points) {
  const int n = mesh.nodes_per_sector(), S = mesh.sectors;
  const Element& element = mesh.elements[place.element];
  const auto corner = [&](const Eigen::Matrix3Xd& of, int plane, int a) -> Eigen::Vector3d {
    return of.col(plane * n + element.node[a] % n);
  };
  // Corners in the own plane are the nodes 0, 3, 4, 7, tied ones between two of them.
  const auto corners = [&](const Eigen::Matrix3Xd& of, int plane) {
    Eigen::Matrix<double, 3, 8> c = Eigen::Matrix<double, 3, 8>::Zero();
    for (const int a : {0, 3, 4, 7}) c.col(a) = corner(of, plane, a);
    if (element.tie.eta != 0) {
      const auto [lower, upper] = element.tie.pairs()[0];
      const Eigen::Vector3d from = c.col(lower), way = c.col(upper) - c.col(lower);
      c.col(lower) = from + element.tie.lower * way;
      c.col(upper) = from + element.tie.upper * way;
    }
    return c;
  };
  const Eigen::Vector3d rest = middle(corners(mesh.X, 0), place.zeta);
  std::vector<double> planes(S);
  Eigen::MatrixXd p(3, S);
  for (int s = 0; s < S; ++s) {
    planes[s] = mesh.angle(s);
    p.col(s) = rest + middle(corners(u, s), place.zeta);
  }
  const numerics::PeriodicSpline curve(planes, 2.0 * std::numbers::pi, p);
  Eigen::Matrix3d J;  // J p = -e x p
  J << 0, 0, -1, 0, 0, 0, 1, 0, 0;
  for (int s = 0; s < S; ++s) {
    ChainPoint& point = points[s];
    point.theta = 0.5 * (mesh.angle(s) + mesh.angle(s + 1));
    const auto here = curve.at(point.theta);
    const Eigen::Matrix3d R = turned(point.theta);
    const Eigen::Vector3d value = here.value, first = here.first, second = here.second;
    point.x = R * value;
    point.u = R * (value - rest);
    point.v = -Omega * (R * (first + J * value));
    point.a = Omega * Omega * (R * (second + 2.0 * J * first + J * J * value));
  }
}

/// Interpolates between the means of the inner and the outer Gauss points; faces have theirs.
Vector6 at_depth(const Eigen::Matrix<double, 6, 8>& E, double zeta) {
  const Vector6 inner = E.leftCols<4>().rowwise().mean(), outer = E.rightCols<4>().rowwise().mean();
  const double share = 0.5 * (1.0 + std::clamp(zeta / kGauss, -1.0, 1.0));
  return (1.0 - share) * inner + share * outer;
}

/// Adds what the dashpots of a stress S take, both counted from the round state.
void add_dissipation(const LossMeter& meter,
                     const PronyTerms& terms,
                     const Eigen::MatrixXd& S,
                     const Eigen::MatrixXd& E,
                     double Omega,
                     std::vector<ChainPoint>& points) {
  for (const PronyTerm& term : terms) {
    if (term.beta == 0.0 || Omega == 0.0) continue;
    const Eigen::MatrixXd h_S = meter.line().history(term, Omega, S),
                          h_E = meter.line().history(term, Omega, E);
    for (std::size_t s = 0; s < points.size(); ++s) {
      const auto k = static_cast<Eigen::Index>(s);
      points[s].dissipation += h_S.col(k).dot(h_E.col(k)) / (term.beta * term.tau);
    }
  }
}

}  // namespace

std::vector<ChainPoint> chain(const LossMeter& meter,
                              const ChainPlace& place,
                              const Eigen::Matrix3Xd& u,
                              const Eigen::VectorXd& alpha,
                              double Omega) {
  const RingElements& elements = meter.elements();
  const Mesh& mesh = elements.ring().mesh();
  const int S = mesh.sectors;
  std::vector<ChainPoint> points(S);
  set_motion(mesh, place, u, Omega, points);
  const std::vector<PointStrains> strains = meter.strains_of(place.element, u, alpha);
  const int at = mesh.elements[place.element].solid;
  const auto& law = elements.materials().solids[at].law;
  const PronyTerms& terms = meter.materials().solids[at].terms;
  Eigen::MatrixXd E(6, S), S_iso(6, S);
  for (int s = 0; s < S; ++s) {
    ChainPoint& point = points[s];
    point.E = at_depth(strains[s].E, place.zeta);
    std::visit([&](const auto& of) { stress(of, point.E, point.S, nullptr); }, law);
    point.energy = std::visit([&](const auto& of) { return energy(of, point.E); }, law);
    const Vector6 round = at_depth(meter.round(s, place.element).E, place.zeta);
    const auto isochoric = [&](const Vector6& strain) -> Vector6 {
      if (const auto* rubber = std::get_if<Hyperelastic>(&law))
        return isochoric_stress(*rubber, strain);
      return isochoric_stress(meter.materials().solids[at].shear, strain);
    };
    E.col(s) = point.E - round;
    S_iso.col(s) = isochoric(point.E) - isochoric(round);
    point.dissipation = point.cord_strain = point.cord_stress = point.cord_force = 0.0;
    if (place.cords < 0) continue;
    const CordLayer& layer =
        elements.materials().layers[mesh.elements[place.element].rebars[place.cords].layer];
    point.cord_strain = strains[s].cords[place.cords].mean();
    point.cord_stress = stress(layer, point.cord_strain).S;
    // The force in the cords' own direction is the stress of the undeformed section times the
    // stretch.
    point.cord_force =
        layer.thickness * point.cord_stress * std::sqrt(1.0 + 2.0 * point.cord_strain);
  }
  add_dissipation(meter, terms, S_iso, E, Omega, points);
  for (const RelaxingCords& cords : meter.materials().solids[at].smeared)
    add_dissipation(meter, cords.terms, cords.D * E, E, Omega, points);
  return points;
}

}  // namespace latsch::fe_tire
