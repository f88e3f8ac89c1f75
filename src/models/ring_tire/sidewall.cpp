// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/sidewall.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace latsch::ring_tire {

using Eigen::Matrix3d;
using Eigen::Vector3d;

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
  u_ = Eigen::Matrix3Xd::Zero(3, nodes);
  maxwell_ = Eigen::Matrix3Xd::Zero(3, nodes);
  slip_ = Eigen::Matrix<double, kFrictions, Eigen::Dynamic>::Zero(kFrictions, nodes);
}

Vector3d SidewallForces::travel(const NodeValues& q, const RimFrame& rim, int k) const {
  const Vector3d x = q.col(k).head<3>() - rim.center;
  return {angles_.radial(rim, k).dot(x) - R_, angles_.tangential(rim, k).dot(x), rim.a.dot(x)};
}

SidewallForces::Pull SidewallForces::spring(int direction, double u) const {
  const double k = direction_[direction].k;
  if (direction != 0 || progressivity_ == 0.0) return {k * u, k};
  const double up = progressive_travel_;
  return {k * (u + progressivity_ * (u - up * std::atan(u / up))),
          k * (1.0 + progressivity_ * u * u / (u * u + up * up))};  // (7)
}

double SidewallForces::maxwell_travel(int k, int direction, double u, const StepRule& rule) const {
  if (rule.statics()) return 0.0;
  const double half = rule.step / (2.0 * tau_);
  return ((1.0 - half) * maxwell_(direction, k) + u - u_(direction, k)) / (1.0 + half);
}

double SidewallForces::friction_travel(int k, int element, double u) const {
  const Friction& f = friction_[element];
  if (f.k == 0.0) return 0.0;
  const double most = f.limit / f.k;
  return std::clamp(slip_(element, k) + u - u_(f.direction, k), -most, most);  // (8)
}

SidewallForces::Pull SidewallForces::memory_pull(int k,
                                                 int direction,
                                                 double u,
                                                 const StepRule& rule) const {
  Pull pull{0.0, 0.0};
  if (const double kM = direction_[direction].k_maxwell; kM > 0.0 && !rule.statics()) {
    pull.force += kM * maxwell_travel(k, direction, u, rule);
    pull.slope += kM / (1.0 + rule.step / (2.0 * tau_));
  }
  for (int i = 0; i < kFrictions; ++i) {
    if (friction_[i].direction != direction || friction_[i].k == 0.0) continue;
    const double stretch = friction_travel(k, i, u);
    pull.force += friction_[i].k * stretch;
    if (std::abs(stretch) * friction_[i].k < friction_[i].limit) pull.slope += friction_[i].k;
  }
  return pull;
}

void SidewallForces::add_force(const NodeValues& q,
                               const NodeValues& v,
                               const RimFrame& rim,
                               const StepRule& rule,
                               NodeValues& force) const {
  for (int k = 0; k < angles_.nodes(); ++k) {
    const Vector3d er = angles_.radial(rim, k), et = angles_.tangential(rim, k);
    const Vector3d u = travel(q, rim, k);
    Vector3d F;
    for (int i = 0; i < 3; ++i) F[i] = -spring(i, u[i]).force;
    if (has_memory_)
      for (int i = 0; i < 3; ++i) F[i] -= memory_pull(k, i, u[i], rule).force;
    const double torsion = torsion_ * (q(3, k) - torsion_by_lateral_ * u[2]);  // (9)
    F[2] += torsion_by_lateral_ * torsion;
    force(3, k) -= torsion;
    if (!rule.statics()) {
      const Vector3d w = v.col(k).head<3>() - rim.velocity_at(q.col(k).head<3>());
      F[0] -= direction_[0].d * er.dot(w);
      F[1] -= direction_[1].d * et.dot(w);
      F[2] -= direction_[2].d * rim.a.dot(w);
      force(3, k) -= torsion_damping_ * v(3, k);
    }
    force.col(k).head<3>() += F[0] * er + F[1] * et + F[2] * rim.a;
  }
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
      slope[i] = spring(i, u[i]).slope + direction_[i].d * rule.velocity;
      if (has_memory_) slope[i] += memory_pull(k, i, u[i], rule).slope;
    }
    slope *= scale;
    const double torsion = scale * torsion_, lambda = torsion_by_lateral_;
    auto& block = K.block(k, 0);
    block.topLeftCorner<3, 3>() +=
        slope[0] * er * er.transpose() + slope[1] * et * et.transpose() +
        (slope[2] + torsion * lambda * lambda) * rim.a * rim.a.transpose();
    block.block<3, 1>(0, 3) -= torsion * lambda * rim.a;
    block.block<1, 3>(3, 0) -= torsion * lambda * rim.a.transpose();
    block(3, 3) += torsion + scale * torsion_damping_ * rule.velocity;
  }
}

void SidewallForces::commit(const NodeValues& q, const RimFrame& rim, const StepRule& rule) {
  for (int k = 0; k < angles_.nodes(); ++k) {
    const Vector3d u = travel(q, rim, k);
    if (has_memory_) {
      for (int i = 0; i < 3; ++i) maxwell_(i, k) = maxwell_travel(k, i, u[i], rule);
      for (int i = 0; i < kFrictions; ++i)
        slip_(i, k) = friction_travel(k, i, u[friction_[i].direction]);
    }
    u_.col(k) = u;
  }
}

double SidewallForces::energy(const NodeValues& q, const RimFrame& rim) const {
  double sum = 0.0;
  for (int k = 0; k < angles_.nodes(); ++k) {
    const Vector3d u = travel(q, rim, k);
    for (int i = 0; i < 3; ++i)
      sum += 0.5 * (direction_[i].k * u[i] * u[i] +
                    direction_[i].k_maxwell * maxwell_(i, k) * maxwell_(i, k));
    const double up = progressive_travel_, ratio = u[0] / up;
    if (progressivity_ > 0.0)  // the integral of (7) beyond k u
      sum += direction_[0].k * progressivity_ *
             (0.5 * u[0] * u[0] -
              up * up * (ratio * std::atan(ratio) - 0.5 * std::log1p(ratio * ratio)));
    for (int i = 0; i < kFrictions; ++i) sum += 0.5 * friction_[i].k * slip_(i, k) * slip_(i, k);
    const double twist = q(3, k) - torsion_by_lateral_ * u[2];
    sum += 0.5 * torsion_ * twist * twist;
  }
  return sum;
}

}  // namespace latsch::ring_tire
