// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/car/car_record.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace latsch::experiment {

using car::kCorners;
using Eigen::Vector3d;

std::array<std::string, kCorners> of_corners(const std::string& name) {
  std::array<std::string, kCorners> names;
  for (std::size_t i = 0; i < kCorners; ++i) names[i] = name + "_" + car::kCornerNames[i];
  return names;
}

std::vector<std::pair<std::string, std::string>> car_channels(bool with_area) {
  std::vector<std::pair<std::string, std::string>> names = {{"time", "s"}};
  const auto add = [&](const char* name, const char* unit) {
    for (const std::string& one : of_corners(name)) names.emplace_back(one, unit);
  };
  add("pushrod", "N");
  add("Fz", "N");
  add("hub", "m/s^2");
  add("spring", "m");
  for (const auto& [name, unit] : {std::pair{"body_z", "m/s^2"},
                                   {"heave", "m"},
                                   {"roll", "rad"},
                                   {"pitch", "rad"},
                                   {"x", "m"},
                                   {"y", "m"}})
    names.emplace_back(name, unit);
  if (with_area) add("area", "m^2");
  return names;
}

CarRecord::CarRecord(const car::Car& car, const car::CarState& start, bool with_area)
    : car_(car),
      with_area_(with_area),
      start_(start.bodies.poses[static_cast<std::size_t>(car.parts().chassis)]),
      names_(car_channels(with_area)),
      values_(names_.size()) {}

namespace {

double upward_acceleration_of_hub(const car::Car& car, const car::CarState& state, int corner) {
  const car::CornerParts& parts = car.parts().corners[static_cast<std::size_t>(corner)];
  const auto body = static_cast<std::size_t>(parts.upright);
  const Vector3d arm =
      state.bodies.poses[body].turn * (parts.wheel_center - car.mechanism().bodies()[body].origin);
  const Vector3d w = state.bodies.rates.segment<3>(6 * parts.upright + 3),
                 a = state.bodies.accelerations.segment<3>(6 * parts.upright),
                 turning = state.bodies.accelerations.segment<3>(6 * parts.upright + 3);
  return (a + turning.cross(arm) + w.cross(w.cross(arm))).z();
}

}  // namespace

void CarRecord::sample(const car::CarState& state, const car::CarInputs& inputs, double time) {
  std::size_t column = 0;
  const auto put = [&](double value) { values_[column++].push_back(value); };
  put(time);
  for (const double force : car_.pushrod_forces(state, inputs)) put(force);
  std::array<std::optional<Footprint>, kCorners> footprints;
  for (std::size_t i = 0; i < kCorners; ++i) footprints[i] = state.wheels[i].tire->footprint();
  // For a tire that does not report the load of the road, which has no belt, the load equals the
  // force on the hub.
  const auto at_hubs = car_.vertical_forces(state);
  for (std::size_t i = 0; i < kCorners; ++i)
    put(footprints[i] ? footprints[i]->load
                      : state.wheels[i].tire->road_load().value_or(at_hubs[i]));
  for (int corner = 0; corner < kCorners; ++corner)
    put(upward_acceleration_of_hub(car_, state, corner));
  for (int corner = 0; corner < kCorners; ++corner) put(car_.spring_extension(state, corner));
  const int chassis = car_.parts().chassis;
  const multibody::Pose& pose = state.bodies.poses[static_cast<std::size_t>(chassis)];
  const Eigen::Matrix3d turned = pose.turn * start_.turn.transpose();
  put(state.bodies.accelerations[6 * chassis + 2]);
  put(pose.place.z() - start_.place.z());
  put(std::atan2(turned(2, 1), turned(2, 2)));
  put(-std::asin(std::clamp(turned(2, 0), -1.0, 1.0)));
  put(pose.place.x() - car_.mechanism().bodies()[static_cast<std::size_t>(chassis)].origin.x());
  put(pose.place.y() - car_.mechanism().bodies()[static_cast<std::size_t>(chassis)].origin.y());
  if (!with_area_) return;
  for (const auto& footprint : footprints) put(footprint ? footprint->area : 0.0);
}

Channels CarRecord::channels() const {
  Channels channels;
  for (std::size_t i = 0; i < names_.size(); ++i)
    channels.add({names_[i].first, names_[i].second, values_[i]});
  return channels;
}

const std::vector<double>& CarRecord::values(const std::string& channel) const {
  const auto found = std::find_if(
      names_.begin(), names_.end(), [&](const auto& name) { return name.first == channel; });
  assert(found != names_.end());
  return values_[static_cast<std::size_t>(found - names_.begin())];
}

}  // namespace latsch::experiment
