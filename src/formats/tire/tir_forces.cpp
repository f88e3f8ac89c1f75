// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_forces.h"

#include <fmt/format.h>

#include <cmath>

#include "models/magic_formula/magic_formula.h"

namespace latsch::formats {
namespace {

using magic_formula::MagicFormula;
using magic_formula::Parameters;
using magic_formula::SteadyState;

SteadyState rolling_straight(const MagicFormula& tire, double load) {
  const Parameters& p = tire.parameters();
  return tire.evaluate({load, 0.0, 0.0, 0.0, 0.0, p.LONGVL, p.NOMPRES});
}

void examine_slopes(const Parameters& p, const SteadyState& s, const AboutParameter& note) {
  if (p.PKY1 != 0.0 && s.Kya > 0.0)
    note("PKY1",
         fmt::format("PKY1 is {:.4g}: the cornering stiffness has the wrong sign, so a slip angle "
                     "pushes the tire on instead of back; PKY1 is negative in a .tir (ISO-W)",
                     p.PKY1));
  if (p.PKX1 != 0.0 && s.Kxk < 0.0)
    note("PKX1",
         fmt::format("PKX1 is {:.4g}: the slip stiffness has the wrong sign, so a braked tire "
                     "drives; PKX1 is positive",
                     p.PKX1));
}

/// Reports friction outside of the limits, which no road gives: 0.02 is wet ice, racing tires reach
/// 2.5.
void examine_friction(const char* peak,
                      const char* scale,
                      double mu,
                      const Parameters& p,
                      const AboutParameter& note) {
  constexpr double kLeast = 0.02, kMost = 5.0;
  const auto value = [&](const char* name) {
    return p.*magic_formula::find_parameter(name)->member;
  };
  // Some programs write a negative peak together with a slope of the usual sign, which gives the
  // same force.
  mu = std::abs(mu);
  if (value(peak) == 0.0 || (mu >= kLeast && mu <= kMost)) return;
  const bool by_scale = value(scale) < kLeast || value(scale) > kMost;
  note(by_scale ? scale : peak,
       fmt::format("{} = {:.4g} with {} = {:.4g} is a friction of {:.4g} at FNOMIN, where tires "
                   "have {:g} to {:g}",
                   peak,
                   value(peak),
                   scale,
                   value(scale),
                   mu,
                   kLeast,
                   kMost));
}

void examine_rolling_radius(const MagicFormula& tire, const AboutParameter& note) {
  constexpr double kRounding = 1e-9;
  constexpr double kSmallest = 0.95;  // times the loaded radius; fitted tires have at least 0.99
  const Parameters& p = tire.parameters();
  for (const double share : {1.0, 0.5, 1.5}) {
    const SteadyState s = rolling_straight(tire, share * p.FNOMIN);
    const double R_omega = s.R_l + s.rho;
    if (!(s.R_l > 0.0) || (s.R_e <= R_omega * (1.0 + kRounding) && s.R_e >= kSmallest * s.R_l))
      continue;
    return note("BREFF",
                fmt::format("BREFF, DREFF and FREFF give an effective rolling radius of {:.4g} mm "
                            "at {:.4g} N, expected one between the loaded radius, {:.4g} mm, and "
                            "the free one, {:.4g} mm",
                            1e3 * s.R_e,
                            share * p.FNOMIN,
                            1e3 * s.R_l,
                            1e3 * R_omega));
  }
}

void examine_patch(const Parameters& p, const SteadyState& s, const AboutParameter& note) {
  constexpr double kLongest = 0.6;  // times the radius; a tire that stands on its rim
  const bool mf52 = p.version == magic_formula::Version::mf52;
  if (!(s.a >= 0.0 && s.a <= kLongest * p.UNLOADED_RADIUS))
    note(mf52 ? "Q_A1" : "Q_RA1",
         fmt::format("{} give a contact patch of {:.4g} mm at FNOMIN, expected less than {:.2g} "
                     "times UNLOADED_RADIUS",
                     mf52 ? "Q_A1 and Q_A2" : "Q_RA1 and Q_RA2",
                     2e3 * s.a,
                     2.0 * kLongest));
  if (!mf52 && p.WIDTH > 0.0 && !(s.b >= 0.0 && s.b <= p.WIDTH))
    note("Q_RB1",
         fmt::format("Q_RB1 and Q_RB2 give a contact patch {:.4g} mm wide at FNOMIN, but WIDTH is "
                     "{:.4g} mm",
                     2e3 * s.b,
                     1e3 * p.WIDTH));
}

}  // namespace

void examine_forces(const Parameters& p, const AboutParameter& note) {
  Parameters unlimited = p;
  unlimited.FZMIN = 0.0;
  unlimited.FZMAX = magic_formula::kUnlimited;
  unlimited.PRESMIN = 0.0;
  unlimited.PRESMAX = magic_formula::kUnlimited;
  unlimited.VXLOW = 0.0;
  const MagicFormula tire(unlimited);
  const SteadyState s = rolling_straight(tire, p.FNOMIN);
  examine_slopes(p, s, note);
  examine_friction("PDX1", "LMUX", s.mux, p, note);
  examine_friction("PDY1", "LMUY", s.muy, p, note);
  examine_rolling_radius(tire, note);
  examine_patch(p, s, note);
}

}  // namespace latsch::formats
