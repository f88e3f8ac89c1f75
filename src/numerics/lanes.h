// SPDX-License-Identifier: Apache-2.0
// Eight doubles side by side: an element's eight nodes or Gauss points, eight states of a tire; or
// four: the unknowns of a ring's node.
//
// A vector type of the compiler, so that one source serves SSE2, AVX2 and AVX-512: a function
// marked LATSCH_CLONES is compiled for each and the processor's own is chosen when the program
// starts. Helpers it calls must be inlined into it (LATSCH_INLINE) to be compiled for the same
// processor.
#pragma once

#include <cstring>

namespace latsch {

using Lanes = double __attribute__((vector_size(64)));
using Lanes4 = double __attribute__((vector_size(32)));

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && \
    !defined(__SANITIZE_ADDRESS__)
#define LATSCH_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define LATSCH_CLONES
#endif
#define LATSCH_INLINE [[gnu::always_inline]] inline

LATSCH_INLINE Lanes lanes(const double* p) {
  Lanes v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

LATSCH_INLINE Lanes4 lanes4(const double* p) {
  Lanes4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

LATSCH_INLINE Lanes all(double x) { return Lanes{x, x, x, x, x, x, x, x}; }

LATSCH_INLINE void store(const Lanes& v, double* p) { std::memcpy(p, &v, sizeof v); }
LATSCH_INLINE void store(const Lanes4& v, double* p) { std::memcpy(p, &v, sizeof v); }

LATSCH_INLINE double sum(const Lanes& v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

}  // namespace latsch
