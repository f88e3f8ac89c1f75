// SPDX-License-Identifier: Apache-2.0
// Records when a tire did not touch the road in a run that assumes contact. Off the road a tire
// without mass has no force. A tire with a belt still has a force on the hub from the belt's
// inertia, which is no load of the road.
#pragma once

#include <memory>
#include <string>

#include "models/tire/tire.h"

namespace latsch {

class LiftLog {
 public:
  /// Takes the end of a step, s, its length, s, the load of the road, N, and Fz on the hub, N. A
  /// load of 0 or less is a tire off the road.
  void see(double time, double step, double load, double hub_Fz);
  /// Returns a sentence on when the tire was off the road and on Fz in this time; empty if it
  /// touched the road in every step.
  std::string sentence() const;

 private:
  /// s; first, last and total time of the steps off the road
  double first_ = 0.0, last_ = 0.0, total_ = 0.0;
  double hub_least_ = 0.0, hub_most_ = 0.0;  // N: Fz on the hub in these steps
  long lifts_ = 0;                           // separate stretches off the road
  bool off_ = false;                         // in the last step
};

/// Returns the tire on a tared rig (tared_tire.h) with a log of its steps. The log has to live
/// longer than the tire.
std::unique_ptr<Tire> watched(std::unique_ptr<Tire> tire, LiftLog& log);

}  // namespace latsch
