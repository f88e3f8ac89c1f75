// SPDX-License-Identifier: Apache-2.0
// Whether a Magic Formula tire behaves like a tire beyond the data it was fitted to.
//
// A polynomial that is right inside the data may turn outside of it. On a lattice over the ranges,
// 1.5 times as wide about their middle, with the limits of the file taken away:
//   cornering stiffness   keeps its sign and is nowhere 0
//   slip stiffness        the same
//   friction              stays in 0.2 ... 3, lengthwise and sideways
//   friction over load    falls or stays: it does not rise by more than 1 % above a lower load
//   friction ellipse      the forces that all slips reach are convex: in no direction less than
//                         80 % of what their convex hull reaches
//   aligning moment       falls behind its peak, and beyond 0 it stays below half of the peak
//   factors               of pressure and camber polynomials stay positive: no pole, no change
//                         of sign
// A row that fails is put down to coefficients by trial: each suspect is set to its neutral
// value (0 for a coefficient of load, camber or pressure), and the one that heals the row, or
// heals most of it, is named; then the next, three at most.
#pragma once

#include <string>
#include <vector>

#include "models/magic_formula/parameters.h"

namespace latsch::magic_formula {

/// What the data reach, SI. Angles and slips to the larger of both sides.
struct DataRange {
  double Fz_from = 0.0, Fz_to = 0.0;
  double alpha = 0.0, kappa = 0.0;
  double gamma_from = 0.0, gamma_to = 0.0;
  double p_from = 0.0, p_to = 0.0;
};

/// The ranges of the file. Where it has none: loads of 0.5 to 1.5 FNOMIN, 12 degrees of side slip,
/// slips of 0.2, cambers of +-4 degrees, pressures of +-15 % about NOMPRES.
DataRange range_of(const Parameters& parameters);

struct SanityFault {
  std::string row;                        // "friction over load"
  std::string words;                      // "lateral friction rises with load: 1.1 at 600 N, ..."
  std::vector<std::string> coefficients;  // those that do it, the strongest first; may be empty
};

/// The rows that fail, in the order above. None is told of forces that the tire does not have.
std::vector<SanityFault> sanity_faults(const Parameters& parameters, const DataRange& range);

}  // namespace latsch::magic_formula
