// SPDX-License-Identifier: Apache-2.0
// The version of the finite-element tire and its rig. Raised whenever a tire of the same numbers
// answers other than before, beyond rounding: trials of another version are not taken for this
// one's. Before 2 none was kept.
#pragma once

namespace latsch::fe_tire {

inline constexpr int kModelVersion = 15;

}  // namespace latsch::fe_tire
