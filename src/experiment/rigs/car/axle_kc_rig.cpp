// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/car/axle_kc_rig.h"

#include <fmt/format.h>

#include <utility>

#include "models/multibody/equilibrium.h"
#include "models/suspension/axle_compliance.h"

namespace latsch::experiment {
namespace {

using Eigen::Vector3d;
using multibody::Matrix6d;
using multibody::Vector6d;

constexpr double kHeld = 1e10, kHeldTurn = 1e9;  // N/m, N m/rad: the chassis
constexpr double kPad = 1e9, kBar = 1e9;         // N/m
constexpr std::array<const char*, 6> kMovedNames = {"dx", "dy", "dz", "camber", "toe", "caster"};
constexpr std::array<const char*, 6> kTwistNames = {
    "dx", "dy", "dz", "about_x", "about_y", "about_z"};
constexpr std::array<const char*, 2> kSides = {"L", "R"};
enum Driver { kRack = car::kRackDriver, kPadLeft, kPadRight, kDriversHere };

/// The car's parts with the chassis held and pads below the wheels.
multibody::Mechanism on_the_rig(const car::Car& car, const AxleKcTest& test, int left) {
  const multibody::Mechanism& whole = car.mechanism();
  std::vector<multibody::Joint> joints = whole.joints();
  std::vector<multibody::Strut> struts = whole.struts();
  const car::CarParts& parts = car.parts();
  // What is joined to the chassis is joined to the ground, and the chassis to that as well.
  const auto grounded = [&](int& body) {
    if (body == parts.chassis || body == parts.chassis_rear) body = multibody::kGround;
  };
  std::erase_if(joints, [&](const multibody::Joint& joint) {
    return joint.a == parts.chassis && joint.b == parts.chassis_rear;
  });
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
  // Pads carry what the springs do; nothing does where there are none.
  std::vector<double> preloads;
  for (multibody::Strut& strut : struts) preloads.push_back(std::exchange(strut.preload, 0.0));
  for (int side = 0; side < 2; ++side) {
    const car::CornerParts& corner = parts.corners[static_cast<std::size_t>(left + side)];
    if (test.springs_locked && corner.unit >= 0)
      struts[static_cast<std::size_t>(corner.unit)].stiffness = kBar;
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
  AxleOnRig(const car::Car& car, const AxleKcTest& test)
      : car_(car),
        test_(test),
        left_(test.front ? car::kFL : car::kRL),
        mechanism_(on_the_rig(car, test, left_)),
        statics_(mechanism_),
        assembly_(mechanism_),
        rest_(statics_.unloaded()) {}

  /// Unloaded, on its pads where there are some: against that travel and angles are told.
  Result<bool> start() {
    auto found = statics_.solve({.drivers = drivers_}, rest_);
    if (!found) return Failure{"unloaded on the K&C rig: " + found.failure().reason};
    rest_ = std::move(*found);
    for (int side = 0; side < 2; ++side)
      wheels_at_rest_[static_cast<std::size_t>(side)] = wheel(rest_, side);
    return true;
  }

  Result<bool> go_to(Eigen::Index state) {
    set_loads(state);
    auto found = statics_.solve(standing(), rest_);
    if (!found)
      return Failure{fmt::format("state {} of the K&C rig: {}", state + 1, found.failure().reason)};
    rest_ = std::move(*found);
    return true;
  }

  /// dx .. caster of a side.
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

  Result<suspension::Matrix12d> compliance() {
    if (const std::string trouble = statics_.linearize(rest_, standing()); !trouble.empty())
      return Failure{trouble};
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
  const car::CornerParts& corner(int side) const {
    return car_.parts().corners[static_cast<std::size_t>(left_ + side)];
  }
  Vector3d load_point(int side) const {
    return test_.at_wheel_center ? corner(side).wheel_center : corner(side).contact;
  }
  /// From the upright's origin to the loads' point, as it stands.
  Vector3d arm(int side) const {
    const auto body = static_cast<std::size_t>(corner(side).upright);
    return rest_.poses[body].turn * (load_point(side) - mechanism_.bodies()[body].origin);
  }
  suspension::WheelPosition wheel(const multibody::Rest& rest, int side) const {
    suspension::WheelPoints points = corner(side).points;
    if (test_.at_wheel_center) points.contact = points.center;
    return wheel_position(points, rest.poses[static_cast<std::size_t>(corner(side).upright)]);
  }
  multibody::Standing standing() const { return {.loads = loads_, .drivers = drivers_}; }
  multibody::Motion motion() const {
    return {.poses = rest_.poses, .memories = &rest_.memories, .drivers = drivers_};
  }

  void set_loads(Eigen::Index state) {
    const double right = test_.mode == AxleKcTest::Mode::parallel  ? 1.0
                         : test_.mode == AxleKcTest::Mode::opposed ? -1.0
                                                                   : 0.0;
    const Vector3d F = test_.loads.col(state).head<3>(), M = test_.loads.col(state).tail<3>();
    const Vector3d mirror(1.0, -1.0, 1.0), mirrored_moment(-1.0, 1.0, -1.0);
    loads_ = {{corner(0).upright, load_point(0), F, M},
              {corner(1).upright,
               load_point(1),
               right * mirror.cwiseProduct(F),
               right * mirrored_moment.cwiseProduct(M)}};
    drivers_[kRack] = test_.rack[static_cast<std::size_t>(state)];
    if (!test_.travel) return;
    drivers_[kPadLeft] = (*test_.travel)[static_cast<std::size_t>(state)];
    drivers_[kPadRight] = right * drivers_[kPadLeft];
  }

  const car::Car& car_;
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

const char* unit_of_load(std::size_t i) { return i < 3 ? "N" : "N m"; }
const char* unit_of_moved(std::size_t i) { return i < 3 ? "m" : "rad"; }

}  // namespace

std::vector<std::pair<std::string, std::string>> axle_kc_channels(const AxleKcTest& test) {
  std::vector<std::pair<std::string, std::string>> names;
  for (std::size_t i = 0; i < 6; ++i)
    if (test.stated[i]) names.emplace_back(AxleKcTest::kLoads[i], unit_of_load(i));
  if (test.travel) names.emplace_back("travel", "m");
  names.emplace_back("rack", "m");
  for (const char* side : kSides) {
    for (std::size_t i = 0; i < 6; ++i)
      names.emplace_back(fmt::format("{}_{}", kMovedNames[i], side), unit_of_moved(i));
    if (test.travel) names.emplace_back(fmt::format("pad_{}", side), "N");
    names.emplace_back(fmt::format("spring_{}", side), "m");
  }
  return names;
}

Result<Channels> run(const car::Car& car, const AxleKcTest& test) {
  AxleOnRig rig(car, test);
  if (const auto there = rig.start(); !there) return there.failure();
  const auto names = axle_kc_channels(test);
  std::vector<std::vector<double>> values(names.size());
  for (Eigen::Index state = 0; state < test.states(); ++state) {
    if (const auto there = rig.go_to(state); !there) return there.failure();
    std::size_t column = 0;
    const auto put = [&](double value) { values[column++].push_back(value); };
    for (Eigen::Index i = 0; i < 6; ++i)
      if (test.stated[static_cast<std::size_t>(i)]) put(test.loads(i, state));
    if (test.travel) put((*test.travel)[static_cast<std::size_t>(state)]);
    put(test.rack[static_cast<std::size_t>(state)]);
    for (int side = 0; side < 2; ++side) {
      for (const double moved : rig.moved(side)) put(moved);
      if (test.travel) put(rig.pad_force(side));
      put(rig.spring(side));
    }
  }
  Channels channels;
  for (std::size_t i = 0; i < names.size(); ++i)
    channels.add({names[i].first, names[i].second, std::move(values[i])});
  return channels;
}

Result<Channels> axle_compliance(const car::Car& car, const AxleKcTest& test) {
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
                      AxleKcTest::kLoads[column],
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
      add(fmt::format("{}_{}", name, suffix), unit, [=](const suspension::Matrix12d& C) {
        return suspension::classical_compliances(C, phase).*member;
      });
  return channels;
}

}  // namespace latsch::experiment
