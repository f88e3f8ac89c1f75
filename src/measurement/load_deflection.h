// SPDX-License-Identifier: Apache-2.0
// A measured load-deflection curve: vertical force over the displacement of the wheel center toward
// the ground, or over its height above the ground. The pressure and the ground belong to the load
// case, not to the curve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measurement/measurement_fault.h"

namespace latsch {

enum class Abscissa {
  deflection,     // 0 at first contact
  loaded_radius,  // wheel center to ground
};

struct LoadDeflectionCurve {
  Abscissa abscissa = Abscissa::deflection;
  std::vector<double> position;  // m, deflection or loaded radius
  std::vector<double> force;     // N, upward on the wheel
  std::vector<double> spread;    // N, standard deviation of the force; empty: not known

  bool operator==(const LoadDeflectionCurve&) const = default;
};

/// Returns the first fault: no point, columns of unequal length, numbers that are not finite,
/// positions or forces that are not positive (errors are relative to the force), a negative spread,
/// or positions that neither all rise nor all fall.
std::optional<MeasurementFault> find_fault(const LoadDeflectionCurve& curve);

/// Returns a clause that says which statement of a study excludes the faulty rows, to follow the
/// description of the fault: a window above 0 if the first row has no deflection, one direction of
/// motion for a hysteresis loop. Empty for other faults.
std::string way_out_of(const LoadDeflectionCurve& curve, const MeasurementFault& fault);

}  // namespace latsch
