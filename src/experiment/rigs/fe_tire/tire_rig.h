// SPDX-License-Identifier: Apache-2.0
// Virtual tire rig: runs the tests of the laboratory on the finite-element tire.
//
// Channels of a load-deflection test, one value for each deflection in the order of the test:
// "deflection" (m), "loaded_radius" (m), "force" (N), "patch_length" (m), "patch_width" (m),
// "patch_area" (m^2). A loaded radius larger than the radius of the inflated tire means no contact:
// force and patch are 0. Channels of a modal test: those of mode_record.h, and for a loaded tire
// "deflection", "loaded_radius", "force" (one value each). If the tire rotates, if its rim moves or
// if the speed of standing waves is requested, the channels are those of spinning_rig.cpp. Other
// tests call tire() themselves.
//
// Every test has a load path of its own: a curve is computed by pressing the tire once through its
// deflections in ascending order; a single deflection is reached in five equal steps. The results
// of a test therefore do not depend on other tests. The inflated tire and the last path are kept: a
// test with exactly that path returns bitwise equal results.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "experiment/rigs/load_case.h"
#include "measurement/channels.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/slopes/tire_slopes.h"

namespace latsch::experiment {

class TireRig {
 public:
  /// Keeps a reference to the tire. `own_pressure`, Pa, applies to tests that state none.
  TireRig(fe_tire::FeTire& tire, double own_pressure) : tire_(tire), own_pressure_(own_pressure) {}

  Result<Channels> run(const LoadDeflection& test);
  Result<Channels> run(const ModalTest& test);
  /// Measures with slopes: of all channels except shapes, those of a patch and the standing state
  /// of a modal test only if they are requested in `asked`. Without friction and upright only.
  using Asked = std::vector<std::string>;
  Result<Channels> run(const LoadDeflection& test, fe_tire::TireSlopes& slopes, const Asked& asked);
  Result<Channels> run(const ModalTest& test, fe_tire::TireSlopes& slopes, const Asked& asked);

  /// Returns the tire inflated to a pressure, Pa, as it spins.
  Result<fe_tire::Inflated> spinning(double pressure, const SpinSpeed& speed);
  /// Sets the data of the rim, for tests in which it moves.
  void set_rim(std::optional<fe_tire::RimBody> rim) { rim_ = rim; }
  const std::optional<fe_tire::RimBody>& rim() const { return rim_; }
  /// Returns the state on the ground at the load or the deflection of a test, about which small
  /// motions are asked for.
  Result<fe_tire::TireState> stand(const ModalTest& test, const fe_tire::Inflated& inflated);
  /// Sets the Prony terms of rubbers and cords, for tests that measure losses. The default is an
  /// elastic tire.
  void set_losses(fe_tire::LossMaterials losses) { losses_ = std::move(losses); }
  const fe_tire::LossMaterials& losses() const { return losses_; }
  /// Sets the friction with the ground that the tire's file states, for tests that state none.
  void set_friction(std::optional<fe_tire::RollingFriction> friction) { friction_ = friction; }
  const std::optional<fe_tire::RollingFriction>& own_friction() const { return friction_; }

  /// Sets the highest frequency, Hz, of a tire that is reduced in tests in time; none: it is not.
  void set_reduction(std::optional<double> highest) { reduced_to_ = highest; }
  const std::optional<double>& reduced_to() const { return reduced_to_; }

  fe_tire::FeTire& tire() const { return tire_; }
  double own_pressure() const { return own_pressure_; }
  /// Returns the tire inflated to a pressure, Pa, on its rim and off the ground.
  const Result<fe_tire::Inflated>& inflated(double pressure);

 private:
  struct Pressed {
    std::vector<double> way;  // deflections, m
    fe_tire::Ground ground;
    Result<std::vector<fe_tire::TireState>> states;  // at the deflections
  };

  const Result<std::vector<fe_tire::TireState>>& pressed(const std::vector<double>& way,
                                                         const fe_tire::Ground& ground);
  struct Vibrating {
    std::optional<fe_tire::TireState> state;  // on the ground; none: not in contact
    std::vector<fe_tire::Mode> modes;
    std::vector<double> damping;  // shares of critical damping; empty: nothing relaxes
  };
  Result<Vibrating> vibrate(const ModalTest& test);
  /// Adds the lowest modes, damped if the test asks for it.
  Status add_modes(Vibrating& found, const fe_tire::Inflated& inflated, const ModalTest& test);
  Channels channels_of(const ModalTest& test, const Vibrating& found);
  Result<Channels> run_spinning(const ModalTest& test);
  struct StandSlopes;  // slopes of the standing state of a modal test
  Result<StandSlopes> slopes_of_stand(const ModalTest& test,
                                      const fe_tire::TireState& state,
                                      fe_tire::TireSlopes& slopes,
                                      const Asked& asked);

  fe_tire::FeTire& tire_;
  double own_pressure_, pressure_ = 0.0;
  std::optional<fe_tire::RimBody> rim_;
  fe_tire::LossMaterials losses_;
  std::optional<fe_tire::RollingFriction> friction_;
  std::optional<double> reduced_to_;
  std::optional<Result<fe_tire::Inflated>> inflated_;  // at pressure_
  std::optional<Pressed> pressed_;                     // pressed from the state inflated_
};

/// Returns the failure that damped modes of a tire without losses give.
Failure damping_of_elastic();

/// Default points for shapes: up to 3 sensors across the outer surface at up to 24 angles around,
/// [3 x points], m, wheel frame.
Eigen::Matrix3Xd default_points(const fe_tire::Mesh& mesh);

/// The node (of the whole ring) of the outer surface nearest to every point, and the greatest
/// distance, m.
struct NearestSensors {
  std::vector<int> nodes;
  double largest_distance = 0.0;
};
NearestSensors nearest_sensors(const fe_tire::Mesh& mesh, const Eigen::Matrix3Xd& points);

/// Fails if a point does not belong to the tire. A point may lie up to 25 mm from the wall: half of
/// that is a mount and its cable, the rest the difference between the drawing and the tire. A point
/// farther away has another unit or other axes. For points inside the wall, such as sensors on the
/// inner liner, the distance is that to the nearest face of the elements.
Status points_on_tire(const fe_tire::Mesh& mesh, const Eigen::Matrix3Xd& points);

}  // namespace latsch::experiment
