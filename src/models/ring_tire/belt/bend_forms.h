// SPDX-License-Identifier: Apache-2.0
// The strains of (1) and (3) to (5) at one place of the belt, by eight linear forms of its four
// nodes in the rim's axes: with x, z in the plane of the rim, y across it, by s of one a segment
//   x', z', x'', z'', y', y'', ψ', ψ
// What hangs on strains one by one is short in them: for what is needed seldom, beside the
// kernels, which work on eight places at once.
#pragma once

#include <Eigen/Core>

#include "models/ring_tire/belt/belt.h"
#include "models/ring_tire/belt/bend_rule.h"

namespace latsch::ring_tire {

enum BendForm { kSlopeX, kSlopeZ, kBendX, kBendZ, kSlopeY, kBendY, kTwist, kTorsion, kBendForms };
using BendVector = Eigen::Vector<double, kBendForms>;
using BendMatrix = Eigen::Matrix<double, kBendForms, kBendForms>;

/// Where the forms are taken, and of it what belt.h says.
struct BendPlace {
  const BendRule& rule;
  double share, tilt, tilt_twist, s0;  // of Simpson's rule; ζ of (4), of (5) over L0²; s at rest
  bool between;                        // in the middle of a segment, where (1) and (5) are taken

  static BendPlace at_knot(const BeltLaw& law);
  static BendPlace middle(const BeltLaw& law);
};

/// Values of the forms at knot or segment k, of rows of nodes or their rates.
BendVector bend_forms(const BendRule& rule, const RimRows& rows, int k);

/// A strain, its first and its second derivatives by the forms.
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

/// The block of node i with node j, by x, y, z, ψ of each, of a matrix by forms.
Eigen::Matrix4d on_nodes(const BendRule& rule, const BendMatrix& by_form, int i, int j);

}  // namespace latsch::ring_tire
