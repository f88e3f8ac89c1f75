// SPDX-License-Identifier: Apache-2.0
// Loops over a row, eight numbers at a time.
#if defined(LATSCH_KERNEL_LOOPS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_KERNEL_LOOPS
#undef LATSCH_KERNEL_LOOPS
#else
#define LATSCH_KERNEL_LOOPS
#endif

#include "numerics/kernels/kernel_lanes.h"

namespace latsch::LATSCH_KERNELS {

/// Calls body(i) for i = begin, begin + 8 .. up to the last eight, which may overlap the ones
/// before. So body must assign, not add. At least eight numbers are required.
template <class Body>
LATSCH_INLINE void by_eight(int begin, int end, const Body& body) {
  for (int i = begin; i < end; i += 8) body(i + 8 <= end ? i : end - 8);
}

/// Works as by_eight() in fours, with at least four numbers.
template <class Body>
LATSCH_INLINE void by_four(int size, const Body& body) {
  for (int i = 0; i < size; i += 4) body(i + 4 <= size ? i : size - 4);
}

/// Calls body(T(), i) over i = 0 .. size - 1: T is Lanes for eight at a time, then Lane for the
/// remaining ones.
template <class Body>
LATSCH_INLINE void around(int size, const Body& body) {
  int i = 0;
  for (; i + 8 <= size; i += 8) body(Lanes(), i);
  for (; i < size; ++i) body(Lane(), i);
}

}  // namespace latsch::LATSCH_KERNELS
#endif
