// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "models/ring_tire/rim_rows.h"
#include "numerics/lanes.h"

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

struct BeltLaw {
  double R, L0, T0, EA, EI, EI_lateral, GJ, pressure_width, s0;
};

/// What the elements of node k carry: the string to node k + 1 (three components), (3) along x and
/// z with the turning of n with the chord, (4), (5).
struct Elements {
  enum { kString = 0, kBendX = 3, kBendZ, kTurning, kLateral, kTwist, kRows };
  double* row[kRows];
};

/// Elements -1 .. nodes of nodes at x, y, z with torsions (rows of rim_rows.h). In the rim's axes
/// a × (t_x, 0, t_z) = (t_z, 0, -t_x).
LATSCH_CLONES void strain(int nodes,
                          const BeltLaw& of,
                          const double* const rows[4],
                          const Elements& elements) {
  const BeltLaw law = of;
  const Elements e = elements;
  const double *x = rows[0], *y = rows[1], *z = rows[2], *psi = rows[3];
  const double spring = law.EA / law.L0, bend = law.EI / (law.L0 * law.L0 * law.L0);
  const double over = 1.0 / (law.L0 * law.L0), of_psi = 1.0 / law.R;
  const double of_travel = 1.0 / (law.L0 * law.R);
#pragma GCC ivdep
  for (int k = -1; k <= nodes; ++k) {
    const double dx = x[k + 1] - x[k], dy = y[k + 1] - y[k], dz = z[k + 1] - z[k];
    const double chord = __builtin_sqrt(dx * dx + dy * dy + dz * dz);
    const double tension = (law.T0 + spring * (chord - law.L0)) / chord;  // (1)
    e.row[Elements::kString][k] = tension * dx;
    e.row[Elements::kString + 1][k] = tension * dy;
    e.row[Elements::kString + 2][k] = tension * dz;
    const double cx = x[k + 1] - x[k - 1], cz = z[k + 1] - z[k - 1];
    const double sx = x[k + 1] + x[k - 1] - 2.0 * x[k], sz = z[k + 1] + z[k - 1] - 2.0 * z[k];
    const double shorter = 1.0 / __builtin_sqrt(cx * cx + cz * cz);
    const double tx = cx * shorter, tz = cz * shorter;
    const double moment = bend * (sx * tz - sz * tx - law.s0);  // (3)
    e.row[Elements::kBendX][k] = moment * tz;
    e.row[Elements::kBendZ][k] = -moment * tx;
    e.row[Elements::kTurning][k] = (sx * tx + sz * tz) * shorter;
    e.row[Elements::kLateral][k] =
        law.EI_lateral * ((y[k + 1] + y[k - 1] - 2.0 * y[k]) * over + psi[k] * of_psi);       // (4)
    e.row[Elements::kTwist][k] = law.GJ * ((psi[k + 1] - psi[k]) / law.L0 - dy * of_travel);  // (5)
  }
}

/// What the elements do to the nodes, and the pressure (2).
LATSCH_CLONES void gather(int nodes,
                          const BeltLaw& of,
                          const double* const rows[4],
                          const Elements& elements,
                          double* const forces[4]) {
  const BeltLaw law = of;
  const Elements e = elements;
  const double *x = rows[0], *z = rows[2];
  double *Fx = forces[0], *Fy = forces[1], *Fz = forces[2], *M = forces[3];
  const double half = 0.5 * law.pressure_width, length = law.L0 / law.R;
  const double by_L = 1.0 / law.L0, by_R = 1.0 / law.R;
#pragma GCC ivdep
  for (int k = 0; k < nodes; ++k) {
    const auto at = [&](int row, int node) { return e.row[row][node]; };
    // At k itself, from the node behind, from the node ahead.
    const double behind = 1.0 - at(Elements::kTurning, k - 1),
                 ahead = 1.0 + at(Elements::kTurning, k + 1);
    const auto bending = [&](int row) {
      return 2.0 * at(row, k) - behind * at(row, k - 1) - ahead * at(row, k + 1);
    };
    Fx[k] = at(Elements::kString, k) - at(Elements::kString, k - 1) + half * (z[k + 1] - z[k - 1]) +
            bending(Elements::kBendX);
    Fz[k] = at(Elements::kString + 2, k) - at(Elements::kString + 2, k - 1) -
            half * (x[k + 1] - x[k - 1]) + bending(Elements::kBendZ);
    const double lateral = at(Elements::kLateral, k);
    const double curving =
        2.0 * lateral - at(Elements::kLateral, k - 1) - at(Elements::kLateral, k + 1);
    const double twisting = at(Elements::kTwist, k) - at(Elements::kTwist, k - 1);
    Fy[k] = at(Elements::kString + 1, k) - at(Elements::kString + 1, k - 1) + curving * by_L -
            twisting * by_R;
    M[k] = twisting - lateral * length;
  }
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
  RimRows at(nodes_), f(nodes_, Elements::kRows);
  at.place(q, rim);
  Elements e;
  for (int i = 0; i < Elements::kRows; ++i) e.row[i] = f.row(RimRows::kRows + i);
  const double* const x[4] = {
      at.row(RimRows::kX), at.row(RimRows::kY), at.row(RimRows::kZ), at.row(RimRows::kTorsion)};
  double* const to[4] = {
      f.row(RimRows::kX), f.row(RimRows::kY), f.row(RimRows::kZ), f.row(RimRows::kTorsion)};
  const BeltLaw law{R_, L0_, T0_, EA_, EI_, EI_lateral_, GJ_, pressure_width_, s0_};
  strain(nodes_, law, x, e);
  gather(nodes_, law, x, e, to);
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
      of[j - i] += (scale * EI_lateral_ * L0_) * curvature[i] * curvature[j].transpose();
  for (int i = 0; i < 2; ++i)
    for (int j = i; j < 2; ++j) of[j - i] += (scale * GJ_ * L0_) * twist[i] * twist[j].transpose();
  for (int k = 0; k < nodes_; ++k)
    for (int j = 0; j < 3; ++j) K.block(k, j) += of[j];
}

}  // namespace latsch::ring_tire
