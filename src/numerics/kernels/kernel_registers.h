// SPDX-License-Identifier: Apache-2.0
// One register of the kernel set being compiled, and one double by the same rules.
#if defined(LATSCH_KERNEL_REGISTERS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_KERNEL_REGISTERS
#undef LATSCH_KERNEL_REGISTERS
#else
#define LATSCH_KERNEL_REGISTERS
#endif

#include "numerics/kernels/kernel_arithmetic.h"

// Macros for the operations of Arithmetic, one line each.
#define LATSCH_BINARY(name, ...) \
  LATSCH_INLINE static Self name(const Self& x, const Self& y) { return __VA_ARGS__; }
#define LATSCH_FUSED(mul_add_, mul_sub_, sub_mul_)                                 \
  LATSCH_INLINE static Self mul_add(const Self& x, const Self& y, const Self& z) { \
    return mul_add_;                                                               \
  }                                                                                \
  LATSCH_INLINE static Self mul_sub(const Self& x, const Self& y, const Self& z) { \
    return mul_sub_;                                                               \
  }                                                                                \
  LATSCH_INLINE static Self sub_mul(const Self& z, const Self& x, const Self& y) { \
    return sub_mul_;                                                               \
  }
#define LATSCH_COMPARE(name, ...) \
  LATSCH_INLINE static Mask name(const Self& x, const Self& y) { return {__VA_ARGS__}; }

namespace latsch::LATSCH_KERNELS {

/// One double, with the operations of a register.
struct Register1 : Arithmetic<Register1> {
  using Self = Register1;
  using Mask = bool;
  static constexpr int kWidth = 1;
  double v;

  Register1() = default;
  LATSCH_INLINE Register1(double x) : v(x) {}
  LATSCH_INLINE Register1(const Product<Self>& p) : v(p.a.v * p.b.v) {}

  LATSCH_INLINE static Self load(const double* p) { return *p; }
  LATSCH_INLINE void save(double* p) const { *p = v; }
  LATSCH_INLINE double at(int) const { return v; }
  LATSCH_BINARY(add, x.v + y.v)
  LATSCH_BINARY(sub, x.v - y.v)
  LATSCH_BINARY(mul, x.v* y.v)
  LATSCH_BINARY(div, x.v / y.v)
#if LATSCH_KERNEL_WIDTH > 2
  LATSCH_FUSED(__builtin_fma(x.v, y.v, z.v),
               __builtin_fma(x.v, y.v, -z.v),
               __builtin_fma(-x.v, y.v, z.v))
#else
  LATSCH_FUSED(x.v* y.v + z.v, x.v* y.v - z.v, z.v - x.v * y.v)
#endif
  LATSCH_INLINE static Self root(const Self& x) { return __builtin_sqrt(x.v); }
  LATSCH_BINARY(least, x.v < y.v ? x.v : y.v)
  LATSCH_BINARY(most, x.v > y.v ? x.v : y.v)

  // Compiler builtins are used, because operations on the bits of one double would go through
  // integer registers.
  LATSCH_INLINE static Self negated(const Self& x) { return -x.v; }
  LATSCH_INLINE static Self absolute(const Self& x) { return __builtin_fabs(x.v); }
  LATSCH_BINARY(with_sign_of, __builtin_copysign(x.v, y.v))

  LATSCH_INLINE static std::int64_t bits(const Self& x) { return std::bit_cast<std::int64_t>(x.v); }
  LATSCH_INLINE static Self of_bits(std::int64_t x) { return std::bit_cast<double>(x); }
  LATSCH_BINARY(bit_and, of_bits(bits(x) & bits(y)))
  LATSCH_BINARY(bit_or, of_bits(bits(x) | bits(y)))
  LATSCH_BINARY(bit_xor, of_bits(bits(x) ^ bits(y)))
  LATSCH_BINARY(int_add, of_bits(bits(x) + bits(y)))
  LATSCH_BINARY(int_sub, of_bits(bits(x) - bits(y)))
  template <int n>
  LATSCH_INLINE static Self shift_left(const Self& x) {
    return of_bits(static_cast<std::int64_t>(static_cast<std::uint64_t>(bits(x)) << n));
  }
  template <int n>
  LATSCH_INLINE static Self shift_right(const Self& x) {
    return of_bits(static_cast<std::int64_t>(static_cast<std::uint64_t>(bits(x)) >> n));
  }
  LATSCH_COMPARE(less, x.v < y.v)
  LATSCH_COMPARE(less_equal, x.v <= y.v)
  LATSCH_COMPARE(equal, x.v == y.v)
  LATSCH_INLINE static Mask negative(const Self& x) { return bits(x) < 0; }
  LATSCH_INLINE static Self choose(bool m, const Self& yes, const Self& no) {
    return m ? yes.v : no.v;
  }
};
LATSCH_INLINE bool any(bool m) { return m; }
LATSCH_INLINE bool every(bool m) { return m; }

#if LATSCH_KERNEL_WIDTH >= 4

#if LATSCH_KERNEL_WIDTH == 8
struct Mask4 {
  __mmask8 v;
};
LATSCH_INLINE Mask4 operator&(Mask4 a, Mask4 b) { return {static_cast<__mmask8>(a.v & b.v)}; }
LATSCH_INLINE Mask4 operator|(Mask4 a, Mask4 b) { return {static_cast<__mmask8>(a.v | b.v)}; }
LATSCH_INLINE bool any(Mask4 m) { return (m.v & 0xF) != 0; }
LATSCH_INLINE bool every(Mask4 m) { return (m.v & 0xF) == 0xF; }
#else
// The comparison is a builtin of the compiler. If the compiler knows that the mask comes from a
// comparison, select() needs no second comparison with zero.
using Ints4 = std::int64_t __attribute__((vector_size(32)));
struct Mask4 {
  Ints4 v;
};
LATSCH_INLINE Mask4 operator&(const Mask4& a, const Mask4& b) { return {a.v & b.v}; }
LATSCH_INLINE Mask4 operator|(const Mask4& a, const Mask4& b) { return {a.v | b.v}; }
LATSCH_INLINE int signs(const Mask4& m) { return _mm256_movemask_pd((__m256d)m.v); }
LATSCH_INLINE bool any(const Mask4& m) { return signs(m) != 0; }
LATSCH_INLINE bool every(const Mask4& m) { return signs(m) == 0xF; }
#endif

/// Four doubles in a register of AVX2.
struct Register4 : Arithmetic<Register4> {
  using Self = Register4;
  using Mask = Mask4;
  static constexpr int kWidth = 4;
  __m256d v;

  Register4() = default;
  LATSCH_INLINE Register4(__m256d x) : v(x) {}
  LATSCH_INLINE Register4(double x) : v(_mm256_set1_pd(x)) {}
  LATSCH_INLINE Register4(const Product<Self>& p) : v(_mm256_mul_pd(p.a.v, p.b.v)) {}

  LATSCH_INLINE static Self load(const double* p) { return _mm256_loadu_pd(p); }
  LATSCH_INLINE void save(double* p) const { _mm256_storeu_pd(p, v); }
  LATSCH_INLINE double at(int i) const { return v[i]; }
  LATSCH_BINARY(add, _mm256_add_pd(x.v, y.v))
  LATSCH_BINARY(sub, _mm256_sub_pd(x.v, y.v))
  LATSCH_BINARY(mul, _mm256_mul_pd(x.v, y.v))
  LATSCH_BINARY(div, _mm256_div_pd(x.v, y.v))
  LATSCH_FUSED(_mm256_fmadd_pd(x.v, y.v, z.v),
               _mm256_fmsub_pd(x.v, y.v, z.v),
               _mm256_fnmadd_pd(x.v, y.v, z.v))
  LATSCH_INLINE static Self root(const Self& x) { return _mm256_sqrt_pd(x.v); }
  LATSCH_BINARY(least, _mm256_min_pd(x.v, y.v))
  LATSCH_BINARY(most, _mm256_max_pd(x.v, y.v))

  LATSCH_INLINE static __m256i bits(const Self& x) { return _mm256_castpd_si256(x.v); }
  LATSCH_INLINE static Self of_bits(__m256i x) { return _mm256_castsi256_pd(x); }
  LATSCH_BINARY(bit_and, _mm256_and_pd(x.v, y.v))
  LATSCH_BINARY(bit_or, _mm256_or_pd(x.v, y.v))
  LATSCH_BINARY(bit_xor, _mm256_xor_pd(x.v, y.v))
  LATSCH_BINARY(int_add, of_bits(_mm256_add_epi64(bits(x), bits(y))))
  LATSCH_BINARY(int_sub, of_bits(_mm256_sub_epi64(bits(x), bits(y))))
  template <int n>
  LATSCH_INLINE static Self shift_left(const Self& x) {
    return of_bits(_mm256_slli_epi64(bits(x), n));
  }
  template <int n>
  LATSCH_INLINE static Self shift_right(const Self& x) {
    return of_bits(_mm256_srli_epi64(bits(x), n));
  }
#if LATSCH_KERNEL_WIDTH == 8
  LATSCH_COMPARE(less, _mm256_cmp_pd_mask(x.v, y.v, _CMP_LT_OQ))
  LATSCH_COMPARE(less_equal, _mm256_cmp_pd_mask(x.v, y.v, _CMP_LE_OQ))
  LATSCH_COMPARE(equal, _mm256_cmp_pd_mask(x.v, y.v, _CMP_EQ_OQ))
  LATSCH_INLINE static Mask negative(const Self& x) { return {_mm256_movepi64_mask(bits(x))}; }
  LATSCH_INLINE static Self choose(Mask4 m, const Self& yes, const Self& no) {
    return _mm256_mask_blend_pd(m.v, no.v, yes.v);
  }
#else
  LATSCH_COMPARE(less, x.v < y.v)
  LATSCH_COMPARE(less_equal, x.v <= y.v)
  LATSCH_COMPARE(equal, x.v == y.v)
  LATSCH_INLINE static Mask negative(const Self& x) { return {(Ints4)x.v < 0}; }
  LATSCH_INLINE static Self choose(const Mask4& m, const Self& yes, const Self& no) {
    return m.v ? yes.v : no.v;
  }
#endif
};

LATSCH_INLINE Register4 four(double a, double b, double c, double d) {
  return _mm256_set_pd(d, c, b, a);
}
/// Returns the sum of the four doubles in the order (x0 + x2) + (x1 + x3).
LATSCH_INLINE double sum_of_four(const Register4& x) {
  const __m128d two = _mm_add_pd(_mm256_castpd256_pd128(x.v), _mm256_extractf128_pd(x.v, 1));
  return _mm_cvtsd_f64(_mm_add_sd(two, _mm_unpackhi_pd(two, two)));
}
#endif

#if LATSCH_KERNEL_WIDTH == 8

struct Mask8 {
  __mmask8 v;
};
LATSCH_INLINE Mask8 operator&(Mask8 a, Mask8 b) { return {static_cast<__mmask8>(a.v & b.v)}; }
LATSCH_INLINE Mask8 operator|(Mask8 a, Mask8 b) { return {static_cast<__mmask8>(a.v | b.v)}; }
LATSCH_INLINE bool any(Mask8 m) { return m.v != 0; }
LATSCH_INLINE bool every(Mask8 m) { return m.v == 0xFF; }

/// Eight doubles in a register of AVX-512. The intrinsics with masks are used because GCC 12 warns
/// of undefined operands in those without.
struct Register8 : Arithmetic<Register8> {
  using Self = Register8;
  using Mask = Mask8;
  static constexpr int kWidth = 8;
  static constexpr __mmask8 kEvery = 0xFF;
  __m512d v;

  Register8() = default;
  LATSCH_INLINE Register8(__m512d x) : v(x) {}
  LATSCH_INLINE Register8(double x) : v(_mm512_set1_pd(x)) {}
  LATSCH_INLINE Register8(const Product<Self>& p) : v(_mm512_mul_pd(p.a.v, p.b.v)) {}

  LATSCH_INLINE static Self load(const double* p) { return _mm512_loadu_pd(p); }
  LATSCH_INLINE void save(double* p) const { _mm512_storeu_pd(p, v); }
  LATSCH_INLINE double at(int i) const { return v[i]; }
  LATSCH_BINARY(add, _mm512_add_pd(x.v, y.v))
  LATSCH_BINARY(sub, _mm512_sub_pd(x.v, y.v))
  LATSCH_BINARY(mul, _mm512_mul_pd(x.v, y.v))
  LATSCH_BINARY(div, _mm512_div_pd(x.v, y.v))
  LATSCH_FUSED(_mm512_fmadd_pd(x.v, y.v, z.v),
               _mm512_fmsub_pd(x.v, y.v, z.v),
               _mm512_fnmadd_pd(x.v, y.v, z.v))
  LATSCH_INLINE static Self root(const Self& x) { return _mm512_maskz_sqrt_pd(kEvery, x.v); }
  LATSCH_BINARY(least, _mm512_maskz_min_pd(kEvery, x.v, y.v))
  LATSCH_BINARY(most, _mm512_maskz_max_pd(kEvery, x.v, y.v))

  LATSCH_INLINE static __m512i bits(const Self& x) { return _mm512_castpd_si512(x.v); }
  LATSCH_INLINE static Self of_bits(__m512i x) { return _mm512_castsi512_pd(x); }
  LATSCH_BINARY(bit_and, _mm512_and_pd(x.v, y.v))
  LATSCH_BINARY(bit_or, _mm512_or_pd(x.v, y.v))
  LATSCH_BINARY(bit_xor, _mm512_xor_pd(x.v, y.v))
  LATSCH_BINARY(int_add, of_bits(_mm512_add_epi64(bits(x), bits(y))))
  LATSCH_BINARY(int_sub, of_bits(_mm512_sub_epi64(bits(x), bits(y))))
  template <int n>
  LATSCH_INLINE static Self shift_left(const Self& x) {
    return of_bits(_mm512_maskz_slli_epi64(kEvery, bits(x), n));
  }
  template <int n>
  LATSCH_INLINE static Self shift_right(const Self& x) {
    return of_bits(_mm512_maskz_srli_epi64(kEvery, bits(x), n));
  }
  LATSCH_COMPARE(less, _mm512_cmp_pd_mask(x.v, y.v, _CMP_LT_OQ))
  LATSCH_COMPARE(less_equal, _mm512_cmp_pd_mask(x.v, y.v, _CMP_LE_OQ))
  LATSCH_COMPARE(equal, _mm512_cmp_pd_mask(x.v, y.v, _CMP_EQ_OQ))
  LATSCH_INLINE static Mask negative(const Self& x) { return {_mm512_movepi64_mask(bits(x))}; }
  LATSCH_INLINE static Self choose(Mask8 m, const Self& yes, const Self& no) {
    return _mm512_mask_blend_pd(m.v, no.v, yes.v);
  }
};
#endif

#if LATSCH_KERNEL_WIDTH == 2

// Vector types of the compiler: SSE2 on x86-64, NEON on 64-bit ARM.
using Doubles2 = double __attribute__((vector_size(16)));
using Ints2 = std::int64_t __attribute__((vector_size(16)));
using Bits2 = std::uint64_t __attribute__((vector_size(16)));

struct Mask2 {
  Ints2 v;
};
LATSCH_INLINE Mask2 operator&(const Mask2& a, const Mask2& b) { return {a.v & b.v}; }
LATSCH_INLINE Mask2 operator|(const Mask2& a, const Mask2& b) { return {a.v | b.v}; }
LATSCH_INLINE bool any(const Mask2& m) { return (m.v[0] | m.v[1]) != 0; }
LATSCH_INLINE bool every(const Mask2& m) { return (m.v[0] & m.v[1]) != 0; }

/// Two doubles, available on every processor.
struct Register2 : Arithmetic<Register2> {
  using Self = Register2;
  using Mask = Mask2;
  static constexpr int kWidth = 2;
  Doubles2 v;

  Register2() = default;
  LATSCH_INLINE Register2(const Doubles2& x) : v(x) {}
  LATSCH_INLINE Register2(double x) : v{x, x} {}
  LATSCH_INLINE Register2(const Product<Self>& p) : v(p.a.v * p.b.v) {}

  LATSCH_INLINE static Self load(const double* p) {
    Doubles2 x;
    std::memcpy(&x, p, sizeof x);
    return x;
  }
  LATSCH_INLINE void save(double* p) const { std::memcpy(p, &v, sizeof v); }
  LATSCH_INLINE double at(int i) const { return v[i]; }
  LATSCH_BINARY(add, x.v + y.v)
  LATSCH_BINARY(sub, x.v - y.v)
  LATSCH_BINARY(mul, x.v* y.v)
  LATSCH_BINARY(div, x.v / y.v)
  LATSCH_FUSED(x.v* y.v + z.v, x.v* y.v - z.v, z.v - x.v * y.v)
  LATSCH_INLINE static Self root(const Self& x) {
    return Doubles2{__builtin_sqrt(x.v[0]), __builtin_sqrt(x.v[1])};
  }
  LATSCH_BINARY(least, x.v < y.v ? x.v : y.v)
  LATSCH_BINARY(most, x.v > y.v ? x.v : y.v)

  LATSCH_INLINE static Bits2 bits(const Self& x) { return (Bits2)x.v; }
  LATSCH_INLINE static Self of_bits(const Bits2& x) { return (Doubles2)x; }
  LATSCH_BINARY(bit_and, of_bits(bits(x) & bits(y)))
  LATSCH_BINARY(bit_or, of_bits(bits(x) | bits(y)))
  LATSCH_BINARY(bit_xor, of_bits(bits(x) ^ bits(y)))
  LATSCH_BINARY(int_add, of_bits(bits(x) + bits(y)))
  LATSCH_BINARY(int_sub, of_bits(bits(x) - bits(y)))
  template <int n>
  LATSCH_INLINE static Self shift_left(const Self& x) {
    return of_bits(bits(x) << n);
  }
  template <int n>
  LATSCH_INLINE static Self shift_right(const Self& x) {
    return of_bits(bits(x) >> n);
  }
  LATSCH_COMPARE(less, x.v < y.v)
  LATSCH_COMPARE(less_equal, x.v <= y.v)
  LATSCH_COMPARE(equal, x.v == y.v)
  LATSCH_INLINE static Mask negative(const Self& x) { return {(Ints2)x.v < 0}; }
  LATSCH_INLINE static Self choose(const Mask2& m, const Self& yes, const Self& no) {
    return m.v ? yes.v : no.v;
  }
};
#endif

}  // namespace latsch::LATSCH_KERNELS

#undef LATSCH_BINARY
#undef LATSCH_FUSED
#undef LATSCH_COMPARE
#endif
