// SPDX-License-Identifier: Apache-2.0
// Second derivatives of the belt's energy. s = a . (d × c)/|c| of (3) is a product of linear forms
// over a length, so its second derivatives in the slope c and the second derivative d are short:
// with t along c, n = a × t, κ the stiffness, m = κ (s - s_0) and along = d . t/|c|, an element of
// weights g_i of c and b_i of d counts
//   b_i b_j A + g_i g_j B + b_i g_j C + g_i b_j C'                                          (27)
//   A = κ n n',  B = κ along² n n' + m ((along/|c|) (t n' + n t') - (s/|c|²) n n'),
//   C = -κ along n n' - (m/|c|) t n'
#include "models/ring_tire/belt/belt.h"
#include "models/ring_tire/belt/bend_rule.h"

namespace latsch::ring_tire {

/// What the elements of node k carry: the string of segment k, symmetric, and (27) in the middle of
/// the segment and at knot k.
struct ElementStiffness {
  enum { kString = 0, kBetween = 6, kKnot = 16, kRows = 26 };
  enum { kA = 0, kB = 3, kC = 6 };  // xx, xz, zz; the same; xx, xz, zx, zz
  double* row[kRows];
};

}  // namespace latsch::ring_tire

#define LATSCH_KERNELS_IN "models/ring_tire/belt/belt_stiffness_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

void BeltForces::find_stiffness(const RimRows& at, double scale, StiffnessRows& K) const {
  static_assert(ElementStiffness::kRows <= StiffnessRows::kScratch);
  const double* const x[3] = {at.row(RimRows::kX), at.row(RimRows::kY), at.row(RimRows::kZ)};
  ElementStiffness e;
  for (int i = 0; i < ElementStiffness::kRows; ++i) e.row[i] = K.scratch(i);
  double* rows[(CyclicBand::kReach + 1) * StiffnessRows::kEntries];
  for (int j = 0; j <= CyclicBand::kReach; ++j)
    for (int i = 0; i < StiffnessRows::kEntries; ++i)
      rows[j * StiffnessRows::kEntries + i] = K.row(j, static_cast<StiffnessRows::Entry>(i));
  K.start();
  LATSCH_KERNEL(stiffen)(nodes_, law_, scale, x, e);
  LATSCH_KERNEL(gather_stiffness)(nodes_, scale * law_.pressure_width, e, rows);
  add_lateral_stiffness(scale, K);
}

/// (4) and (5) are the same at every node.
void BeltForces::add_lateral_stiffness(double scale, StiffnessRows& K) const {
  using Eigen::Vector4d;
  const auto row = [&](double lateral, double torsion) -> Vector4d {
    return {0.0, lateral, 0.0, torsion};
  };
  const auto add = [&](double stiffness, const auto& row_of) {
    for (int i = 0; i < 4; ++i)
      for (int j = i; j < 4; ++j) K.same(j - i) += stiffness * row_of(i) * row_of(j).transpose();
  };
  const auto curvature = [&](const BendRule& rule, double tilt) {
    return [&rule, &row, tilt, this](int i) {
      return row(rule.second[i] / (law_.L0 * law_.L0), tilt / law_.R * rule.place[i]);
    };
  };
  const double EI = scale * law_.EI_out_of_plane * law_.L0;
  add(kKnotShare * EI, curvature(kAtKnot, law_.tilt));
  add((1.0 - kKnotShare) * EI, curvature(kBetween, law_.tilt_between));
  add(scale * law_.GJ / law_.L0,
      [&](int i) { return row(-kBetween.slope[i] / law_.R, kBetween.slope[i]); });
}

}  // namespace latsch::ring_tire
