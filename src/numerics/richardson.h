// SPDX-License-Identifier: Apache-2.0
// Richardson extrapolation: the value at vanishing element size from values at three sizes.
//   v(h) = v0 + C h^p
// [Roache, Perspective: a method for uniform reporting of grid refinement studies, J. Fluids Eng.
// 116 (1994) 405-413]
#pragma once

#include <array>

namespace latsch::numerics {

struct Extrapolation {
  double value = 0.0;  // v0
  double order = 0.0;  // order p; the assumed one if the three values do not determine it
  bool observed = false;
};

/// Takes sizes h[0] > h[1] > h[2] > 0. If the values do not approach a limit monotonically with an
/// order within [1, 2 assumed_order], the last two are extrapolated with `assumed_order`.
Extrapolation extrapolate(const std::array<double, 3>& h,
                          const std::array<double, 3>& v,
                          double assumed_order = 2.0);

}  // namespace latsch::numerics
