// SPDX-License-Identifier: Apache-2.0
// Tests the FMI packages of a car, for both versions of FMI: life cycle, saved states, and several
// instances at once. The outputs equal those of the car without FMI, to the last bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "base/file.h"
#include "exchange/unit/car_unit.h"
#include "fmu_testing.h"
#include "formats/road/road_file.h"

namespace latsch::exchange {
namespace {

constexpr const char* kCar = "kerb/baseline.toml";
constexpr const char* kCleat =
    "kind = \"cleat\"\nheight = \"10 mm\"\nlength = \"25 mm\"\nplace = \"1.9 m\"\n";
constexpr double kStep = 1e-3, kSpeed = 15.0, kRackRate = 0.02;
// number of communication steps, and number of the car's steps in each
constexpr int kSteps = 30, kCarSteps = 5;

using Bits = std::vector<std::uint64_t>;

Bits bits_of(const std::vector<double>& values) {
  Bits bits;
  for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

/// Inputs of a car that runs over a cleat, driven at the rear, while its rack moves to the left.
class Drive {
 public:
  Drive(const Package& package, double torque = 100.0)
      : package_(package), slave_(instantiate(package)), torque_(torque) {}

  Slave& slave() { return *slave_; }
  void set(const std::string& variable, double value) {
    ASSERT_EQ(slave_->set(package_.reference(variable), value), CallStatus::ok) << variable;
  }
  void start() {
    set("speed", kSpeed);
    ASSERT_EQ(slave_->initialize(0.0), CallStatus::ok);
  }
  void step(int from) {
    set("rack.travel", kRackRate * kStep * from);
    set("rack.velocity", kRackRate);
    set("drive.RL", torque_);
    set("drive.RR", torque_);
    set("load.Fz", -200.0);
    ASSERT_EQ(slave_->step(kStep * from, kStep), CallStatus::ok)
        << (slave_->log.empty() ? "" : slave_->log.back().second);
  }
  /// Returns all outputs of the unit.
  Bits answer() {
    std::vector<double> values;
    for (const ExchangedVariable& variable : package_.variables) {
      if (variable.causality != Causality::output) continue;
      values.emplace_back();
      EXPECT_EQ(slave_->get(package_.reference(variable.name), values.back()), CallStatus::ok);
    }
    return bits_of(values);
  }
  double get(const std::string& variable) {
    double value = 0.0;
    EXPECT_EQ(slave_->get(package_.reference(variable), value), CallStatus::ok);
    return value;
  }

 private:
  const Package& package_;
  std::unique_ptr<Slave> slave_;
  double torque_;
};

class CarOf : public testing::TestWithParam<FmiVersion> {};
INSTANTIATE_TEST_SUITE_P(Fmi,
                         CarOf,
                         testing::Values(FmiVersion::fmi2, FmiVersion::fmi3),
                         [](const auto& info) {
                           return info.param == FmiVersion::fmi2 ? "fmi2" : "fmi3";
                         });

TEST_P(CarOf, AnswersOverACleatAsTheCarDrivenDirectlyToTheLastBit) {
  const Package package(GetParam(), kCar, kCleat);
  Drive drive(package);
  ASSERT_TRUE(drive.slave().there());
  drive.start();

  const std::filesystem::path file = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies" / kCar;
  const auto& kind = experiment::language().kind_of_file(file);
  const auto specimen = kind.build(kind.read(file));
  const auto car = specimen->find<Drives>()->car({});
  ASSERT_TRUE(car);
  const auto road = formats::read_road_file(package.file("resources/road.toml")).road;
  const auto expect_same = [&](const car::CarState& state, const car::CarInputs& inputs) {
    const auto pushrods = (*car)->pushrod_forces(state, inputs);
    const auto vertical = (*car)->vertical_forces(state);
    for (int corner = 0; corner < car::kCorners; ++corner) {
      const auto i = static_cast<std::size_t>(corner);
      const std::string name = car::kCornerNames[i], wheel = "wheel." + name + ".";
      EXPECT_EQ(bits_of({pushrods[i],
                         (*car)->spring_extension(state, corner),
                         vertical[i],
                         state.wheels[i].motion.spin_rate}),
                bits_of({drive.get("pushrod." + name + ".force"),
                         drive.get("spring." + name + ".extension"),
                         drive.get(wheel + "Fz"),
                         drive.get(wheel + "spin_rate")}));
    }
    const auto chassis = static_cast<std::size_t>((*car)->parts().chassis);
    // center of mass of the chassis
    const Eigen::Vector3d place = state.bodies.poses[chassis].place;
    EXPECT_EQ(bits_of({place.x(), place.y(), place.z()}),
              bits_of({drive.get("chassis.x"), drive.get("chassis.y"), drive.get("chassis.z")}));
  };

  car::CarInputs inputs;
  inputs.loads = {{(*car)->parts().chassis, (*car)->parameters().chassis.body.center}};
  auto state = (*car)->settle(*road, kSpeed, inputs);
  ASSERT_TRUE(state);
  expect_same(*state, inputs);
  const double at_rest = (*car)->vertical_forces(*state)[0];
  double highest = 0.0;
  inputs.loads[0].force.z() = -200.0;
  inputs.drive = {0.0, 0.0, 100.0, 100.0};
  const double h = kStep / kCarSteps;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 1; j <= kCarSteps; ++j) {
      inputs.rack = kRackRate * kStep * i + j * h * kRackRate;
      ASSERT_TRUE((*car)->advance(*state, h, *road, inputs).ok());
    }
    drive.step(i);
    expect_same(*state, inputs);
    highest = std::max(highest, (*car)->vertical_forces(*state)[0]);
  }
  EXPECT_GT(highest, 1.2 * at_rest);  // the cleat has increased the force
}

TEST_P(CarOf, GoesBackToAStateAndOnToTheSameBitsAlsoInAnotherInstance) {
  const Package package(GetParam(), kCar, kCleat);
  Drive drive(package), other(package);
  drive.start();
  other.start();
  for (int i = 0; i < 10; ++i) drive.step(i);
  void* state = nullptr;
  ASSERT_EQ(drive.slave().copy(&state), CallStatus::ok);
  const Bits there = drive.answer();
  std::vector<Bits> first;
  for (int i = 10; i < kSteps; ++i) {
    drive.step(i);
    first.push_back(drive.answer());
  }
  EXPECT_NE(first.front(), first.back());
  for (Drive* again : {&drive, &other}) {
    ASSERT_EQ(again->slave().restore(state), CallStatus::ok);
    EXPECT_EQ(again->answer(), there);
    for (int i = 10; i < kSteps; ++i) {
      again->step(i);
      EXPECT_EQ(again->answer(), first[static_cast<std::size_t>(i - 10)]);
    }
  }
  ASSERT_EQ(drive.slave().free(&state), CallStatus::ok);
}

TEST_P(CarOf, InstancesOfOneProcessDoNotFeelEachOther) {
  const Package package(GetParam(), kCar, kCleat);
  const auto run_alone = [&](double torque) {
    Drive drive(package, torque);
    drive.start();
    for (int i = 0; i < kSteps; ++i) drive.step(i);
    return drive.answer();
  };
  Drive one(package, 100.0), two(package, -50.0);
  one.start();
  two.start();
  for (int i = 0; i < kSteps; ++i) {
    one.step(i);
    two.step(i);
  }
  EXPECT_NE(one.answer(), two.answer());
  EXPECT_EQ(one.answer(), run_alone(100.0));
  EXPECT_EQ(two.answer(), run_alone(-50.0));
}

TEST_P(CarOf, LivesAsTheStandardSays) {
  const Package package(GetParam(), kCar, "");
  Drive drive(package);
  double value = 0.0;
  Slave& slave = drive.slave();
  EXPECT_EQ(slave.step(0.0, kStep), CallStatus::error);
  EXPECT_EQ(slave.get(package.reference("chassis.z"), value), CallStatus::error);
  EXPECT_EQ(slave.set(package.reference("speed"), -3.0), CallStatus::ok);
  EXPECT_EQ(slave.initialize(0.0), CallStatus::error);
  EXPECT_NE(slave.log.back().second.find("speed = -3 m/s"), std::string::npos)
      << slave.log.back().second;
  ASSERT_EQ(slave.reset(), CallStatus::ok);
  drive.start();
  const Bits rest = drive.answer();
  EXPECT_EQ(slave.set(package.reference("speed"), 3.0), CallStatus::error);
  drive.step(0);
  const Bits first = drive.answer();
  EXPECT_NE(first, rest);
  ASSERT_EQ(slave.terminate(), CallStatus::ok);
  EXPECT_EQ(slave.step(kStep, kStep), CallStatus::error);
  ASSERT_EQ(slave.reset(), CallStatus::ok);
  drive.start();
  EXPECT_EQ(drive.answer(), rest);
  drive.step(0);
  EXPECT_EQ(drive.answer(), first);
}

// A load presses the floor of a car below its map of air forces: the logger is called at that step
// and at the end, each time with the status `warning`, and not at the steps between.
TEST_P(CarOf, LogsOnceThatItsFloorLeftTheMapOfAirForces) {
  const ScratchFolder folder;
  const std::filesystem::path kerb = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/kerb";
  std::string text = read_text_file(kerb / "baseline.toml");
  for (const char* part : {"front_rigid.toml", "rear_rigid.toml", "slick.tir"})
    for (std::size_t at = 0; (at = text.find("\"" + std::string(part), at)) != text.npos; ++at)
      text.replace(at + 1, std::string(part).size(), (kerb / part).string());
  text +=
      "[aero]\narea = \"1 m^2\"\nfloor = [\"80 mm\", \"80 mm\"]\nmap = [[\"60 mm\", \"0 mm\", 1, "
      "1], "
      "[\"100 mm\", \"0 mm\", 1, 1], [\"60 mm\", \"500 mm\", 1, 1], [\"100 mm\", \"500 mm\", 1, "
      "1]]\n";
  write_text_file(folder / "car.toml", text);
  const Package package(GetParam(), (folder / "car.toml").string(), "");
  Drive drive(package, 0.0);
  drive.start();
  Slave& slave = drive.slave();
  drive.set("load.Fz", -4000.0);
  int warned = 0;
  void* state = nullptr;
  ASSERT_EQ(slave.copy(&state), CallStatus::ok);
  for (const bool again : {false, true}) {
    if (again) {
      ASSERT_EQ(slave.restore(state), CallStatus::ok);
    }
    for (int i = 0; i < 100; ++i) {
      const CallStatus status = slave.step(kStep * i, kStep);
      ASSERT_LE(status, CallStatus::warning);
      warned += status == CallStatus::warning ? 1 : 0;
    }
  }
  slave.free(&state);
  EXPECT_EQ(warned, 1);
  ASSERT_EQ(slave.log.size(), 1u);
  EXPECT_EQ(slave.log[0].first, CallStatus::warning);
  EXPECT_NE(slave.log[0].second.find("at the front axle, outside of the heights of aero.map"),
            std::string::npos)
      << slave.log[0].second;
  EXPECT_EQ(slave.terminate(), CallStatus::warning);
  const bool at_end = std::any_of(slave.log.begin() + 1, slave.log.end(), [](const auto& line) {
    return line.first == CallStatus::warning &&
           line.second.find("of 501 samples") != std::string::npos;
  });
  EXPECT_TRUE(at_end);
}

}  // namespace
}  // namespace latsch::exchange
