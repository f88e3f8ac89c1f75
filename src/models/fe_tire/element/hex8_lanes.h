// SPDX-License-Identifier: Apache-2.0
// Number types for several elements at once, one in each lane of a vector register
// (numerics/kernels/kernel_registers.h).
//
// Lanes do not interact: no sum runs across lanes, and no stored value depends on a neighbor.
// Results of an element therefore have the same bits in any lane, beside any other elements, and in
// registers of four or eight lanes. V is one register, not all eight lanes of a batch, because
// tiles of a matrix product are held in registers: the sixteen registers of AVX2 hold a tile of
// three by four.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_HEX8_LANES) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_HEX8_LANES
#undef LATSCH_FE_TIRE_HEX8_LANES
#else
#define LATSCH_FE_TIRE_HEX8_LANES
#endif

#include "numerics/kernels/kernel_floats.h"
#include "numerics/kernels/kernel_registers.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

#if LATSCH_KERNEL_WIDTH == 8
using V = latsch::LATSCH_KERNELS::Register8;
#elif LATSCH_KERNEL_WIDTH == 4
using V = latsch::LATSCH_KERNELS::Register4;
#else
using V = latsch::LATSCH_KERNELS::Register2;
#endif
using Mask = V::Mask;
/// All lanes of a batch in single precision, for results of low accuracy.
using F = latsch::LATSCH_KERNELS::Floats8;
static_assert(F::kWidth == ElementBatch::kLanes);

LATSCH_INLINE V load(const double* p) { return V::load(p); }

/// Rounds the lanes of v to single precision and stores them at p.
LATSCH_INLINE void round(const V& v, float* p) {
#if LATSCH_KERNEL_WIDTH == 8
  _mm256_storeu_ps(p, _mm512_maskz_cvtpd_ps(V::kEvery, v.v));
#elif LATSCH_KERNEL_WIDTH == 4
  _mm_storeu_ps(p, _mm256_cvtpd_ps(v.v));
#else
  for (int lane = 0; lane < V::kWidth; ++lane) p[lane] = static_cast<float>(v.v[lane]);
#endif
}
/// Reads as many floats as a register has lanes and converts them to doubles.
LATSCH_INLINE V widened(const float* p) {
#if LATSCH_KERNEL_WIDTH == 8
  return _mm512_maskz_cvtps_pd(V::kEvery, _mm256_loadu_ps(p));
#elif LATSCH_KERNEL_WIDTH == 4
  return _mm256_cvtps_pd(_mm_loadu_ps(p));
#else
  return latsch::LATSCH_KERNELS::Doubles2{p[0], p[1]};
#endif
}
/// Rounds arrays, or structures that consist of V, and stores them in lanes `first` ... of the
/// corresponding structure of F.
template <class Exact, class Rough>
LATSCH_INLINE void round(const Exact& from, int first, Rough& to) {
  constexpr std::size_t kCount = sizeof(Exact) / sizeof(V);
  static_assert(kCount * sizeof(V) == sizeof(Exact) && kCount * sizeof(F) == sizeof(Rough));
  const V* v = reinterpret_cast<const V*>(&from);
  float* p = reinterpret_cast<float*>(&to) + first;
  for (std::size_t k = 0; k < kCount; ++k) round(v[k], p + k * F::kWidth);
}

/// Returns a mask of bits, one for each lane in which `mask` is true.
LATSCH_INLINE unsigned lanes_of(const Mask& mask) {
  double chosen[V::kWidth];
  select(mask, V(1.0), V(0.0)).save(chosen);
  unsigned bits = 0;
  for (int lane = 0; lane < V::kWidth; ++lane) bits |= (chosen[lane] != 0.0 ? 1u : 0u) << lane;
  return bits;
}

LATSCH_INLINE Mask negated(const Mask& mask) { return select(mask, V(0.0), V(1.0)) > V(0.5); }

LATSCH_INLINE V dot(const V* a, const V* b) { return a[0] * b[0] + (a[1] * b[1] + a[2] * b[2]); }

/// Returns a^(-1/3) for a > 0, within a few units in the last place. The first value, within 4
/// percent, is obtained by dividing the exponent by three. Two steps of order four follow: with y =
/// 1 - a r^3, a^(-1/3) = r (1 - y)^(-1/3).
LATSCH_INLINE V inverse_cube_root(const V& a) {
  // Constant that minimizes the largest error over [1, 8).
  constexpr std::uint64_t kFromWord = 0x553ef00000000000;
  double values[V::kWidth];
  a.save(values);
  for (double& value : values) {
    value = std::bit_cast<double>(kFromWord - std::bit_cast<std::uint64_t>(value) / 3);
  }
  V r = load(values);
  for (int step = 0; step < 2; ++step) {
    const V r2 = r * r, r3 = r2 * r;
    const V y = 1.0 - a * r3;
    const V series = y * (y * (14.0 / 81.0) + 2.0 / 9.0) + 1.0 / 3.0;
    const V ry = r * y;
    r = ry * series + r;
  }
  return r;
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
