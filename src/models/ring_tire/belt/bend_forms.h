// SPDX-License-Identifier: Apache-2.0
// The strains of (1) and (3) to (5) at one point of the belt as functions of eight linear forms of
// its four nodes in the rim's axes. With x, z in the plane of the rim, y lateral, and s from 0 to 1
// in a segment, the forms are
//   x', z', x'', z'', y', y'', ψ', ψ
// With the forms, code for single strains stays short. It runs rarely, unlike the kernels, which
// process eight points at once.
#pragma once

#include <Eigen/Core>

#include "models/ring_tire/belt/belt.h"
#include "models/ring_tire/belt/bend_rule.h"

namespace latsch::ring_tire {

enum BendForm { kSlopeX, kSlopeZ, kBendX, kBendZ, kSlopeY, kBendY, kTwist, kTorsion, kBendForms };
using BendVector = Eigen::Vector<double, kBendForms>;
using BendMatrix = Eigen::Matrix<double, kBendForms, kBendForms>;

/// A point at which the forms are evaluated, and its constants from belt.h.
struct BendPlace {
  const BendRule& rule;
  double share, tilt, tilt_twist, s0;  // Simpson's weight; ζ of (4); ζ of (5) over L0²; s at rest
  bool between;                        // true in the middle of a segment, where (1) and (5) apply

  static BendPlace at_knot(const BeltLaw& law);
  static BendPlace middle(const BeltLaw& law);
};

/// Returns the values of the forms at knot or segment k, from rows of nodes or their rates.
BendVector bend_forms(const BendRule& rule, const RimRows& rows, int k);

/// A strain with its first and second derivatives with respect to the forms.
struct Strain {
  double value;
  BendVector slope;
  BendMatrix second;
};

/// s of (3), u'' - ζ ψ s of (4), ψ' + ζ u' s/L0² of (5), |g_k| of (1).
struct Strains {
  Strain bend, lateral, twist, length;

  Strains(const BendPlace& place, const BendVector& forms);
};

/// Returns the block of node i with node j, each with x, y, z, ψ, of a matrix by forms.
Eigen::Matrix4d on_nodes(const BendRule& rule, const BendMatrix& by_form, int i, int j);

}  // namespace latsch::ring_tire
