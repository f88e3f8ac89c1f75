// SPDX-License-Identifier: Apache-2.0
// Loops over an array, eight numbers at a time.
#if defined(LATSCH_KERNEL_LOOPS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_KERNEL_LOOPS
#undef LATSCH_KERNEL_LOOPS
#else
#define LATSCH_KERNEL_LOOPS
#endif

#include "numerics/kernels/kernel_lanes.h"

namespace latsch::LATSCH_KERNELS {

/// Calls body(i) for blocks of eight numbers that begin at i = begin, begin + 8 and so on. The last
/// block may overlap the one before it, so body must assign its results, not add them to earlier
/// ones. At least eight numbers are required.
template <class Body>
LATSCH_INLINE void by_eight(int begin, int end, const Body& body) {
  for (int i = begin; i < end; i += 8) body(i + 8 <= end ? i : end - 8);
}

/// Works as by_eight() with blocks of four numbers, of which there must be at least one.
template <class Body>
LATSCH_INLINE void by_four(int size, const Body& body) {
  for (int i = 0; i < size; i += 4) body(i + 4 <= size ? i : size - 4);
}

/// Calls body(T(), i) for the numbers i = 0 .. size - 1: T is Lanes for blocks of eight, then Lane
/// for each of the remaining numbers.
template <class Body>
LATSCH_INLINE void around(int size, const Body& body) {
  int i = 0;
  for (; i + 8 <= size; i += 8) body(Lanes(), i);
  for (; i < size; ++i) body(Lane(), i);
}

}  // namespace latsch::LATSCH_KERNELS
#endif
