// SPDX-License-Identifier: Apache-2.0
// Version of the finite-element tire and its rig. It must be raised whenever the same input gives
// other results beyond rounding, because trials of another version are not reused. Versions before
// 2 stored no number.
#pragma once

namespace latsch::fe_tire {

inline constexpr int kModelVersion = 15;

}  // namespace latsch::fe_tire
