// SPDX-License-Identifier: Apache-2.0
// TireRig (tire_rig.h) with a tire that rotates off the ground, or whose rim moves.
//
// Channels besides those of mode_record.h, one value for each mode: "sense" (1 if the mode travels
// with the rotation, -1 against it, 0 neither), "frequency_on_tire" (Hz, seen by a sensor on the
// tire; "frequency" is seen from axes that do not rotate), and "shape_later", the shape a quarter
// of a period later, and if the test asks for damped modes "damping" (of critical). One value:
// "spin" (rad/s) and "outer_radius" (m) of the rotating tire and, if requested,
// "standing_wave_speed" (rad/s) and "standing_wave_n".
#include <fmt/format.h>

#include "base/error.h"
#include "experiment/rigs/fe_tire/tire_rig.h"
#include "experiment/rigs/mode_record.h"
#include "models/fe_tire/motion/damped_tire.h"
#include "models/fe_tire/motion/spinning_tire.h"

namespace latsch::experiment {
namespace {

double code(fe_tire::Sense sense) {
  return sense == fe_tire::Sense::with ? 1.0 : sense == fe_tire::Sense::against ? -1.0 : 0.0;
}

/// Returns the displacements of the sensor nodes in the wheel frame, one node after the other.
Eigen::VectorXd at_sensors(const fe_tire::Mesh& mesh,
                           const std::vector<int>& sensors,
                           const Eigen::Matrix3Xd& shape) {
  Eigen::VectorXd values(3 * std::ssize(sensors));
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    values.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        mesh.frame(sensors[i] / mesh.nodes_per_sector()) * shape.col(sensors[i]);
  }
  return values;
}

}  // namespace

Result<fe_tire::Inflated> TireRig::spinning(double pressure, const SpinSpeed& speed) {
  const auto& at_rest = inflated(pressure);
  if (!at_rest) return at_rest.failure();
  return fe_tire::SpinningTire(tire_).inflate(*at_rest, speed.on(at_rest->radius));
}

Result<Channels> TireRig::run_spinning(const ModalTest& test) {
  fe_tire::Rim rim{.motion = test.rim};
  if (test.rim != fe_tire::RimMotion::held) {
    if (!rim_)
      throw InputError(
          "the rim of this test moves, and the tire file states none: expected a table [rim] with "
          "mass, inertia_spin and inertia_diameter in it, or rim = \"held\"");
    rim.body = *rim_;
  }
  if (const Status near = points_on_tire(tire_.mesh(), test.points); !near) return near.failure();
  const double pressure = test.pressure.value_or(own_pressure_);
  const auto state = spinning(pressure, test.speed.value_or(SpinSpeed{}));
  if (!state) return state.failure();
  fe_tire::SpinningTire spinning(tire_);
  std::vector<double> damping;
  const auto modes = [&]() -> Result<std::vector<fe_tire::SpinningMode>> {
    if (!test.is_damped) return spinning.modes(*state, rim, test.count);
    if (losses_.is_elastic()) return damping_of_elastic();
    auto damped = fe_tire::DampedTire(tire_, losses_).modes(*state, rim, test.count);
    if (!damped) return damped.failure();
    std::vector<fe_tire::SpinningMode> found;
    for (fe_tire::DecayingWave& wave : *damped) {
      found.push_back(std::move(wave.mode));
      damping.push_back(wave.damping);
    }
    return found;
  }();
  if (!modes) return modes.failure();
  const auto sensors = nearest_sensors(tire_.mesh(), test.points).nodes;
  std::vector<ModeRecord> records;
  Channel sense{"sense", "1", {}}, on_tire{"frequency_on_tire", "Hz", {}};
  Channel later{"shape_later", "1", {}};
  for (const fe_tire::SpinningMode& mode : *modes) {
    records.push_back({mode.frequency,
                       mode.n,
                       mode.type,
                       ' ',
                       at_sensors(tire_.mesh(), sensors, mode.shape.real())});
    sense.values.push_back(code(mode.sense));
    on_tire.values.push_back(mode.frequency_on_tire);
    // Re(shape exp(i omega t)) is -Im(shape) after a quarter of a period.
    const Eigen::VectorXd next = -at_sensors(tire_.mesh(), sensors, mode.shape.imag());
    later.values.insert(later.values.end(), next.begin(), next.end());
  }
  Channels channels = to_channels(records);
  if (!damping.empty()) channels.add({"damping", "1", std::move(damping)});
  channels.add(std::move(sense));
  channels.add(std::move(on_tire));
  if (!later.values.empty()) channels.add(std::move(later));
  channels.add({"spin", "rad/s", {state->spin}});
  channels.add({"outer_radius", "m", {state->radius}});
  if (!test.standing_wave) return channels;
  const auto wave = spinning.standing_wave(*inflated(pressure));
  if (!wave) return wave.failure();
  channels.add({"standing_wave_speed", "rad/s", {wave->speed}});
  channels.add({"standing_wave_n", "1", {static_cast<double>(wave->n)}});
  return channels;
}

}  // namespace latsch::experiment
