// SPDX-License-Identifier: Apache-2.0
// A car on its tires: the mechanism of its bodies (multibody/transient.h) with a tire of any kind
// on each wheel, a step of time after the other.
//
//   wheel: I w' = My + T + B, solved with the tire's step     T: drive, B: brake
//   on the upright: the hub's force and moment but for My, -I w (ω × a) of the spinning wheel, -B
//   on the chassis: aero loads, -T, and what guides it
// The tires are asked once a step, at the motion that is predicted for its end. The mechanism,
// which vibrates faster than they do, takes two steps meanwhile, on tires' forces, loads and a rack
// that change evenly. A guide keeps the car on its line and at its speed in a driver's place:
// springs and dampers between the chassis and a point that goes straight on at constant speed, soft
// against the tires. Across and in yaw it holds the chassis at its center of mass. Along it pulls
// as a driven axle does whose shafts come from the chassis: P on the wheel centers and -P r, r the
// loaded radius, on the chassis, together a force at the contact. It begins with what it has to
// bear (drag, rolling losses, side forces of the tires): the car starts in balance.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "models/car/car_mechanism.h"
#include "models/multibody/transient.h"
#include "models/tire/free_wheel.h"
#include "models/tire/tire.h"

namespace latsch::car {

using Tires = std::array<std::unique_ptr<Tire>, kCorners>;

/// Holds the chassis against a point that moves along x.
struct Guide {
  double y = 0.0;        // m, of the line of the car's middle; beside that of a GuidePoint
  double lateral = 2e4;  // N/m; damped critically with the car's mass
  double yaw = 5e4;      // N m/rad
  double along = 2e4;    // N/m
  /// Shares of the front and the rear axle in the pull along; together 1.
  std::array<double, 2> drives = {0.0, 1.0};
};

/// What the guide does before its point and the car part: it is the same all the way.
struct Trim {
  double along = 0.0, lateral = 0.0;   // N
  double yaw = 0.0;                    // N m
  std::array<double, kCorners> arm{};  // m, wheel center over the road: of the pull's reaction
  bool operator==(const Trim&) const = default;
};

/// Where the guide is: by how far it has gone along x, m, at which speed, on which line.
struct GuidePoint {
  double x, speed, y;
};

/// At the end of a step.
struct CarInputs {
  double rack = 0.0;                              // m, to the left
  std::vector<multibody::Load> loads = {};        // aero and others, on bodies of the mechanism
  std::array<double, kCorners> drive{}, brake{};  // N m
  std::optional<GuidePoint> guide = {};           // none: straight on at the speed it started with
};

struct WheelState {
  std::unique_ptr<Tire> tire;
  FreeWheel wheel;
  WheelMotion motion;
  HubForces hub;              // in C
  double brake_moment = 0.0;  // N m, on the wheel

  WheelState() = default;
  WheelState(const WheelState& other);
  WheelState& operator=(const WheelState& other);
  WheelState(WheelState&&) = default;
  WheelState& operator=(WheelState&&) = default;
};

/// A value: copied with its tires, restored by assignment. Equal: all motions and forces are; what
/// tires remember beyond their forces is not looked at.
struct CarState {
  multibody::MechanismState bodies;
  std::array<WheelState, kCorners> wheels;
  double speed = 0.0;  // m/s, of the guide
  Trim trim;
  double rack = 0.0;  // m, and loads: of the last step's inputs
  std::vector<multibody::Load> loads;

  double time() const { return bodies.time; }
  bool operator==(const CarState& other) const;
};

class Car {
 public:
  /// Parameters without fault(). Its springs carry it as it is drawn, at rest on tires that stand
  /// on z = 0 with the loads of the inputs: their preloads follow from that.
  static Result<std::unique_ptr<Car>> make(const CarParameters& parameters,
                                           const Tires& tires,
                                           const CarInputs& at_rest = {},
                                           const multibody::TransientSettings& settings = {});

  const CarParameters& parameters() const { return parameters_; }
  const multibody::Mechanism& mechanism() const { return *mechanism_; }
  const CarParts& parts() const { return parts_; }
  Guide guide = {};
  /// Of the mechanism to one of the tires.
  int mechanism_steps = 2;

  /// At rest on the road, or at constant speed: poses, tires in equilibrium, spins of rolling. At
  /// speed the tires roll up to their place on level ground, so that they have grown with the
  /// speed, lost what pressing down has left, and turn as freely as they do.
  Result<CarState> settle(const road::Road& road, double speed, const CarInputs& inputs);
  /// Whether a tire may stand beyond what is known of its road (Road::beyond); else it is a
  /// Failure.
  bool may_leave_road = false;
  /// One step. After a Failure, which names the part and the time, the state is of no more use.
  Result<bool> advance(CarState& state,
                       double step,
                       const road::Road& road,
                       const CarInputs& inputs);

  /// N along the push-rod, compression positive.
  std::array<double, kCorners> pushrod_forces(const CarState& state,
                                              const CarInputs& inputs = {}) const;
  /// As it moves, for the forces of its elements; it lives as long as the state.
  multibody::Motion motion_of(const CarState& state) const;
  const multibody::Assembly& assembly() const { return transient_->assembly(); }
  /// m, of its spring unit against rest; 0 where it is locked.
  double spring_extension(const CarState& state, int corner) const;
  /// N, upward, of each tire on its hub: with the inertia of a belt that moves.
  std::array<double, kCorners> vertical_forces(const CarState& state) const;
  WheelMotion motion_of_wheel(int corner,
                              const multibody::Poses& poses,
                              const Eigen::VectorXd* rates) const;
  /// The pose of a material point of a body that was at `at_rest`.
  Eigen::Vector3d point(const CarState& state, int body, const Eigen::Vector3d& at_rest) const;

  /// What the guide does to the chassis, with its slopes, where it stands: along it holds the
  /// chassis' center, so that statics and linear models have its slope there.
  void add_guide(const multibody::Motion& motion,
                 const GuidePoint& point,
                 std::vector<multibody::Wrench>& wrenches) const;
  /// The same in motion: along it pulls by the driven axle, with what it began with.
  void add_guide(const multibody::Motion& motion,
                 const GuidePoint& point,
                 const Trim& trim,
                 std::vector<multibody::Wrench>& wrenches) const;

  /// What air does to the chassis at a forward speed, with its slopes; nothing without a map.
  void add_air(const multibody::Motion& motion,
               double speed,
               std::vector<multibody::Wrench>& wrenches) const;

  multibody::Equilibrium& statics() { return *statics_; }

 private:
  /// The guide's springs hold so much harder at rest than in motion: the car stays where it is.
  static constexpr double kStill = 1e3;

  Car(const CarParameters& parameters, const multibody::TransientSettings& settings);
  /// Tires as straight lines about the place where they are, for statics.
  struct LineTire {
    double force = 0.0, stiffness = 0.0, height = 0.0;         // N, N/m, m: of the wheel center
    multibody::Vector6d beside = multibody::Vector6d::Zero();  // what else acts at the wheel center
  };
  using LineTires = std::array<LineTire, kCorners>;
  /// With the pull of `trim`, to which what the guide still held along is added: N, in `held`.
  Result<multibody::Rest> stand(const LineTires& tires,
                                double speed,
                                const CarInputs& inputs,
                                const multibody::Rest& from,
                                Trim& trim,
                                double* held = nullptr);
  /// P by the driven axle: on its wheel centers, its reaction on the chassis.
  void add_pull(const multibody::Motion& motion,
                double pull,
                const Trim& trim,
                std::vector<multibody::Wrench>& wrenches) const;
  /// How far the car has sunk where it rests, in words, at its worst corner.
  std::string sunk(const multibody::Rest& rest, const LineTires& tires, double speed) const;
  /// How far the chassis is from the guide's line and heading there, m, m, rad.
  Eigen::Vector3d off_guide(const multibody::Pose& chassis, const GuidePoint& point) const;
  /// Static equilibrium on tires that are pressed down, at rest or spinning.
  Result<multibody::Rest> settle_on_tires(CarState& state,
                                          LineTires& lines,
                                          const road::Road& road,
                                          const CarInputs& inputs);
  /// The same on tires that have rolled up to where they stand.
  Result<multibody::Rest> roll_in(CarState& state,
                                  LineTires& lines,
                                  const multibody::Rest& rest,
                                  const road::Road& road,
                                  const CarInputs& inputs);
  void rebuild(std::vector<multibody::Strut> struts);
  /// Of struts with preloads: a unit that no spring of its kind could be, or empty.
  std::string fault_of_spring(int corner, const std::vector<multibody::Strut>& springs) const;
  /// Of its center, and angular; of a motion that has rates and accelerations.
  multibody::Vector6d acceleration_of_wheel(int corner, const multibody::Motion& motion) const;
  /// The tires' step: to where the wheels will be `ahead` seconds after this motion.
  std::string roll(CarState& next,
                   const multibody::Motion& motion,
                   double ahead,
                   double step,
                   const road::Road& road,
                   const CarInputs& inputs) const;
  /// What tires, drive and guide do in this motion; of tires' forces `share` of those now, the rest
  /// of those before.
  void add_wheels(const CarState& state,
                  const std::array<HubForces, kCorners>& before,
                  double share,
                  const multibody::Motion& motion,
                  const CarInputs& inputs,
                  const GuidePoint& guide,
                  std::vector<multibody::Wrench>& wrenches) const;
  Eigen::Vector3d wheel_center_in_upright(int corner) const;
  /// Of the point below the wheel in its plane; empty: there is road.
  std::string off_road(int corner, const WheelMotion& wheel, const road::Road& road) const;
  const AxleMasses& masses(int corner) const;

  CarParameters parameters_;
  multibody::TransientSettings settings_;
  std::unique_ptr<multibody::Mechanism> mechanism_;
  CarParts parts_;
  std::unique_ptr<multibody::Equilibrium> statics_;
  std::unique_ptr<multibody::Transient> transient_;
  Tires tires_;  // at rest, off the road
};

}  // namespace latsch::car
