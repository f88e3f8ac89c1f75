// SPDX-License-Identifier: Apache-2.0
// The loops of newmark.h.
#include "numerics/kernels/kernel_loops.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// Applies (26) twice: each node's unknowns from those of the two nodes on either side.
void at_knots_and_back(int nodes, const double* m, const double* a, double* to) {
  const auto at = [&](int k) { return lanes4(a + 4 * k); };
  const auto wrapped = [&](int k) { return at(k < 0 ? k + nodes : k < nodes ? k : k - nodes); };
  const Lanes4 share = (1.0 / 36.0) * lanes4(m);
  const auto set = [&](int k, const auto& of) {
    const Lanes4 sum = (18.0 * of(k) + 8.0 * (of(k - 1) + of(k + 1))) + (of(k - 2) + of(k + 2));
    store(share * sum, to + 4 * k);
  };
  for (const int k : {0, 1, nodes - 2, nodes - 1}) set(k, wrapped);
  for (int k = 2; k < nodes - 2; ++k) set(k, at);
}

void follow(int size,
            double velocity,
            double acceleration,
            const double* q1,
            const double* predicted,
            const double* v,
            const double* a,
            double* v1,
            double* a1) {
  around(size, [&](auto type, int i) {
    using T = decltype(type);
    const T way = T::load(q1 + i) - T::load(predicted + i);
    T(T::load(v + i) + velocity * way).save(v1 + i);
    T(T::load(a + i) + acceleration * way).save(a1 + i);
  });
}

double find_residual(int size,
                     double theta,
                     const double* f1,
                     const double* f0,
                     const double* inertia,
                     double* residual) {
  Lanes most = all(0.0), finite = all(0.0);
  by_eight(0, size, [&](int i) {
    const Lanes left = (1.0 - theta) * lanes(f1 + i) + theta * lanes(f0 + i) - lanes(inertia + i);
    store(left, residual + i);
    most = larger(most, larger(left, -left));
    finite += 0.0 * left;  // larger() may lose a NaN
  });
  double largest = 0.0;
  for (int i = 0; i < 8; ++i) largest = most.at(i) > largest ? most.at(i) : largest;
  return largest + sum(finite);
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
