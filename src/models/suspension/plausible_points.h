// SPDX-License-Identifier: Apache-2.0
// Limits within which hardpoints of a suspension are plausible.
#pragma once

namespace latsch::suspension {

/// Smallest length of a link, distance of two hardpoints, or distance of a rod from the axis about
/// which it holds a part, m. A smaller one is a fault.
inline constexpr double kNear = 1e-3;
/// Largest plausible coordinate, m.
inline constexpr double kFar = 50.0;

}  // namespace latsch::suspension
