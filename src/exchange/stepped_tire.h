// SPDX-License-Identifier: Apache-2.0
// Converts calls at arbitrary times into steps of a tire. An integrator calls DTYRE for forces at
// any times that it tries, repeatedly and also going back; a tire advances from a state by a step.
// So states are kept with their times, and forces at t are those of a step from the latest kept
// state before t:
//
//   the first t, or none later than it   the tire is settled there, at rest
//   t grows                              a step from the last call's state
//   the same t                           the step that led there, to the motion of this call
//   an earlier t                         later states are forgotten, then as above
//
// A step that an integrator tries and rejects costs only computing time. The last 64 states are
// kept; going back beyond them, except to the start, is an error.
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "base/result.h"
#include "models/road/road.h"
#include "models/tire/tire.h"

namespace latsch::exchange {

class SteppedTire {
 public:
  explicit SteppedTire(std::unique_ptr<Tire> tire) : unused_(std::move(tire)) {}

  double free_radius() const { return unused_->free_radius(); }
  /// `keep` says that later steps may start from this state. A Failure keeps no new state.
  Result<HubForces> forces(const WheelMotion& motion,
                           const road::Road& road,
                           double time,
                           bool keep);

 private:
  struct Kept {
    double time;
    std::unique_ptr<Tire> tire;
  };
  static constexpr std::size_t kMost = 64;

  std::unique_ptr<Tire> unused_;
  std::deque<Kept> kept_;  // in order of time
  std::optional<double> start_;
};

}  // namespace latsch::exchange
