// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_sizes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace latsch::formats {
namespace {

using magic_formula::Parameters;

/// Plausible range, SI, of a parameter: from the tire of a bicycle to that of an earthmover.
struct Size {
  std::string_view name;
  const char* unit;
  double from, to;
};

constexpr Size kSizes[] = {{"LONGVL", "m/s", 1.0, 100.0},
                           {"VXLOW", "m/s", 0.0, 20.0},
                           {"UNLOADED_RADIUS", "m", 0.05, 3.0},
                           {"RIM_RADIUS", "m", 0.02, 2.0},
                           {"RIM_WIDTH", "m", 0.01, 2.0},
                           {"WIDTH", "m", 0.01, 2.0},
                           {"ASPECT_RATIO", "", 0.1, 1.5},
                           {"FNOMIN", "N", 10.0, 1e6},
                           {"VERTICAL_STIFFNESS", "N/m", 1e3, 1e8},
                           {"Q_RE0", "", 0.9, 1.1},
                           {"LMUV", "", 0.0, 10.0},
                           {"VERTICAL_DAMPING", "N s/m", 0.0, 1e5},
                           {"BOTTOM_STIFF", "N/m", 1e3, 1e10},
                           {"NOMPRES", "Pa", 2e4, 1.2e6},
                           {"INFLPRES", "Pa", 2e4, 1.2e6},
                           {"MASS", "kg", 0.1, 5e3},
                           {"IXX", "kg m^2", 1e-4, 2e4},
                           {"IYY", "kg m^2", 1e-4, 2e4},
                           {"BELT_MASS", "kg", 0.05, 4e3},
                           {"BELT_IXX", "kg m^2", 1e-4, 2e4},
                           {"BELT_IYY", "kg m^2", 1e-4, 2e4},
                           {"LONGITUDINAL_STIFFNESS", "N/m", 1e3, 1e8},
                           {"LATERAL_STIFFNESS", "N/m", 1e3, 1e8},
                           {"YAW_STIFFNESS", "N m/rad", 1.0, 1e7},
                           {"FREQ_LONG", "Hz", 2.0, 500.0},
                           {"FREQ_LAT", "Hz", 2.0, 500.0},
                           {"FREQ_YAW", "Hz", 2.0, 500.0},
                           {"FREQ_WINDUP", "Hz", 2.0, 500.0},
                           {"DAMP_RESIDUAL", "s", 0.0, 0.1},
                           {"DAMP_VLOW", "s", 0.0, 1.0}};

/// Parameters that are damping ratios, shares of the critical damping.
constexpr std::array<std::string_view, 4> kDampings = {
    "DAMP_LONG", "DAMP_LAT", "DAMP_YAW", "DAMP_WINDUP"};

/// A coefficient at whose value 0 a force is 0 in every state.
struct Factor {
  std::string_view name;
  const char* force;
};
constexpr Factor kFactors[] = {{"PCX1", "longitudinal force"},
                               {"PDX1", "longitudinal force"},
                               {"PKX1", "longitudinal force by slip"},
                               {"PCY1", "side force"},
                               {"PDY1", "side force"},
                               {"PKY1", "side force by slip angle"},
                               {"QCZ1", "pneumatic trail"},
                               {"QDZ1", "pneumatic trail"}};

double value_of(const Parameters& p, std::string_view name) {
  return p.*magic_formula::find_parameter(name)->member;
}

/// Returns the mass, kg, of the cylinder that encloses the tire at a density of 1 kg/m^3; 0 if the
/// file states no width.
double enclosing_cylinder(const Parameters& p) {
  constexpr double kPi = 3.14159265358979;
  return kPi * p.UNLOADED_RADIUS * p.UNLOADED_RADIUS * p.WIDTH;
}

/// Compares masses with the size: per volume of the enclosing cylinder, tires have 30 kg/m^3 (a
/// bicycle's) to 400 (an earthmover's).
void examine_masses(const Parameters& p, const AboutParameter& note) {
  constexpr double kLight = 10.0, kHeavy = 1500.0;  // kg/m^3
  const double volume = enclosing_cylinder(p);
  for (const std::string_view name : {"MASS", "BELT_MASS"}) {
    const double mass = value_of(p, name);
    if (mass <= 0.0 || volume <= 0.0 || (mass >= kLight * volume && mass <= kHeavy * volume))
      continue;
    note(name,
         fmt::format("{} is {:.4g} kg, where a tire of this size has {:.2g} to {:.2g} kg: is a "
                     "unit of [UNITS] right?",
                     name,
                     mass,
                     kLight * volume,
                     kHeavy * volume));
  }
  if (p.MASS > 0.0 && p.BELT_MASS > p.MASS)
    note("BELT_MASS",
         fmt::format("BELT_MASS is {:.4g} kg, but the belt is a part of the tire, whose MASS is "
                     "{:.4g} kg",
                     p.BELT_MASS,
                     p.MASS));
}

/// Compares each moment of inertia with that of the whole mass at the tire's radius, which it
/// cannot exceed.
void examine_inertias(const Parameters& p, const AboutParameter& note) {
  struct Inertia {
    std::string_view name, of;
  };
  constexpr Inertia kInertias[] = {
      {"IXX", "MASS"}, {"IYY", "MASS"}, {"BELT_IXX", "BELT_MASS"}, {"BELT_IYY", "BELT_MASS"}};
  for (const auto& [name, of] : kInertias) {
    const double most =
        value_of(p, of) * (p.UNLOADED_RADIUS * p.UNLOADED_RADIUS + p.WIDTH * p.WIDTH);
    if (most <= 0.0 || value_of(p, name) <= most) continue;
    note(name,
         fmt::format("{} is {:.4g} kg m^2, but {} has at most {:.4g} kg m^2 within "
                     "UNLOADED_RADIUS: is a unit of [UNITS] right?",
                     name,
                     value_of(p, name),
                     of,
                     most));
  }
}

/// Checks coefficients by which the equations of turn slip divide. They matter only if a test uses
/// turn slip.
void examine_turn_slip(const Parameters& p, const AboutParameter& note) {
  if (p.QDRP1 == 0.0 || p.PHYP1 == 0.0 || p.QCRP1 == 0.0) return;
  constexpr double kLeast = 1e-9;  // equal to the limit in Parameters::missing_of_turn_slip()
  if (const std::string_view missing = p.missing_of_turn_slip(); !missing.empty()) {
    note(missing,
         fmt::format("{} is {:.4g}: the equations of turn slip divide by it, so that tests without "
                     "turn slip are not affected, and turn_slip = \"on\" has no effect",
                     missing,
                     value_of(p, missing)));
  } else if (std::abs(p.QDZ10) < kLeast) {
    note("QDZ10",
         fmt::format("QDZ10 is {:.4g}: without camber at FNOMIN the tire has no stiffness against "
                     "spin, by which the equations of turn slip divide (4.100): with turn_slip = "
                     "\"on\" the residual torque there does not fall with the slip angle",
                     p.QDZ10));
  }
  if (p.PHYP2 == 0.0 && p.PHYP3 == 0.0)
    note("PHYP2",
         "PHYP2 is 0: with turn_slip = \"on\" neither spin nor camber shifts the side force");
}

}  // namespace

void examine_sizes(const Parameters& p,
                   const std::function<bool(std::string_view)>& is_given,
                   const AboutParameter& refuse,
                   const AboutParameter& note) {
  if (!(p.LONGVL > 0.0))
    refuse("LONGVL",
           fmt::format("LONGVL is {:g} m/s, expected a positive speed: that of the measurement, to "
                       "which the forces refer",
                       p.LONGVL));
  for (const Size& size : kSizes) {
    const double value = value_of(p, size.name);
    const std::string unit = *size.unit == '\0' ? "" : fmt::format(" {}", size.unit);
    if (value < 0.0)
      refuse(size.name,
             fmt::format("{} is {:g}{}, expected no negative number", size.name, value, unit));
    if ((value == 0.0 && (size.name != "WIDTH" || !is_given("WIDTH"))) ||
        (size.from <= value && value <= size.to))
      continue;
    note(size.name,
         fmt::format("{} is {:.4g}{}, where tires have {:g} to {:g}{}: is a unit of [UNITS] right?",
                     size.name,
                     value,
                     unit,
                     size.from,
                     size.to,
                     unit));
  }
  for (const std::string_view name : kDampings) {
    const double share = value_of(p, name);
    if (share < 0.0)
      refuse(name,
             fmt::format("{} is {:g}: a negative damping feeds the vibration, expected a share of "
                         "the critical damping, 0 to 1",
                         name,
                         share));
    if (share > 1.0)
      note(name,
           fmt::format("{} is {:g}, where tires have 0 to 1, a share of the critical damping: is "
                       "it in percent?",
                       name,
                       share));
  }
  examine_masses(p, note);
  examine_inertias(p, note);
  examine_turn_slip(p, note);
  for (const Factor& factor : kFactors)
    if (is_given(factor.name) && value_of(p, factor.name) == 0.0)
      note(factor.name, fmt::format("{} is 0: the tire has no {}", factor.name, factor.force));
}

}  // namespace latsch::formats
