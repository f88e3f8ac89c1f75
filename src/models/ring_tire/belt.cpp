// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace latsch::ring_tire {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d cross_matrix(const Vector3d& a) {
  Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

/// What (3) is made of at one node.
struct Bend {
  Vector3d c, d;  // in the plane of the rim
  double length;  // |c|
  Vector3d t, n;  // along c; outward
  double s;       // d . n
};

Bend bend_at(const Vector3d& before, const Vector3d& x, const Vector3d& after, const Vector3d& a) {
  Bend bend;
  bend.c = after - before;
  bend.d = after + before - 2.0 * x;
  bend.c -= a * a.dot(bend.c);
  bend.d -= a * a.dot(bend.d);
  bend.length = bend.c.norm();
  bend.t = bend.c / bend.length;
  bend.n = a.cross(bend.t);
  bend.s = bend.d.dot(bend.n);
  return bend;
}

/// Adds scale * B to A(i, j) where the three nodes are k - 1, k, k + 1 and i <= j in that order.
void add_block(CyclicBand& K, int k, int i, int j, const Matrix3d& B) {
  const int first = (k + i - 1 + K.nodes()) % K.nodes();
  K.block(first, j - i).topLeftCorner<3, 3>() += B;
}

}  // namespace

BeltForces::BeltForces(const Belt& belt, int nodes)
    : nodes_(nodes),
      R_(belt.radius),
      L0_(2.0 * R_ * std::sin(std::numbers::pi / nodes)),
      T0_(belt.pressure * belt.pressure_width * R_ * std::cos(std::numbers::pi / nodes)),
      EA_(belt.extension),
      EI_(belt.bending_in_plane),
      EI_lateral_(belt.bending_lateral),
      GJ_(belt.twist),
      pressure_width_(belt.pressure * belt.pressure_width),
      s0_(-2.0 * R_ * (1.0 - std::cos(2.0 * std::numbers::pi / nodes))) {}

double BeltForces::energy(const NodeValues& q, const RimFrame& rim) const {
  double sum = 0.0;
  for (int k = 0; k < nodes_; ++k) {
    const int after = (k + 1) % nodes_, before = (k + nodes_ - 1) % nodes_;
    const Vector3d x = q.col(k).head<3>(), x1 = q.col(after).head<3>(),
                   x0 = q.col(before).head<3>();
    const double stretch = (x1 - x).norm() - L0_ + T0_ * L0_ / EA_;
    sum += 0.5 * EA_ / L0_ * stretch * stretch;                                         // (1)
    sum += 0.5 * pressure_width_ * rim.a.dot((x - rim.center).cross(x1 - rim.center));  // (2)
    const double s = bend_at(x0, x, x1, rim.a).s - s0_;
    sum += 0.5 * EI_ / (L0_ * L0_ * L0_) * s * s;  // (3)
    const double u = rim.a.dot(x), u1 = rim.a.dot(x1), u0 = rim.a.dot(x0);
    const double curvature = (u1 + u0 - 2.0 * u) / (L0_ * L0_) + q(3, k) / R_;
    const double twist = (q(3, after) - q(3, k)) / L0_ - (u1 - u) / (L0_ * R_);
    sum += 0.5 * L0_ * (EI_lateral_ * curvature * curvature + GJ_ * twist * twist);  // (4), (5)
  }
  return sum;
}

void BeltForces::add_force(const NodeValues& q, const RimFrame& rim, NodeValues& force) const {
  for (int k = 0; k < nodes_; ++k) {
    const int after = k + 1 < nodes_ ? k + 1 : 0, before = k > 0 ? k - 1 : nodes_ - 1;
    const Vector3d x = q.col(k).head<3>(), x1 = q.col(after).head<3>(),
                   x0 = q.col(before).head<3>();
    const Vector3d chord = x1 - x;
    const double length = chord.norm();
    const Vector3d tension = chord * ((T0_ + EA_ * (length - L0_) / L0_) / length);    // (1)
    force.col(k).head<3>() += tension + 0.5 * pressure_width_ * rim.a.cross(x1 - x0);  // (2)
    force.col(after).head<3>() -= tension;

    const Bend bend = bend_at(x0, x, x1, rim.a);
    const double moment = EI_ / (L0_ * L0_ * L0_) * (bend.s - s0_);
    const double beta = bend.d.dot(bend.t) / bend.length;          // turning of n with the chord
    force.col(after).head<3>() -= moment * (1.0 - beta) * bend.n;  // (3)
    force.col(before).head<3>() -= moment * (1.0 + beta) * bend.n;
    force.col(k).head<3>() += 2.0 * moment * bend.n;

    const double u = rim.a.dot(x), u1 = rim.a.dot(x1), u0 = rim.a.dot(x0);
    const double lateral = EI_lateral_ * ((u1 + u0 - 2.0 * u) / (L0_ * L0_) + q(3, k) / R_);
    force.col(after).head<3>() -= lateral / L0_ * rim.a;  // (4)
    force.col(before).head<3>() -= lateral / L0_ * rim.a;
    force.col(k).head<3>() += 2.0 * lateral / L0_ * rim.a;
    force(3, k) -= lateral * L0_ / R_;
    const double torque = GJ_ * ((q(3, after) - q(3, k)) / L0_ - (u1 - u) / (L0_ * R_));
    force(3, after) -= torque;  // (5)
    force(3, k) += torque;
    force.col(after).head<3>() += torque / R_ * rim.a;
    force.col(k).head<3>() -= torque / R_ * rim.a;
  }
}

void BeltForces::add_stiffness(const NodeValues& q,
                               const RimFrame& rim,
                               double scale,
                               CyclicBand& K) const {
  const Matrix3d pressure = scale * 0.5 * pressure_width_ * cross_matrix(rim.a);
  for (int k = 0; k < nodes_; ++k) {
    const int after = k + 1 < nodes_ ? k + 1 : 0;
    const Vector3d chord = q.col(after).head<3>() - q.col(k).head<3>();
    const double length = chord.norm();
    const double string = scale * (T0_ + EA_ * (length - L0_) / L0_) / length;
    const Vector3d e = chord / length;
    const Matrix3d spring =
        (scale * EA_ / L0_ - string) * e * e.transpose() + string * Matrix3d::Identity();
    K.block(k, 0).topLeftCorner<3, 3>() += spring;  // (1)
    K.block(after, 0).topLeftCorner<3, 3>() += spring;
    K.block(k, 1).topLeftCorner<3, 3>() -= spring + pressure;  // (2)
    add_bending_stiffness(q, rim, k, scale, K);
    add_lateral_stiffness(rim, k, scale, K);
  }
}

/// s = a . (d × c)/|c| is a product of linear forms over a length, so its second derivatives in c
/// and d are short; x_(k+1) moves c and d by +1, x_(k-1) by -1 and +1, x_k moves d by -2.
void BeltForces::add_bending_stiffness(
    const NodeValues& q, const RimFrame& rim, int k, double scale, CyclicBand& K) const {
  const int after = k + 1 < nodes_ ? k + 1 : 0, before = k > 0 ? k - 1 : nodes_ - 1;
  const Bend bend =
      bend_at(q.col(before).head<3>(), q.col(k).head<3>(), q.col(after).head<3>(), rim.a);
  const double stiffness = scale * EI_ / (L0_ * L0_ * L0_);
  const double moment = stiffness * (bend.s - s0_);
  const double along = bend.d.dot(bend.t) / bend.length;
  const double weight[3] = {1.0 + along, -2.0, 1.0 - along};
  const Matrix3d nn = bend.n * bend.n.transpose(), tn = bend.t * bend.n.transpose();
  const Matrix3d cc =
      (along / bend.length) * (tn + tn.transpose()) - (bend.s / (bend.length * bend.length)) * nn;
  const Matrix3d cd = -tn.transpose() / bend.length;  // rows c, columns d
  const double of_c[3] = {-1.0, 0.0, 1.0}, of_d[3] = {1.0, -2.0, 1.0};
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      add_block(K,
                k,
                i,
                j,
                stiffness * weight[i] * weight[j] * nn +
                    moment * (of_c[i] * of_c[j] * cc + of_c[i] * of_d[j] * cd +
                              of_d[i] * of_c[j] * cd.transpose()));
}

void BeltForces::add_lateral_stiffness(const RimFrame& rim,
                                       int k,
                                       double scale,
                                       CyclicBand& K) const {
  using Eigen::Vector4d;
  const auto row = [&](double lateral, double torsion) {
    Vector4d g;
    g << lateral * rim.a, torsion;
    return g;
  };
  const double bend = 1.0 / (L0_ * L0_);
  const Vector4d curvature[3] = {row(bend, 0.0), row(-2.0 * bend, 1.0 / R_), row(bend, 0.0)};
  const Vector4d twist[2] = {row(1.0 / (L0_ * R_), -1.0 / L0_), row(-1.0 / (L0_ * R_), 1.0 / L0_)};
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      K.block((k + i - 1 + nodes_) % nodes_, j - i) +=
          (scale * EI_lateral_ * L0_) * curvature[i] * curvature[j].transpose();
  for (int i = 0; i < 2; ++i)
    for (int j = i; j < 2; ++j)
      K.block((k + i) % nodes_, j - i) += (scale * GJ_ * L0_) * twist[i] * twist[j].transpose();
}

}  // namespace latsch::ring_tire
