// SPDX-License-Identifier: Apache-2.0
// Second derivatives of the belt's energy. s = a . (d × c)/|c| of (3) is a product of linear forms
// over a length, so its second derivatives by the slope c and the second derivative d are short.
// With t along c, n = a × t, κ the stiffness, m = κ (s - s_0) and along = d . t/|c|, an element
// with weights g_i of c and b_i of d contributes
//   b_i b_j A + g_i g_j B + b_i g_j C + g_i b_j C'                                          (27)
//   A = κ n n',  B = κ along² n n' + m ((along/|c|) (t n' + n t') - (s/|c|²) n n'),
//   C = -κ along n n' - (m/|c|) t n'
// (4) and (5) add their second and first derivative by s to κ and m. They also couple positions in
// the plane of the rim with torsion and lateral travel: s changes by (b_j - g_j along) n of node j.
#include "models/ring_tire/belt/belt.h"
#include "models/ring_tire/belt/bend_rule.h"
#include "models/ring_tire/belt/ply_coupling.h"

namespace latsch::ring_tire {

/// Elements of node k: the tension of segment k, symmetric; in the middle of the segment and at
/// knot k (27), then for (4) and (5): u'' with ψ, ψ with itself, along, n, and s with u'', ψ and
/// between knots u' and ψ'; for (5) u' with ψ' and with itself.
struct ElementStiffness {
  enum { kString = 0, kBetween = 6, kKnot = 25, kTwist = 42, kRows = 44 };
  enum { kA = 0, kB = 3, kC = 6 };  // xx, xz, zz; xx, xz, zz; xx, xz, zx, zz
  enum { kTilt = 10, kTiltTilt, kAlong, kNx, kNz, kBendS, kTorsionS, kSlopeS, kTwistS };
  double* row[kRows];
};

}  // namespace latsch::ring_tire

#define LATSCH_KERNELS_IN "models/ring_tire/belt/belt_stiffness_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

/// The stress is computed by one law, the stiffness of the strains by another: with (30) that is
/// larger by the part of a strain's rate that depends on the strain at the end of a step.
void BeltForces::find_stiffness(const RimRows& at,
                                double velocity,
                                double scale,
                                StiffnessRows& K) const {
  if (damped() && velocity > 0.0)
    find_by_laws(law_,
                 law_.stiffer(1.0 + law_.extension_damping_time * velocity,
                              1.0 + law_.damping_time * velocity),
                 at,
                 scale,
                 K);
  else
    find_by_laws(law_, law_, at, scale, K);
}

void BeltForces::find_damping(const RimRows& at, double scale, StiffnessRows& C) const {
  find_by_laws(
      law_.slack(), law_.stiffer(law_.extension_damping_time, law_.damping_time), at, scale, C);
}

void BeltForces::find_by_laws(const BeltLaw& stress,
                              const BeltLaw& stretch,
                              const RimRows& at,
                              double scale,
                              StiffnessRows& K) const {
  static_assert(ElementStiffness::kRows <= StiffnessRows::kScratch);
  const double* const x[4] = {
      at.row(RimRows::kX), at.row(RimRows::kY), at.row(RimRows::kZ), at.row(RimRows::kTorsion)};
  ElementStiffness e;
  for (int i = 0; i < ElementStiffness::kRows; ++i) e.row[i] = K.scratch(i);
  double* rows[(CyclicBand::kReach + 1) * StiffnessRows::kEntries];
  for (int j = 0; j <= CyclicBand::kReach; ++j)
    for (int i = 0; i < StiffnessRows::kEntries; ++i)
      rows[j * StiffnessRows::kEntries + i] = K.row(j, i);
  K.start();
  LATSCH_KERNEL(stiffen)(nodes_, stress, stretch, scale, x, e);
  LATSCH_KERNEL(gather_stiffness)(nodes_, scale * stress.pressure_width, e, rows);
  add_lateral_stiffness(stretch, scale, K);
  if (stretch.D16 != 0.0) add_ply_stiffness(stress, stretch, at, scale, K);
}

/// Adds the parts of (4) and (5) that do not change with the belt's bend.
void BeltForces::add_lateral_stiffness(const BeltLaw& law, double scale, StiffnessRows& K) const {
  const double EI = scale * law.EI_out_of_plane / (law.L0 * law.L0 * law.L0);
  const double GJ = scale * law.GJ / law.L0;
  for (int i = 0; i < 4; ++i)
    for (int j = i; j < 4; ++j) {
      Eigen::Matrix4d& block = K.same(j - i);
      block(1, 1) += EI * (kKnotShare * kAtKnot.second[i] * kAtKnot.second[j] +
                           (1.0 - kKnotShare) * kBetween.second[i] * kBetween.second[j]);
      block(3, 3) += GJ * kBetween.slope[i] * kBetween.slope[j];
    }
}

}  // namespace latsch::ring_tire
