// SPDX-License-Identifier: Apache-2.0
// How rigs find the motion of what the tire moves: a wheel that spins freely, an axle under its
// load. A part of the identity of tests that roll, so that a journal never mixes recordings of two.
#pragma once

namespace latsch::experiment {

inline constexpr const char* kWheelScheme = "wheel and axle solved with the tire's step";

}  // namespace latsch::experiment
