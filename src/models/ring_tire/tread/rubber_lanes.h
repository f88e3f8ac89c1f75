// SPDX-License-Identifier: Apache-2.0
// Contact of block cells, eight blocks at a time, with linear rubber or that of rubber_law.h.
#if defined(LATSCH_RING_RUBBER_LANES) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_RING_RUBBER_LANES
#undef LATSCH_RING_RUBBER_LANES
#else
#define LATSCH_RING_RUBBER_LANES
#endif

#include "models/ring_tire/tread/block_forces.h"
#include "models/ring_tire/tread/rubber_law.h"
#include "numerics/kernels/kernel_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// Contact of a block's cell with the road. Its depth runs linearly from δ - g at one end to δ + g
/// at the other. Members are the share λ of it that touches, and the means over ξ = -1 .. 1 of (δ +
/// g ξ)_+ and of ξ (δ + g ξ)_+, or of the rubber's function of (δ + g ξ)_+. The means have a
/// continuous slope in δ and g, and the share is continuous, so nothing jumps when blocks touch or
/// leave.
struct Touch {
  Lanes share, depth, moment;
  Lanes slope;           // derivative of `depth` by δ
  Lanes deepest, range;  // deepest end; difference of the ends
};

/// `on` is the share if a block is pressed, else 0.
struct LinearRubber {
  LATSCH_INLINE explicit LinearRubber(double) {}

  LATSCH_INLINE Touch touch(const Lanes& depth, const Lanes& g) const {
    const Lanes a = larger(larger(g, -g), all(1e-12));
    const Lanes over = 0.5 / a;  // equal for all lines of a station on level ground
    const Lanes share = larger(smaller((depth + a) * over, all(1.0)), all(0.0));
    const Lanes square = share * share;
    return {share,
            a * square + larger(depth - a, all(0.0)),
            g * square * (1.0 - (2.0 / 3.0) * share),
            share,
            depth + a,
            2.0 * a};
  }
  LATSCH_INLINE static void keep(const Touch&, const BlockResults&, int) {}
  LATSCH_INLINE static Lanes slope(const BlockResults&, int, const Lanes& on) { return on; }
};

/// (38).
struct BottomingRubber {
  double bottom, over_bottom;

  LATSCH_INLINE explicit BottomingRubber(double b) : bottom(b), over_bottom(1.0 / b) {}

  LATSCH_INLINE Touch touch(const Lanes& depth, const Lanes& g) const {
    Touch touch = LinearRubber(bottom).touch(depth, g);
    const Lanes middle = depth * over_bottom, end = g * (kGauss * over_bottom);
    const Lanes fore = middle + end, aft = middle - end;
    if (!any(larger(fore, aft) > 0.0)) return touch;
    const Lanes left_fore = 1.0 - within(fore), left_aft = 1.0 - within(aft);
    const Lanes over_both = 1.0 / (left_fore * left_aft);
    const Beyond a = beyond(fore, left_aft * over_both), b = beyond(aft, left_fore * over_both);
    touch.depth += (0.5 * bottom) * (a.force + b.force);
    touch.moment += (0.5 * kGauss * bottom) * (a.force - b.force);
    touch.slope += 0.5 * (a.slope + b.slope);
    return touch;
  }
  LATSCH_INLINE static void keep(const Touch& touch, const BlockResults& results, int block) {
    store(touch.slope, results.slope + block);
  }
  LATSCH_INLINE static Lanes slope(const BlockResults& results, int block, const Lanes& on) {
    return select(on > 0.0, lanes(results.slope + block), all(0.0));
  }

 private:
  LATSCH_INLINE static Lanes within(const Lanes& x) {
    return larger(smaller(x, all(kLinearFrom)), all(0.0));
  }
  /// Returns BeyondLinear at δ over b, with r = 1/λ.
  struct Beyond {
    Lanes force, slope;
  };
  LATSCH_INLINE static Beyond beyond(const Lanes& depth, const Lanes& r) {
    const Lanes x = within(depth), square = r * r;
    const Lanes slope = (2.0 / 3.0) * (square * r - 1.0);
    const Lanes over = larger(depth, all(kLinearFrom)) - kLinearFrom;
    return {x * x * (1.0 - (2.0 / 3.0) * x) * square + slope * over, slope};
  }
};

}  // namespace latsch::ring_tire::LATSCH_KERNELS
#endif
