// SPDX-License-Identifier: Apache-2.0
// Records the sensors of a car, sample by sample.
//
//   time                                   s
//   pushrod_FL ... pushrod_RR              N, along the push-rod, compression positive
//   Fz_FL ...                              N, of the road on the tire: its contact's load, not the
//                                          force on the hub, where the inertia of a belt acts too
//   hub_FL ...                             m/s^2, of the wheel center, upward
//   spring_FL ...                          m, extension of the spring unit from rest; 0 for bars
//   body_z                                 m/s^2, of the chassis' center of mass, upward
//   heave, roll, pitch                     m, rad: of the chassis from its start; positive: up,
//                                          left side up, nose down
//   x, y                                   m, displacement of the chassis from its drawn position
//   area_FL ...                            m^2, of contact, if requested and known
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "measurement/channels.h"
#include "models/car/car.h"

namespace latsch::experiment {

/// Returns the names for the four corners: "pushrod" gives "pushrod_FL" ...
std::array<std::string, car::kCorners> of_corners(const std::string& name);

/// Returns names and units of all channels of a car; if `with_area` is true, the area is the last
/// one.
std::vector<std::pair<std::string, std::string>> car_channels(bool with_area);

/// Called at every sample of a run.
using CarWatcher =
    std::function<void(const car::Car&, const car::CarState&, const road::Road&, double time)>;

class CarRecord {
 public:
  CarRecord(const car::Car& car, const car::CarState& start, bool with_area);

  /// Records a sample; `time` is the time that is recorded with it.
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
