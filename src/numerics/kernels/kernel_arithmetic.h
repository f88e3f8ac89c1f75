// SPDX-License-Identifier: Apache-2.0
// The operators of lanes (kernel_lanes.h), built from the operations of a register.
#if defined(LATSCH_KERNEL_ARITHMETIC) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_KERNEL_ARITHMETIC
#undef LATSCH_KERNEL_ARITHMETIC
#else
#define LATSCH_KERNEL_ARITHMETIC
#endif

#ifndef LATSCH_INLINE
#define LATSCH_INLINE [[gnu::always_inline]] inline
#endif

namespace latsch::LATSCH_KERNELS {

/// The product a * b before rounding, so that a following addition is fused with it.
template <class T>
struct Product {
  T a, b;
};

/// Operations on the sign bits of lanes.
template <class T>
struct SignBits {
  LATSCH_INLINE static T negated(const T& x) { return T::bit_xor(x, T(-0.0)); }
  LATSCH_INLINE static T absolute(const T& x) {
    return T::bit_and(x, T(std::bit_cast<double>(~std::uint64_t{0} >> 1)));
  }
  LATSCH_INLINE static T with_sign_of(const T& x, const T& sign) {
    return T::bit_or(x, T::bit_and(sign, T(-0.0)));
  }
};

/// Operators of T, which must have kWidth, Mask, load, save and the operations named here.
template <class T>
struct Arithmetic : SignBits<T> {
  /// A number that is equal in all lanes.
  using Constant = double;

  LATSCH_INLINE friend Product<T> operator*(const T& a, const T& b) { return {a, b}; }
  LATSCH_INLINE friend T operator/(const T& a, const T& b) { return T::div(a, b); }

  LATSCH_INLINE friend T operator+(const T& a, const T& b) { return T::add(a, b); }
  LATSCH_INLINE friend T operator+(const Product<T>& p, const T& c) {
    return T::mul_add(p.a, p.b, c);
  }
  LATSCH_INLINE friend T operator+(const T& c, const Product<T>& p) {
    return T::mul_add(p.a, p.b, c);
  }
  LATSCH_INLINE friend T operator+(const Product<T>& p, const Product<T>& q) {
    return T::mul_add(p.a, p.b, T::mul(q.a, q.b));
  }

  LATSCH_INLINE friend T operator-(const T& a, const T& b) { return T::sub(a, b); }
  LATSCH_INLINE friend T operator-(const Product<T>& p, const T& c) {
    return T::mul_sub(p.a, p.b, c);
  }
  LATSCH_INLINE friend T operator-(const T& c, const Product<T>& p) {
    return T::sub_mul(c, p.a, p.b);
  }
  LATSCH_INLINE friend T operator-(const Product<T>& p, const Product<T>& q) {
    return T::mul_sub(p.a, p.b, T::mul(q.a, q.b));
  }

  LATSCH_INLINE friend T operator-(const T& a) { return T::negated(a); }
  LATSCH_INLINE friend Product<T> operator-(const Product<T>& p) { return {-p.a, p.b}; }

  LATSCH_INLINE friend T& operator+=(T& c, const T& a) { return c = c + a; }
  LATSCH_INLINE friend T& operator+=(T& c, const Product<T>& p) { return c = c + p; }
  LATSCH_INLINE friend T& operator-=(T& c, const T& a) { return c = c - a; }
  LATSCH_INLINE friend T& operator-=(T& c, const Product<T>& p) { return c = c - p; }
  LATSCH_INLINE friend T& operator*=(T& a, const T& b) { return a = T::mul(a, b); }

  // Comparisons with NaN are false.
  LATSCH_INLINE friend auto operator<(const T& a, const T& b) { return T::less(a, b); }
  LATSCH_INLINE friend auto operator>(const T& a, const T& b) { return T::less(b, a); }
  LATSCH_INLINE friend auto operator<=(const T& a, const T& b) { return T::less_equal(a, b); }
  LATSCH_INLINE friend auto operator>=(const T& a, const T& b) { return T::less_equal(b, a); }
  LATSCH_INLINE friend auto operator==(const T& a, const T& b) { return T::equal(a, b); }

  LATSCH_INLINE friend T sqrt(const T& x) { return T::root(x); }
  /// Returns a < b ? a : b.
  LATSCH_INLINE friend T smaller(const T& a, const T& b) { return T::least(a, b); }
  /// Returns a > b ? a : b.
  LATSCH_INLINE friend T larger(const T& a, const T& b) { return T::most(a, b); }
  LATSCH_INLINE friend T abs(const T& x) { return T::absolute(x); }
  /// Returns |x| with the sign of `sign`, for x >= 0.
  LATSCH_INLINE friend T with_sign(const T& x, const T& sign) { return T::with_sign_of(x, sign); }
  /// Returns the sign of x, -1 or 1. At 0 it is 1 also for -0, because the sum x + 0 drops the sign
  /// of zero.
  LATSCH_INLINE friend T sign_or_one(const T& x) { return with_sign(T(1.0), x + T(0.0)); }
  /// Returns the sign of x: -1, 0 or 1.
  LATSCH_INLINE friend T sign(const T& x) { return T::choose(x == T(0.0), T(0.0), sign_or_one(x)); }
  /// Returns `yes` where the mask is true, and `no` elsewhere.
  template <class Mask>
  LATSCH_INLINE friend T select(const Mask& where, const T& yes, const T& no) {
    return T::choose(where, yes, no);
  }
};

}  // namespace latsch::LATSCH_KERNELS
#endif
