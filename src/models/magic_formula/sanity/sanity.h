// SPDX-License-Identifier: Apache-2.0
// Checks whether a Magic Formula tire behaves like a tire beyond the data it was fitted to.
//
// A polynomial that fits the data may behave differently outside of them. The checks use a lattice
// of points over the ranges of the data, widened by a factor of 1.5 about their middle, and ignore
// the limits of the file:
//   cornering stiffness   keeps its sign and is nowhere 0
//   slip stiffness        keeps its sign and is nowhere 0
//   friction              stays in 0.2 ... 3, longitudinally and laterally
//   friction over load    falls or stays: it does not rise by more than 1 % above a lower load
//   friction ellipse      the forces of all slips are convex: in every direction at least 80 % of
//                         their convex hull
//   force at large slip   up to a locked wheel and 45 degrees the force of one slip keeps its
//                         direction, with at least 10 % of its peak
//   trail                 is positive at zero slip angle
//   overturning moment    at most the load at a lever of half the radius
//   camber stiffness      at most six times the load, for each radian, and toward the lean
//   aligning moment       falls beyond its peak, and beyond 0 it stays below half of the peak
//   factors               of pressure and camber polynomials stay positive: no pole, no change
//                         of sign
// The coefficients that cause a failed check are found by trial. Each coefficient is set to a
// neutral value (0 for a coefficient of load, camber or pressure, else a usual value). If that of
// one coefficient alone removes the violation, all such coefficients are possible causes, and the
// three of the most unusual values are reported. If none does, the one that removes most of it is
// reported; then the next one is sought, at most three.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/magic_formula/parameters.h"

namespace latsch::magic_formula {

/// Range of the data, in SI units. The range of angles and slips is symmetric: the larger modulus
/// of both sides.
struct DataRange {
  double Fz_from = 0.0, Fz_to = 0.0;
  double alpha = 0.0, kappa = 0.0;
  double gamma_from = 0.0, gamma_to = 0.0;
  double p_from = 0.0, p_to = 0.0;
};

/// Returns the ranges stated in the file. If the file states none, returns loads of 0.5 to 1.5
/// FNOMIN, slip angles of 12 degrees, slips of 0.2, cambers of +-4 degrees, and pressures of +-15 %
/// about NOMPRES.
DataRange range_of(const Parameters& parameters);

struct SanityFault {
  std::string row;  // name of the check, for example "friction over load"
  // Description of the fault, for example "lateral friction rises with load: 1.1 at 600 N, ...".
  std::string words;
  // Coefficients that cause it: each alone, that of the most unusual value first, or all together,
  // the strongest first; may be empty.
  std::vector<std::string> coefficients;
};

/// Usual values of a coefficient, SI.
struct UsualSpan {
  double lower, upper;
};
/// Returns the usual values of a coefficient by its name; nullopt if none are known.
using UsualOf = std::function<std::optional<UsualSpan>(std::string_view)>;

/// Returns the checks that fail, in the order of the list above. Forces that the tire does not have
/// are not checked. Without `usual`, only coefficients of a check's own formulas are tried.
std::vector<SanityFault> sanity_faults(const Parameters& parameters,
                                       const DataRange& range,
                                       const UsualOf& usual = {});

}  // namespace latsch::magic_formula
