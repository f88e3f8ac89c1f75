// SPDX-License-Identifier: Apache-2.0
// Blocks of a tire that stands. Their forces are the gradient of an energy, so that an equilibrium
// is a minimum which a line search cannot miss:
//   normal      1/2 c_n δ^2 where δ > 0
//   tangential  1/2 c_t |e|^2 up to |F_t| = g, from there on g (|e| - g/(2 c_t)): the tip gives way
// g = μ_adhesion F_n is held while an equilibrium is sought and then renewed with the F_n found
// (Tresca's friction as a step towards Coulomb's). A block that was in the air one step of the
// rim before has no e and holds nothing along the road: where its tip touched is not known.
#include "models/ring_tire/tread/block_lanes.h"
#include "models/ring_tire/tread/friction_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

struct StandingBlocks {
  BlockGround ground;
  BlockMemory before;
  BlockLaw law;
  BlockResults results;

  LATSCH_INLINE Section at(const SegmentStations&, int, Section place, Section) const {
    return place;
  }

  template <class Height>
  LATSCH_INLINE Lanes3 force(const Section& s, const Height& H, double y, bool, int block) const {
    const Lanes3 T = at_line(s, H, y);
    const Lanes3 N = lanes3(ground.N, block), tip = lanes3(before.tip, block);
    const Lanes depth = lanes(ground.level + block) - dot(N, T);
    const Lanes Fn = law.normal * larger(depth, all(0.0));  // (11)
    Lanes3 e = {tip.x - T.x, tip.y - T.y, tip.z - T.z};
    const Lanes across = dot(N, e);
    e = {e.x - N.x * across, e.y - N.y * across, e.z - N.z * across};
    const Lanes held = lanes(ground.held + block);
    const Lanes trial = law.tangential * sqrt(dot(e, e));
    const Lanes holds = select(trial > held, held / larger(trial, all(1e-300)), all(1.0));  // (13)
    const Lanes gripped = select(lanes(before.touches + block) > 0.5, holds, all(0.0));
    e = {gripped * e.x, gripped * e.y, gripped * e.z};
    const double k = law.tangential;
    const Lanes3 F = {k * e.x, k * e.y, k * e.z};  // (12)
    store3(F, results.F, block);
    store(Fn, results.Fn + block);
    store(gripped, results.gripped + block);
    store3({T.x + depth * N.x + e.x, T.y + depth * N.y + e.y, T.z + depth * N.z + e.z},
           results.tip,
           block);
    return {F.x + Fn * N.x, F.y + Fn * N.y, F.z + Fn * N.z};
  }
};

void standing_forces(const BlockStep& step, const BlockGround& ground) {
  add_block_forces(step, StandingBlocks{ground, step.before, step.law, step.results});
}

void hold_friction(const BlockSpan& at,
                   int count,
                   const BlockGround& ground,
                   const BlockLaw& law,
                   const double* Fn) {
  for (int line = 0; line < count; ++line)
    for (int j = at.begin; j < at.end; j += kWide) {
      const int block = line * at.stride + j;
      const Lanes push = lanes(Fn + block);
      const Lanes mu =
          lanes(ground.friction + block) * adhesion(law.friction->table(), push * law.by_force);
      store(mu * push, ground.held + block);
    }
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
