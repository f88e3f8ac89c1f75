// SPDX-License-Identifier: Apache-2.0
// Kernels of dual_number_test.cpp: functions of x (direction 0), y (direction 5) and a constant
// (direction 63).
#include "numerics/kernels/dual_lanes.h"

namespace latsch::dual_lanes_testing::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

template <class R>
LATSCH_INLINE void functions(const R& x, const R& y, const typename R::Constant& c, R* f) {
  f[0] = x * y + c * x;
  f[1] = x / y - c;
  f[2] = c - x * y;
  f[3] = x * y - y * c;
  f[4] = sqrt(x) * sin(y) + cos(c * x);
  f[5] = atan(x * y);
  f[6] = atan_of_quotient(y, x);
  f[7] = exp(x - y) * log(x);
  f[8] = larger(x, y) + smaller(x, R(c));
  f[9] = abs(y - x) * sign(y) + with_sign(x, y);
  f[10] = select(x < y, x * c, -y);
  f[11] = R(c);
}

/// Evaluates every test function f in all lanes and writes values[f][lane] and slopes[f][lane].
void evaluate(const double* x,
              const double* y,
              const DualNumber& c,
              const SlopeBlock* of_x,
              const SlopeBlock* of_y,
              double (*values)[8],
              double (*plain)[8],
              const SlopeBlock** slopes) {
  using Dual = DualLanes<Lanes>;
  Dual f[kFunctions];
  functions(Dual(lanes(x), widened<Lanes>(of_x)), Dual(lanes(y), widened<Lanes>(of_y)), c, f);
  Lanes g[kFunctions];
  functions(lanes(x), lanes(y), c.v, g);
  for (int i = 0; i < kFunctions; ++i) {
    store(f[i].v, values[i]);
    store(g[i], plain[i]);
    slopes[i] = f[i].slopes;
  }
}

}  // namespace latsch::dual_lanes_testing::LATSCH_KERNELS
