// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/ply_coupling.h"

#include <cmath>

#include "models/ring_tire/belt/bend_forms.h"

namespace latsch::ring_tire {
namespace {

int around(int node, int nodes) {
  return node < 0 ? node + nodes : node < nodes ? node : node - nodes;
}

}  // namespace

void add_ply_force(const BeltLaw& law, const RimRows& at, const RimRows* rate, RimRows& force) {
  const int N = at.nodes();
  const double tau = law.damping_time;
  double* const to[4] = {force.row(RimRows::kX),
                         force.row(RimRows::kY),
                         force.row(RimRows::kZ),
                         force.row(RimRows::kTorsion)};
  for (const BendPlace& place : {BendPlace::at_knot(law), BendPlace::middle(law)}) {
    const double stiffness = place.share * law.D16 / (law.L0 * law.L0);
    for (int k = 0; k < N; ++k) {
      const BendVector z = bend_forms(place.rule, at, k);
      const double shorter = 1.0 / std::hypot(z[kSlopeX], z[kSlopeZ]);
      const double tx = z[kSlopeX] * shorter, tz = z[kSlopeZ] * shorter;
      const double s = z[kBendX] * tz - z[kBendZ] * tx,
                   along = (z[kBendX] * tx + z[kBendZ] * tz) * shorter;
      const double follows = place.tilt_twist * s, turned = place.tilt_twist * z[kSlopeY];
      double bend = s - place.s0, twist = z[kTwist] + z[kSlopeY] * follows;
      if (rate) {  // (30)
        const BendVector v = bend_forms(place.rule, *rate, k);
        const double s_rate =
            (v[kBendX] - along * v[kSlopeX]) * tz - (v[kBendZ] - along * v[kSlopeZ]) * tx;
        bend += tau * s_rate;
        twist += tau * (v[kTwist] + v[kSlopeY] * follows + turned * s_rate);
      }
      const double torque = stiffness * bend, moment = stiffness * twist + torque * turned;
      for (int i = 0; i < 4; ++i) {
        const int node = around(k + i - 1, N);
        const double by_s = moment * (place.rule.second[i] - along * place.rule.slope[i]);
        to[0][node] -= by_s * tz;
        to[1][node] -= torque * follows * place.rule.slope[i];
        to[2][node] += by_s * tx;
        to[3][node] -= torque * place.rule.slope[i];
      }
    }
  }
}

void add_ply_stiffness(const BeltLaw& stress,
                       const BeltLaw& stretch,
                       const RimRows& at,
                       double scale,
                       StiffnessRows& K) {
  const int N = at.nodes();
  for (const BendPlace& place : {BendPlace::at_knot(stretch), BendPlace::middle(stretch)}) {
    const double share = scale * place.share / (stretch.L0 * stretch.L0);
    for (int k = 0; k < N; ++k) {
      const Strains e(place, bend_forms(place.rule, at, k));
      const BendMatrix both = e.bend.slope * e.twist.slope.transpose();
      const BendMatrix sum =
          share * stretch.D16 * (both + both.transpose()) +
          share * stress.D16 *
              ((e.bend.value - place.s0) * e.twist.second + e.twist.value * e.bend.second);
      const int nodes = place.between ? 4 : 3;
      for (int i = 0; i < nodes; ++i)
        for (int j = i; j < nodes; ++j) {
          const Eigen::Matrix4d block = on_nodes(place.rule, sum, i, j);
          for (int entry = 0; entry < StiffnessRows::kEntries; ++entry)
            K.row(j - i, entry)[around(k + i - 1, N)] += block(entry / 4, entry % 4);
        }
    }
  }
}

}  // namespace latsch::ring_tire
