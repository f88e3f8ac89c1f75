// SPDX-License-Identifier: Apache-2.0
// Records when a tire does not touch the road in a simulation that assumes contact. A tire model
// without mass then has no force. A model with a belt still exerts a force on the hub because of
// the belt's inertia, which is no load of the road.
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

/// Returns the tire on a rig whose load cell is tared (tared_tire.h), and records its steps in a
/// log. The log must outlive the tire.
std::unique_ptr<Tire> watched(std::unique_ptr<Tire> tire, LiftLog& log);

}  // namespace latsch
