// SPDX-License-Identifier: Apache-2.0
// Elementary functions of lanes (kernel_lanes.h) without branches, so that vector units and
// overlapping execution are used. T is Lane, Lanes4 or Lanes; each lane gets the same bits in all
// three.
//
// Accuracy is a few units in the last place. sin_cos holds for |x| <= 1e5 (reduction by pi/2 in two
// parts [Cody, Waite 1980]), exp saturates beyond +-708, power and log accept normal x > 0 (power
// also 0). The series are Taylor series on the reduced interval, long enough for the last bit. The
// series of atan is the Chebyshev interpolant of (atan(sqrt z)/sqrt z - 1)/z on [0, tan^2(pi/8)],
// error 3e-17.
#if defined(LATSCH_KERNEL_MATH) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_KERNEL_MATH
#undef LATSCH_KERNEL_MATH
#else
#define LATSCH_KERNEL_MATH
#endif

#include "numerics/kernels/kernel_lanes.h"

namespace latsch::LATSCH_KERNELS {

/// Returns the number whose bits are `x`.
template <class T>
LATSCH_INLINE T of_bits(std::uint64_t x) {
  return std::bit_cast<double>(x);
}

/// Returns atan(y/x) for x >= 0, not both 0.
template <class T>
LATSCH_INLINE T atan_of_quotient(const T& y, const T& x) {
  // atan is computed by series about 0, 1 and infinity in the ranges |y|/x <= tan(pi/8), up to
  // tan(3 pi/8), and beyond.
  constexpr double kNear = 0.41421356237309503, kFar = 2.414213562373095;
  constexpr double kPi4 = 0.78539816339744831, kPi4Low = 3.061616997868383e-17;
  const T a = abs(y);
  const auto far = a > kFar * x, middle = a > kNear * x;
  const T numerator = select(far, -x, select(middle, a - x, a));
  const T denominator = select(far, a, select(middle, a + x, x));
  const T offset = select(far, T(2.0 * kPi4), select(middle, T(kPi4), T(0.0)));
  const T low = select(far, T(2.0 * kPi4Low), select(middle, T(kPi4Low), T(0.0)));
  const T t = numerator / denominator;
  const T z = t * t, z2 = z * z, z4 = z2 * z2;
  const T p0 = (-0.3333333333333333016 + 0.19999999999995520678 * z) +
               z2 * (-0.14285714284666542922 + 0.11111111015256361727 * z);
  const T p1 = (-0.090909045781239018905 + 0.076921831908260865637 * z) +
               z2 * (-0.066645114473819480001 + 0.058581489128022098816 * z);
  const T p2 =
      (-0.050854497379402598613 + 0.039231658295587191303 * z) + z2 * -0.019176887119062258989;
  const T p = p0 + z4 * (p1 + z4 * p2);
  return with_sign((offset + t) + (low + (t * z) * p), y);
}
template <class T>
LATSCH_INLINE T atan(const T& x) {
  return atan_of_quotient(x, T(1.0));
}

template <class T>
struct SinCos {
  T sin, cos;
};

/// Adding this number to a double rounds it to an integer, which then stands in the low bits of the
/// sum.
inline constexpr double kRounder = 6755399441055744.0;  // 1.5 * 2^52

template <class T>
LATSCH_INLINE SinCos<T> sin_cos(const T& x) {
  // pi/2 is the sum of its first 33 bits, whose product with k is exact, and the remainder.
  constexpr double kHigh = 1.5707963267341256, kLow = 6.077100506506192e-11;
  const T shifted = x * 0.63661977236758134 + kRounder;
  const T k = shifted - kRounder;
  const T r = (x - k * kHigh) - k * kLow;
  const T z = r * r, z2 = z * z, z4 = z2 * z2;
  const T s = ((-1.0 / 6 + z * (1.0 / 120)) + z2 * (-1.0 / 5040 + z * (1.0 / 362880))) +
              z4 * ((-1.0 / 39916800 + z * (1.0 / 6227020800)) + z2 * (-1.0 / 1307674368000));
  const T c = ((1.0 / 24 - z * (1.0 / 720)) + z2 * (1.0 / 40320 - z * (1.0 / 3628800))) +
              z4 * ((1.0 / 479001600 - z * (1.0 / 87178291200)) + z2 * (1.0 / 20922789888000));
  const T sine = r + (r * z) * s;
  const T cosine = (1.0 - 0.5 * z) + z2 * c;
  // The low two bits of `shifted` are the quadrant q. If q is odd, sine and cosine are exchanged;
  // bit 1 of q reverses the sine's sign, bit 1 of q + 1 the cosine's.
  const auto odd = T::negative(T::template shift_left<63>(shifted));
  const T minus(-0.0);
  const T sine_sign = T::bit_and(T::template shift_left<62>(shifted), minus);
  const T cosine_sign =
      T::bit_and(T::template shift_left<62>(T::int_add(shifted, of_bits<T>(1))), minus);
  return {T::bit_xor(select(odd, cosine, sine), sine_sign),
          T::bit_xor(select(odd, sine, cosine), cosine_sign)};
}
template <class T>
LATSCH_INLINE T sin(const T& x) {
  return sin_cos(x).sin;
}
template <class T>
LATSCH_INLINE T cos(const T& x) {
  return sin_cos(x).cos;
}

inline constexpr double kLn2High = 0.6931471804855391, kLn2Low = 7.440617110012397e-11;

template <class T>
LATSCH_INLINE T exp(const T& unbounded) {
  const T x = smaller(larger(unbounded, T(-708.0)), T(708.0));
  const T shifted = x * 1.4426950408889634 + kRounder;
  const T k = shifted - kRounder;
  const T r = (x - k * kLn2High) - k * kLn2Low;
  const T r2 = r * r, r4 = r2 * r2;
  const T p0 = (0.5 + r * (1.0 / 6)) + r2 * (1.0 / 24 + r * (1.0 / 120));
  const T p1 = (1.0 / 720 + r * (1.0 / 5040)) + r2 * (1.0 / 40320 + r * (1.0 / 362880));
  const T p2 =
      (1.0 / 3628800 + r * (1.0 / 39916800)) + r2 * (1.0 / 479001600 + r * (1.0 / 6227020800));
  const T mantissa = 1.0 + (r + r2 * (p0 + r4 * (p1 + r4 * p2)));
  return T::int_add(mantissa, T::template shift_left<52>(shifted));
}

template <class T>
LATSCH_INLINE T log(const T& x) {
  // Reduction x = 2^e m with m in [sqrt(1/2), sqrt 2) and log m = 2 artanh((m - 1)/(m + 1)).
  constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcd, kOne = 0x3ff0000000000000;
  constexpr double kBias = 1023.0;
  // The low bits of `biased` hold e + 1023.
  const T biased = T::template shift_right<52>(T::int_add(x, of_bits<T>(kOne - kRootHalf)));
  const T m = T::int_add(T::int_sub(x, T::template shift_left<52>(biased)), of_bits<T>(kOne));
  const T e = T::int_add(biased, T(kRounder)) - (kRounder + kBias);
  const T s = (m - 1.0) / (m + 1.0);
  const T z = s * s, z2 = z * z, z4 = z2 * z2;
  const T p = ((1.0 / 3 + z * (1.0 / 5)) + z2 * (1.0 / 7 + z * (1.0 / 9))) +
              z4 * (((1.0 / 11 + z * (1.0 / 13)) + z2 * (1.0 / 15 + z * (1.0 / 17))) +
                    z4 * (1.0 / 19 + z * (1.0 / 21)));
  const T twice = s + s;
  return e * kLn2High + (twice + ((twice * z) * p + e * kLn2Low));
}

/// Returns x^y for x >= 0; 0^0 is 1, and 0 to any other power is 0.
template <class T>
LATSCH_INLINE T power(const T& x, double y) {
  const auto zero = x <= 0.0;
  return select(zero, T(y == 0.0 ? 1.0 : 0.0), exp(T(y * log(select(zero, T(1.0), x)))));
}

/// Returns the cube root of normal x > 0, with a step of Newton's method for the last bits.
template <class T>
LATSCH_INLINE T cbrt(const T& x) {
  const T y = exp(T(log(x) * (1.0 / 3.0))), y2 = y * y;
  return y - (y * y2 - x) / (3.0 * y2);
}

// These overloads round a product before they use it as an argument.
template <class T>
LATSCH_INLINE T atan(const Product<T>& x) {
  return atan(T(x));
}
template <class T>
LATSCH_INLINE SinCos<T> sin_cos(const Product<T>& x) {
  return sin_cos(T(x));
}
template <class T>
LATSCH_INLINE T sin(const Product<T>& x) {
  return sin(T(x));
}
template <class T>
LATSCH_INLINE T cos(const Product<T>& x) {
  return cos(T(x));
}
template <class T>
LATSCH_INLINE T exp(const Product<T>& x) {
  return exp(T(x));
}
template <class T>
LATSCH_INLINE T log(const Product<T>& x) {
  return log(T(x));
}

template <class T>
LATSCH_INLINE T cbrt(const Product<T>& x) {
  return cbrt(T(x));
}

}  // namespace latsch::LATSCH_KERNELS
#endif
