// SPDX-License-Identifier: Apache-2.0
// The parameters of a Magic Formula tire with their usual names: PCX1, PKY4, FNOMIN ...
//
// One set serves MF 5.2, 6.1 and 6.2; `version` selects the equations. For the meaning of the
// coefficients see docs/magic_formula.md and [Pacejka 2012, Tire and Vehicle Dynamics, 3rd ed.,
// 4.3.2]; [Besselink, Schmeitz, Pacejka 2010, An improved Magic Formula/Swift tyre model that can
// handle inflation pressure changes, Vehicle System Dynamics 48 S1, 337-352]. SI units.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "models/magic_formula/parameter_list.h"

namespace latsch::magic_formula {

inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

enum class Version { mf52, mf61, mf62 };

/// Side of the vehicle for which the coefficients were measured.
enum class MeasuredSide { left, right, symmetric };

/// All numeric parameters: as doubles, or as dual numbers for derivatives (dual_number.h).
template <class K>
struct CoefficientsOf {
#define LATSCH_DECLARE(section, name, value, unit) K name = value;
  LATSCH_MAGIC_FORMULA_PARAMETERS(LATSCH_DECLARE)
#undef LATSCH_DECLARE
};

struct Parameters : CoefficientsOf<double> {
  Version version = Version::mf61;
  MeasuredSide side = MeasuredSide::left;
  /// USE_MODE: the units digit selects the forces (0 vertical only, 1 Fx My, 2 Fy Mx Mz, 3 all
  /// without interaction, 4 all), the tens digit the dynamics (0 steady state, 1 relaxation with
  /// constant, 2 with load- and slip-dependent lengths, 3 and 4 with a belt), the hundreds digit
  /// the contact.
  int use_mode = 14;
  /// The columns of [SHAPE] or [DEFLECTION_LOAD_CURVE] in the file: deflections in ascending order
  /// and forces; empty if the file has none.
  std::vector<double> curve_deflection, curve_force;

  /// Returns false if the coefficients of turn slip are missing, or if the stiffness against spin
  /// (4.99), by which the formula divides, is zero.
  bool turn_slip_known() const { return missing_of_turn_slip().empty(); }
  /// Returns the name of a coefficient that is 0, or too close to 0 for turn slip to be defined;
  /// empty if there is none.
  std::string_view missing_of_turn_slip() const;
};

enum class ParameterUnit {
  one,
  length,
  force,
  angle,
  mass,
  time,
  pressure,
  velocity,
  acceleration,
  stiffness,
  torsional_stiffness,
  damping,
  inertia,
  frequency,
};

/// Describes a parameter: its name, its section in a .tir file, its default and its member of
/// Parameters.
struct ParameterField {
  std::string_view section, name;
  double fallback;
  ParameterUnit unit;
  double Parameters::*member;
};

/// Returns the descriptions of all parameters in the order of a .tir file.
const std::vector<ParameterField>& parameter_fields();
/// Returns the description of the parameter with this name (in capitals), or nullptr if there is
/// none.
const ParameterField* find_parameter(std::string_view name);

}  // namespace latsch::magic_formula
