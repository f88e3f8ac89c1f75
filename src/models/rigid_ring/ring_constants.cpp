// SPDX-License-Identifier: Apache-2.0
#include "models/rigid_ring/ring_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "models/magic_formula/vertical/load_curve.h"

namespace latsch::rigid_ring {
namespace {

double stiffness(double inertia, double frequency) {
  const double omega = 2.0 * std::numbers::pi * frequency;
  return inertia * omega * omega;
}

double damping(double zeta, double k, double inertia) {
  return 2.0 * zeta * std::sqrt(k * inertia);
}

/// Returns the stiffness of the residual spring that completes the file's stiffness, and records
/// the stiffness if the belt does not fit it.
double residual(StiffnessBesideBelt one, double belt_compliance, RingConstants& c) {
  // If the ring alone is as soft as the file's whole tire, the residual spring is nearly rigid.
  constexpr double kLeastShare = 0.05;
  // Belts of tires have 10 to 100 % of the whole tire's compliance.
  constexpr double kStiffBelt = 30.0;
  const double compliance = 1.0 / one.stated - belt_compliance;
  const bool left = compliance * one.stated >= kLeastShare;
  const double spring = left ? 1.0 / compliance : one.stated / kLeastShare;
  one.of_belt = 1.0 / belt_compliance;
  one.made = 1.0 / (belt_compliance + 1.0 / spring);
  if (!left) c.too_soft.push_back(one);
  if (one.of_belt > kStiffBelt * one.stated) c.too_stiff.push_back(one);
  return spring;
}

/// Fails if a tire of these stiffnesses has no state of rest.
Status stands(const magic_formula::Parameters& p, const RingConstants& c) {
  // The belt's displacement and the load are found by iteration. It converges if the tire's
  // steepest stiffness is below this share of the belt's stiffness.
  constexpr double kMostShare = 0.5;
  const double steepest = magic_formula::greatest_stiffness(p);
  if (steepest < kMostShare * c.k_bx) return {};
  return Failure{fmt::format(
      "FREQ_LONG = {:.4g} Hz of BELT_MASS = {:.4g} kg is a belt of {:.4g} N/mm, which cannot stand "
      "on a tire of {:.4g} N/mm ({}); expected at least twice as much: a higher FREQ_LONG",
      p.FREQ_LONG,
      c.m_b,
      1e-3 * c.k_bx,
      1e-3 * steepest,
      magic_formula::has_load_curve(p) ? "the steepest line of [DEFLECTION_LOAD_CURVE]"
                                       : "VERTICAL_STIFFNESS")};
}

std::string in_unit(const StiffnessBesideBelt& one, double value) {
  return one.turns ? fmt::format("{:.4g} N m/rad", value)
                   : fmt::format("{:.4g} N/mm", 1e-3 * value);
}

}  // namespace

std::vector<std::string> contradictions(const RingConstants& ring) {
  std::vector<std::string> sentences;
  for (const StiffnessBesideBelt& one : ring.too_soft)
    sentences.push_back(fmt::format(
        "{} is {}, but the belt of {} alone is as soft as {}: the rigid ring has {} in its place",
        one.stiffness,
        in_unit(one, one.stated),
        one.frequencies,
        in_unit(one, one.of_belt),
        in_unit(one, one.made)));
  for (const StiffnessBesideBelt& one : ring.too_stiff)
    sentences.push_back(
        fmt::format("{} is {}, but the belt of {} is {:.3g} times as stiff, {}: one of them is "
                    "hardly of this tire; is a unit of [UNITS] right?",
                    one.stiffness,
                    in_unit(one, one.stated),
                    one.frequencies,
                    one.of_belt / one.stated,
                    in_unit(one, one.of_belt)));
  return sentences;
}

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
  if (!(p.LONGITUDINAL_STIFFNESS > 0.0 && p.LATERAL_STIFFNESS > 0.0 && p.VERTICAL_STIFFNESS > 0.0))
    return Failure{
        "a rigid ring needs LONGITUDINAL_STIFFNESS, LATERAL_STIFFNESS and VERTICAL_STIFFNESS above "
        "zero"};
  if (const Status status = stands(p, c); !status) return status.failure();
  c.c_rx = residual({"LONGITUDINAL_STIFFNESS",
                     "FREQ_LONG, FREQ_WINDUP, BELT_MASS and BELT_IYY",
                     false,
                     p.LONGITUDINAL_STIFFNESS},
                    1.0 / c.k_bx + R_l * R_l / c.k_btheta,
                    c);
  c.c_ry = residual({"LATERAL_STIFFNESS",
                     "FREQ_LAT, FREQ_YAW, BELT_MASS and BELT_IXX",
                     false,
                     p.LATERAL_STIFFNESS},
                    1.0 / c.k_by + R_l * R_l / c.k_bgamma,
                    c);
  const bool has_curve = magic_formula::has_load_curve(p);
  c.c_rz = residual({has_curve ? "The slope of [DEFLECTION_LOAD_CURVE]" : "VERTICAL_STIFFNESS",
                     "FREQ_LONG and BELT_MASS",
                     false,
                     magic_formula::nominal_stiffness(p)},
                    1.0 / c.k_bx,
                    c);
  if (p.YAW_STIFFNESS > 0.0)
    c.c_rpsi = residual(
        {"YAW_STIFFNESS", "FREQ_YAW and BELT_IXX", true, p.YAW_STIFFNESS}, 1.0 / c.k_bgamma, c);
  return c;
}

}  // namespace latsch::rigid_ring
