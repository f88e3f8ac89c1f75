// SPDX-License-Identifier: Apache-2.0
// Types that hold several doubles side by side in the registers of the kernel set being compiled:
//
//   Lanes    eight doubles: one register of AVX-512, two of AVX2, four of the baseline
//   Lanes4   four doubles
//   Lane     one double, with the same rules
//
// A product that is directly added or subtracted is fused: a * b + c rounds once, with any compiler
// and options; x = a * b; x + c rounds twice. So every set with a fused multiply-add gives the same
// bits. `a * b + c * d` fuses the first product. The baseline of x86-64 has no fused multiply-add
// and always rounds twice.
//
// A double converts implicitly to equal lanes. Comparisons give masks for select(), any(), every().
// sum() adds in one order: ((0+4) + (2+6)) + ((1+5) + (3+7)). v.at(i) returns one lane, if i is
// known to the compiler or the loop is unrolled; otherwise use store() and read the array. Lanes
// are for registers: data is kept in arrays of doubles and read by lanes(), lanes4().
//
// This file is included once per kernel set, by for_each_kernel_set.h only.
#if defined(LATSCH_KERNEL_LANES) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_KERNEL_LANES
#undef LATSCH_KERNEL_LANES
#else
#define LATSCH_KERNEL_LANES
#endif

#ifndef LATSCH_INLINE
#define LATSCH_INLINE [[gnu::always_inline]] inline
#endif

#include "numerics/kernels/kernel_registers.h"

namespace latsch::LATSCH_KERNELS {

/// Masks and registers of twice the width of T, made of two T each.
template <class T>
struct TwiceMask {
  T lo, hi;
};
template <class T>
struct Twice : Arithmetic<Twice<T>> {
  static constexpr int kWidth = 2 * T::kWidth;
  using Mask = TwiceMask<typename T::Mask>;
  T lo, hi;

  Twice() = default;
  LATSCH_INLINE Twice(double x) : lo(x), hi(x) {}
  LATSCH_INLINE Twice(const Product<Twice>& p) { *this = mul(p.a, p.b); }
  LATSCH_INLINE Twice(const T& lo_, const T& hi_) : lo(lo_), hi(hi_) {}

  LATSCH_INLINE static Twice load(const double* p) { return {T::load(p), T::load(p + T::kWidth)}; }
  LATSCH_INLINE void save(double* p) const {
    lo.save(p);
    hi.save(p + T::kWidth);
  }
  LATSCH_INLINE double at(int i) const { return i < T::kWidth ? lo.at(i) : hi.at(i - T::kWidth); }
  LATSCH_INLINE static Twice add(const Twice& a, const Twice& b) {
    return {T::add(a.lo, b.lo), T::add(a.hi, b.hi)};
  }
  LATSCH_INLINE static Twice sub(const Twice& a, const Twice& b) {
    return {T::sub(a.lo, b.lo), T::sub(a.hi, b.hi)};
  }
  LATSCH_INLINE static Twice mul(const Twice& a, const Twice& b) {
    return {T::mul(a.lo, b.lo), T::mul(a.hi, b.hi)};
  }
  LATSCH_INLINE static Twice div(const Twice& a, const Twice& b) {
    return {T::div(a.lo, b.lo), T::div(a.hi, b.hi)};
  }
  LATSCH_INLINE static Twice mul_add(const Twice& a, const Twice& b, const Twice& c) {
    return {T::mul_add(a.lo, b.lo, c.lo), T::mul_add(a.hi, b.hi, c.hi)};
  }
  LATSCH_INLINE static Twice mul_sub(const Twice& a, const Twice& b, const Twice& c) {
    return {T::mul_sub(a.lo, b.lo, c.lo), T::mul_sub(a.hi, b.hi, c.hi)};
  }
  LATSCH_INLINE static Twice sub_mul(const Twice& c, const Twice& a, const Twice& b) {
    return {T::sub_mul(c.lo, a.lo, b.lo), T::sub_mul(c.hi, a.hi, b.hi)};
  }
  LATSCH_INLINE static Twice root(const Twice& x) { return {T::root(x.lo), T::root(x.hi)}; }
  LATSCH_INLINE static Twice least(const Twice& a, const Twice& b) {
    return {T::least(a.lo, b.lo), T::least(a.hi, b.hi)};
  }
  LATSCH_INLINE static Twice most(const Twice& a, const Twice& b) {
    return {T::most(a.lo, b.lo), T::most(a.hi, b.hi)};
  }
  LATSCH_INLINE static Twice bit_and(const Twice& a, const Twice& b) {
    return {T::bit_and(a.lo, b.lo), T::bit_and(a.hi, b.hi)};
  }
  LATSCH_INLINE static Twice bit_or(const Twice& a, const Twice& b) {
    return {T::bit_or(a.lo, b.lo), T::bit_or(a.hi, b.hi)};
  }
  LATSCH_INLINE static Twice bit_xor(const Twice& a, const Twice& b) {
    return {T::bit_xor(a.lo, b.lo), T::bit_xor(a.hi, b.hi)};
  }
  LATSCH_INLINE static Twice int_add(const Twice& a, const Twice& b) {
    return {T::int_add(a.lo, b.lo), T::int_add(a.hi, b.hi)};
  }
  LATSCH_INLINE static Twice int_sub(const Twice& a, const Twice& b) {
    return {T::int_sub(a.lo, b.lo), T::int_sub(a.hi, b.hi)};
  }
  template <int bits>
  LATSCH_INLINE static Twice shift_left(const Twice& a) {
    return {T::template shift_left<bits>(a.lo), T::template shift_left<bits>(a.hi)};
  }
  template <int bits>
  LATSCH_INLINE static Twice shift_right(const Twice& a) {
    return {T::template shift_right<bits>(a.lo), T::template shift_right<bits>(a.hi)};
  }
  LATSCH_INLINE static Mask less(const Twice& a, const Twice& b) {
    return {T::less(a.lo, b.lo), T::less(a.hi, b.hi)};
  }
  LATSCH_INLINE static Mask less_equal(const Twice& a, const Twice& b) {
    return {T::less_equal(a.lo, b.lo), T::less_equal(a.hi, b.hi)};
  }
  LATSCH_INLINE static Mask equal(const Twice& a, const Twice& b) {
    return {T::equal(a.lo, b.lo), T::equal(a.hi, b.hi)};
  }
  LATSCH_INLINE static Mask negative(const Twice& x) {
    return {T::negative(x.lo), T::negative(x.hi)};
  }
  LATSCH_INLINE static Twice choose(const Mask& m, const Twice& yes, const Twice& no) {
    return {T::choose(m.lo, yes.lo, no.lo), T::choose(m.hi, yes.hi, no.hi)};
  }
};

template <class M>
LATSCH_INLINE TwiceMask<M> operator&(const TwiceMask<M>& a, const TwiceMask<M>& b) {
  return {a.lo & b.lo, a.hi & b.hi};
}
template <class M>
LATSCH_INLINE TwiceMask<M> operator|(const TwiceMask<M>& a, const TwiceMask<M>& b) {
  return {a.lo | b.lo, a.hi | b.hi};
}
template <class M>
LATSCH_INLINE bool any(const TwiceMask<M>& m) {
  return any(m.lo | m.hi);
}
template <class M>
LATSCH_INLINE bool every(const TwiceMask<M>& m) {
  return every(m.lo & m.hi);
}

using Lane = Register1;
#if LATSCH_KERNEL_WIDTH == 8
using Lanes4 = Register4;
using Lanes = Register8;
LATSCH_INLINE Lanes4 low_half(const Lanes& v) {
  return __builtin_shufflevector(v.v, v.v, 0, 1, 2, 3);
}
LATSCH_INLINE Lanes4 high_half(const Lanes& v) {
  return __builtin_shufflevector(v.v, v.v, 4, 5, 6, 7);
}
LATSCH_INLINE Lanes joined(const Lanes4& lo, const Lanes4& hi) {
  return __builtin_shufflevector(lo.v, hi.v, 0, 1, 2, 3, 4, 5, 6, 7);
}
#else
#if LATSCH_KERNEL_WIDTH == 4
using Lanes4 = Register4;
#else
using Lanes4 = Twice<Register2>;
#endif
using Lanes = Twice<Lanes4>;
LATSCH_INLINE Lanes4 low_half(const Lanes& v) { return v.lo; }
LATSCH_INLINE Lanes4 high_half(const Lanes& v) { return v.hi; }
LATSCH_INLINE Lanes joined(const Lanes4& lo, const Lanes4& hi) { return {lo, hi}; }
#endif

LATSCH_INLINE Lanes lanes(const double* p) { return Lanes::load(p); }
LATSCH_INLINE Lanes4 lanes4(const double* p) { return Lanes4::load(p); }
LATSCH_INLINE Lanes all(double x) { return x; }
LATSCH_INLINE void store(const Lanes& v, double* p) { v.save(p); }
LATSCH_INLINE void store(const Lanes4& v, double* p) { v.save(p); }

#if LATSCH_KERNEL_WIDTH == 2
LATSCH_INLINE Lanes4 four(double a, double b, double c, double d) {
  return {Doubles2{a, b}, Doubles2{c, d}};
}
/// Returns the sum of four lanes in the order (x0 + x2) + (x1 + x3).
LATSCH_INLINE double sum_of_four(const Lanes4& x) {
  const Doubles2 two = x.lo.v + x.hi.v;
  return two[0] + two[1];
}
#endif

/// Transposes a four-by-four matrix given by rows.
LATSCH_INLINE void transpose(Lanes4 (&m)[4]) {
#if LATSCH_KERNEL_WIDTH == 2
  const auto quarter = [](const Register2& a, const Register2& b, Register2& c, Register2& d) {
    const Doubles2 low = __builtin_shufflevector(a.v, b.v, 0, 2),
                   high = __builtin_shufflevector(a.v, b.v, 1, 3);
    c = low;
    d = high;
  };
  const Lanes4 a = m[0], b = m[1], c = m[2], d = m[3];
  quarter(a.lo, b.lo, m[0].lo, m[1].lo);
  quarter(c.lo, d.lo, m[0].hi, m[1].hi);
  quarter(a.hi, b.hi, m[2].lo, m[3].lo);
  quarter(c.hi, d.hi, m[2].hi, m[3].hi);
#else
  const auto ab_even = __builtin_shufflevector(m[0].v, m[1].v, 0, 4, 2, 6),
             ab_odd = __builtin_shufflevector(m[0].v, m[1].v, 1, 5, 3, 7),
             cd_even = __builtin_shufflevector(m[2].v, m[3].v, 0, 4, 2, 6),
             cd_odd = __builtin_shufflevector(m[2].v, m[3].v, 1, 5, 3, 7);
  m[0] = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
  m[1] = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
  m[2] = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  m[3] = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
#endif
}

LATSCH_INLINE Lanes
lanes(double a, double b, double c, double d, double e, double f, double g, double h) {
  return joined(four(a, b, c, d), four(e, f, g, h));
}
LATSCH_INLINE double sum(const Lanes4& v) { return sum_of_four(v); }
LATSCH_INLINE double sum(const Lanes& v) { return sum_of_four(low_half(v) + high_half(v)); }

}  // namespace latsch::LATSCH_KERNELS
#endif
