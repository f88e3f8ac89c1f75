// SPDX-License-Identifier: Apache-2.0
// Remembers the greatest inputs that a car as a unit was given, and says which of them no car has:
// programs that connect units convert no units, so a rack in mm or a torque in N mm arrives as a
// number that is a thousand times too large.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "exchange/unit/unit.h"

namespace latsch::exchange {

class CarInputWatch {
 public:
  /// Records an input or a parameter of a step; its sign does not matter.
  void add(const ExchangedVariable& variable, double value);
  /// Records a largest torque of a brake, which is cut at 0.
  void add_brake(const ExchangedVariable& variable, double value);
  /// Records the weight of the car, N, by which its loads and torques are judged.
  void set_weight(double newtons) { weight_ = newtons; }
  /// Records the distance, m, by which a step of the car moved it.
  void add_way(double metres);
  /// Records the deflection, m, of a tire of this free radius, m.
  void add_deflection(double deflection, double free_radius);

  /// Returns a sentence for every value beyond that of any car.
  std::vector<std::string> sentences() const;

 private:
  struct Greatest {
    std::string unit;
    double value = 0.0;
  };
  std::map<std::string, Greatest> greatest_;
  std::string negative_brake_;
  double weight_ = 0.0, way_ = 0.0, deflection_ = 0.0, free_radius_ = 0.0;
};

}  // namespace latsch::exchange
