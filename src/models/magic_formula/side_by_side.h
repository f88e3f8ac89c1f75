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

LATSCH_INLINE double number(double x) { return x; }
LATSCH_INLINE double number(const Lane& x) {
  double v = x.v;
#if LATSCH_X86_KERNELS
  // Held in a register. What was just written to memory one by one cannot be read from there as
  // four before all of it has arrived, and the compiler likes to do that.
  __asm__("" : "+x"(v));
#endif
  return v;
}

/// x[0] to x[N - 1], N <= 4, and `beyond`.
template <int N, class T>
LATSCH_INLINE Lanes4 gathered(const T* x, double beyond = 0.0) {
  static_assert(N <= 4);
  const auto at = [&](int i) { return i < N ? number(x[i < N ? i : 0]) : beyond; };
  return four(at(0), at(1), at(2), at(3));
}
template <int N>
LATSCH_INLINE void scatter(const Lanes4& v, Lane* x) {
  for (int i = 0; i < N; ++i) x[i] = v.at(i);
}

/// Sine and cosine of C atan(x - E (x - atan x)).
template <class T>
LATSCH_INLINE SinCos<T> magic(const T& x, const T& C, const T& E) {
  return sin_cos(C * atan(x - E * (x - atan(x))));
}
LATSCH_INLINE void magic_of_eight(
    const Lane* x, const Lane* C, const Lane* E, Lane* sine, Lane* cosine) {
  const SinCos<Lanes> r = magic(joined(gathered<4>(x), gathered<4>(x + 4)),
                                joined(gathered<4>(C), gathered<4>(C + 4)),
                                joined(gathered<4>(E), gathered<4>(E + 4)));
  scatter<4>(low_half(r.sin), sine);
  scatter<4>(high_half(r.sin), sine + 4);
  scatter<4>(low_half(r.cos), cosine);
  scatter<4>(high_half(r.cos), cosine + 4);
}
LATSCH_INLINE void magic_of_eight(
    const Lanes* x, const Lanes* C, const Lanes* E, Lanes* sine, Lanes* cosine) {
  for (int i = 0; i < 8; ++i) {
    const SinCos<Lanes> r = magic(x[i], C[i], E[i]);
    sine[i] = r.sin;
    cosine[i] = r.cos;
  }
}
/// Of the four curves behind each other.
LATSCH_INLINE void magic_of_four(
    const Lane* x, const Lane* C, const Lane* E, Lane* sine, Lane* cosine) {
  const SinCos<Lanes4> r = magic(gathered<4>(x), gathered<4>(C), gathered<4>(E));
  scatter<4>(r.sin, sine);
  scatter<4>(r.cos, cosine);
}
LATSCH_INLINE void magic_of_four(
    const Lanes* x, const Lanes* C, const Lanes* E, Lanes* sine, Lanes* cosine) {
  for (int i = 0; i < 4; ++i) {
    const SinCos<Lanes> r = magic(x[i], C[i], E[i]);
    sine[i] = r.sin;
    cosine[i] = r.cos;
  }
}

/// Arc tangents of six x; sine and cosine of the first four times a factor, and of one more angle.
LATSCH_INLINE void sin_cos_of_atan_all(const Lane (&x)[6],
                                       const double (&factor)[4],
                                       const Lane& angle,
                                       Lane (&arc)[6],
                                       Lane (&sine)[5],
                                       Lane (&cosine)[5]) {
  const Lanes4 arcs = atan(gathered<4>(x));
  // Independent of those arcs, so that the two go on side by side.
  const SinCos<Lanes4> alone = sin_cos(four(angle.v, 0.0, 0.0, 0.0));
  const SinCos<Lanes4> r = sin_cos(gathered<4>(factor) * arcs);
  scatter<2>(atan(gathered<2>(x + 4)), arc + 4);
  scatter<4>(arcs, arc);
  scatter<4>(r.sin, sine);
  scatter<4>(r.cos, cosine);
  sine[4] = alone.sin.at(0);
  cosine[4] = alone.cos.at(0);
}
LATSCH_INLINE void sin_cos_of_atan_all(const Lanes (&x)[6],
                                       const double (&factor)[4],
                                       const Lanes& angle,
                                       Lanes (&arc)[6],
                                       Lanes (&sine)[5],
                                       Lanes (&cosine)[5]) {
  for (int i = 0; i < 6; ++i) arc[i] = atan(x[i]);
  for (int i = 0; i < 5; ++i) {
    const SinCos<Lanes> r = i < 4 ? sin_cos(factor[i < 4 ? i : 0] * arc[i]) : sin_cos(angle);
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
  const Lanes4 powers = gathered<N>(power) * log(gathered<N>(base, 1.0));
  const Lanes r = exp(joined(powers, gathered<M>(exponent)));
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
