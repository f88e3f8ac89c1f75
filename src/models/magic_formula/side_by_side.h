// SPDX-License-Identifier: Apache-2.0
// Evaluates elementary functions of several numbers at once. For a single state all numbers share
// one vector register. For eight states, with or without derivatives, each function is evaluated
// for all states, one after the other.
#if defined(LATSCH_MAGIC_FORMULA_SIDE_BY_SIDE) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_MAGIC_FORMULA_SIDE_BY_SIDE
#undef LATSCH_MAGIC_FORMULA_SIDE_BY_SIDE
#else
#define LATSCH_MAGIC_FORMULA_SIDE_BY_SIDE
#endif

#include "models/magic_formula/tire_constants.h"
#include "numerics/kernels/dual_lanes.h"

namespace latsch::magic_formula::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// Types of the coefficients for a number type R: if R has derivatives, the coefficients have them,
/// too.
template <class R>
using ConstantOf = typename R::Constant;
template <class R>
using CoefficientsFor = CoefficientsOf<ConstantOf<R>>;
template <class R>
using TireOf = TireConstantsOf<ConstantOf<R>>;

LATSCH_INLINE double number(double x) { return x; }
LATSCH_INLINE double number(const Lane& x) {
  double v = x.v;
#if LATSCH_X86_KERNELS
  // Keeps the value in a register. Compilers tend to write four values to memory one by one and to
  // read them back as one vector, which stalls the processor until all writes are done.
  __asm__("" : "+x"(v));
#endif
  return v;
}

/// Returns a vector of x[0] to x[N - 1], N <= 4, filled up with `beyond`.
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

// Sine and cosine of four curves C atan(x - E (x - atan x)), in two steps. For a single state,
// other computations can overlap with the first step. For eight states the first step does nothing,
// and the second does all.
LATSCH_INLINE Lanes4 inner_arcs(const Lane* x) { return atan(gathered<4>(x)); }
LATSCH_INLINE void magic_of_four(
    const Lane* x_, const Lane* C, const Lane* E, const Lanes4& arcs, Lane* sine, Lane* cosine) {
  const Lanes4 x = gathered<4>(x_);
  const SinCos<Lanes4> r = sin_cos(gathered<4>(C) * atan(x - gathered<4>(E) * (x - arcs)));
  scatter<4>(r.sin, sine);
  scatter<4>(r.cos, cosine);
}
struct ArcsLater {};
template <class R>
LATSCH_INLINE ArcsLater inner_arcs(const R*) {
  return {};
}
template <class R>
LATSCH_INLINE void magic_of_four(
    const R* x, const R* C, const R* E, const ArcsLater&, R* sine, R* cosine) {
  for (int i = 0; i < 4; ++i) {
    const SinCos<R> r = sin_cos(C[i] * atan(x[i] - E[i] * (x[i] - atan(x[i]))));
    sine[i] = r.sin;
    cosine[i] = r.cos;
  }
}

/// Computes the arc tangents of four numbers x, and the sines and cosines of four angles: the first
/// three arc tangents times a factor each, and one more angle.
LATSCH_INLINE void sin_cos_of_atan_all(const Lane (&x)[4],
                                       const double (&factor)[3],
                                       const Lane& angle,
                                       Lane (&arc)[4],
                                       Lane (&sine)[4],
                                       Lane (&cosine)[4]) {
  const Lanes4 arcs = atan(gathered<4>(x));
  const auto last = four(0.0, 0.0, 0.0, 1.0) > 0.0;
  const SinCos<Lanes4> r = sin_cos(select(last, Lanes4(angle.v), gathered<3>(factor) * arcs));
  scatter<4>(arcs, arc);
  scatter<4>(r.sin, sine);
  scatter<4>(r.cos, cosine);
}
template <class R>
LATSCH_INLINE void sin_cos_of_atan_all(const R (&x)[4],
                                       const ConstantOf<R> (&factor)[3],
                                       const R& angle,
                                       R (&arc)[4],
                                       R (&sine)[4],
                                       R (&cosine)[4]) {
  for (int i = 0; i < 4; ++i) arc[i] = atan(x[i]);
  for (int i = 0; i < 4; ++i) {
    const SinCos<R> r = i < 3 ? sin_cos(factor[i < 3 ? i : 0] * arc[i]) : sin_cos(angle);
    sine[i] = r.sin;
    cosine[i] = r.cos;
  }
}

/// Computes base^power for three positive bases, and e^exponent.
LATSCH_INLINE void powers_and_exp(const Lane (&base)[3],
                                  const double (&power)[3],
                                  const Lane& exponent,
                                  Lane (&raised)[3],
                                  Lane& e_to) {
  const auto last = four(0.0, 0.0, 0.0, 1.0) > 0.0;
  const Lanes4 powers = gathered<3>(power) * log(gathered<3>(base, 1.0));
  const Lanes4 r = exp(select(last, Lanes4(exponent.v), powers));
  scatter<3>(r, raised);
  e_to = r.at(3);
}
template <class R>
LATSCH_INLINE void powers_and_exp(const R (&base)[3],
                                  const ConstantOf<R> (&power)[3],
                                  const R& exponent,
                                  R (&raised)[3],
                                  R& e_to) {
  for (int i = 0; i < 3; ++i) raised[i] = exp(power[i] * log(base[i]));
  e_to = exp(exponent);
}

}  // namespace latsch::magic_formula::LATSCH_KERNELS
#endif
