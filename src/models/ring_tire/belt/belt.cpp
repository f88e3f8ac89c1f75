// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/belt.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "models/ring_tire/belt/rim_rows.h"

namespace latsch::ring_tire {

struct BeltLaw {
  double R, L0, T0, EA, EI, EI_out_of_plane, GJ, pressure_width, s0;
};

/// What the elements of node k carry: the string to node k + 1 (three components), (3) along x and
/// z with the turning of n with the chord, (4), (5).
struct Elements {
  enum { kString = 0, kBendX = 3, kBendZ, kTurning, kLateral, kTwist, kRows };
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
      EI_out_of_plane_(belt.bending_out_of_plane),
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
    sum +=
        0.5 * L0_ * (EI_out_of_plane_ * curvature * curvature + GJ_ * twist * twist);  // (4), (5)
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
  const BeltLaw law{R_, L0_, T0_, EA_, EI_, EI_out_of_plane_, GJ_, pressure_width_, s0_};
  LATSCH_KERNEL(strain)(nodes_, law, x, e);
  LATSCH_KERNEL(gather)(nodes_, law, x, e, to);
  f.add_to(force, rim);
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
  }
  add_lateral_stiffness(rim, scale, K);
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

/// (4) and (5) are the same at every node.
void BeltForces::add_lateral_stiffness(const RimFrame& rim, double scale, CyclicBand& K) const {
  using Eigen::Matrix4d, Eigen::Vector4d;
  const auto row = [&](double lateral, double torsion) {
    Vector4d g;
    g << lateral * rim.a, torsion;
    return g;
  };
  const double bend = 1.0 / (L0_ * L0_);
  const Vector4d curvature[3] = {row(bend, 0.0), row(-2.0 * bend, 1.0 / R_), row(bend, 0.0)};
  const Vector4d twist[2] = {row(1.0 / (L0_ * R_), -1.0 / L0_), row(-1.0 / (L0_ * R_), 1.0 / L0_)};
  Matrix4d of[3] = {Matrix4d::Zero(), Matrix4d::Zero(), Matrix4d::Zero()};
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      of[j - i] += (scale * EI_out_of_plane_ * L0_) * curvature[i] * curvature[j].transpose();
  for (int i = 0; i < 2; ++i)
    for (int j = i; j < 2; ++j) of[j - i] += (scale * GJ_ * L0_) * twist[i] * twist[j].transpose();
  for (int k = 0; k < nodes_; ++k)
    for (int j = 0; j < 3; ++j) K.block(k, j) += of[j];
}

}  // namespace latsch::ring_tire
