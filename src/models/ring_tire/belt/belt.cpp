// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/belt.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/belt/rim_rows.h"

namespace latsch::ring_tire {

/// What the elements of node k carry: the tension in the middle of segment k (three components),
/// (3) along x and z with the turning of n with the slope, at knot k and in the middle of the
/// segment, (4), (5).
struct Elements {
  enum {
    kString = 0,
    kBendX = 3,
    kBendZ,
    kTurning,
    kBetweenX,
    kBetweenZ,
    kBetweenTurning,
    kLateral,
    kLateralBetween,
    kTwist,
    kRows
  };
  double* row[kRows];
};

}  // namespace latsch::ring_tire

#define LATSCH_KERNELS_IN "models/ring_tire/belt/belt_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d cross_matrix(const Vector3d& a) {
  Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

/// Where (3) and (4) are taken: what the nodes k-1 .. k+2 count in the curve's place and in its
/// first and second derivative by s.
struct BendRule {
  double place[4], slope[4], second[4];
};
constexpr BendRule kAtKnot{
    {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0}, {-0.5, 0.0, 0.5, 0.0}, {1.0, -2.0, 1.0, 0.0}};
constexpr BendRule kBetween{{1.0 / 48.0, 23.0 / 48.0, 23.0 / 48.0, 1.0 / 48.0},
                            {-0.125, -0.625, 0.625, 0.125},
                            {0.5, -0.5, -0.5, 0.5}};

/// What (3) is made of there.
struct Bend {
  double length;    // of the slope in the plane of the rim
  Vector3d t, n;    // along it; outward
  double s, along;  // the second derivative along n; along t, over the length
};

template <class Place>
Bend bend_of(const BendRule& rule, const Place& place, const Vector3d& a) {
  Vector3d c = Vector3d::Zero(), d = Vector3d::Zero();
  for (int i = 0; i < 4; ++i) {
    c += rule.slope[i] * place(i - 1);
    d += rule.second[i] * place(i - 1);
  }
  c -= a * a.dot(c);
  Bend bend;
  bend.length = c.norm();
  bend.t = c / bend.length;
  bend.n = a.cross(bend.t);
  bend.s = d.dot(bend.n);
  bend.along = d.dot(bend.t) / bend.length;
  return bend;
}

}  // namespace

BeltForces::BeltForces(const Belt& belt, int nodes) : nodes_(nodes), law_() {
  const double x = 2.0 * std::numbers::pi / nodes;
  const double node_radius = belt.radius * node_radius_over_knot_radius(nodes);
  // The pressure on a node at rest; the tension along g_k counts T0 L0/R there.
  const double outward = 2.0 * (kArea1 * std::sin(x) + kArea2 * std::sin(2.0 * x)) * node_radius *
                         belt.pressure * belt.pressure_width;
  law_ = {.R = belt.radius,
          .L0 = belt.radius * x,
          .stretch0 = 0.25 * node_radius * (5.0 * std::sin(0.5 * x) + std::sin(1.5 * x)),
          .T0 = outward * node_radius / (belt.radius * x),
          .EA = belt.extension,
          .EI = belt.bending_in_plane,
          .EI_out_of_plane = belt.bending_out_of_plane,
          .GJ = belt.twist,
          .pressure_width = belt.pressure * belt.pressure_width,
          .s0 = -2.0 * node_radius * (1.0 - std::cos(x)),
          .s0_between = -node_radius * (std::cos(0.5 * x) - std::cos(1.5 * x)),
          .tilt = 2.0 * (1.0 - std::cos(x)) * node_radius / (belt.radius * x * x),
          .tilt_between = 24.0 * (std::cos(0.5 * x) - std::cos(1.5 * x)) /
                          ((23.0 * std::cos(0.5 * x) + std::cos(1.5 * x)) * x * x)};
}

double BeltForces::energy(const NodeValues& q, const RimFrame& rim) const {
  const auto& [R,
               L0,
               stretch0,
               T0,
               EA,
               EI,
               EI_out_of_plane,
               GJ,
               pressure_width,
               s0,
               s0_between,
               tilt,
               tilt_between] = law_;
  double sum = 0.0;
  for (int k = 0; k < nodes_; ++k) {
    const auto node = [&](int i) -> Eigen::Vector4d { return q.col((k + i + nodes_) % nodes_); };
    const auto place = [&](int i) -> Vector3d { return node(i).head<3>() - rim.center; };
    const Eigen::Vector4d slope = 0.125 * (5.0 * (node(1) - node(0)) + node(2) - node(-1));  // (26)
    const double strain = slope.head<3>().norm() / stretch0 - 1.0 + T0 / EA;
    sum += 0.5 * EA * L0 * strain * strain;  // (1)
    sum +=
        pressure_width * rim.a.dot(place(0).cross(kArea1 * place(1) + kArea2 * place(2)));  // (2)
    const double at_knot = bend_of(kAtKnot, place, rim.a).s - s0;
    const double between = bend_of(kBetween, place, rim.a).s - s0_between;
    sum += 0.5 * EI / (L0 * L0 * L0) *
           (kKnotShare * at_knot * at_knot + (1.0 - kKnotShare) * between * between);  // (3)
    const auto curvature = [&](const BendRule& rule, double by_torsion) {
      double sum = 0.0;
      for (int i = 0; i < 4; ++i)
        sum += rule.second[i] / (L0 * L0) * rim.a.dot(place(i - 1)) +
               by_torsion / R * rule.place[i] * node(i - 1)[3];
      return sum;
    };
    const double knot = curvature(kAtKnot, tilt), middle = curvature(kBetween, tilt_between);
    const double twist = (slope[3] - rim.a.dot(slope.head<3>()) / R) / L0;
    sum += 0.5 * L0 * EI_out_of_plane *
           (kKnotShare * knot * knot + (1.0 - kKnotShare) * middle * middle);  // (4)
    sum += 0.5 * L0 * GJ * twist * twist;                                      // (5)
  }
  return sum;
}

void BeltForces::add_force(const NodeValues& q, const RimFrame& rim, NodeValues& force) const {
  RimRows at(nodes_), f(nodes_, Elements::kRows);
  at.place(q, rim);
  Elements e;
  for (int i = 0; i < Elements::kRows; ++i) e.row[i] = f.row(RimRows::kRows + i);
  const double* const x[4] = {
      at.row(RimRows::kX), at.row(RimRows::kY), at.row(RimRows::kZ), at.row(RimRows::kTorsion)};
  double* const to[4] = {
      f.row(RimRows::kX), f.row(RimRows::kY), f.row(RimRows::kZ), f.row(RimRows::kTorsion)};
  LATSCH_KERNEL(strain)(nodes_, law_, x, e);
  LATSCH_KERNEL(gather)(nodes_, law_, x, e, to);
  f.add_to(force, rim);
}

void BeltForces::add_stiffness(const NodeValues& q,
                               const RimFrame& rim,
                               double scale,
                               CyclicBand& K) const {
  const Matrix3d turned = scale * law_.pressure_width * cross_matrix(rim.a);
  for (int k = 0; k < nodes_; ++k) {
    add_string_stiffness(q, k, scale, K);
    K.block(k, 1).topLeftCorner<3, 3>() -= kArea1 * turned;  // (2)
    K.block(k, 2).topLeftCorner<3, 3>() -= kArea2 * turned;
    add_bending_stiffness(q, rim, k, scale, K);
  }
  add_lateral_stiffness(rim, scale, K);
}

/// (1) in the middle of segment k.
void BeltForces::add_string_stiffness(const NodeValues& q,
                                      int k,
                                      double scale,
                                      CyclicBand& K) const {
  const int node[4] = {(k + nodes_ - 1) % nodes_, k, (k + 1) % nodes_, (k + 2) % nodes_};
  Vector3d slope = Vector3d::Zero();
  for (int i = 0; i < 4; ++i) slope += kBetween.slope[i] * q.col(node[i]).head<3>();
  const double length = slope.norm(), rest = law_.stretch0, of = scale * law_.L0 / rest;
  const double string = of * (law_.T0 + law_.EA * (length - rest) / rest) / length;
  const Vector3d e = slope / length;
  const Matrix3d spring =
      (of * law_.EA / rest - string) * e * e.transpose() + string * Matrix3d::Identity();
  for (int i = 0; i < 4; ++i)
    for (int j = i; j < 4; ++j)
      K.block(node[i], j - i).topLeftCorner<3, 3>() +=
          kBetween.slope[i] * kBetween.slope[j] * spring;
}

/// s = a . (d × c)/|c| is a product of linear forms over a length, so its second derivatives in the
/// slope c and the second derivative d are short.
void BeltForces::add_bending_stiffness(
    const NodeValues& q, const RimFrame& rim, int k, double scale, CyclicBand& K) const {
  const int node[4] = {(k + nodes_ - 1) % nodes_, k, (k + 1) % nodes_, (k + 2) % nodes_};
  const auto place = [&](int i) -> Vector3d { return q.col(node[i + 1]).head<3>(); };
  const double EI = scale * law_.EI / (law_.L0 * law_.L0 * law_.L0);
  const auto add = [&](const BendRule& rule, int nodes, double stiffness, double s0) {
    const Bend bend = bend_of(rule, place, rim.a);
    const double moment = stiffness * (bend.s - s0);
    const Matrix3d nn = bend.n * bend.n.transpose(), tn = bend.t * bend.n.transpose();
    const Matrix3d cc = (bend.along / bend.length) * (tn + tn.transpose()) -
                        (bend.s / (bend.length * bend.length)) * nn;
    const Matrix3d cd = -tn.transpose() / bend.length;  // rows c, columns d
    const auto weight = [&](int i) { return rule.second[i] - bend.along * rule.slope[i]; };
    for (int i = 0; i < nodes; ++i)
      for (int j = i; j < nodes; ++j)
        K.block(node[i], j - i).topLeftCorner<3, 3>() +=
            stiffness * weight(i) * weight(j) * nn +
            moment * (rule.slope[i] * rule.slope[j] * cc + rule.slope[i] * rule.second[j] * cd +
                      rule.second[i] * rule.slope[j] * cd.transpose());
  };
  add(kAtKnot, 3, kKnotShare * EI, law_.s0);
  add(kBetween, 4, (1.0 - kKnotShare) * EI, law_.s0_between);
}

/// (4) and (5) are the same at every node.
void BeltForces::add_lateral_stiffness(const RimFrame& rim, double scale, CyclicBand& K) const {
  using Eigen::Matrix4d, Eigen::Vector4d;
  const auto row = [&](double lateral, double torsion) {
    Vector4d g;
    g << lateral * rim.a, torsion;
    return g;
  };
  Matrix4d of[4] = {Matrix4d::Zero(), Matrix4d::Zero(), Matrix4d::Zero(), Matrix4d::Zero()};
  const auto add = [&](double stiffness, const auto& row_of) {
    for (int i = 0; i < 4; ++i)
      for (int j = i; j < 4; ++j) of[j - i] += stiffness * row_of(i) * row_of(j).transpose();
  };
  const auto curvature = [&](const BendRule& rule, double tilt) {
    return [&rule, &row, tilt, this](int i) {
      return row(rule.second[i] / (law_.L0 * law_.L0), tilt / law_.R * rule.place[i]);
    };
  };
  const double EI = scale * law_.EI_out_of_plane * law_.L0;
  add(kKnotShare * EI, curvature(kAtKnot, law_.tilt));
  add((1.0 - kKnotShare) * EI, curvature(kBetween, law_.tilt_between));
  add(scale * law_.GJ / law_.L0,
      [&](int i) { return row(-kBetween.slope[i] / law_.R, kBetween.slope[i]); });
  for (int k = 0; k < nodes_; ++k)
    for (int j = 0; j < 4; ++j) K.block(k, j) += of[j];
}

}  // namespace latsch::ring_tire
