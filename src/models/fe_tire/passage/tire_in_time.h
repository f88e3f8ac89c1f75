// SPDX-License-Identifier: Apache-2.0
// A finite-element tire in time, full (rolling_transient.h) or reduced (reduced_passage.h), with
// one language for both.
#pragma once

#include <optional>
#include <variant>

#include "models/fe_tire/passage/reduced_passage.h"
#include "models/fe_tire/passage/rolling_transient.h"

namespace latsch::fe_tire {

class TireInTime {
 public:
  /// A state as a value, of the kind of tire that made it.
  using State = std::variant<TransientState, ReducedState>;

  /// Keeps a reference to the tire. `touching`, rad, as in RollingTransient. `reduction`: none if
  /// the tire moves in all its unknowns.
  TireInTime(FeTire& tire, double touching, const std::optional<ReductionSettings>& reduction);

  void set_history(const LossMaterials& losses, const Inflated& round);
  Result<TransientForces> start(const RollingState& steady,
                                const RollingTransientSettings& settings);
  /// Begins like start(), but a reduced tire is made by the first step.
  Result<TransientForces> begin(const RollingState& steady,
                                const RollingTransientSettings& settings);
  Result<TransientForces> advance(const WheelMoment& to, double step);

  State state() const;
  State take();
  void resume(State state);
  double touching() const { return full_.touching(); }
  double half_width() const { return full_.half_width(); }
  /// Returns the reduced tire of the present state, if it is reduced.
  const ReducedTire* reduced_tire() const;

 private:
  RollingTransient full_;
  std::optional<ReductionSettings> reduction_;
  std::optional<ReducedPassage> reduced_;  // refers to full_

 public:
  TireInTime(const TireInTime&) = delete;
  TireInTime& operator=(const TireInTime&) = delete;
};

}  // namespace latsch::fe_tire
