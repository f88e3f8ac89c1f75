// SPDX-License-Identifier: Apache-2.0
// A car on its tires: the mechanism of its bodies (multibody/transient.h) with a tire of any kind
// on each wheel, advanced in steps of time.
//
//   wheel: I w' = My + T + B, solved with the tire's step     T: drive, B: brake
//   on the upright: the hub's force and moment without My, -I w (ω × a) of the spinning wheel, -B
//   on the chassis: aero loads, -T, and the guide
// The tires are evaluated once per step, at the motion predicted for its end. The mechanism
// vibrates faster than the tires and is advanced in two steps during this time, with tire forces,
// loads and rack position that change linearly. In place of a driver, a guide keeps the car on its
// line and at its speed. It consists of springs and dampers, much softer than the tires, between
// the chassis and a point that moves straight ahead at constant speed. Laterally and in yaw it
// holds the chassis at its center of mass. Longitudinally it acts like a driven axle with drive
// shafts from the chassis: a force P on the wheel centers and a moment -P r on the chassis, with r
// the loaded radius, which together are equivalent to a force at the contact points. At the start
// the guide bears exactly the force that the car needs (drag, rolling losses, side forces of the
// tires), so the car starts in equilibrium.
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

/// The four tires of a car, in the order of its corners (front left, front right, rear left, rear
/// right).
using Tires = std::array<std::unique_ptr<Tire>, kCorners>;

/// Parameters of the guide, which holds the chassis against a point that moves along x.
struct Guide {
  double y = 0.0;  // m, lateral position of the car's middle, added to that of a GuidePoint
  /// N/m, lateral stiffness; the lateral damping is critical for the car's mass
  double lateral = 2e4;
  double yaw = 5e4;    // N m/rad
  double along = 2e4;  // N/m
  /// Shares of the front and the rear axle in the longitudinal pull; together 1.
  std::array<double, 2> drives = {0.0, 1.0};
};

/// Constant forces of the guide that act from the start, before the car deviates from the guide's
/// point.
struct Trim {
  double along = 0.0, lateral = 0.0;  // N
  double yaw = 0.0;                   // N m
  /// Height of the wheel center above the road, m: arm of the reaction to the longitudinal pull.
  std::array<double, kCorners> arm{};
  bool operator==(const Trim&) const = default;
};

/// State of the guide's point: distance along x (m), speed (m/s), and lateral position of its line
/// (m).
struct GuidePoint {
  double x, speed, y;  // m, m/s, m to the left
};

/// Inputs of a car (rack, loads, guide) at the end of a step.
struct CarInputs {
  double rack = 0.0;  // m, displacement of the rack to the left
  /// Aerodynamic and other loads on bodies of the mechanism.
  std::vector<multibody::Load> loads = {};
  std::array<double, kCorners> drive{}, brake{};  // N m
  /// Not set: the guide moves straight ahead at the initial speed.
  std::optional<GuidePoint> guide = {};
};

/// State of a wheel and its tire.
struct WheelState {
  std::unique_ptr<Tire> tire;  // tire with its internal state
  FreeWheel wheel;             // spin of the wheel
  WheelMotion motion;          // motion of the rim
  HubForces hub;               // in C
  double brake_moment = 0.0;   // N m, on the wheel

  WheelState() = default;
  /// Copies the tire with its internal state.
  WheelState(const WheelState& other);
  /// Copies the tire with its internal state.
  WheelState& operator=(const WheelState& other);
  WheelState(WheelState&&) = default;
  WheelState& operator=(WheelState&&) = default;
};

/// The state is a value: copied with its tires, restored by assignment. Two states are equal if all
/// motions and forces are; internal states of tires are not compared.
struct CarState {
  multibody::MechanismState bodies;         // poses and rates of the bodies, and the time
  std::array<WheelState, kCorners> wheels;  // front left, front right, rear left, rear right
  double speed = 0.0;                       // m/s, speed of the guide's point
  Trim trim;                                // constant forces of the guide
  double rack = 0.0;                        // m, rack and loads of the last step's inputs
  std::vector<multibody::Load> loads;       // loads of the last step

  /// Time, s.
  double time() const { return bodies.time; }
  /// Compares motions and forces, not the internal states of tires.
  bool operator==(const CarState& other) const;
};

/// A car made from a set of parameters, on four tires, held on its line by a guide.
class Car {
 public:
  /// Makes a car. The parameters must have no fault(). The preloads of the springs are chosen such
  /// that they carry the car in its drawn position, at rest on tires that stand on z = 0, under the
  /// loads of the inputs.
  static Result<std::unique_ptr<Car>> make(const CarParameters& parameters,
                                           const Tires& tires,
                                           const CarInputs& at_rest = {},
                                           const multibody::TransientSettings& settings = {});

  /// A corner whose tire does not fit under its wheel center.
  struct Misfit {
    int corner;       // index, in the order of the corners
    std::string why;  // one sentence
  };
  /// Returns the first corner whose tire does not fit; nullopt if all fit.
  static std::optional<Misfit> misfit(const CarParts& parts, const Tires& tires);

  /// The parameters from which this car was made.
  const CarParameters& parameters() const { return parameters_; }
  /// The mechanism of this car: its bodies, joints and struts.
  const multibody::Mechanism& mechanism() const { return *mechanism_; }
  /// Indices of the car's bodies and elements in the mechanism.
  const CarParts& parts() const { return parts_; }
  /// The guide that keeps the car on its line. It may be changed before settle() is called.
  Guide guide = {};
  /// Number of steps of the mechanism per step of the tires.
  int mechanism_steps = 2;

  /// Returns the state of equilibrium on the road, at rest or at constant speed: poses of the
  /// bodies, tires in equilibrium, spins of rolling wheels. At speed the tires first roll toward
  /// the start on level ground. They have then grown with the speed, have lost the deformation of
  /// being pressed down at rest, and turn at the free rolling speed. If all tires start steadily,
  /// they begin in that state.
  Result<CarState> settle(const road::Road& road, double speed, const CarInputs& inputs);
  /// If true, a tire may leave the known part of its road (Road::beyond). If false, this is a
  /// Failure.
  bool may_leave_road = false;
  /// Takes one step. After a Failure, which names the part and the time, the state must not be
  /// used.
  Status advance(CarState& state, double step, const road::Road& road, const CarInputs& inputs);

  /// Returns the force along the push-rod, N, compression positive.
  std::array<double, kCorners> pushrod_forces(const CarState& state,
                                              const CarInputs& inputs = {}) const;
  /// Returns the motion of the bodies as the elements' force laws need it. It refers to `state`,
  /// which must outlive it.
  multibody::Motion motion_of(const CarState& state) const;
  /// The equations of motion of the car's bodies.
  const multibody::Assembly& assembly() const { return transient_->assembly(); }
  /// Returns how much longer the spring unit of a corner is than at rest, m; 0 if it is locked.
  double spring_extension(const CarState& state, int corner) const;
  /// Returns the upward force of each tire on its hub, N, including the inertia of a moving belt.
  std::array<double, kCorners> vertical_forces(const CarState& state) const;
  /// Returns the motion of a wheel for these poses and rates of the bodies. If `rates` is nullptr,
  /// the wheel is at rest.
  WheelMotion motion_of_wheel(int corner,
                              const multibody::Poses& poses,
                              const Eigen::VectorXd* rates) const;
  /// Returns the current position, m, of the material point of a body that was at the position
  /// `at_rest` when the car stood as drawn.
  Eigen::Vector3d point(const CarState& state, int body, const Eigen::Vector3d& at_rest) const;

  /// Adds the guide's wrench on the chassis and its derivatives, for a car at rest. Longitudinally
  /// the guide holds the center of the chassis, so that statics and linear models have a stiffness
  /// in that direction.
  void add_guide(const multibody::Motion& motion,
                 const GuidePoint& point,
                 std::vector<multibody::BodyForce>& wrenches) const;
  /// Adds the guide's wrench for a moving car. Longitudinally the guide pulls through the driven
  /// axle with its initial force.
  void add_guide(const multibody::Motion& motion,
                 const GuidePoint& point,
                 const Trim& trim,
                 std::vector<multibody::BodyForce>& wrenches) const;

  /// Adds the aerodynamic wrench on the chassis at a forward speed, with its derivatives. Adds
  /// nothing if the car has no aerodynamic map.
  void add_air(const multibody::Motion& motion,
               double speed,
               std::vector<multibody::BodyForce>& wrenches) const;

  /// Returns the heights of the floor above the plane z = 0 at the front and at the rear axle, m,
  /// over which the map of air forces is read; nullopt if the car has no such map.
  std::optional<std::array<double, 2>> floor_heights(const CarState& state) const;

  /// The solver for the static equilibrium of the car's bodies.
  multibody::Equilibrium& statics() { return *statics_; }

 private:
  /// Factor by which the guide is stiffer for a car at rest, so that it holds the car at its
  /// position.
  static constexpr double kStill = 1e3;

  Car(const CarParameters& parameters, const multibody::TransientSettings& settings);
  /// The four tires with their vertical forces linearized about their current state, for the static
  /// equilibrium.
  struct LineTire {
    double force = 0.0, stiffness = 0.0, height = 0.0;  // N; N/m; m, height of the wheel center
    // Other forces and moments at the wheel center.
    multibody::Vector6d beside = multibody::Vector6d::Zero();
  };
  using LineTires = std::array<LineTire, kCorners>;
  /// Solves the static equilibrium with the longitudinal pull of `trim`. Adds to this pull the
  /// longitudinal force, N, that the guide still carries, and returns that force in `held`.
  Result<multibody::Rest> stand(const LineTires& tires,
                                double speed,
                                const CarInputs& inputs,
                                const multibody::Rest& from,
                                Trim& trim,
                                double* held = nullptr);
  /// Adds the pull P of the driven axle: forces on its wheel centers, and the reaction on the
  /// chassis.
  void add_pull(const multibody::Motion& motion,
                double pull,
                const Trim& trim,
                std::vector<multibody::BodyForce>& wrenches) const;
  /// Describes in words how far the car at rest has sunk at the corner that sank most.
  std::string sunk(const multibody::Rest& rest, const LineTires& tires, double speed) const;
  /// Describes the forces on the car as drawn, for the case that no share of them leads to an
  /// equilibrium.
  std::string unstable_as_drawn(double speed) const;
  /// Returns the deviation of the chassis from the guide's line and heading, m, m, rad.
  Eigen::Vector3d off_guide(const multibody::Pose& chassis, const GuidePoint& point) const;
  /// Returns the static equilibrium on tires that are pressed down without rolling in, at rest or
  /// spinning.
  Result<multibody::Rest> settle_on_tires(CarState& state,
                                          LineTires& lines,
                                          const road::Road& road,
                                          const CarInputs& inputs);
  /// Returns the static equilibrium on tires that have rolled to their starting positions, over a
  /// distance after which their forces are steady. Returns a Failure if a tire does not become
  /// steady.
  Result<multibody::Rest> roll_in(CarState& state,
                                  LineTires& lines,
                                  const multibody::Rest& rest,
                                  const road::Road& road,
                                  const CarInputs& inputs);
  /// Returns the static equilibrium on tires that all start steadily (Tire::starts_steadily): each
  /// is put into the steady state of its wheel, again until the car stands still.
  Result<multibody::Rest> start_steadily(CarState& state,
                                         LineTires& lines,
                                         const multibody::Rest& start,
                                         const road::Road& road,
                                         const CarInputs& inputs);
  /// Lets the tires roll a given number of rounds. Sets, for each tire, the range of its force in
  /// the last half round, N, if this range is still decreasing; otherwise 0.
  Result<multibody::Rest> roll_rounds(int rounds,
                                      CarState& state,
                                      LineTires& lines,
                                      const multibody::Rest& rest,
                                      const road::Road& road,
                                      const CarInputs& inputs,
                                      std::array<double, kCorners>& falling);
  void rebuild(std::vector<multibody::Strut> struts);
  /// Returns a Failure if a corner needs a preload that no real spring of its stiffness can have.
  Status check_spring(int corner, const std::vector<multibody::Strut>& springs) const;
  /// Returns the linear acceleration of a wheel's center and its angular acceleration, for a motion
  /// with rates and accelerations of the bodies.
  multibody::Vector6d acceleration_of_wheel(int corner, const multibody::Motion& motion) const;
  /// Advances the tires to the positions that the wheels reach `ahead` seconds after this motion.
  Status roll(CarState& next,
              const multibody::Motion& motion,
              double ahead,
              double step,
              const road::Road& road,
              const CarInputs& inputs) const;
  /// Adds the forces of tires, drive and guide for this motion. The tire forces are interpolated
  /// between those before the step and the present ones, which have the weight `share`.
  void add_wheels(const CarState& state,
                  const std::array<HubForces, kCorners>& before,
                  double share,
                  const multibody::Motion& motion,
                  const CarInputs& inputs,
                  const GuidePoint& guide,
                  std::vector<multibody::BodyForce>& wrenches) const;
  Eigen::Vector3d wheel_center_in_upright(int corner) const;
  /// Returns a Failure if the contact point below the wheel, in the wheel's plane, is off the road.
  /// The message says where.
  Status check_on_road(int corner, const WheelMotion& wheel, const road::Road& road) const;
  const AxleMasses& masses(int corner) const;

  CarParameters parameters_;
  multibody::TransientSettings settings_;
  std::unique_ptr<multibody::Mechanism> mechanism_;
  CarParts parts_;
  std::unique_ptr<multibody::Equilibrium> statics_;
  std::unique_ptr<multibody::Transient> transient_;
  Tires tires_;  // tires as made by the caller, at rest and off the road
};

}  // namespace latsch::car
