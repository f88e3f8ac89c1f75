// SPDX-License-Identifier: Apache-2.0
#include "models/rigid_ring/ring_constants.h"

#include <cmath>
#include <numbers>

namespace latsch::rigid_ring {
namespace {

double stiffness(double inertia, double frequency) {
  const double omega = 2.0 * std::numbers::pi * frequency;
  return inertia * omega * omega;
}

double damping(double zeta, double k, double inertia) {
  return 2.0 * zeta * std::sqrt(k * inertia);
}

}  // namespace

Result<RingConstants> ring_constants(const magic_formula::Parameters& p, double R_l) {
  RingConstants c;
  c.m_b = p.BELT_MASS;
  c.I_xx = p.BELT_IXX;
  c.I_yy = p.BELT_IYY;
  if (!(c.m_b > 0.0 && c.I_xx > 0.0 && c.I_yy > 0.0))
    return Failure{"a rigid ring needs BELT_MASS, BELT_IXX and BELT_IYY above zero"};
  if (!(p.FREQ_LONG > 0.0 && p.FREQ_LAT > 0.0 && p.FREQ_YAW > 0.0 && p.FREQ_WINDUP > 0.0))
    return Failure{"a rigid ring needs FREQ_LONG, FREQ_LAT, FREQ_YAW and FREQ_WINDUP above zero"};
  if (!(p.DAMP_LONG >= 0.0 && p.DAMP_LAT >= 0.0 && p.DAMP_YAW >= 0.0 && p.DAMP_WINDUP >= 0.0 &&
        p.DAMP_RESIDUAL >= 0.0))
    return Failure{
        "a rigid ring needs DAMP_LONG, DAMP_LAT, DAMP_YAW, DAMP_WINDUP and DAMP_RESIDUAL of at "
        "least zero: a negative damping feeds the vibration"};
  c.k_bx = stiffness(c.m_b, p.FREQ_LONG);
  c.k_by = stiffness(c.m_b, p.FREQ_LAT);
  c.k_bgamma = stiffness(c.I_xx, p.FREQ_YAW);
  c.k_btheta = stiffness(c.I_yy, p.FREQ_WINDUP);
  c.c_bx = damping(p.DAMP_LONG, c.k_bx, c.m_b);
  c.c_by = damping(p.DAMP_LAT, c.k_by, c.m_b);
  c.c_bgamma = damping(p.DAMP_YAW, c.k_bgamma, c.I_xx);
  c.c_btheta = damping(p.DAMP_WINDUP, c.k_btheta, c.I_yy);
  const auto residual = [&c](double overall, double of_ring) {
    const double compliance = 1.0 / overall - of_ring;
    // If the ring alone is as soft as the file's whole tire, the residual spring is nearly rigid.
    constexpr double kLeastShare = 0.05;
    const bool left = compliance * overall >= kLeastShare;
    c.too_soft = c.too_soft || !left;
    return left ? 1.0 / compliance : overall / kLeastShare;
  };
  if (!(p.LONGITUDINAL_STIFFNESS > 0.0 && p.LATERAL_STIFFNESS > 0.0 && p.VERTICAL_STIFFNESS > 0.0))
    return Failure{
        "a rigid ring needs LONGITUDINAL_STIFFNESS, LATERAL_STIFFNESS and VERTICAL_STIFFNESS above "
        "zero"};
  c.c_rx = residual(p.LONGITUDINAL_STIFFNESS, 1.0 / c.k_bx + R_l * R_l / c.k_btheta);
  c.c_ry = residual(p.LATERAL_STIFFNESS, 1.0 / c.k_by + R_l * R_l / c.k_bgamma);
  c.c_rz = residual(p.VERTICAL_STIFFNESS, 1.0 / c.k_bx);
  if (p.YAW_STIFFNESS > 0.0) c.c_rpsi = residual(p.YAW_STIFFNESS, 1.0 / c.k_bgamma);
  return c;
}

}  // namespace latsch::rigid_ring
