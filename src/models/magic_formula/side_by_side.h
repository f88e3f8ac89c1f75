// SPDX-License-Identifier: Apache-2.0
// Elementary functions of several numbers at once: of one state side by side, from end to end; of
// eight states one after the other.
#if defined(LATSCH_MAGIC_FORMULA_SIDE_BY_SIDE) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_MAGIC_FORMULA_SIDE_BY_SIDE
#undef LATSCH_MAGIC_FORMULA_SIDE_BY_SIDE
#else
#define LATSCH_MAGIC_FORMULA_SIDE_BY_SIDE
#endif

#include "numerics/kernel_math.h"

namespace latsch::magic_formula::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

template <int N>
LATSCH_INLINE Lanes gathered(const Lane (&x)[N], double beyond = 0.0) {
  static_assert(N <= 8);
  // From registers: written to memory one by one they would have to arrive there first.
  const auto at = [&](int i) { return i < N ? x[i < N ? i : 0].v : beyond; };
  return lanes(at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7));
}
LATSCH_INLINE double number(double x) { return x; }
LATSCH_INLINE double number(const Lane& x) { return x.v; }
template <class T, int N>
LATSCH_INLINE Lanes4 gathered_four(const T (&x)[N], double beyond = 0.0) {
  static_assert(N <= 4);
  const auto at = [&](int i) { return i < N ? number(x[i < N ? i : 0]) : beyond; };
  return four(at(0), at(1), at(2), at(3));
}
template <int N>
LATSCH_INLINE void scatter(const Lanes& v, Lane (&x)[N]) {
  for (int i = 0; i < N; ++i) x[i] = v.at(i);
}
/// The sine and cosine of C atan(x - E (x - atan x)).
LATSCH_INLINE SinCos<Lanes> magic(const Lanes& x, const Lanes& C, const Lanes& E) {
  return sin_cos(C * atan(x - E * (x - atan(x))));
}
template <int N>
LATSCH_INLINE void magic_all(const Lane (&x)[N],
                             const Lane (&C)[N],
                             const Lane (&E)[N],
                             Lane (&sine)[N],
                             Lane (&cosine)[N]) {
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
LATSCH_INLINE void sin_cos_of_atan_all(const Lane (&x)[N],
                                       const double (&factor)[M],
                                       const Lane& angle,
                                       Lane (&arc)[N],
                                       Lane (&sine)[M + 1],
                                       Lane (&cosine)[M + 1]) {
  static_assert(M < N && N <= 8);
  const Lanes arcs = atan(gathered(x));
  Lane angles[M + 1];
  for (int i = 0; i < M; ++i) angles[i] = factor[i] * Lane(arcs.at(i));
  angles[M] = angle;
  const SinCos<Lanes> r = sin_cos(gathered(angles));
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
    const SinCos<Lanes> r = i < M ? sin_cos(factor[i < M ? i : 0] * arc[i]) : sin_cos(angle);
    sine[i] = r.sin;
    cosine[i] = r.cos;
  }
}

/// base^power for base > 0, and exponentials.
template <int N, int M>
LATSCH_INLINE void powers_and_exps(const Lane (&base)[N],
                                   const double (&power)[N],
                                   const Lane (&exponent)[M],
                                   Lane (&raised)[N],
                                   Lane (&exps)[M]) {
  static_assert(N <= 4 && M <= 4);
  const Lanes4 x = gathered_four(power) * log(gathered_four(base, 1.0));
  const Lanes r = exp(joined(x, gathered_four(exponent)));
  for (int i = 0; i < N; ++i) raised[i] = r.at(i);
  for (int i = 0; i < M; ++i) exps[i] = r.at(4 + i);
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

}  // namespace latsch::magic_formula::LATSCH_KERNELS
#endif
