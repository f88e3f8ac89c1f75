// SPDX-License-Identifier: Apache-2.0
// Eight floats side by side, with the operators of lanes (kernel_lanes.h) but without comparisons.
// They give results of low accuracy with half the instructions and memory of eight doubles. They
// occupy one AVX2 register, also in the AVX-512 set, so that both sets give the same bits, and two
// registers in the baseline set.
//
// This file is included once per kernel set, by for_each_kernel_set.h only.
#if defined(LATSCH_KERNEL_FLOATS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_KERNEL_FLOATS
#undef LATSCH_KERNEL_FLOATS
#else
#define LATSCH_KERNEL_FLOATS
#endif

#include "numerics/kernels/kernel_registers.h"

namespace latsch::LATSCH_KERNELS {

#if LATSCH_KERNEL_WIDTH >= 4

struct Floats8 : Arithmetic<Floats8> {
  using Self = Floats8;
  using Constant = float;
  static constexpr int kWidth = 8;
  __m256 v;

  Floats8() = default;
  LATSCH_INLINE Floats8(__m256 x) : v(x) {}
  LATSCH_INLINE Floats8(float x) : v(_mm256_set1_ps(x)) {}
  LATSCH_INLINE Floats8(double x) : v(_mm256_set1_ps(static_cast<float>(x))) {}
  LATSCH_INLINE Floats8(const Product<Self>& p) : v(_mm256_mul_ps(p.a.v, p.b.v)) {}

  LATSCH_INLINE static Self load(const float* p) { return _mm256_loadu_ps(p); }
  LATSCH_INLINE void save(float* p) const { _mm256_storeu_ps(p, v); }
  LATSCH_INLINE static Self negated(const Self& x) {
    return _mm256_xor_ps(x.v, _mm256_set1_ps(-0.0f));
  }
  LATSCH_INLINE static Self add(const Self& x, const Self& y) { return _mm256_add_ps(x.v, y.v); }
  LATSCH_INLINE static Self sub(const Self& x, const Self& y) { return _mm256_sub_ps(x.v, y.v); }
  LATSCH_INLINE static Self mul(const Self& x, const Self& y) { return _mm256_mul_ps(x.v, y.v); }
  LATSCH_INLINE static Self div(const Self& x, const Self& y) { return _mm256_div_ps(x.v, y.v); }
  LATSCH_INLINE static Self mul_add(const Self& x, const Self& y, const Self& z) {
    return _mm256_fmadd_ps(x.v, y.v, z.v);
  }
  LATSCH_INLINE static Self mul_sub(const Self& x, const Self& y, const Self& z) {
    return _mm256_fmsub_ps(x.v, y.v, z.v);
  }
  LATSCH_INLINE static Self sub_mul(const Self& z, const Self& x, const Self& y) {
    return _mm256_fnmadd_ps(x.v, y.v, z.v);
  }
};

#else

struct Floats8 : Arithmetic<Floats8> {
  using Self = Floats8;
  using Constant = float;
  using Floats4 = float __attribute__((vector_size(16)));
  static constexpr int kWidth = 8;
  Floats4 lo, hi;

  Floats8() = default;
  LATSCH_INLINE Floats8(const Floats4& a, const Floats4& b) : lo(a), hi(b) {}
  LATSCH_INLINE Floats8(float x) : lo{x, x, x, x}, hi(lo) {}
  LATSCH_INLINE Floats8(double x) : Floats8(static_cast<float>(x)) {}
  LATSCH_INLINE Floats8(const Product<Self>& p) : lo(p.a.lo * p.b.lo), hi(p.a.hi * p.b.hi) {}

  LATSCH_INLINE static Self load(const float* p) {
    Self x;
    std::memcpy(&x.lo, p, sizeof x.lo);
    std::memcpy(&x.hi, p + 4, sizeof x.hi);
    return x;
  }
  LATSCH_INLINE void save(float* p) const {
    std::memcpy(p, &lo, sizeof lo);
    std::memcpy(p + 4, &hi, sizeof hi);
  }
  LATSCH_INLINE static Self negated(const Self& x) { return {-x.lo, -x.hi}; }
  LATSCH_INLINE static Self add(const Self& x, const Self& y) { return {x.lo + y.lo, x.hi + y.hi}; }
  LATSCH_INLINE static Self sub(const Self& x, const Self& y) { return {x.lo - y.lo, x.hi - y.hi}; }
  LATSCH_INLINE static Self mul(const Self& x, const Self& y) { return {x.lo * y.lo, x.hi * y.hi}; }
  LATSCH_INLINE static Self div(const Self& x, const Self& y) { return {x.lo / y.lo, x.hi / y.hi}; }
  LATSCH_INLINE static Self mul_add(const Self& x, const Self& y, const Self& z) {
    return {x.lo * y.lo + z.lo, x.hi * y.hi + z.hi};
  }
  LATSCH_INLINE static Self mul_sub(const Self& x, const Self& y, const Self& z) {
    return {x.lo * y.lo - z.lo, x.hi * y.hi - z.hi};
  }
  LATSCH_INLINE static Self sub_mul(const Self& z, const Self& x, const Self& y) {
    return {z.lo - x.lo * y.lo, z.hi - x.hi * y.hi};
  }
};

#endif

}  // namespace latsch::LATSCH_KERNELS
#endif
