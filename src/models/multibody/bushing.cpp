// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/bushing.h"

#include <algorithm>
#include <cmath>

namespace latsch::multibody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct ForceAndMoment {
  Vector3d F, M;
};

ForceAndMoment force_and_moment(const BushingStrain& s, const BushingForces& forces) {
  return {-(s.axes * forces.f.head<3>()), -(s.axes * (s.N.transpose() * forces.f.tail<3>()))};
}

/// Returns force and moment about the origin of a body; `arm` leads from this origin to the point
/// at which they act.
Vector6d about(const Vector3d& arm, const Vector3d& F, const Vector3d& M) {
  Vector6d wrench;
  wrench << F, arm.cross(F) + M;
  return wrench;
}

/// Returns d(N' t)/dq N for constant moments t: one column per component of the angular velocity ω.
Matrix3d turned_moments(const BushingStrain& s, const Vector3d& t) {
  const double s1 = s.s1, c1 = s.c1, c2 = s.c2, t2 = s.t2;
  // N' t = (t_1, s_1 w + c_1 t_2, -c_1 w + s_1 t_2) with w = t_1 tan q_2 - t_3 / cos q_2.
  const double w = t[0] * t2 - t[2] / c2;
  const double by_q2 = (t[0] / c2 - t[2] * t2) / c2;
  Matrix3d by_q = Matrix3d::Zero();
  by_q(1, 0) = c1 * w - s1 * t[1];
  by_q(2, 0) = s1 * w + c1 * t[1];
  by_q(1, 1) = s1 * by_q2;
  by_q(2, 1) = -c1 * by_q2;
  return by_q * s.N;
}

}  // namespace

BushingStrain strain_of(const BushingPlace& place, const Pose& a, const Pose& b) {
  BushingStrain s;
  s.axes = a.turn * place.axes_in_a;
  s.arm_b = b.turn * place.in_b;
  const Vector3d point = b.place + s.arm_b;
  s.arm_a = point - a.place;
  s.d = s.axes.transpose() * (s.arm_a - a.turn * place.in_a);
  const Matrix3d R = s.axes.transpose() * (b.turn * place.axes_in_b);
  const double s2 = std::clamp(R(0, 2), -1.0, 1.0);
  s.q = {std::atan2(-R(1, 2), R(2, 2)), std::asin(s2), std::atan2(-R(0, 1), R(0, 0))};
  s.c2 = std::sqrt(R(0, 0) * R(0, 0) + R(0, 1) * R(0, 1));
  s.t2 = s2 / s.c2;
  s.s1 = -R(1, 2) / s.c2;
  s.c1 = R(2, 2) / s.c2;
  const double s1 = s.s1, c1 = s.c1, c2 = s.c2, t2 = s.t2;
  s.N << 1.0, s1 * t2, -c1 * t2,  //
      0.0, c1, s1,                //
      0.0, -s1 / c2, c1 / c2;
  return s;
}

Vector6d rates_of(const BushingStrain& s, const Vector6d& a, const Vector6d& b) {
  const Vector3d relative = b.tail<3>() - a.tail<3>();
  const Vector3d travel =
      b.head<3>() - s.arm_b.cross(b.tail<3>()) - (a.head<3>() - s.arm_a.cross(a.tail<3>()));
  Vector6d rates;
  rates << s.axes.transpose() * travel, s.N * (s.axes.transpose() * relative);
  return rates;
}

BushingForces spring_forces(const BushingStrain& s, const BushingParameters& p) {
  BushingForces forces;
  forces.slopes << p.stiffness, p.rotational;
  forces.f << p.stiffness.cwiseProduct(s.d), p.rotational.cwiseProduct(s.q);
  return forces;
}

BushingForces forces_in_motion(const BushingStrain& s,
                               const Vector6d& rates,
                               const BushingParameters& p,
                               double rate_share,
                               const PartMemory* memory,
                               double step,
                               PartMemory* kept) {
  BushingForces forces = spring_forces(s, p);
  forces.f.head<3>() += p.damping.cwiseProduct(rates.head<3>());
  forces.f.tail<3>() += p.rotational_damping.cwiseProduct(rates.tail<3>());
  forces.slopes.head<3>() += rate_share * p.damping;
  forces.slopes.tail<3>() += rate_share * p.rotational_damping;
  for (std::size_t i = 0; i < p.parts.size(); ++i) {
    const int axis = p.parts[i].axis;
    const double d = axis < 3 ? s.d[axis] : s.q[axis - 3];
    const PartForce part = respond(p.parts[i].law, d, rates[axis], memory[i], step);
    forces.f[axis] += part.f;
    forces.slopes[axis] += part.by_d + rate_share * part.by_rate;
    if (kept) kept[i] = {part.s, d};
  }
  return forces;
}

BushingWrenches wrenches(const BushingStrain& s, const BushingForces& forces) {
  const auto [F, M] = force_and_moment(s, forces);
  return {-about(s.arm_a, F, M), about(s.arm_b, F, M)};
}

BushingWrenches wrenches(const BushingStrain& s, const BushingParameters& p) {
  return wrenches(s, spring_forces(s, p));
}

/// Returns the tangent. The displacement of b's point against a is δs = δx_b - ρ × δθ_b ... - (δx_a
/// - σ × δθ_a ...) with arms ρ of b and σ of a, and δφ = δθ_b - δθ_a. Then
///   δF = δθ_a × F - K δs,   δM = δθ_a × M - C δφ,   K = A k A',  C = A (N' c N + d(N' c q)/dω) A'
/// Forces act at b's point, so δρ = δθ_b × ρ and δσ = δx_b + δθ_b × ρ - δx_a.
BushingTangent tangent(const BushingStrain& s, const BushingForces& forces) {
  const auto [F, M] = force_and_moment(s, forces);
  const Vector3d k = forces.slopes.head<3>(), c = forces.slopes.tail<3>();
  const Matrix3d K = s.axes * k.asDiagonal() * s.axes.transpose();
  const Vector3d t = forces.f.tail<3>();
  const Matrix3d C =
      s.axes * (s.N.transpose() * c.asDiagonal() * s.N + turned_moments(s, t)) * s.axes.transpose();
  const Matrix3d rho = cross(s.arm_b), sigma = cross(s.arm_a), f = cross(F), m = cross(M);
  // The derivatives of force and moment with respect to displacement and rotation of a body, at b's
  // point, form the block matrix (K, K arm'; 0, C).
  const Matrix3d K_rho = K * rho, K_sigma = K * sigma;
  BushingTangent J;
  J.bb << -K, K_rho, -(rho * K), rho * K_rho - C + f * rho;
  J.ba << K, -K_sigma - f, rho * K, -(rho * (K_sigma + f)) + C - m;
  J.ab << K, -K_rho, sigma * K + f, -(sigma * K_rho) + C - f * rho;
  J.aa << -K, K_sigma + f, -(sigma * K) - f, sigma * (K_sigma + f) - C + m;
  return J;
}

BushingTangent tangent(const BushingStrain& s, const BushingParameters& p) {
  return tangent(s, spring_forces(s, p));
}

double energy(const BushingStrain& s, const BushingParameters& p, const PartMemory* memory) {
  double sum = 0.5 * (p.stiffness.dot(s.d.cwiseAbs2()) + p.rotational.dot(s.q.cwiseAbs2()));
  for (std::size_t i = 0; i < p.parts.size(); ++i) {
    const int axis = p.parts[i].axis;
    sum += stored_energy(
        p.parts[i].law, axis < 3 ? s.d[axis] : s.q[axis - 3], memory ? memory[i] : PartMemory{});
  }
  return sum;
}

}  // namespace latsch::multibody
