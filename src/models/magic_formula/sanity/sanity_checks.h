// SPDX-License-Identifier: Apache-2.0
// The checks of sanity.h, one function each: a tire and a lattice of points in, the worst violation
// and its description out. The functions know no names of coefficients, except for the factors.
//
// The friction ellipse is in friction_ellipse_check.cpp, the polynomial factors of pressure and
// camber are in polynomial_factors.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "models/magic_formula/coefficient_conditions.h"
#include "models/magic_formula/magic_formula.h"
#include "models/magic_formula/sanity/sanity.h"

namespace latsch::magic_formula {

/// Points of the checks: loads in N, cambers in rad, pressures in Pa, and the largest slips.
struct Lattice {
  std::vector<double> loads, cambers, pressures;
  double alpha, kappa, nominal_pressure, speed;
};

/// Returns a lattice over the range of the data, widened by a factor of 1.5 about its middle.
Lattice lattice_over(const DataRange& range, const Parameters& p);

/// Result of a check: the severity of a violation (0: none) and its description.
struct WorstViolation {
  double severity = 0.0;
  std::string words;

  void worsen(double by, const std::function<std::string()>& in_words) {
    if (!(by > severity)) return;
    severity = by;
    words = in_words();
  }
};

/// A number of the answer, such as the cornering stiffness.
using NumberOfState = double SteadyState::*;

/// Checks that a stiffness keeps its sign and is nowhere 0.
WorstViolation keeps_sign(const Parameters& p,
                          const Lattice& at,
                          NumberOfState stiffness,
                          const char* name);
/// Checks that the friction stays in 0.2 ... 3.
WorstViolation friction_in_bounds(const Parameters& p,
                                  const Lattice& at,
                                  NumberOfState mu,
                                  const char* name);
/// Checks that the friction rises nowhere by more than 1 % above that of a lower load.
WorstViolation friction_falls(const Parameters& p,
                              const Lattice& at,
                              NumberOfState mu,
                              const char* name);
/// Checks the forces of one slip alone up to a locked wheel or 45 degrees, whatever the data: they
/// keep the direction that they have at small slip.
WorstViolation force_keeps_direction(const Parameters& p, const Lattice& at, bool lateral);
/// Checks that the trail at zero slip angle is positive, so that the side force steers back.
WorstViolation trail_is_positive(const Parameters& p, const Lattice& at);
/// Checks the overturning moment against half of the radius as the lever of the load.
WorstViolation overturning_in_bounds(const Parameters& p, const Lattice& at);
/// Checks the side force by camber at zero slip angle over load and angle, and that it points to
/// the side to which the tire leans.
WorstViolation camber_force_in_bounds(const Parameters& p, const Lattice& at);
/// Checks that the forces over all slips at a load form a nearly convex set. It compares the
/// largest force in each direction with the convex hull.
WorstViolation ellipse_is_convex(const Parameters& p, const Lattice& at);
/// Checks that the aligning moment falls beyond its peak and stays small beyond 0.
WorstViolation moment_returns(const Parameters& p, const Lattice& at);

/// A polynomial factor that has to stay positive. It is a function of x = (p - NOMPRES) / NOMPRES,
/// or of gamma.
struct Factor {
  const char* words;
  Condition condition;
  std::vector<const char*> coefficients;
  double (*value)(const Parameters&, double);
};

/// Returns all such factors of the formulas.
const std::vector<Factor>& factors();
/// Checks that a factor is positive over the pressures or cambers.
WorstViolation stays_positive(const Parameters& p, const Lattice& at, const Factor& factor);

}  // namespace latsch::magic_formula
