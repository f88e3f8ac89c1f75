// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/state_slopes.h"

#include <memory>
#include <utility>

namespace latsch::ring_tire {

RingState along(const RingState& state, const RingState& slope, double by) {
  RingState to = state;
  to.place += by * slope.place;
  to.rate += by * slope.rate;
  to.acceleration += by * slope.acceleration;
  to.force += by * slope.force;
  to.sidewall.travel += by * slope.sidewall.travel;
  to.sidewall.maxwell += by * slope.sidewall.maxwell;
  to.sidewall.slip += by * slope.sidewall.slip;
  to.section += by * slope.section;
  if (!state.tread.tips()) return to;
  auto tips = std::make_shared<TreadTips>(*state.tread.tips());
  for (std::size_t i = 0; i < tips->columns.size(); ++i)
    tips->columns[i] += by * slope.tread.tips()->columns[i];
  to.tread = TreadMemory(std::move(tips));
  return to;
}

bool find_memory_slope(const RingState& more, const RingState& less, double over, RingState& to) {
  to.sidewall.travel = (more.sidewall.travel - less.sidewall.travel) / over;
  to.sidewall.maxwell = (more.sidewall.maxwell - less.sidewall.maxwell) / over;
  to.sidewall.slip = (more.sidewall.slip - less.sidewall.slip) / over;
  to.section = (more.section - less.section) / over;
  const TreadTips &a = *more.tread.tips(), &b = *less.tread.tips();
  if (a.segments != b.segments) return false;
  auto tips = std::make_shared<TreadTips>(a);
  for (std::size_t i = 0; i < a.columns.size(); ++i)
    tips->columns[i] = (a.columns[i] - b.columns[i]) / over;
  to.tread = TreadMemory(std::move(tips));
  return true;
}

}  // namespace latsch::ring_tire
