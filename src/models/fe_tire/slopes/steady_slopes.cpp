// SPDX-License-Identifier: Apache-2.0
// Derivatives of steady states of the rolling tire (tire_slopes.h).
#include <algorithm>
#include <cassert>

#include "models/fe_tire/slopes/tire_slopes.h"
#include "models/fe_tire/slopes/tire_slopes_impl.h"

namespace latsch::fe_tire {

bool TireSlopes::move_shape() const {
  return std::ranges::any_of(impl_->varied, [](const std::unique_ptr<VariedPair>& pair) {
    return !pair->below.same_shape || !pair->above.same_shape;
  });
}

std::optional<TireSlopes::Frictions> TireSlopes::friction(int parameter) const {
  const auto& below = impl_->variations[parameter].below.friction;
  const auto& above = impl_->variations[parameter].above.friction;
  if (!below || !above || *below == *above) return std::nullopt;
  return Frictions(*below, *above);
}

Result<std::vector<RollingRates>> TireSlopes::of_rolling(RollingTire& rolling,
                                                         const RollingState& state,
                                                         const std::vector<RollsWith>& with,
                                                         bool is_at_own_pressure) {
  const int parameters = impl_->count();
  assert(std::ssize(with) == parameters && !move_shape());
  const auto numbers = impl_->moved_numbers(Impl::OfRing::pressed, state.pressure);
  std::vector<RollingCause> causes;
  for (int k = 0; k < parameters; ++k) {
    const MovedNumber& number = numbers[k];
    causes.push_back({number.below,
                      number.above,
                      is_at_own_pressure ? number.pressure_below : state.pressure,
                      is_at_own_pressure ? number.pressure_above : state.pressure,
                      with[k].friction,
                      0.5 * number.way,
                      with[k].spin});
  }
  return rolling.rates(state, causes);
}

}  // namespace latsch::fe_tire
