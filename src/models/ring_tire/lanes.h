// SPDX-License-Identifier: Apache-2.0
// Four doubles side by side, the unknowns of a node: a vector type of the compiler, so that one
// source serves every processor. A function marked LATSCH_RING_CLONES is compiled for each
// generation and the processor's own is chosen when the program starts; helpers it calls must be
// inlined into it.
#pragma once

#include <cstring>

namespace latsch::ring_tire {

using Lanes4 = double __attribute__((vector_size(32)));

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && \
    !defined(__SANITIZE_ADDRESS__)
#define LATSCH_RING_CLONES \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define LATSCH_RING_CLONES
#endif
#define LATSCH_RING_INLINE [[gnu::always_inline]] inline

LATSCH_RING_INLINE Lanes4 load(const double* p) {
  Lanes4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

LATSCH_RING_INLINE void store(double* p, const Lanes4& v) { std::memcpy(p, &v, sizeof v); }

}  // namespace latsch::ring_tire
