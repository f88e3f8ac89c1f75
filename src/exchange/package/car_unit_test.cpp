// SPDX-License-Identifier: Apache-2.0
#include "exchange/unit/car_unit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "exchange/package/unit_folder.h"
#include "formats/road/road_file.h"

namespace latsch::exchange {
namespace {

const std::filesystem::path kCars = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/kerb";
// the tires of this car have no longitudinal force
const std::filesystem::path kCar = kCars / "baseline.toml";
const std::filesystem::path kRingCar = kCars / "ring_rigid.toml";
constexpr double kMass =
    // kg, sum of the masses in the car's file
    220.0 + 4.0 * (8.2 + 4.0 + 0.8 + 1.0 + 0.4 + 0.3 + 0.4);
constexpr double kGravity = 9.80665, kCommunication = 1e-3;

/// A car unit whose variables are accessible by name.
class Driven {
 public:
  explicit Driven(const std::filesystem::path& file = kCar,
                  const std::filesystem::path& road = {}) {
    const auto& kind = experiment::language().kind_of_file(file);
    unit_ = unit_of(kind, kind.read(file), road);
  }
  CarUnit& unit() { return static_cast<CarUnit&>(*unit_); }
  std::size_t number(const std::string& name) const {
    const auto& variables = unit_->variables();
    for (std::size_t i = 0; i < variables.size(); ++i)
      if (variables[i].name == name) return i;
    throw std::runtime_error("no variable " + name);
  }
  double get(const std::string& name) const { return unit_->value(number(name)); }
  void set(const std::string& name, double value) { unit_->set(number(name), value); }
  void set_all(const std::string& name, double value) {
    for (const char* corner : car::kCornerNames) set(name + corner, value);
  }
  void start() {
    const Status done = unit_->start(0.0);
    ASSERT_TRUE(done.ok()) << done.failure().reason;
  }
  void go(int steps, double step = kCommunication) {
    for (int i = 0; i < steps; ++i, time_ += step) {
      const Status done = unit_->step(time_, step);
      ASSERT_TRUE(done.ok()) << done.failure().reason;
    }
  }
  double sum(const std::string& of) const {
    double sum = 0.0;
    for (const char* corner : car::kCornerNames)
      sum += get("wheel." + std::string(corner) + "." + of);
    return sum;
  }
  void let_go() {
    for (const char* name : {"guide.along", "guide.lateral", "guide.yaw"}) set(name, 0.0);
  }

 private:
  std::unique_ptr<ExchangedModel> unit_;
  double time_ = 0.0;
};

TEST(CarUnit, StandsOnItsTiresWithItsWeightAndWhatIsPutOnIt) {
  // The tolerance of the equilibrium is 1e-5 of the weight at each tire.
  Driven car;
  car.start();
  EXPECT_NEAR(car.sum("Fz"), kMass * kGravity, 5e-5 * kMass * kGravity);
  // The height of the chassis is its drawn height minus the deflection of the tires.
  EXPECT_NEAR(car.get("chassis.z"), 0.28, 0.02);
  EXPECT_NEAR(car.get("chassis.az"), 0.0, 1e-2);
  const double height = car.get("chassis.z");
  car.set("load.Fz", -1000.0);
  car.start();
  EXPECT_NEAR(car.sum("Fz"), kMass * kGravity + 1000.0, 5e-5 * (kMass * kGravity + 1000.0));
  EXPECT_LT(car.get("chassis.z"), height - 1e-3);
  EXPECT_LT(car.get("spring.FL.extension"), 0.0);
  EXPECT_GT(car.get("pushrod.FL.force"), 0.0);
}

TEST(CarUnit, GoesStraightOnAtItsSpeed) {
  Driven car;
  car.set("speed", 20.0);
  car.start();
  EXPECT_EQ(car.get("chassis.vx"), 20.0);
  const double x = car.get("chassis.x"), spin = car.get("wheel.RL.spin");
  car.go(100);
  EXPECT_NEAR(car.get("chassis.x") - x, 2.0, 2e-3);
  EXPECT_NEAR(car.get("wheel.RL.spin") - spin, 0.1 * car.get("wheel.RL.spin_rate"), 0.02);
}

TEST(CarUnit, TorqueOnTheWheelsAcceleratesTheCarThatIsLetGo) {
  // Rolling wheels fulfill (m + Σ I/r²) a = Σ T/r, with the acceleration a relative to a car that
  // coasts, the inertia I of wheel and belt and the rolling radius r. The wheels slip at first,
  // which reduces the speed by 5 %.
  Driven coasting(kRingCar), driven(kRingCar);
  const double torque = 60.0;
  for (Driven* car : {&coasting, &driven}) {
    car->set("speed", 15.0);
    car->let_go();
    car->start();
  }
  driven.set_all("drive.", torque);
  const int steps = 600;
  coasting.go(steps);
  driven.go(steps);
  const double gained = driven.get("chassis.vx") - coasting.get("chassis.vx");
  const double r = coasting.get("chassis.vx") / coasting.get("wheel.RL.spin_rate");
  const double I = 0.07 + 3.2 * 0.229 * 0.229;
  const double expected = 4.0 * torque / r / (kMass + 4.0 * I / (r * r));
  EXPECT_NEAR(gained / (steps * kCommunication), expected, 0.05 * expected);
  driven.set_all("drive.", 0.0);
  driven.set_all("brake.", torque);
  const double before = driven.get("chassis.vx");
  driven.go(200);
  EXPECT_LT(driven.get("chassis.vx"), before - 0.5 * expected * 0.2);
}

TEST(CarUnit, RackToTheLeftTurnsACarWithTrackRodsBehindItsKingpinsToTheRight) {
  Driven car;
  car.set("speed", 15.0);
  car.let_go();
  car.start();
  car.set("rack.velocity", 0.01);
  car.go(1);
  for (int i = 1; i < 300; ++i) {
    car.set("rack.travel", 1e-5 * i);
    car.go(1);
  }
  EXPECT_LT(car.get("chassis.wz"), -0.01);
  EXPECT_LT(car.get("chassis.yaw"), 0.0);
  EXPECT_LT(car.get("chassis.y"), 0.0);
  EXPECT_LT(car.sum("Fy"), -100.0);
}

TEST(CarUnit, TheGuideGoesWhereTheInputsAre) {
  Driven car;
  car.set("speed", 10.0);
  car.set("guide.is_given", 1.0);
  car.set("guide.speed", 10.0);
  car.start();
  for (int i = 0; i < 400; ++i) {
    car.set("guide.x", 0.01 * i);
    car.set("guide.y", 1e-4 * i);  // moves the guide to the left at 0.1 m/s
    car.go(1);
  }
  EXPECT_NEAR(car.get("chassis.x") - 0.75, 4.0, 0.05);
  // the car lags behind the guide, because its tires resist lateral motion
  EXPECT_GT(car.get("chassis.y"), 0.005);
}

TEST(CarUnit, ACommunicationStepIsEqualStepsOfTheCarNoneLongerThanTheLongest) {
  // With constant inputs, five steps of 0.2 ms give the same bits in one call of 1 ms and in five
  // calls. With a longest step of 0.15 ms there are seven steps, so the result is another one.
  const auto run = [](double communication, int calls, double longest) {
    Driven car;
    car.set("speed", 10.0);
    car.set("step.longest", longest);
    car.start();
    car.set("load.Fz", -500.0);
    car.go(calls, communication);
    return *car.unit().state();
  };
  const car::CarState whole = run(1e-3, 4, 2e-4);
  EXPECT_TRUE(whole == run(1e-3 / 5.0, 20, 1e-3));
  EXPECT_FALSE(whole == run(1e-3, 4, 1.5e-4));
}

TEST(CarUnit, ACopyGoesOnToTheSameBitsWhateverTheOtherDoes) {
  Driven car;
  car.set("speed", 10.0);
  car.start();
  car.go(5);
  const std::unique_ptr<ExchangedModel> copy = car.unit().clone();
  auto& other = static_cast<CarUnit&>(*copy);
  EXPECT_TRUE(*other.state() == *car.unit().state());
  car.set("load.Fx", 300.0);
  for (int i = 0; i < 5; ++i) {  // advances both cars in turn
    ASSERT_TRUE(other.step(5e-3 + i * kCommunication, kCommunication).ok());
    car.go(1);
  }
  EXPECT_FALSE(*other.state() == *car.unit().state());
  Driven alone;
  alone.set("speed", 10.0);
  alone.start();
  alone.go(10);
  EXPECT_TRUE(*other.state() == *alone.unit().state());
}

// The road's file, two level triangles, ends at 5 m, which the car reaches after 0.2 s. Then a step
// fails or, if the road may continue, the car drives on as on an endless level road.
TEST(CarUnit, EndsAtTheEdgeOfItsRoadUnlessThatContinues) {
  const ScratchFolder folder;
  const road::TriangleMesh mesh{{{-3, -2, 0}, {5, -2, 0}, {5, 2, 0}, {-3, 2, 0}},
                                {{{0, 1, 2}}, {{0, 2, 3}}}};
  write_text_file(folder / "short.rdf", formats::rdf_text(mesh, "ends at 5 m"));
  Driven ends(kCar, folder / "short.rdf"), goes_on(kCar, folder / "short.rdf"), endless;
  goes_on.set("road.continues", 1.0);
  for (Driven* car : {&ends, &goes_on, &endless}) {
    car->set("speed", 20.0);
    car->start();
  }
  Status done;
  for (int i = 0; done.ok() && i < 300; ++i) done = ends.unit().step(1e-3 * i, 1e-3);
  ASSERT_FALSE(done.ok());
  const std::string& why = done.failure().reason;
  EXPECT_NE(why.find("off the road's edge"), std::string::npos) << why;
  EXPECT_NE(why.find("road.continues"), std::string::npos) << why;
  goes_on.go(300);
  endless.go(300);
  EXPECT_GT(goes_on.get("wheel.FL.x"), 6.0);
  EXPECT_NEAR(goes_on.get("chassis.z"), endless.get("chassis.z"), 1e-6);
  EXPECT_NEAR(goes_on.get("chassis.x"), endless.get("chassis.x"), 1e-6);
}

TEST(CarUnit, SaysWhichParameterIsOutOfRange) {
  for (const auto& [name, value] : {std::pair("speed", -1.0),
                                    {"step.longest", 0.0},
                                    {"step.longest", 0.1},
                                    {"guide.yaw", -1.0}}) {
    Driven car;
    car.set(name, value);
    try {
      (void)car.unit().start(0.0);
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

TEST(CarUnit, RollPitchAndYawAreThoseTheRotationWasMadeOf) {
  const double roll = 0.1, pitch = -0.3, yaw = 2.5;
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                                   .toRotationMatrix();
  EXPECT_LT((roll_pitch_yaw(turn) - Eigen::Vector3d(roll, pitch, yaw)).norm(), 1e-14);
}

TEST(CarUnit, ACarWrittenAsOneFileIsTheSameCar) {
  const auto& kind = experiment::language().kind_of_file(kCar);
  const Document numbers = kind.read(kCar);
  const ScratchFolder folder;
  for (const auto& [name, bytes] : unit_files(kind, numbers)) write_text_file(folder / name, bytes);
  const Document back = kind.read(folder / "model.toml");
  ASSERT_EQ(back.paths(), numbers.paths());
  for (const std::string& path : numbers.paths()) EXPECT_EQ(back.get(path), numbers.get(path));
}

TEST(CarUnit, InputsInAnotherUnitAreTold) {
  const auto told = [](const std::string& name, double value, bool runs = true) {
    Driven car;
    car.set("speed", 10.0);
    car.start();
    car.set(name, value);
    if (runs) {
      const Status done = car.unit().step(0.0, 1e-4);
      EXPECT_TRUE(done.ok()) << done.failure().reason;
    }
    std::string all;
    for (const std::string& one : car.unit().limits_met()) all += one + "\n";
    return all;
  };
  const auto says = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
  };
  EXPECT_EQ(told("rack.travel", 0.001), "");
  EXPECT_EQ(told("drive.RL", 300.0), "");
  says(told("drive.RL", 3e5), "drive.RL was 3e+05 N m, beyond the");
  says(told("load.Fz", -2e6), "load.Fz was -2e+06 N, beyond the");
  says(told("rack.velocity", 30.0), "rack.velocity was 30 m/s, beyond the 2 m/s");
  says(told("brake.FL", -50.0),
       "brake.FL was -50 N m: a largest torque of a brake is not negative");
  says(told("guide.is_given", 2.0), "guide.is_given was 2: expected 0 or 1");
  Driven fast;
  fast.set("speed", 60.0);
  fast.set("step.longest", 1e-3);
  fast.start();
  fast.go(2);
  std::string all;
  for (const std::string& one : fast.unit().limits_met()) all += one + "\n";
  says(all, "a step of the car moved it by 60 mm");
}

/// Writes the car with a map of air forces of 60 to 100 mm at the front axle, above which its floor
/// is drawn at 80 mm; the rear axle never leaves the map.
std::filesystem::path car_with_map(const ScratchFolder& folder) {
  std::string text = read_text_file(kCar);
  for (const char* part : {"front_rigid.toml", "rear_rigid.toml", "slick.tir"})
    for (std::size_t at = 0; (at = text.find("\"" + std::string(part), at)) != text.npos; ++at)
      text.replace(at + 1, std::string(part).size(), (kCars / part).string());
  text += R"([aero]
area = "1 m^2"
floor = ["80 mm", "80 mm"]
map = [["60 mm", "0 mm", 1.0, 1.0], ["100 mm", "0 mm", 1.2, 1.0],
       ["60 mm", "500 mm", 1.0, 1.0], ["100 mm", "500 mm", 1.2, 1.0]]
)";
  write_text_file(folder / "car.toml", text);
  return folder / "car.toml";
}

/// Returns the sentence among the limits of a unit that speaks of the map; empty if there is none.
std::string limit_of_map(const CarUnit& unit) {
  for (const std::string& one : unit.limits_met())
    if (one.find("aero.map") != one.npos) return one;
  return {};
}

// A load of 4 kN at the center of mass presses the floor below the map.
TEST(CarUnit, SaysThatItsFloorLeftTheMapOfAirForces) {
  const ScratchFolder folder;
  Driven car(car_with_map(folder));
  car.set("speed", 20.0);
  car.start();
  car.go(5);
  EXPECT_EQ(limit_of_map(car.unit()), "");
  EXPECT_EQ(car.unit().first_limit(), "");
  const auto before = car.unit().clone();
  car.set("load.Fz", -4000.0);
  car.go(100);
  const std::string all = limit_of_map(car.unit()), first = car.unit().first_limit();
  EXPECT_NE(all.find("of 526 samples"), std::string::npos) << all;  // the start, 105 steps of five
  EXPECT_NE(all.find("at the front axle it is"), std::string::npos) << all;
  EXPECT_NE(all.find("the map has 60 to 100 mm"), std::string::npos) << all;
  EXPECT_EQ(all.find("rear"), std::string::npos) << all;
  EXPECT_NE(first.find("at the front axle, outside of the heights of aero.map, 60 to 100 mm"),
            std::string::npos)
      << first;
  EXPECT_NE(first.find("the coefficients of the map's edge are taken"), std::string::npos) << first;
  car.go(5);
  EXPECT_EQ(car.unit().first_limit(), first);
  // The way of a copy from before the load has not left the map.
  EXPECT_EQ(limit_of_map(static_cast<const CarUnit&>(*before)), "");
  EXPECT_EQ(before->first_limit(), "");
}

TEST(CarUnit, SaysThatItsFloorIsOutsideOfTheMapFromTheStart) {
  const ScratchFolder folder;
  Driven car(car_with_map(folder)), stands(folder / "car.toml");
  for (Driven* one : {&car, &stands}) one->set("load.Fz", -4000.0);
  car.set("speed", 20.0);
  car.start();
  EXPECT_NE(car.unit().first_limit().find("at 0 s the car's floor is"), std::string::npos)
      << car.unit().first_limit();
  stands.start();  // a car that stands has no air forces
  stands.go(2);
  EXPECT_EQ(stands.unit().first_limit(), "");
}

}  // namespace
}  // namespace latsch::exchange
