// SPDX-License-Identifier: Apache-2.0
// What sensors on a car record, a sample after the other.
//
//   time                                   s
//   pushrod_FL ... pushrod_RR              N, along the push-rod, compression positive
//   Fz_FL ...                              N, of the road on the tire: its contact's load, not the
//                                          force on the hub, where the inertia of a belt acts too
//   hub_FL ...                             m/s^2, of the wheel center, upward
//   spring_FL ...                          m, extension of the spring unit against rest; 0 of bars
//   body_z                                 m/s^2, of the chassis' center of mass, upward
//   heave, roll, pitch                     m, rad: of the chassis against its start; positive: up,
//                                          left side up, nose down
//   x, y                                   m, the chassis' way from where it was drawn
//   area_FL ...                            m^2, of contact, where it is asked for and known
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "measurement/channels.h"
#include "models/car/car.h"

namespace latsch::experiment {

/// Of four, by corner: "pushrod" gives "pushrod_FL" ...
std::array<std::string, car::kCorners> of_corners(const std::string& name);

/// Names and units of all of them but area, which stands last.
std::vector<std::pair<std::string, std::string>> car_channels(bool with_area);

/// Looks at a run at every sample.
using CarWatcher =
    std::function<void(const car::Car&, const car::CarState&, const road::Road&, double time)>;

class CarRecord {
 public:
  CarRecord(const car::Car& car, const car::CarState& start, bool with_area);

  /// As time is to be told.
  void sample(const car::CarState& state, const car::CarInputs& inputs, double time);
  Channels channels() const;
  const std::vector<double>& values(const std::string& channel) const;

 private:
  const car::Car& car_;
  bool with_area_;
  multibody::Pose start_;
  std::vector<std::pair<std::string, std::string>> names_;
  std::vector<std::vector<double>> values_;
};

}  // namespace latsch::experiment
