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
#include "models/ring_tire/belt/rim_rows.h"
#include "models/ring_tire/belt/stiffness_rows.h"

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

void BeltForces::add_stiffness(const NodeValues& q,
                               const RimFrame& rim,
                               double scale,
                               CyclicBand& K) const {
  RimRows at(nodes_);
  at.place(q, rim);
  const double* const x[3] = {at.row(RimRows::kX), at.row(RimRows::kY), at.row(RimRows::kZ)};
  StiffnessRows sums(nodes_, ElementStiffness::kRows);
  ElementStiffness e;
  for (int i = 0; i < ElementStiffness::kRows; ++i) e.row[i] = sums.more(i);
  LATSCH_KERNEL(stiffen)(nodes_, law_, scale, x, e);
  double* rows[4 * StiffnessRows::kEntries];
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < StiffnessRows::kEntries; ++i)
      rows[j * StiffnessRows::kEntries + i] = sums.row(j, static_cast<StiffnessRows::Entry>(i));
  LATSCH_KERNEL(gather_stiffness)(nodes_, scale * law_.pressure_width, e, rows);
  sums.add_to(K, rim);
  add_lateral_stiffness(rim, scale, K);
}

/// (4) and (5) are the same at every node.
void BeltForces::add_lateral_stiffness(const RimFrame& rim, double scale, CyclicBand& K) const {
  using Eigen::Matrix4d, Eigen::Vector4d;
  const auto row = [&](double lateral, double torsion) {
    Vector4d g;
    g << lateral * rim.a, torsion;
    return g;
  };
  Matrix4d of[4] = {Matrix4d::Zero(), Matrix4d::Zero(), Matrix4d::Zero(), Matrix4d::Zero()};
  const auto add = [&](double stiffness, const auto& row_of) {
    for (int i = 0; i < 4; ++i)
      for (int j = i; j < 4; ++j) of[j - i] += stiffness * row_of(i) * row_of(j).transpose();
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
  for (int k = 0; k < nodes_; ++k)
    for (int j = 0; j < 4; ++j) K.block(k, j) += of[j];
}

}  // namespace latsch::ring_tire
