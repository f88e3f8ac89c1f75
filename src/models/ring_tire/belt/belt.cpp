// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/belt.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/belt/bend_rule.h"
#include "models/ring_tire/belt/ply_coupling.h"

namespace latsch::ring_tire {

/// Elements of node k: the tension in the middle of segment k (three components); (3) along x and z
/// with the rotation of n by the slope, at knot k and in the middle of the segment; (4); (5).
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
    kTorsion,
    kTorsionBetween,
    kTwist,
    kTwistAcross,
    kRows
  };
  double* row[kRows];
};

}  // namespace latsch::ring_tire

#define LATSCH_KERNELS_IN "models/ring_tire/belt/belt_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Vector3d;

/// Returns s of (3).
template <class Place>
double bend_of(const BendRule& rule, const Place& place, const Vector3d& a) {
  Vector3d c = Vector3d::Zero(), d = Vector3d::Zero();
  for (int i = 0; i < 4; ++i) {
    c += rule.slope[i] * place(i - 1);
    d += rule.second[i] * place(i - 1);
  }
  c -= a * a.dot(c);
  return d.dot(a.cross(c)) / c.norm();
}

}  // namespace

BeltForces::BeltForces(const Belt& belt, int nodes) : nodes_(nodes), law_() {
  const double x = 2.0 * std::numbers::pi / nodes;
  const double node_radius = belt.radius * node_radius_over_knot_radius(nodes);
  // The pressure force on a node at rest; the tension along g_k balances it with T0 L0/R.
  const double outward = 2.0 * (kArea1 * std::sin(x) + kArea2 * std::sin(2.0 * x)) * node_radius *
                         belt.pressure * belt.pressure_width;
  law_ = {
      .R = belt.radius,
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
      .tilt_between =
          24.0 * belt.radius / ((23.0 * std::cos(0.5 * x) + std::cos(1.5 * x)) * node_radius),
      .tilt_twist = belt.radius * x * x / (node_radius * (std::cos(0.5 * x) - std::cos(1.5 * x))),
      .damping_time = belt.damping_time,
      .extension_damping_time = belt.extension_damping_time,
      .D16 = belt.bending_twist,
      .cone = 0.0,
      .cone_between = 0.0};
  law_.cone = belt.conicity * law_.s0;
  law_.cone_between = belt.conicity * law_.tilt_between * law_.s0_between;
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
               tilt_between,
               tilt_twist,
               damping_time,
               extension_damping_time,
               D16,
               cone,
               cone_between] = law_;
  double sum = 0.0;
  for (int k = 0; k < nodes_; ++k) {
    const auto node = [&](int i) -> Eigen::Vector4d { return q.col((k + i + nodes_) % nodes_); };
    const auto place = [&](int i) -> Vector3d { return node(i).head<3>() - rim.center; };
    const Eigen::Vector4d slope = 0.125 * (5.0 * (node(1) - node(0)) + node(2) - node(-1));  // (26)
    const double strain = slope.head<3>().norm() / stretch0 - 1.0 + T0 / EA;
    sum += 0.5 * EA * L0 * strain * strain;  // (1)
    sum +=
        pressure_width * rim.a.dot(place(0).cross(kArea1 * place(1) + kArea2 * place(2)));  // (2)
    const double at_knot = bend_of(kAtKnot, place, rim.a);
    const double between = bend_of(kBetween, place, rim.a);
    sum += 0.5 * EI / (L0 * L0 * L0) *
           (kKnotShare * (at_knot - s0) * (at_knot - s0) +
            (1.0 - kKnotShare) * (between - s0_between) * (between - s0_between));  // (3)
    const auto curvature = [&, L0 = L0](const BendRule& rule, double torsion_by_bend) {
      double sum = 0.0;
      for (int i = 0; i < 4; ++i)
        sum += rule.second[i] * rim.a.dot(place(i - 1)) -
               torsion_by_bend * rule.place[i] * node(i - 1)[3];
      return sum / (L0 * L0);
    };
    const double knot = curvature(kAtKnot, at_knot) + cone / (L0 * L0),
                 middle = curvature(kBetween, tilt_between * between) + cone_between / (L0 * L0);
    const double twist =
        (slope[3] + rim.a.dot(slope.head<3>()) * tilt_twist * between / (L0 * L0)) / L0;
    sum += 0.5 * L0 * EI_out_of_plane *
           (kKnotShare * knot * knot + (1.0 - kKnotShare) * middle * middle);  // (4)
    sum += 0.5 * L0 * GJ * twist * twist;                                      // (5)
    if (D16 == 0.0) continue;
    const double at_knot_slope = 0.5 * (node(1) - node(-1))[3],
                 across = 0.5 * rim.a.dot(place(1) - place(-1));
    const double twist_at_knot = (at_knot_slope - across * at_knot / (R * s0)) / L0;
    sum += D16 / L0 *
           (kKnotShare * (at_knot - s0) * twist_at_knot +
            (1.0 - kKnotShare) * (between - s0_between) * twist);  // (32)
  }
  return sum;
}

void BeltForces::find_force(const RimRows& at, const RimRows* rate, RimRows& force) const {
  static_assert(kScratch == Elements::kRows);
  Elements e;
  for (int i = 0; i < Elements::kRows; ++i) e.row[i] = force.row(RimRows::kRows + i);
  const double* const x[4] = {
      at.row(RimRows::kX), at.row(RimRows::kY), at.row(RimRows::kZ), at.row(RimRows::kTorsion)};
  double* const to[4] = {force.row(RimRows::kX),
                         force.row(RimRows::kY),
                         force.row(RimRows::kZ),
                         force.row(RimRows::kTorsion)};
  if (rate && damped()) {
    const double* const v[4] = {rate->row(RimRows::kX),
                                rate->row(RimRows::kY),
                                rate->row(RimRows::kZ),
                                rate->row(RimRows::kTorsion)};
    LATSCH_KERNEL(strain_damped)(nodes_, law_, x, v, e);
  } else {
    LATSCH_KERNEL(strain)(nodes_, law_, x, e);
  }
  LATSCH_KERNEL(gather)(nodes_, law_, x, e, to);
  if (law_.D16 != 0.0) add_ply_force(law_, at, damped() ? rate : nullptr, force);
}

}  // namespace latsch::ring_tire
