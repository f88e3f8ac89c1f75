// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/tire_in_time.h"

#include <utility>

namespace latsch::fe_tire {

TireInTime::TireInTime(FeTire& tire,
                       double touching,
                       const std::optional<ReductionSettings>& reduction)
    : full_(tire, touching), reduction_(reduction) {
  if (reduction_) reduced_.emplace(full_);
}

void TireInTime::set_history(const LossMaterials& losses, const Inflated& round) {
  full_.set_history(losses, round);
}

Result<TransientForces> TireInTime::start(const RollingState& steady,
                                          const RollingTransientSettings& settings) {
  return reduced_ ? reduced_->start(steady, settings, *reduction_) : full_.start(steady, settings);
}

Result<TransientForces> TireInTime::begin(const RollingState& steady,
                                          const RollingTransientSettings& settings) {
  return reduced_ ? reduced_->begin(steady, settings, *reduction_) : full_.start(steady, settings);
}

Result<TransientForces> TireInTime::advance(const WheelMoment& to, double step) {
  return reduced_ ? reduced_->advance(to, step) : full_.advance(to, step);
}

TireInTime::State TireInTime::state() const {
  return reduced_ ? State(reduced_->state()) : State(full_.state());
}

TireInTime::State TireInTime::take() {
  return reduced_ ? State(reduced_->take()) : State(full_.take());
}

void TireInTime::resume(State state) {
  if (reduced_)
    reduced_->resume(std::get<ReducedState>(std::move(state)));
  else
    full_.resume(std::get<TransientState>(std::move(state)));
}

const ReducedTire* TireInTime::reduced_tire() const {
  return reduced_ ? reduced_->state().tire.get() : nullptr;
}

}  // namespace latsch::fe_tire
