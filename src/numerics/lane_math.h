// SPDX-License-Identifier: Apache-2.0
// Elementary functions for one double or for eight side by side, by the same source, without
// branches: what a vector unit can do and a processor can overlap.
//
// Accuracy: a few units in the last place. sin_cos holds for |x| <= 1e5 (reduction by pi/2 in three
// parts [Cody, Waite 1980]), exp saturates beyond +-708, power and log take x > 0 (power also 0).
// The series are Taylor's on the reduced interval, long enough for the last bit; that of atan is
// the Chebyshev interpolant of (atan(sqrt z)/sqrt z - 1)/z on [0, tan^2(pi/8)], error 3e-17.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "numerics/lanes.h"

namespace latsch::lane_math {

using LaneInts = std::int64_t __attribute__((vector_size(64)));

LATSCH_INLINE std::int64_t bits(double x) { return std::bit_cast<std::int64_t>(x); }
LATSCH_INLINE LaneInts bits(const Lanes& x) { return (LaneInts)x; }
LATSCH_INLINE double from_bits(std::int64_t x) { return std::bit_cast<double>(x); }
LATSCH_INLINE Lanes from_bits(const LaneInts& x) { return (Lanes)x; }

/// The same number in every lane.
template <class R>
LATSCH_INLINE R constant(double x);
template <>
LATSCH_INLINE double constant<double>(double x) {
  return x;
}
template <>
LATSCH_INLINE Lanes constant<Lanes>(double x) {
  return all(x);
}

LATSCH_INLINE double select(bool where, double yes, double no) { return where ? yes : no; }
LATSCH_INLINE Lanes select(const LaneInts& where, const Lanes& yes, const Lanes& no) {
  return where ? yes : no;
}
LATSCH_INLINE bool any(bool where) { return where; }
LATSCH_INLINE bool any(const LaneInts& where) {
  return (where[0] | where[1] | where[2] | where[3] | where[4] | where[5] | where[6] | where[7]) !=
         0;
}

LATSCH_INLINE bool any_positive(const Lanes& x) {
  const Lanes one = x > 0.0 ? all(1.0) : all(0.0);
  const Lanes4 half =
      __builtin_shufflevector(one, one, 0, 1, 2, 3) + __builtin_shufflevector(one, one, 4, 5, 6, 7);
  return half[0] + half[1] + half[2] + half[3] > 0.0;
}

template <class R>
LATSCH_INLINE R abs(const R& x) {
  return from_bits(bits(x) & std::int64_t{0x7fffffffffffffff});
}
/// |x| with the sign of `sign`; for x >= 0.
template <class R>
LATSCH_INLINE R with_sign(const R& x, const R& sign) {
  return from_bits(bits(x) | (bits(sign) & std::int64_t(0x8000000000000000ull)));
}
/// -1 or 1; 1 also at 0, where the sum drops the sign of zero. Without a branch to guess.
template <class R>
LATSCH_INLINE R sign_or_one(const R& x) {
  return with_sign(constant<R>(1.0), x + 0.0);
}
/// -1, 0 or 1.
template <class R>
LATSCH_INLINE R sign(const R& x) {
  return select(x == 0.0, constant<R>(0.0), sign_or_one(x));
}
template <class R>
LATSCH_INLINE R smaller(const R& a, const R& b) {
  return select(a < b, a, b);
}
template <class R>
LATSCH_INLINE R larger(const R& a, const R& b) {
  return select(a > b, a, b);
}

LATSCH_INLINE double sqrt(double x) { return __builtin_sqrt(x); }
LATSCH_INLINE Lanes sqrt(const Lanes& x) {
  Lanes y;
  for (int i = 0; i < 8; ++i) y[i] = __builtin_sqrt(x[i]);
  return y;
}

template <class R>
LATSCH_INLINE R atan(const R& x) {
  // |x| <= tan(pi/8), up to tan(3 pi/8), beyond: atan about 0, 1 and infinity.
  constexpr double kNear = 0.41421356237309503, kFar = 2.414213562373095;
  constexpr double kPi4 = 0.78539816339744831, kPi4Low = 3.061616997868383e-17;
  const R a = abs(x);
  const auto far = a > kFar;
  const auto middle = a > kNear;
  const R one = constant<R>(1.0);
  const R numerator = select(far, -one, select(middle, a - 1.0, a));
  const R denominator = select(far, a, select(middle, a + 1.0, one));
  const R offset =
      select(far, constant<R>(2.0 * kPi4), select(middle, constant<R>(kPi4), constant<R>(0.0)));
  const R low = select(
      far, constant<R>(2.0 * kPi4Low), select(middle, constant<R>(kPi4Low), constant<R>(0.0)));
  const R t = numerator / denominator;
  const R z = t * t, z2 = z * z, z4 = z2 * z2;
  const R p0 = (-0.3333333333333333016 + 0.19999999999995520678 * z) +
               z2 * (-0.14285714284666542922 + 0.11111111015256361727 * z);
  const R p1 = (-0.090909045781239018905 + 0.076921831908260865637 * z) +
               z2 * (-0.066645114473819480001 + 0.058581489128022098816 * z);
  const R p2 =
      (-0.050854497379402598613 + 0.039231658295587191303 * z) + z2 * -0.019176887119062258989;
  const R p = p0 + z4 * (p1 + z4 * p2);
  return with_sign(offset + (t + (low + t * z * p)), x);
}

template <class R>
struct SinCos {
  R sin, cos;
};

/// Adding it rounds to an integer, which then stands in the low bits.
inline constexpr double kRounder = 6755399441055744.0;  // 1.5 * 2^52

template <class R>
LATSCH_INLINE SinCos<R> sin_cos(const R& x) {
  // pi/2 in parts of 33 bits, so that k times each of the first two is exact
  constexpr double kHigh = 1.5707963267341256, kMiddle = 6.077100506303966e-11,
                   kLow = 2.0222662487959506e-21;
  const R shifted = x * 0.63661977236758134 + kRounder;
  const R k = shifted - kRounder;
  const R r = ((x - k * kHigh) - k * kMiddle) - k * kLow;
  const R z = r * r, z2 = z * z, z4 = z2 * z2;
  const R s = ((-1.0 / 6 + z * (1.0 / 120)) + z2 * (-1.0 / 5040 + z * (1.0 / 362880))) +
              z4 * ((-1.0 / 39916800 + z * (1.0 / 6227020800)) + z2 * (-1.0 / 1307674368000));
  const R c = ((1.0 / 24 - z * (1.0 / 720)) + z2 * (1.0 / 40320 - z * (1.0 / 3628800))) +
              z4 * ((1.0 / 479001600 - z * (1.0 / 87178291200)) + z2 * (1.0 / 20922789888000));
  const R sine = r + r * z * s;
  const R cosine = 1.0 - (0.5 * z - z2 * c);
  const auto quadrant = bits(shifted);
  const auto odd = (quadrant & 1) != 0;
  const auto sine_sign = (quadrant & 2) << 62;
  const auto cosine_sign = ((quadrant + 1) & 2) << 62;
  return {from_bits(bits(select(odd, cosine, sine)) ^ sine_sign),
          from_bits(bits(select(odd, sine, cosine)) ^ cosine_sign)};
}
template <class R>
LATSCH_INLINE R sin(const R& x) {
  return sin_cos(x).sin;
}
template <class R>
LATSCH_INLINE R cos(const R& x) {
  return sin_cos(x).cos;
}

inline constexpr double kLn2High = 0.6931471804855391, kLn2Low = 7.440617110012397e-11;

template <class R>
LATSCH_INLINE R exp(const R& unbounded) {
  const R x = smaller(larger(unbounded, constant<R>(-708.0)), constant<R>(708.0));
  const R shifted = x * 1.4426950408889634 + kRounder;
  const R k = shifted - kRounder;
  const R r = (x - k * kLn2High) - k * kLn2Low;
  const R r2 = r * r, r4 = r2 * r2;
  const R p0 = (0.5 + r * (1.0 / 6)) + r2 * (1.0 / 24 + r * (1.0 / 120));
  const R p1 = (1.0 / 720 + r * (1.0 / 5040)) + r2 * (1.0 / 40320 + r * (1.0 / 362880));
  const R p2 =
      (1.0 / 3628800 + r * (1.0 / 39916800)) + r2 * (1.0 / 479001600 + r * (1.0 / 6227020800));
  const R mantissa = 1.0 + (r + r2 * (p0 + r4 * (p1 + r4 * p2)));
  return from_bits(bits(mantissa) + (bits(shifted) << 52));
}

template <class R>
LATSCH_INLINE R log(const R& x) {
  // x = 2^e m with m in [sqrt(1/2), sqrt 2); log m = 2 artanh((m - 1)/(m + 1)).
  constexpr std::int64_t kRootHalf = 0x3fe6a09e667f3bcd;
  const auto above = bits(x) - kRootHalf;
  const auto exponent = above >> 52;  // rounds down
  const R m = from_bits(bits(x) - (exponent << 52));
  const R e = from_bits(exponent + bits(constant<R>(kRounder))) - kRounder;
  const R s = (m - 1.0) / (m + 1.0);
  const R z = s * s, z2 = z * z, z4 = z2 * z2;
  const R p = ((1.0 / 3 + z * (1.0 / 5)) + z2 * (1.0 / 7 + z * (1.0 / 9))) +
              z4 * (((1.0 / 11 + z * (1.0 / 13)) + z2 * (1.0 / 15 + z * (1.0 / 17))) +
                    z4 * (1.0 / 19 + z * (1.0 / 21)));
  return e * kLn2High + (2.0 * s + (2.0 * s * z * p + e * kLn2Low));
}

/// x^y for x >= 0; 0^0 is 1, 0 to any other power 0.
template <class R>
LATSCH_INLINE R power(const R& x, double y) {
  const R at_zero = constant<R>(y == 0.0 ? 1.0 : 0.0);
  const auto zero = x <= 0.0;
  return select(zero, at_zero, exp(y * log(select(zero, constant<R>(1.0), x))));
}

// Functions of N <= 8 independent numbers: of doubles at once, side by side from end to end; of
// eight states one after the other.

template <int N>
LATSCH_INLINE Lanes gathered(const double (&x)[N], double beyond = 0.0) {
  static_assert(N <= 8);
  // From registers: written to memory one by one they would have to arrive there first.
  const auto at = [&](int i) { return i < N ? x[i < N ? i : 0] : beyond; };
  return Lanes{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
}
template <int N>
LATSCH_INLINE void scatter(const Lanes& v, double (&x)[N]) {
  for (int i = 0; i < N; ++i) x[i] = v[i];
}
/// The sine and cosine of C atan(x - E (x - atan x)).
LATSCH_INLINE SinCos<Lanes> magic(const Lanes& x, const Lanes& C, const Lanes& E) {
  return sin_cos(C * atan(x - E * (x - atan(x))));
}
template <int N>
LATSCH_INLINE void magic_all(const double (&x)[N],
                             const double (&C)[N],
                             const double (&E)[N],
                             double (&sine)[N],
                             double (&cosine)[N]) {
  const SinCos<Lanes> r = magic(gathered(x), gathered(C), gathered(E));
  scatter(r.sin, sine);
  scatter(r.cos, cosine);
}
template <int N>
LATSCH_INLINE void magic_all(const Lanes (&x)[N],
                             const Lanes (&C)[N],
                             const Lanes (&E)[N],
                             Lanes (&sine)[N],
                             Lanes (&cosine)[N]) {
  for (int i = 0; i < N; ++i) {
    const SinCos<Lanes> r = magic(x[i], C[i], E[i]);
    sine[i] = r.sin;
    cosine[i] = r.cos;
  }
}

/// Arc tangents of all x, sine and cosine of the first M times a factor, and of one more angle.
template <int N, int M>
LATSCH_INLINE void sin_cos_of_atan_all(const double (&x)[N],
                                       const double (&factor)[M],
                                       double angle,
                                       double (&arc)[N],
                                       double (&sine)[M + 1],
                                       double (&cosine)[M + 1]) {
  static_assert(M < N && N <= 8);
  const Lanes arcs = atan(gathered(x));
  Lanes alone = all(0.0);
  alone[M] = angle;
  const SinCos<Lanes> r = sin_cos(gathered(factor) * arcs + alone);
  scatter(arcs, arc);
  scatter(r.sin, sine);
  scatter(r.cos, cosine);
}
template <int N, int M>
LATSCH_INLINE void sin_cos_of_atan_all(const Lanes (&x)[N],
                                       const double (&factor)[M],
                                       const Lanes& angle,
                                       Lanes (&arc)[N],
                                       Lanes (&sine)[M + 1],
                                       Lanes (&cosine)[M + 1]) {
  for (int i = 0; i < N; ++i) arc[i] = atan(x[i]);
  for (int i = 0; i <= M; ++i) {
    const SinCos<Lanes> r = sin_cos(i < M ? factor[i < M ? i : 0] * arc[i] : angle);
    sine[i] = r.sin;
    cosine[i] = r.cos;
  }
}

/// base^power for base > 0, and exponentials.
template <int N, int M>
LATSCH_INLINE void powers_and_exps(const double (&base)[N],
                                   const double (&power)[N],
                                   const double (&exponent)[M],
                                   double (&raised)[N],
                                   double (&exps)[M]) {
  static_assert(N + M <= 8);
  Lanes alone = all(0.0);
  for (int i = 0; i < M; ++i) alone[N + i] = exponent[i];
  const Lanes r = exp(gathered(power) * log(gathered(base, 1.0)) + alone);
  for (int i = 0; i < N; ++i) raised[i] = r[i];
  for (int i = 0; i < M; ++i) exps[i] = r[N + i];
}
template <int N, int M>
LATSCH_INLINE void powers_and_exps(const Lanes (&base)[N],
                                   const double (&power)[N],
                                   const Lanes (&exponent)[M],
                                   Lanes (&raised)[N],
                                   Lanes (&exps)[M]) {
  for (int i = 0; i < N; ++i) raised[i] = exp(power[i] * log(base[i]));
  for (int i = 0; i < M; ++i) exps[i] = exp(exponent[i]);
}

}  // namespace latsch::lane_math
