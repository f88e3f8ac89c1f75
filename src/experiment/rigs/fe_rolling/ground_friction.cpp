// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/ground_friction.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <variant>

namespace latsch::experiment {
namespace {

/// Largest fall of mu p with the sliding speed, in shear moduli of the tread over the speed. Tire B
/// with 60 sectors has one steady state up to 37 of them, whether it is approached from less or
/// from more slip, and two at 73; finer sectors hold less.
constexpr double kStable = 5.0;
/// Contact pressure at which the slope is limited, in inflation pressures: that below a tread is
/// hardly higher but at its edges.
constexpr double kContactPressure = 2.0;

/// Returns the least shear modulus of the solids below the tread's surface, Pa.
double tread_modulus(const fe_tire::FeTire& tire) {
  double least = std::numeric_limits<double>::infinity();
  for (const fe_tire::Element& element : tire.mesh().elements) {
    if (!element.tread) continue;
    const auto& law = tire.materials().solids[element.solid].law;
    if (const auto* rubber = std::get_if<fe_tire::Hyperelastic>(&law)) {
      least = std::min(least, 2.0 * (rubber->C10 + rubber->C01));
    } else {
      const auto& D = std::get<fe_tire::StVenantKirchhoff>(law).D;
      for (int k = 3; k < 6; ++k) least = std::min(least, D(k, k));
    }
  }
  return least;
}

/// Says how friction depends on the pressure, beside its value.
std::string by_pressure(const fe_tire::RollingFriction& law) {
  if (!(law.a > 0.0)) return "";
  return fmt::format(
      " at {:.4g} bar, less by the power {:g} of the pressure,", law.p_0 / 1e5, law.a);
}

std::string by_speed(const fe_tire::RollingFriction& law) {
  if (!law.depends_on_speed()) return "";
  return fmt::format(" at rest and {:.3g} at a sliding speed of {:.3g} m/s",
                     law.peak * law.at_rest,
                     law.peak_speed);
}

/// Says where the law is limited; empty if it is not.
std::string limited(const fe_tire::RollingFriction& law, double speed) {
  if (!(law.line_to > law.line_from)) return "";
  return fmt::format(
      "; at {:.4g} km/h it falls by no more than {:.3g} for each m/s, since a steeper fall lets "
      "the "
      "tread slide in jerks, so between {:.3g} and {:.3g} m/s it is up to {:.2g} above the law of "
      "the file (a lower peak, a higher peak_speed or a wider peak_width falls less steeply)",
      3.6 * speed,
      law.line_fall * law.at_rest,
      law.line_from,
      law.line_to,
      law.most_above() * law.at_rest);
}

}  // namespace

fe_tire::RollingFriction friction_of(const TireRig& rig, std::optional<double> of_test) {
  if (of_test) return {.at_rest = *of_test};
  return rig.own_friction().value_or(fe_tire::RollingFriction{.at_rest = kAssumedFriction});
}

fe_tire::RollingFriction stable_friction(const TireRig& rig,
                                         const fe_tire::RollingFriction& law,
                                         double pressure,
                                         double speed) {
  return friction_by_speed(rig, law, pressure)(speed);
}

std::function<fe_tire::RollingFriction(double speed)> friction_by_speed(
    const TireRig& rig, const fe_tire::RollingFriction& law, double pressure) {
  if (!law.depends_on_speed()) return [law](double) { return law; };
  const double p = kContactPressure * pressure;
  const double fall = kStable * tread_modulus(rig.tire());  // Pa m/s, that of mu p times the speed
  return [law, p, fall](double speed) {
    return law.no_steeper_than(fall / speed / (law.at(p, 0.0) * p));
  };
}

std::string friction_in_words(const TireRig& rig, double pressure, double speed) {
  if (!rig.own_friction())
    return fmt::format(
        "friction {:g} is taken, because neither the test nor the tire's file states one",
        kAssumedFriction);
  const fe_tire::RollingFriction law = stable_friction(rig, *rig.own_friction(), pressure, speed);
  return fmt::format("friction {:g}{}{} is that of the tire's file, because the test states none{}",
                     law.at_rest,
                     by_pressure(law),
                     by_speed(law),
                     limited(law, speed));
}

std::string friction_at_rest_in_words(const TireRig& rig, double of_test) {
  if (!rig.own_friction()) return "";
  const fe_tire::RollingFriction& law = *rig.own_friction();
  if (!(law.a > 0.0) && !law.depends_on_speed()) return "";
  return fmt::format(
      "the tire stands on {}; friction {:g}{}{} of its file is that of tests in which it rolls",
      of_test > 0.0 ? fmt::format("the friction {:g} of the test, whatever the pressure and the "
                                  "sliding speed",
                                  of_test)
                    : std::string("ground without friction, because the test states none"),
      law.at_rest,
      by_pressure(law),
      by_speed(law));
}

}  // namespace latsch::experiment
