// SPDX-License-Identifier: Apache-2.0
// Springs, Maxwell and friction elements of the sidewall (sidewall.h), one value a node.
#include "numerics/kernels/kernel_loops.h"
#include "numerics/kernels/kernel_math.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// Converts to travel along e_r = (s, 0, -c), minus R, e_t = (c, 0, s) and a.
void to_polar(int nodes,
              const double* x,
              const double* y,
              const double* z,
              const double* sine,
              const double* cosine,
              double R,
              double* const polar[3]) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    const T at_x = T::load(x + i), at_z = T::load(z + i);
    const T s = T::load(sine + i), c = T::load(cosine + i);
    T(at_x * s - at_z * c - R).save(polar[0] + i);
    T(at_x * c + at_z * s).save(polar[1] + i);
    T::load(y + i).save(polar[2] + i);
  });
}
void from_polar(int nodes,
                const double* const polar[3],
                const double* sine,
                const double* cosine,
                double* x,
                double* y,
                double* z) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    const T r = T::load(polar[0] + i), t = T::load(polar[1] + i);
    const T s = T::load(sine + i), c = T::load(cosine + i);
    T(r * s + t * c).save(x + i);
    T::load(polar[2] + i).save(y + i);
    T(t * s - r * c).save(z + i);
  });
}

/// Evaluates (9); `lateral` is the travel along a.
void add_torsion(int nodes,
                 const TorsionSpring& spring,
                 const double* psi,
                 const double* lateral,
                 const double* psi_rate,
                 double* y,
                 double* torsion) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    const T turned = (T::load(psi + i) - spring.by_lateral * T::load(lateral + i)) - spring.rest;
    const T moment = spring.stiffness * turned;
    T(T::load(y + i) + spring.by_lateral * moment).save(y + i);
    T(-(moment + spring.damping * T::load(psi_rate + i))).save(torsion + i);
  });
}

void add_multiple(int nodes, double k, const double* u, double* F) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    T(T::load(F + i) + k * T::load(u + i)).save(F + i);
  });
}

void add_progressive(int nodes, double k, double P, double up, const double* u, double* F) {
  const double per_up = 1.0 / up;
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    const T travel = T::load(u + i);
    T(T::load(F + i) - k * (travel + P * (travel - up * atan(travel * per_up))))
        .save(F + i);  // (7)
  });
}

/// (28)
void add_rim(int nodes, double k, double travel, const double* u, double* F) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    T(T::load(F + i) - k * smaller(T::load(u + i) + travel, T(0.0))).save(F + i);
  });
}
void add_rim_slope(int nodes, double k, double travel, const double* u, double* slope) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    const T more = select(T::load(u + i) + travel < T(0.0), T(k), T(0.0));
    T(T::load(slope + i) + more).save(slope + i);
  });
}

/// Computes constant + kP u²/(u² + u_p²), the slope of (7).
void find_progressive(
    int nodes, double constant, double kP, double up, const double* u, double* slope) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    const T square = T::load(u + i) * T::load(u + i);
    T(constant + kP * square / (square + up * up)).save(slope + i);
  });
}

/// Adds k if a friction element of (8) sticks.
void add_sticking(int nodes,
                  double k,
                  double most,
                  const double* before,
                  const double* stretch,
                  const double* u,
                  double* slope) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    const T end = T::load(stretch + i) + (T::load(u + i) - T::load(before + i));
    const T sticks = select(larger(end, -end) < most, T(k), T(0.0));
    T(T::load(slope + i) + sticks).save(slope + i);
  });
}

/// Converts slopes along e_r = (s, 0, -c), e_t = (c, 0, s) and a to entries xx, xz, zz, yy.
void turn_slopes(int nodes,
                 double scale,
                 const double* const slope[3],
                 const double* sine,
                 const double* cosine,
                 double* const to[4]) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    const T r = scale * T::load(slope[0] + i), t = scale * T::load(slope[1] + i);
    const T s = T::load(sine + i), c = T::load(cosine + i);
    T(r * s * s + t * c * c).save(to[0] + i);
    T((t - r) * s * c).save(to[1] + i);
    T(r * c * c + t * s * s).save(to[2] + i);
    T(scale * T::load(slope[2] + i)).save(to[3] + i);
  });
}

/// Adds the blocks (i, i + j) of B' k B on the nodes for a stiffness k at the knots.
void add_from_knots(int nodes, int j, const double* k, double* to) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    const T next = T::load(k + i + 1);
    T more;
    if (j == 0)
      more = T::load(k + i - 1) + 16.0 * T::load(k + i) + next;
    else if (j == 1)
      more = 4.0 * (T::load(k + i) + next);
    else
      more = next;
    T(T::load(to + i) + (1.0 / 36.0) * more).save(to + i);
  });
}

/// Integrates (6) by the trapezoidal rule and returns u - u_i at the end of the step; half is h/(2
/// τ).
template <class T>
LATSCH_INLINE T maxwell_end(double half, const T& before, const T& stretch, const T& u) {
  return ((1.0 - half) * stretch + (u - before)) * (1.0 / (1.0 + half));
}
/// Returns the stretch of a friction spring at the end of the step by (8).
template <class T>
LATSCH_INLINE T friction_end(double most, const T& before, const T& stretch, const T& u) {
  return larger(smaller(stretch + (u - before), most), -most);
}

void add_maxwell(int nodes,
                 double k,
                 double half,
                 const double* before,
                 const double* stretch,
                 const double* u,
                 double* F) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    const T end = maxwell_end(half, T::load(before + i), T::load(stretch + i), T::load(u + i));
    T(T::load(F + i) - k * end).save(F + i);
  });
}

void go_on_maxwell(int nodes, double half, const double* before, const double* u, double* stretch) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    maxwell_end(half, T::load(before + i), T::load(stretch + i), T::load(u + i)).save(stretch + i);
  });
}

void add_friction(int nodes,
                  double k,
                  double most,
                  const double* before,
                  const double* stretch,
                  const double* u,
                  double* F) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    const T end = friction_end(most, T::load(before + i), T::load(stretch + i), T::load(u + i));
    T(T::load(F + i) - k * end).save(F + i);
  });
}

void go_on_friction(
    int nodes, double most, const double* before, const double* u, double* stretch) {
  around(nodes, [&](auto type, int i) {
    using T = decltype(type);
    friction_end(most, T::load(before + i), T::load(stretch + i), T::load(u + i)).save(stretch + i);
  });
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
