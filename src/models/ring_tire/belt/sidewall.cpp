// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/sidewall.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace latsch::ring_tire {

/// The torsion spring (9) of a node.
struct TorsionSpring {
  double stiffness, damping, by_lateral, rest;
};

}  // namespace latsch::ring_tire

#define LATSCH_KERNELS_IN "models/ring_tire/belt/sidewall_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

using Eigen::Matrix3d;
using Eigen::Vector3d;

SidewallForces::SidewallForces(const Sidewall& sidewall, double radius, int nodes, double conicity)
    : angles_(nodes),
      R_(radius),
      tau_(sidewall.time_constant),
      progressivity_(sidewall.progressivity),
      progressive_travel_(sidewall.progressive_travel),
      rim_travel_(sidewall.rim_travel) {
  const double share = 2.0 * std::numbers::pi * radius / nodes;
  rim_stiffness_ = share * sidewall.rim_stiffness;
  const SidewallElement* elements[3] = {&sidewall.radial, &sidewall.tangential, &sidewall.lateral};
  has_memory_ = false;
  int place = 0;
  for (int i = 0; i < 3; ++i) {
    const SidewallElement& e = *elements[i];
    const double k = share * e.stiffness;
    direction_[i] = {k, share * e.damping, k * e.dynamic_stiffening};
    const int count = i == 0 ? kRadialFrictions : 1;
    for (int j = 1; j <= count; ++j)
      friction_[place++] = {i,
                            k * e.friction_stiffening / count,
                            share * e.friction_force * 2.0 * j / (count * (count + 1.0))};
    has_memory_ = has_memory_ || e.dynamic_stiffening > 0.0 || e.friction_stiffening > 0.0;
  }
  torsion_ = share * sidewall.torsion;
  torsion_damping_ = share * sidewall.torsion_damping;
  torsion_by_lateral_ = sidewall.torsion_by_lateral;
  conicity_ = conicity;
  reset();
}

void SidewallForces::reset() {
  const int nodes = angles_.nodes();
  memory_.travel = Eigen::Matrix3Xd::Zero(3, nodes);
  now_ = memory_.travel;
  memory_.maxwell = Eigen::Matrix3Xd::Zero(3, nodes);
  const bool rubs = std::any_of(
      std::begin(friction_), std::end(friction_), [](const Friction& f) { return f.k > 0.0; });
  memory_.slip.setZero(kFrictions, rubs ? nodes : 0);
}

Vector3d SidewallForces::travel(const NodeValues& q, const RimFrame& rim, int k) const {
  const Vector3d x = q.col(k).head<3>() - rim.center;
  return {angles_.radial(rim, k).dot(x) - R_, angles_.tangential(rim, k).dot(x), rim.a.dot(x)};
}

void SidewallForces::find_slopes(int direction,
                                 const double* u,
                                 const StepRule& rule,
                                 double* slope) const {
  const int nodes = angles_.nodes();
  const Direction& of = direction_[direction];
  double constant = of.k + of.d * rule.velocity;
  if (has_memory_ && !rule.statics()) constant += of.k_maxwell / (1.0 + half_step(rule));
  if (direction == 0 && progressivity_ > 0.0) LATSCH_KERNEL(find_progressive)
  (nodes, constant, of.k * progressivity_, progressive_travel_, u, slope);
  else std::fill(slope, slope + nodes, constant);
  if (direction == 0 && rim_stiffness_ > 0.0)
    LATSCH_KERNEL(add_rim_slope)(nodes, rim_stiffness_, rim_travel_, u, slope);
  if (!has_memory_) return;
  const double* before = &memory_.travel(direction, 0);
  for (int i = 0; i < kFrictions; ++i) {
    const Friction& f = friction_[i];
    if (f.direction == direction && f.k > 0.0) LATSCH_KERNEL(add_sticking)
    (nodes, f.k, most_stretch(f), before, &memory_.slip(i, 0), u, slope);
  }
}

void SidewallForces::add_spring(int direction, const double* u, double* F) const {
  const int nodes = angles_.nodes();
  const double k = direction_[direction].k;
  if (direction == 0 && progressivity_ > 0.0)
    LATSCH_KERNEL(add_progressive)(nodes, k, progressivity_, progressive_travel_, u, F);
  else
    LATSCH_KERNEL(add_multiple)(nodes, -k, u, F);
  if (direction == 0 && rim_stiffness_ > 0.0)
    LATSCH_KERNEL(add_rim)(nodes, rim_stiffness_, rim_travel_, u, F);
}

void SidewallForces::add_memory(int direction,
                                const double* u,
                                const StepRule& rule,
                                double* F) const {
  const int nodes = angles_.nodes();
  const double* before = memory_.travel.data() + direction * nodes;
  if (const double kM = direction_[direction].k_maxwell; kM > 0.0 && !rule.statics())
    LATSCH_KERNEL(add_maxwell)
  (nodes, kM, half_step(rule), before, &memory_.maxwell(direction, 0), u, F);
  for (int i = 0; i < kFrictions; ++i) {
    const Friction& f = friction_[i];
    if (f.direction == direction && f.k > 0.0)
      LATSCH_KERNEL(add_friction)(nodes, f.k, most_stretch(f), before, &memory_.slip(i, 0), u, F);
  }
}

/// Computes travel along e_r = (sin, 0, -cos), minus R, e_t = (cos, 0, sin) and a: three rows one
/// after the other.
void SidewallForces::to_polar(const RimRows& at, double R, double* const polar[3]) const {
  LATSCH_KERNEL(to_polar)
  (angles_.nodes(),
   at.row(RimRows::kX),
   at.row(RimRows::kY),
   at.row(RimRows::kZ),
   angles_.sine(),
   angles_.cosine(),
   R,
   polar);
}

void SidewallForces::find_force(const RimRows& at,
                                const RimRows& rate,
                                const StepRule& rule,
                                RimRows& force) const {
  const int nodes = angles_.nodes();
  double *u[3], *w[3], *F[3];
  for (int i = 0; i < 3; ++i) {
    u[i] = force.row(RimRows::kRows + i);
    w[i] = force.row(RimRows::kRows + 3 + i);
    F[i] = force.row(RimRows::kRows + 6 + i);
  }
  to_polar(at, R_, u);
  if (!rule.statics()) to_polar(rate, 0.0, w);
  for (int i = 0; i < 3; ++i) {
    std::fill(F[i], F[i] + nodes, 0.0);
    add_spring(i, u[i], F[i]);
    if (has_memory_) add_memory(i, u[i], rule, F[i]);
    if (!rule.statics()) LATSCH_KERNEL(add_multiple)(nodes, -direction_[i].d, w[i], F[i]);
  }
  LATSCH_KERNEL(from_polar)
  (nodes,
   F,
   angles_.sine(),
   angles_.cosine(),
   force.row(RimRows::kX),
   force.row(RimRows::kY),
   force.row(RimRows::kZ));
  LATSCH_KERNEL(add_torsion)
  (nodes,
   {.stiffness = torsion_,
    .damping = rule.statics() ? 0.0 : torsion_damping_,
    .by_lateral = torsion_by_lateral_,
    .rest = conicity_},
   at.row(RimRows::kTorsion),
   u[2],
   rate.row(RimRows::kTorsion),
   force.row(RimRows::kY),
   force.row(RimRows::kTorsion));
}

/// Computes the stiffness along e_r, e_t and a at the knots, then in the rim's axes, then on the
/// nodes.
void SidewallForces::add_stiffness(const RimRows& at,
                                   const StepRule& rule,
                                   double scale,
                                   StiffnessRows& K) const {
  const int nodes = angles_.nodes();
  double *u[3], *slope[3], *knots[4];  // xx, xz, zz, yy
  for (int i = 0; i < 3; ++i) {
    u[i] = K.scratch(i);
    slope[i] = K.scratch(3 + i);
  }
  for (int i = 0; i < 4; ++i) knots[i] = K.scratch(kKnotSlopes + i);
  to_polar(at, R_, u);
  for (int i = 0; i < 3; ++i) find_slopes(i, u[i], rule, slope[i]);
  LATSCH_KERNEL(turn_slopes)(nodes, scale, slope, angles_.sine(), angles_.cosine(), knots);
  for (double* row : knots) {
    row[-1] = row[nodes - 1];
    row[nodes] = row[0];
  }
  using Rows = StiffnessRows;
  for (int j = 0; j < 3; ++j) {
    const auto add = [&](Rows::Entry entry, int from) {
      LATSCH_KERNEL(add_from_knots)(nodes, j, knots[from], K.row(j, entry));
    };
    add(Rows::kXX, 0);
    add(Rows::kXZ, 1);
    add(Rows::kZX, 1);
    add(Rows::kZZ, 2);
    add(Rows::kYY, 3);
  }
  const double torsion = scale * torsion_, lambda = torsion_by_lateral_;  // (9)
  Eigen::Matrix4d of_torsion = Eigen::Matrix4d::Zero();
  of_torsion(1, 1) = torsion * lambda * lambda;
  of_torsion(1, 3) = of_torsion(3, 1) = -torsion * lambda;
  of_torsion(3, 3) = torsion + scale * torsion_damping_ * rule.velocity;
  K.add_at_knots(of_torsion);
}

SidewallForces::Losses SidewallForces::losses() const {
  const auto& d = direction_;
  return {.damping = {d[0].d, d[1].d, d[2].d, torsion_damping_},
          .maxwell = {d[0].k_maxwell, d[1].k_maxwell, d[2].k_maxwell, 0.0},
          .time_constant = tau_};
}

void SidewallForces::commit(const RimRows& at, const StepRule& rule) {
  const int nodes = angles_.nodes();
  Travels& u = now_;
  double* const rows[3] = {&u(0, 0), &u(1, 0), &u(2, 0)};
  to_polar(at, R_, rows);
  if (has_memory_) {
    // At rest Maxwell elements have no force.
    if (rule.statics()) memory_.maxwell.setZero();
    for (int i = 0; i < 3 && !rule.statics(); ++i) LATSCH_KERNEL(go_on_maxwell)
    (nodes, half_step(rule), &memory_.travel(i, 0), &u(i, 0), &memory_.maxwell(i, 0));
    for (int i = 0; i < kFrictions; ++i) {
      const Friction& f = friction_[i];
      if (f.k == 0.0) continue;
      LATSCH_KERNEL(go_on_friction)
      (nodes,
       most_stretch(f),
       &memory_.travel(f.direction, 0),
       &u(f.direction, 0),
       &memory_.slip(i, 0));
    }
  }
  memory_.travel.swap(u);
}

double SidewallForces::energy(const NodeValues& q, const RimFrame& rim) const {
  double sum = 0.0;
  for (int k = 0; k < angles_.nodes(); ++k) {
    const Vector3d u = travel(q, rim, k);
    for (int i = 0; i < 3; ++i)
      sum += 0.5 * (direction_[i].k * u[i] * u[i] +
                    direction_[i].k_maxwell * memory_.maxwell(i, k) * memory_.maxwell(i, k));
    const double up = progressive_travel_, ratio = u[0] / up;
    if (progressivity_ > 0.0)  // the integral of (7) beyond k u
      sum += direction_[0].k * progressivity_ *
             (0.5 * u[0] * u[0] -
              up * up * (ratio * std::atan(ratio) - 0.5 * std::log1p(ratio * ratio)));
    for (int i = 0; i < kFrictions; ++i)
      if (friction_[i].k > 0.0)
        sum += 0.5 * friction_[i].k * memory_.slip(i, k) * memory_.slip(i, k);
    const double on_rim = std::min(u[0] + rim_travel_, 0.0);
    sum += 0.5 * rim_stiffness_ * on_rim * on_rim;  // (28)
    const double twist = q(3, k) - torsion_by_lateral_ * u[2] - conicity_;
    sum += 0.5 * torsion_ * twist * twist;
  }
  return sum;
}

}  // namespace latsch::ring_tire
