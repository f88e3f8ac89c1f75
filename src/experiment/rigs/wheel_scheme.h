// SPDX-License-Identifier: Apache-2.0
// Version of the method by which rigs solve the motion of parts that the tire moves: a freely
// spinning wheel, an axle under its load. It is part of the identity of tests that roll, so that a
// journal never mixes recordings of two versions.
#pragma once

namespace latsch::experiment {

inline constexpr const char* kWheelScheme = "wheel and axle solved with the tire's step";

}  // namespace latsch::experiment
