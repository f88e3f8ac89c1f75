// SPDX-License-Identifier: Apache-2.0
// Eight numbers in single precision side by side, in one register if the processor has registers of
// that width. Included once per kernel set, by files of kernels only.

namespace latsch::numerics::LATSCH_KERNELS {

using EightFloats = float __attribute__((vector_size(32), aligned(4), may_alias));

}  // namespace latsch::numerics::LATSCH_KERNELS
