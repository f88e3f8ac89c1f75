// SPDX-License-Identifier: Apache-2.0
#include "exchange/unit/stepped_tire.h"

#include <fmt/format.h>

namespace latsch::exchange {

Result<HubForces> SteppedTire::forces(const WheelMotion& motion,
                                      const road::Road& road,
                                      double time,
                                      bool keep) {
  std::size_t before = kept_.size();
  while (before > 0 && kept_[before - 1].time >= time) --before;
  const bool starts = before == 0 && (!start_ || time <= *start_);
  if (before == 0 && !starts)
    return Failure{
        fmt::format("TIME = {} s is before the last {} states that are kept, from {} s on",
                    time,
                    kept_.size(),
                    kept_.front().time)};
  auto tire = starts ? unused_->clone() : kept_[before - 1].tire->clone();
  auto hub = starts ? tire->settle(motion, road, time)
                    : tire->advance(motion, road, time, time - kept_[before - 1].time);
  if (!hub || !keep) return hub;
  if (starts) start_ = time;
  kept_.resize(before);
  kept_.push_back({time, std::move(tire)});
  if (kept_.size() > kMost) kept_.pop_front();
  return hub;
}

}  // namespace latsch::exchange
