// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/car/axle_kc_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "models/multibody/equilibrium.h"
#include "models/suspension/axle_compliance.h"

namespace latsch::experiment {
namespace {

using Eigen::Vector3d;
using multibody::Matrix6d;
using multibody::Vector6d;

// stiffnesses, N/m and N m/rad, that hold the chassis fixed
constexpr double kHeld = 1e10, kHeldTurn = 1e9;
constexpr double kPad = 1e9, kStrutStiffness = 1e9;  // N/m
constexpr std::array<const char*, 6> kTwistNames = {
    "dx", "dy", "dz", "about_x", "about_y", "about_z"};
constexpr auto kSides = AxleKcTest::kSides;
// number of recorded quantities for each side: dx, dy, dz, camber, toe, caster; spring
constexpr int kMovedOfSide = 7;
enum Driver { kRack = car::kRackDriver, kPadLeft, kPadRight, kDriversHere };

bool is_of_torsion(const multibody::Joint& joint, const car::CarParts& parts) {
  return joint.a == parts.chassis && joint.b == parts.chassis_rear;
}

/// Returns the mechanism on the rig: the car's parts with the chassis held and pads below the
/// wheels.
multibody::Mechanism on_the_rig(const car::CarMechanism& car, const AxleKcTest& test, int left) {
  const multibody::Mechanism& whole = car.mechanism;
  std::vector<multibody::Joint> joints = whole.joints();
  std::vector<multibody::Strut> struts = whole.struts();
  const car::CarParts& parts = car.parts;
  // Joints to the chassis become joints to the ground, and the chassis is held by the ground too.
  const auto grounded = [&](int& body) {
    if (body == parts.chassis || body == parts.chassis_rear) body = multibody::kGround;
  };
  std::erase_if(joints, [&](const multibody::Joint& joint) { return is_of_torsion(joint, parts); });
  for (multibody::Joint& joint : joints) {
    grounded(joint.a);
    grounded(joint.b);
  }
  for (multibody::Strut& strut : struts)
    for (multibody::StrutLine& line : strut.lines) {
      grounded(line.a);
      grounded(line.b);
    }
  multibody::BushingParameters held{Vector3d::Constant(kHeld), Vector3d::Constant(kHeldTurn)};
  for (int body = parts.chassis; body <= parts.chassis_rear; ++body)
    joints.push_back({"rig",
                      multibody::kGround,
                      body,
                      whole.bodies()[static_cast<std::size_t>(body)].origin,
                      held});
  // The springs keep their preloads only if pads carry the wheels.
  std::vector<double> preloads;
  for (multibody::Strut& strut : struts) preloads.push_back(std::exchange(strut.preload, 0.0));
  for (int side = 0; side < 2; ++side) {
    const car::CornerParts& corner = parts.corners[static_cast<std::size_t>(left + side)];
    if (test.springs_locked && corner.unit >= 0)
      struts[static_cast<std::size_t>(corner.unit)].stiffness = kStrutStiffness;
    if (!test.travel) continue;
    if (corner.unit >= 0) {
      const auto unit = static_cast<std::size_t>(corner.unit);
      struts[unit].preload = preloads[unit];
    }
    joints.push_back({fmt::format("pad {}", kSides[static_cast<std::size_t>(side)]),
                      multibody::kGround,
                      corner.upright,
                      corner.wheel_center,
                      {{0.0, 0.0, kPad}, Vector3d::Zero()},
                      Eigen::Matrix3d::Identity(),
                      kPadLeft + side,
                      Vector3d::UnitZ()});
  }
  return multibody::Mechanism(whole.bodies(), std::move(joints), std::move(struts), kDriversHere);
}

class AxleOnRig {
 public:
  AxleOnRig(const car::CarMechanism& car, const AxleKcTest& test)
      : car_(car),
        test_(test),
        left_(test.front ? car::kFL : car::kRL),
        mechanism_(on_the_rig(car, test, left_)),
        statics_(mechanism_),
        assembly_(mechanism_),
        rest_(statics_.unloaded()) {}

  /// Solves the unloaded state, in which the wheels stand on pads if there are pads; travel and
  /// angles are relative to this state.
  Status start() {
    auto found = statics_.solve({.drivers = drivers_}, rest_);
    if (!found) return Failure{"unloaded on the K&C rig: " + found.failure().reason};
    rest_ = std::move(*found);
    for (int side = 0; side < 2; ++side)
      wheels_at_rest_[static_cast<std::size_t>(side)] = wheel(rest_, side);
    return {};
  }

  Status go_to(Eigen::Index state) {
    set_loads(state);
    auto found = statics_.solve(standing(), rest_);
    if (!found) return unreached(state, found.failure().reason);
    rest_ = std::move(*found);
    return {};
  }

  /// Returns dx, dy, dz, camber, toe, caster of a side relative to the unloaded state.
  Vector6d moved(int side) const {
    const suspension::WheelPosition now = wheel(rest_, side),
                                    &was = wheels_at_rest_[static_cast<std::size_t>(side)];
    Vector6d moved;
    moved << now.contact - was.contact, now.camber - was.camber, now.toe - was.toe,
        now.caster - was.caster;
    return moved;
  }
  double pad_force(int side) const {
    const int pads = static_cast<int>(mechanism_.joints().size()) - 2;
    return assembly_.joint_load(pads + side, motion())[2];
  }
  double spring(int side) const {
    const int unit = corner(side).unit;
    return unit < 0 ? 0.0 : assembly_.extension(unit, rest_.poses);
  }

  void show(const RigWatcher& watch, Eigen::Index state) const {
    std::array<RigState::Wheel, 2> wheels;
    for (std::size_t side = 0; side < 2; ++side) {
      const car::CornerParts& of = corner(static_cast<int>(side));
      wheels[side] = {side == 0 ? "left" : "right", of.upright, of.wheel_center, of.contact};
    }
    watch({mechanism_, assembly_, rest_, loads_, wheels, state});
  }

  /// Returns the derivatives of the motion of both wheels by all stiffnesses, with columns as in
  /// Equilibrium::by_stiffness.
  Result<Eigen::MatrixXd> slopes() {
    if (const Status done = statics_.linearize(rest_, standing()); !done) return done.failure();
    Eigen::MatrixXd by_pose =
        Eigen::MatrixXd::Zero(mechanism_.bodies().size() * 6, 2 * kMovedOfSide);
    for (int side = 0; side < 2; ++side) {
      const int upright = corner(side).upright;
      by_pose.block<6, 6>(6 * upright, kMovedOfSide * side) =
          wheel_slopes(wheel_points(side), rest_.poses[static_cast<std::size_t>(upright)])
              .transpose();
      by_pose.col(kMovedOfSide * side + 6) = extension_slopes(side);
    }
    return statics_.by_stiffness(rest_.poses, by_pose);
  }

  Result<suspension::Matrix12d> compliance() {
    if (const Status done = statics_.linearize(rest_, standing()); !done) return done.failure();
    suspension::Matrix12d C;
    for (int of = 0; of < 2; ++of)
      for (int by = 0; by < 2; ++by) {
        const Matrix6d of_origin =
            statics_.compliance(corner(of).upright, corner(by).upright, arm(by));
        C.block<6, 6>(6 * of, 6 * by) = suspension::travel_at(arm(of), of_origin);
      }
    return C;
  }

 private:
  /// Returns a Failure that names the travel and the rack position of a state if the rig prescribes
  /// travel, and otherwise only the number of the state.
  Failure unreached(Eigen::Index state, const std::string& reason) const {
    if (!test_.travel)
      return Failure{fmt::format("state {} of the K&C rig: {}", state + 1, reason)};
    constexpr std::string_view kOfTheLoad = " of the load: ";
    std::string why = reason;
    if (const auto at = why.find(kOfTheLoad); at != why.npos)
      why.replace(at, kOfTheLoad.size(), " of the way there: ");
    const auto at = static_cast<std::size_t>(state);
    const auto& travel = *test_.travel;
    const std::string from = at == 0 ? "rest"
                                     : fmt::format("travel {:.4g} mm (left) and {:.4g} mm (right)",
                                                   1e3 * travel[0][at - 1],
                                                   1e3 * travel[1][at - 1]);
    return Failure{
        fmt::format("state {} of the K&C rig: travel {:.4g} mm (left) and {:.4g} mm (right) with "
                    "the rack at {:.4g} mm cannot be reached from {}: {}; the wheels cannot travel "
                    "so far, or the step there is too long",
                    state + 1,
                    1e3 * travel[0][at],
                    1e3 * travel[1][at],
                    1e3 * test_.rack[at],
                    from,
                    why)};
  }

  const car::CornerParts& corner(int side) const {
    return car_.parts.corners[static_cast<std::size_t>(left_ + side)];
  }
  Vector3d load_point(int side) const {
    return test_.at_wheel_center ? corner(side).wheel_center : corner(side).contact;
  }
  /// Vector from the upright's origin to the point of the loads, in the current state.
  Vector3d arm(int side) const {
    const auto body = static_cast<std::size_t>(corner(side).upright);
    return rest_.poses[body].turn * (load_point(side) - mechanism_.bodies()[body].origin);
  }
  suspension::WheelPoints wheel_points(int side) const {
    suspension::WheelPoints points = corner(side).points;
    if (test_.at_wheel_center) points.contact = points.center;
    return points;
  }
  suspension::WheelPosition wheel(const multibody::Rest& rest, int side) const {
    return wheel_position(wheel_points(side),
                          rest.poses[static_cast<std::size_t>(corner(side).upright)]);
  }
  multibody::RestSettings standing() const { return {.loads = loads_, .drivers = drivers_}; }
  multibody::Motion motion() const {
    return {.poses = rest_.poses, .memories = &rest_.memories, .drivers = drivers_};
  }

  void set_loads(Eigen::Index state) {
    loads_.clear();
    for (int side = 0; side < 2; ++side) {
      const Vector6d load = test_.loads.col(state).segment<6>(6 * side);
      loads_.push_back({corner(side).upright, load_point(side), load.head<3>(), load.tail<3>()});
    }
    const auto at = static_cast<std::size_t>(state);
    drivers_[kRack] = test_.rack[at];
    if (!test_.travel) return;
    drivers_[kPadLeft] = (*test_.travel)[0][at];
    drivers_[kPadRight] = (*test_.travel)[1][at];
  }
  /// Returns the derivatives of the spring's extension by translation and rotation of all bodies.
  Eigen::VectorXd extension_slopes(int side) const {
    Eigen::VectorXd slopes = Eigen::VectorXd::Zero(mechanism_.bodies().size() * 6);
    const int unit = corner(side).unit;
    if (unit < 0) return slopes;
    const auto& lines = mechanism_.struts()[static_cast<std::size_t>(unit)].lines;
    const auto pose = [&](int body) {
      return body == multibody::kGround ? multibody::Pose{}
                                        : rest_.poses[static_cast<std::size_t>(body)];
    };
    for (std::size_t l = 0; l < lines.size(); ++l) {
      const auto& [in_a, in_b] = mechanism_.ends(unit, static_cast<int>(l));
      const multibody::LineGeometry line =
          multibody::line_geometry(pose(lines[l].a), pose(lines[l].b), in_a, in_b, lines[l].weight);
      if (lines[l].a != multibody::kGround) slopes.segment<6>(6 * lines[l].a) += line.by_a();
      if (lines[l].b != multibody::kGround) slopes.segment<6>(6 * lines[l].b) += line.by_b();
    }
    return slopes;
  }

  const car::CarMechanism& car_;
  const AxleKcTest& test_;
  int left_;
  multibody::Mechanism mechanism_;
  multibody::Equilibrium statics_;
  multibody::Assembly assembly_;
  multibody::Rest rest_;
  std::array<suspension::WheelPosition, 2> wheels_at_rest_{};
  std::vector<multibody::Load> loads_;
  std::array<double, kDriversHere> drivers_{};
};

/// Returns the columns of the stiffnesses in the rig's mechanism, which has the joints of the car
/// without its torsion spring.
std::vector<std::vector<Eigen::Index>> columns_on_the_rig(const car::CarMechanism& car,
                                                          const std::vector<Stiffnesses>& varied) {
  const auto& joints = car.mechanism.joints();
  const bool twists = std::any_of(joints.begin(), joints.end(), [&](const auto& joint) {
    return is_of_torsion(joint, car.parts);
  });
  std::vector<std::vector<Eigen::Index>> columns;
  for (const Stiffnesses& number : varied) {
    columns.emplace_back();
    for (const auto& [joint, axis] : number)  // the torsion spring comes first
      columns.back().push_back(6 * (joint - (twists ? 1 : 0)) + axis);
  }
  return columns;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> axle_kc_moved(const AxleKcTest& test) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const char* side : kSides) {
    for (std::size_t i = 0; i < 6; ++i)
      names.emplace_back(fmt::format("{}_{}", KcTest::kMoved[i], side), i < 3 ? "m" : "rad");
    if (test.travel) names.emplace_back(fmt::format("pad_{}", side), "N");
    names.emplace_back(fmt::format("spring_{}", side), "m");
  }
  return names;
}

Result<Channels> run(const car::CarMechanism& car,
                     const AxleKcTest& test,
                     const KcSlopes& asked,
                     const RigWatcher& watch) {
  const std::vector<Stiffnesses>& varied = asked.varied;
  assert((varied.empty() || !test.travel) && "preloads depend on the varied numbers");
  AxleOnRig rig(car, test);
  if (const auto there = rig.start(); !there) return there.failure();
  const auto columns = columns_on_the_rig(car, varied);
  const auto states = static_cast<std::size_t>(test.states());
  Channels channels;
  for (Channel prescribed : test.prescribed) {
    prescribed.slopes.assign(states * varied.size(), 0.0);
    channels.add(std::move(prescribed));
  }
  std::vector<Channel> moved;
  for (const auto& [name, unit] : axle_kc_moved(test))
    moved.push_back({name, unit, {}, std::vector<double>(states * varied.size())});
  for (std::size_t state = 0; state < states; ++state) {
    if (const auto there = rig.go_to(static_cast<Eigen::Index>(state)); !there)
      return there.failure();
    if (watch) rig.show(watch, static_cast<Eigen::Index>(state));
    std::size_t channel = 0;
    const auto put = [&](double value) { moved[channel++].values.push_back(value); };
    for (int side = 0; side < 2; ++side) {
      for (const double value : rig.moved(side)) put(value);
      if (test.travel) put(rig.pad_force(side));
      put(rig.spring(side));
    }
    if (varied.empty()) continue;
    const auto slopes = rig.slopes();
    if (!slopes) return slopes.failure();
    for (std::size_t m = 0; m < moved.size(); ++m)
      for (std::size_t v = 0; v < columns.size(); ++v)
        for (const Eigen::Index column : columns[v])
          moved[m].slopes[v * states + state] += (*slopes)(static_cast<Eigen::Index>(m), column);
  }
  std::vector<std::string> names;
  for (Channel& channel : moved) {
    names.push_back(channel.name);
    channels.add(std::move(channel));
  }
  if (test.slopes) add_slopes(*test.slopes, names, channels);
  return with_slopes_of(asked.channels, channels);
}

Result<Channels> axle_compliance(const car::CarMechanism& car, const AxleKcTest& test) {
  AxleOnRig rig(car, test);
  if (const auto there = rig.start(); !there) return there.failure();
  std::vector<suspension::Matrix12d> matrices;
  for (Eigen::Index state = 0; state < test.states(); ++state) {
    if (const auto there = rig.go_to(state); !there) return there.failure();
    const auto C = rig.compliance();
    if (!C) return C.failure();
    matrices.push_back(*C);
  }
  Channels channels;
  const auto add = [&](std::string name, std::string unit, auto&& value) {
    std::vector<double> values;
    for (const suspension::Matrix12d& C : matrices) values.push_back(value(C));
    channels.add({std::move(name), std::move(unit), std::move(values)});
  };
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) {
      const auto row = static_cast<std::size_t>(i % 6), column = static_cast<std::size_t>(j % 6);
      const std::string unit =
          column < 3 ? (row < 3 ? "m/N" : "rad/N") : (row < 3 ? "1/N" : "rad/(N m)");
      add(fmt::format("{}_{}_by_{}_{}",
                      kTwistNames[row],
                      kSides[static_cast<std::size_t>(i / 6)],
                      KcTest::kLoads[column],
                      kSides[static_cast<std::size_t>(j / 6)]),
          unit,
          [=](const suspension::Matrix12d& C) { return C(i, j); });
    }
  using suspension::ClassicalCompliances;
  const std::array<std::tuple<const char*, const char*, double ClassicalCompliances::*>, 8> all = {
      {{"lateral_force_toe", "rad/N", &ClassicalCompliances::lateral_force_toe},
       {"lateral_force_camber", "rad/N", &ClassicalCompliances::lateral_force_camber},
       {"longitudinal_force_toe", "rad/N", &ClassicalCompliances::longitudinal_force_toe},
       {"aligning_torque_toe", "rad/(N m)", &ClassicalCompliances::aligning_torque_toe},
       {"aligning_torque_camber", "rad/(N m)", &ClassicalCompliances::aligning_torque_camber},
       {"longitudinal_compliance", "m/N", &ClassicalCompliances::longitudinal},
       {"lateral_compliance", "m/N", &ClassicalCompliances::lateral},
       {"vertical_compliance", "m/N", &ClassicalCompliances::vertical}}};
  for (const auto& [phase, suffix] :
       {std::pair{suspension::Phase::in, "in_phase"}, {suspension::Phase::out, "out_of_phase"}})
    for (const auto& [name, unit, member] : all)
      add(fmt::format("{}_{}", name, suffix),
          unit,
          [phase = phase, member = member](const suspension::Matrix12d& C) {
            return suspension::classical_compliances(C, phase).*member;
          });
  return channels;
}

}  // namespace latsch::experiment
