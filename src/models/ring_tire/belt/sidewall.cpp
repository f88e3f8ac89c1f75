// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/sidewall.h"

#include <cmath>
#include <numbers>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/belt/rim_rows.h"

#define LATSCH_KERNELS_IN "models/ring_tire/belt/sidewall_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// Along e_r = (sin, 0, -cos), less R, e_t = (cos, 0, sin) and a: three rows one after the other.
void to_polar(int nodes, const NodeAngles& angles, double R, RimRows& at, double* polar) {
  const double *s = angles.sine(), *c = angles.cosine();
  const double *x = at.row(RimRows::kX), *y = at.row(RimRows::kY), *z = at.row(RimRows::kZ);
#pragma GCC ivdep
  for (int k = 0; k < nodes; ++k) {
    polar[k] = x[k] * s[k] - z[k] * c[k] - R;
    polar[nodes + k] = x[k] * c[k] + z[k] * s[k];
    polar[2 * nodes + k] = y[k];
  }
}

void from_polar(int nodes, const NodeAngles& angles, const double* polar, RimRows& to) {
  const double *s = angles.sine(), *c = angles.cosine();
  double *x = to.row(RimRows::kX), *y = to.row(RimRows::kY), *z = to.row(RimRows::kZ);
#pragma GCC ivdep
  for (int k = 0; k < nodes; ++k) {
    x[k] = polar[k] * s[k] + polar[nodes + k] * c[k];
    y[k] = polar[2 * nodes + k];
    z[k] = -polar[k] * c[k] + polar[nodes + k] * s[k];
  }
}

}  // namespace

SidewallForces::SidewallForces(const Sidewall& sidewall, double radius, int nodes)
    : angles_(nodes),
      R_(radius),
      tau_(sidewall.time_constant),
      progressivity_(sidewall.progressivity),
      progressive_travel_(sidewall.progressive_travel) {
  const double share = 2.0 * std::numbers::pi * radius / nodes;
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
  reset();
}

void SidewallForces::reset() {
  const int nodes = angles_.nodes();
  memory_.travel = Eigen::Matrix3Xd::Zero(3, nodes);
  memory_.maxwell = Eigen::Matrix3Xd::Zero(3, nodes);
  memory_.slip = Eigen::Matrix<double, kFrictions, Eigen::Dynamic>::Zero(kFrictions, nodes);
}

Vector3d SidewallForces::travel(const NodeValues& q, const RimFrame& rim, int k) const {
  const Vector3d x = q.col(k).head<3>() - rim.center;
  return {angles_.radial(rim, k).dot(x) - R_, angles_.tangential(rim, k).dot(x), rim.a.dot(x)};
}

double SidewallForces::spring_slope(int direction, double u) const {
  const double k = direction_[direction].k, up = progressive_travel_;
  return direction == 0 ? k * (1.0 + progressivity_ * u * u / (u * u + up * up)) : k;  // (7)
}

double SidewallForces::memory_slope(int k, int direction, double u, const StepRule& rule) const {
  double slope = 0.0;
  if (!rule.statics()) slope += direction_[direction].k_maxwell / (1.0 + rule.step / (2.0 * tau_));
  for (int i = 0; i < kFrictions; ++i) {
    const Friction& f = friction_[i];
    if (f.direction == direction && f.k > 0.0 &&
        std::abs(memory_.slip(i, k) + u - memory_.travel(direction, k)) < most_stretch(f))
      slope += f.k;
  }
  return slope;
}

void SidewallForces::add_spring(int direction, const double* u, double* F) const {
  const int nodes = angles_.nodes();
  const double k = direction_[direction].k;
  if (direction == 0 && progressivity_ > 0.0)
    LATSCH_KERNEL(add_progressive)(nodes, k, progressivity_, progressive_travel_, u, F);
  else
    LATSCH_KERNEL(add_multiple)(nodes, -k, u, F);
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

void SidewallForces::add_force(const NodeValues& q,
                               const NodeValues& v,
                               const RimFrame& rim,
                               const StepRule& rule,
                               NodeValues& force) const {
  const int nodes = angles_.nodes();
  RimRows at(nodes), rate(nodes), f(nodes);
  at.place(q, rim);
  if (!rule.statics()) rate.place_rates(at, v, rim);
  Travels u(3, nodes), w(3, nodes), F = Travels::Zero(3, nodes);
  to_polar(nodes, angles_, R_, at, u.data());
  to_polar(nodes, angles_, 0.0, rate, w.data());
  for (int i = 0; i < 3; ++i) {
    add_spring(i, &u(i, 0), &F(i, 0));
    if (has_memory_) add_memory(i, &u(i, 0), rule, &F(i, 0));
    if (!rule.statics()) LATSCH_KERNEL(add_multiple)(nodes, -direction_[i].d, &w(i, 0), &F(i, 0));
  }
  from_polar(nodes, angles_, F.data(), f);
  const double* psi = at.row(RimRows::kTorsion);
  const double* psi_rate = rate.row(RimRows::kTorsion);
  const double damping = rule.statics() ? 0.0 : torsion_damping_;
  for (int k = 0; k < nodes; ++k) {
    const double torsion = torsion_ * (psi[k] - torsion_by_lateral_ * u(2, k));  // (9)
    f.row(RimRows::kY)[k] += torsion_by_lateral_ * torsion;
    f.row(RimRows::kTorsion)[k] = -torsion - damping * psi_rate[k];
  }
  f.add_to(force, rim);
}

void SidewallForces::add_stiffness(const NodeValues& q,
                                   const RimFrame& rim,
                                   const StepRule& rule,
                                   double scale,
                                   CyclicBand& K) const {
  for (int k = 0; k < angles_.nodes(); ++k) {
    const Vector3d er = angles_.radial(rim, k), et = angles_.tangential(rim, k);
    const Vector3d u = travel(q, rim, k);
    Vector3d slope;
    for (int i = 0; i < 3; ++i) {
      slope[i] = spring_slope(i, u[i]) + direction_[i].d * rule.velocity;
      if (has_memory_) slope[i] += memory_slope(k, i, u[i], rule);
    }
    slope *= scale;
    const double torsion = scale * torsion_, lambda = torsion_by_lateral_;
    Eigen::Matrix4d block = Eigen::Matrix4d::Zero();
    block.topLeftCorner<3, 3>() =
        slope[0] * er * er.transpose() + slope[1] * et * et.transpose() +
        (slope[2] + torsion * lambda * lambda) * rim.a * rim.a.transpose();
    block.block<3, 1>(0, 3) = -torsion * lambda * rim.a;
    block.block<1, 3>(3, 0) = -torsion * lambda * rim.a.transpose();
    block(3, 3) = torsion + scale * torsion_damping_ * rule.velocity;
    add_at_knot(block, k, K);
  }
}

SidewallForces::Losses SidewallForces::losses() const {
  const auto& d = direction_;
  return {.damping = {d[0].d, d[1].d, d[2].d, torsion_damping_},
          .maxwell = {d[0].k_maxwell, d[1].k_maxwell, d[2].k_maxwell, 0.0},
          .time_constant = tau_};
}

void SidewallForces::commit(const NodeValues& q, const RimFrame& rim, const StepRule& rule) {
  const int nodes = angles_.nodes();
  RimRows at(nodes);
  at.place(q, rim);
  Travels u(3, nodes);
  to_polar(nodes, angles_, R_, at, u.data());
  if (has_memory_) {
    // Nothing is left of Maxwell's forces at rest.
    if (rule.statics()) memory_.maxwell.setZero();
    for (int i = 0; i < 3 && !rule.statics(); ++i) LATSCH_KERNEL(go_on_maxwell)
    (nodes, half_step(rule), &memory_.travel(i, 0), &u(i, 0), &memory_.maxwell(i, 0));
    for (int i = 0; i < kFrictions; ++i) {
      const Friction& f = friction_[i];
      LATSCH_KERNEL(go_on_friction)
      (nodes,
       most_stretch(f),
       &memory_.travel(f.direction, 0),
       &u(f.direction, 0),
       &memory_.slip(i, 0));
    }
  }
  memory_.travel = u;
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
      sum += 0.5 * friction_[i].k * memory_.slip(i, k) * memory_.slip(i, k);
    const double twist = q(3, k) - torsion_by_lateral_ * u[2];
    sum += 0.5 * torsion_ * twist * twist;
  }
  return sum;
}

}  // namespace latsch::ring_tire
