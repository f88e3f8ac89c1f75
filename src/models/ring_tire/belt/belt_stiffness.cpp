// SPDX-License-Identifier: Apache-2.0
// Second derivatives of the belt's energy. s = a . (d × c)/|c| of (3) is a product of linear forms
// over a length, so its second derivatives in the slope c and the second derivative d are short:
// with t along c, n = a × t, κ the stiffness, m = κ (s - s_0) and along = d . t/|c|, an element of
// weights g_i of c and b_i of d counts
//   b_i b_j A + g_i g_j B + b_i g_j C + g_i b_j C'                                          (27)
//   A = κ n n',  B = κ along² n n' + m ((along/|c|) (t n' + n t') - (s/|c|²) n n'),
//   C = -κ along n n' - (m/|c|) t n'
// Left out is what vanishes where the belt has neither torsion nor travel across its plane: what
// (4) and (5) have to do with the places in that plane.
#include "models/ring_tire/belt/belt.h"
#include "models/ring_tire/belt/bend_rule.h"

namespace latsch::ring_tire {

/// What the elements of node k carry: the string of segment k, symmetric, and (27) in the middle of
/// the segment and at knot k, EI_o ζ s and EI_o ζ² s² of (4) at both places, GJ times the slope of
/// (5)'s twist by u' and its square.
struct ElementStiffness {
  enum {
    kString = 0,
    kBetween = 6,
    kKnot = 16,
    kTiltBetween = 26,
    kTilt = 28,
    kTwist = 30,
    kRows = 32
  };
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

/// Of (4) and (5) what does not change with the belt's bend.
void BeltForces::add_lateral_stiffness(double scale, StiffnessRows& K) const {
  const double EI = scale * law_.EI_out_of_plane / (law_.L0 * law_.L0 * law_.L0);
  const double GJ = scale * law_.GJ / law_.L0;
  for (int i = 0; i < 4; ++i)
    for (int j = i; j < 4; ++j) {
      Eigen::Matrix4d& block = K.same(j - i);
      block(1, 1) += EI * (kKnotShare * kAtKnot.second[i] * kAtKnot.second[j] +
                           (1.0 - kKnotShare) * kBetween.second[i] * kBetween.second[j]);
      block(3, 3) += GJ * kBetween.slope[i] * kBetween.slope[j];
    }
}

}  // namespace latsch::ring_tire
