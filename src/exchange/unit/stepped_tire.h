// SPDX-License-Identifier: Apache-2.0
// Converts calls at arbitrary times to time steps of a tire. An integrator calls DTYRE for forces
// at any times that it tries, repeatedly and also going back, while a tire advances from a state by
// a step. Therefore states are kept with their times, and the forces at a time t are those of a
// step from the latest kept state before t:
//
//   the first call, or t not later      the tire is set at rest at t
//     than the first kept state
//   a later t                           a step from the state of the last call
//   the same t                          the last step is repeated with the motion of this call
//   an earlier t                        later states are dropped, then as for a later t
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
  /// Returns the forces at this time. `keep` says that later steps may start from the new state. If
  /// the result is a Failure, no state is kept.
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
  std::deque<Kept> kept_;  // in ascending order of time
  std::optional<double> start_;
};

}  // namespace latsch::exchange
