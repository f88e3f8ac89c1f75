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

ForceAndMoment force_and_moment(const BushingStrain& s, const BushingParameters& p) {
  return {-(s.axes * p.stiffness.cwiseProduct(s.d)),
          -(s.axes * (s.N.transpose() * p.rotational.cwiseProduct(s.q)))};
}

/// A wrench about the origin of a body whose arm to the point it acts at is given.
Vector6d about(const Vector3d& arm, const Vector3d& F, const Vector3d& M) {
  Vector6d wrench;
  wrench << F, arm.cross(F) + M;
  return wrench;
}

/// d(N' t)/dq N for moments t that stay, by columns of ω.
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

BushingWrenches wrenches(const BushingStrain& s, const BushingParameters& p) {
  const auto [F, M] = force_and_moment(s, p);
  return {-about(s.arm_a, F, M), about(s.arm_b, F, M)};
}

/// With the travel of b's point against a, δs = δx_b - ρ × δθ_b ... - (δx_a - σ × δθ_a ...), arms ρ
/// of b and σ of a, and δφ = δθ_b - δθ_a
///   δF = δθ_a × F - K δs,   δM = δθ_a × M - C δφ,   K = A k A',  C = A (N' c N + d(N' c q)/dω) A'
/// and as forces act where b's point goes, δρ = δθ_b × ρ and δσ = δx_b + δθ_b × ρ - δx_a.
BushingTangent tangent(const BushingStrain& s, const BushingParameters& p) {
  const auto [F, M] = force_and_moment(s, p);
  const Matrix3d K = s.axes * p.stiffness.asDiagonal() * s.axes.transpose();
  const Vector3d t = p.rotational.cwiseProduct(s.q);
  const Matrix3d C = s.axes *
                     (s.N.transpose() * p.rotational.asDiagonal() * s.N + turned_moments(s, t)) *
                     s.axes.transpose();
  const Matrix3d rho = cross(s.arm_b), sigma = cross(s.arm_a), f = cross(F), m = cross(M);
  // Force and moment by the twist of a body at b's point: (K, K arm'; 0, C).
  const Matrix3d K_rho = K * rho, K_sigma = K * sigma;
  BushingTangent J;
  J.bb << -K, K_rho, -(rho * K), rho * K_rho - C + f * rho;
  J.ba << K, -K_sigma - f, rho * K, -(rho * (K_sigma + f)) + C - m;
  J.ab << K, -K_rho, sigma * K + f, -(sigma * K_rho) + C - f * rho;
  J.aa << -K, K_sigma + f, -(sigma * K) - f, sigma * (K_sigma + f) - C + m;
  return J;
}

double energy(const BushingStrain& s, const BushingParameters& p) {
  return 0.5 * (p.stiffness.dot(s.d.cwiseAbs2()) + p.rotational.dot(s.q.cwiseAbs2()));
}

}  // namespace latsch::multibody
