// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/vibration_rig.h"

#include <Eigen/Geometry>

#include "experiment/rigs/drum_rig.h"
#include "experiment/rigs/mode_record.h"
#include "models/ring_tire/ring/standing_modes.h"
#include "models/road/plane_road.h"
#include "models/tire/tared_tire.h"

namespace latsch::experiment {
namespace {

/// Only a motion of the whole belt around the circumference is called torsional; all other modes in
/// the plane are called radial.
fe_tire::ModeType type_of(const ring_tire::StandingMode& mode) {
  if (mode.lateral) return fe_tire::ModeType::lateral;
  const bool around = mode.shape.row(1).norm() > mode.shape.row(0).norm();
  return mode.n == 0 && around ? fe_tire::ModeType::torsional : fe_tire::ModeType::radial;
}

}  // namespace

Result<Channels> run(ring_tire::RingTire& tire, const ModalTest& test) {
  if (test.ground.mu != 0.0)
    throw InputError(
        "a flexible ring has friction in its own file: expected a test of modes without it");
  if (test.moves())
    throw InputError(
        "a flexible ring's modes are computed at rest with its rim held: expected a test of modes "
        "without speed, rim and standing_wave");
  if (test.points.cols() > 0)
    throw InputError(
        "modes of a flexible ring are paired by label: expected a measurement without "
        "shapes");
  if (test.count > tire.parameters().nodes)
    return Failure{
        "a ring has few meaningful modes: expected a count of at most its number of nodes"};
  const road::PlaneRoad ground;
  WheelMotion motion;
  motion.carrier = Eigen::AngleAxisd(test.camber, Eigen::Vector3d::UnitX()).toRotationMatrix();
  motion.center.z() =
      test.deflection ? tire.free_radius() - *test.deflection : 2.0 * tire.free_radius();
  if (test.load) {
    const auto height =
        height_under_load(tire, ground, motion.carrier, *test.load - weight_in_air(tire));
    if (!height) return height.failure();
    motion.center.z() = *height;
  }
  const auto hub = tire.settle(motion, ground, 0.0);
  if (!hub) return hub.failure();
  const auto modes = standing_modes(tire, test.count);
  if (!modes) return modes.failure();
  std::vector<ModeRecord> records;
  Channel damping{"damping", "1", {}};
  for (const ring_tire::StandingMode& mode : *modes) {
    records.push_back({mode.frequency, mode.n, type_of(mode), mode.phase, {}});
    damping.values.push_back(mode.damping);
  }
  Channels channels = to_channels(records);
  channels.add(std::move(damping));
  return channels;
}

}  // namespace latsch::experiment
