// SPDX-License-Identifier: Apache-2.0
// Kernel that evaluates the Magic Formula for eight states with derivatives.
#include "models/magic_formula/steady_state.h"

namespace latsch::magic_formula::LATSCH_KERNELS {

using DualEight = DualLanes<Lanes>;

// Splits a struct of dual numbers into values and derivatives; the struct is read as an array of
// its fields.
template <class Fields, class Eight>
LATSCH_INLINE void take_apart(const Fields& fields, Eight& eight) {
  static_assert(sizeof fields == std::size(decltype(eight.values){}) * sizeof(DualEight));
  for (std::size_t i = 0; i < std::size(eight.values); ++i) {
    const DualEight& field = reinterpret_cast<const DualEight*>(&fields)[i];
    store(field.v, eight.values[i]);
    eight.slopes[i] = field.slopes;
  }
}

void evaluate_with_slopes(const TireConstantsOf<DualNumber>& tire,
                          const Conventions& conventions,
                          const AskedOutputs& asked,
                          const StateOfEight& given,
                          SteadyStateOfEight& result,
                          WheelOfEight& wheel) {
  StateOf<DualEight> state;
  for (std::size_t i = 0; i < std::size(given.values); ++i) {
    const SlopeBlock* slopes = given.slopes[i];
    reinterpret_cast<DualEight*>(&state)[i] = {
        lanes(given.values[i]), slopes == nullptr ? nullptr : widened<Lanes>(slopes)};
  }
  SteadyStateOf<DualEight> s{};
  WheelUnderLoadOf<DualEight> under_load;
  steady_state(tire, conventions, state, s, under_load, asked);
  take_apart(s, result);
  take_apart(under_load, wheel);
}

}  // namespace latsch::magic_formula::LATSCH_KERNELS
