// SPDX-License-Identifier: Apache-2.0
// Blocks of a standing tire. Their forces are the gradient of an energy, so that an equilibrium is
// a minimum, which a line search always finds:
//   normal      1/2 c_n times the mean of δ^2 over the cell where δ > 0, and what (37) has beyond
//   tangential  1/2 k |e|^2 up to |F_t| = g, from there on g (|e| - g/(2 k)): the tip slips
// k is c_t times the share of the cell that was on the road one step of the rim before: the part
// that was in the air has no e and holds nothing along the road, because its point of first touch
// is not known. g = μ_adhesion F_n is held while an equilibrium is sought and then updated with the
// resulting F_n (Tresca friction as a step toward Coulomb friction).
#include "models/ring_tire/tread/block_lanes.h"
#include "models/ring_tire/tread/friction_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

template <class Rubber>
struct StandingBlocks {
  Rubber rubber;
  BlockGround ground;
  BlockMemory before;
  BlockLaw law;
  BlockResults results;

  LATSCH_INLINE BeltStation at(const SegmentStations&, int, BeltStation place, BeltStation) const {
    return place;
  }

  template <class Height>
  LATSCH_INLINE Lanes3 force(const BeltStation& s,
                             const Lanes3& half,
                             const Height& H,
                             double y,
                             const BeltBefore&,
                             int block,
                             Lanes3& moment) const {
    const Lanes3 T = at_line(s, H, y);
    const Lanes3 N = lanes3(ground.N, block), tip = lanes3(before.tip, block);
    const Lanes depth = lanes(ground.level + block) - dot(N, T);
    const Touch touch = rubber.touch(depth, -dot(N, half));
    const Lanes Fn = law.normal * touch.depth;  // (11)
    Lanes3 e = {tip.x - T.x, tip.y - T.y, tip.z - T.z};
    const Lanes across = dot(N, e);
    e = {e.x - N.x * across, e.y - N.y * across, e.z - N.z * across};
    const Lanes held = lanes(ground.held + block);
    const Lanes touched = lanes(before.touches + block), k = law.tangential * touched;
    const Lanes trial = k * sqrt(dot(e, e));
    const Lanes holds = select(trial > held, held / larger(trial, all(1e-300)), all(1.0));  // (13)
    const Lanes3 F = {k * holds * e.x, k * holds * e.y, k * holds * e.z};                   // (12)
    // The force is spread over the part that touches now.
    const Lanes gripped = holds * touched / larger(larger(touched, touch.share), all(1e-300));
    e = {gripped * e.x, gripped * e.y, gripped * e.z};
    store3(F, results.F, block);
    store(Fn, results.Fn + block);
    store(gripped, results.gripped + block);
    store3({T.x + depth * N.x + e.x, T.y + depth * N.y + e.y, T.z + depth * N.z + e.z},
           results.tip,
           block);
    store(touch.share, results.share + block);
    rubber.keep(touch, results, block);
    const Lanes push = law.normal * touch.moment;
    moment = {moment.x + push * N.x, moment.y + push * N.y, moment.z + push * N.z};
    return {F.x + Fn * N.x, F.y + Fn * N.y, F.z + Fn * N.z};
  }
};

void standing_forces(const BlockStep& step, const BlockGround& ground) {
  add_block_forces<StandingBlocks>(step, ground);
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
