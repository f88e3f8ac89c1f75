// SPDX-License-Identifier: Apache-2.0
// Tests that FMI packages of a tire follow the standards [FMI 2.0.5, 2.1 and 4.2; FMI 3.0.2, 2.2
// and 4.2]: life cycle, saved states, several instances at once, and the statuses of errors. The
// outputs equal those of the tire without FMI, to the last bit.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/file.h"
#include "exchange/unit/tire_unit.h"
#include "fmu_testing.h"
#include "formats/road/road_file.h"

namespace latsch::exchange {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRing = "ring_tires/passenger_205_55R16.toml";
constexpr const char* kRigidRing = "tire_model_comparison/rigid_ring.tir";
constexpr const char* kMagicFormula = "tire_model_comparison/magic_formula.tir";
constexpr const char* kCleat =
    "kind = \"cleat\"\nheight = \"10 mm\"\nlength = \"25 mm\"\nplace = \"0.3 m\"\n";

constexpr double kStep = 1e-3, kSpeed = 10.0, kSpin = 32.5, kYaw = 0.01, kInclination = 0.02;
constexpr int kSteps = 40;

struct Case {
  FmiVersion version;
  const char* model;
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  const std::string model = info.param.model == kRing        ? "ring"
                            : info.param.model == kRigidRing ? "rigid_ring"
                                                             : "magic_formula";
  return (info.param.version == FmiVersion::fmi2 ? "fmi2_" : "fmi3_") + model;
}

using Answer = std::array<double, 6>;

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

void expect_same_bits(const Answer& a, const Answer& b) {
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(bits(a[i]), bits(b[i])) << i;
}

/// Inputs of a wheel that moves straight ahead with yaw and inclination angles, pressed by 15 mm.
class Drive {
 public:
  Drive(const Package& package, Slave& slave, double height)
      : package_(package), slave_(slave), height_(height) {}

  void set(const std::string& variable, double value) {
    ASSERT_EQ(slave_.set(package_.reference(variable), value), CallStatus::ok);
  }
  void set_motion(int step) {
    set("wheel.x", kSpeed * kStep * step);
    set("wheel.z", height_);
    set("wheel.yaw", kYaw);
    set("wheel.inclination", kInclination);
    set("wheel.vx", kSpeed);
    set("wheel.spin", kSpin * kStep * step);
    set("wheel.spin_rate", kSpin);
  }
  void start() {
    set_motion(0);
    ASSERT_EQ(slave_.initialize(0.0), CallStatus::ok);
  }
  void step(int from) {
    set_motion(from);
    ASSERT_EQ(slave_.step(kStep * from, kStep), CallStatus::ok)
        << (slave_.log.empty() ? "" : slave_.log.back().second);
  }
  Answer answer() {
    Answer hub{};
    const char* names[] = {"hub.Fx", "hub.Fy", "hub.Fz", "hub.Mx", "hub.My", "hub.Mz"};
    for (std::size_t i = 0; i < hub.size(); ++i)
      EXPECT_EQ(slave_.get(package_.reference(names[i]), hub[i]), CallStatus::ok);
    return hub;
  }

 private:
  const Package& package_;
  Slave& slave_;
  double height_;
};

Answer answer_of(const HubForces& hub) {
  return {
      hub.force.x(), hub.force.y(), hub.force.z(), hub.moment.x(), hub.moment.y(), hub.moment.z()};
}

/// A tire that is called directly, without FMI.
struct Direct {
  explicit Direct(const std::string& model)
      : specimen([&] {
          const fs::path file = fs::path(LATSCH_SOURCE_DIR) / "studies" / model;
          const auto& kind = experiment::language().kind_of_file(file);
          return kind.build(kind.read(file));
        }()),
        tire(specimen->find<Rolls>()->tire()) {
    ScratchFolder folder;
    write_text_file(folder / "road.toml", kCleat);
    road = formats::read_road_file(folder / "road.toml").road;
    height = tire->free_radius() - 0.015;
  }
  WheelMotion motion(int step) const {
    WheelMotion motion;
    motion.center = {kSpeed * kStep * step, 0.0, height};
    motion.carrier = Eigen::AngleAxisd(kYaw, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                     Eigen::AngleAxisd(kInclination, Eigen::Vector3d::UnitX()).toRotationMatrix();
    motion.velocity.x() = kSpeed;
    motion.spin = kSpin * kStep * step;
    motion.spin_rate = kSpin;
    return motion;
  }

  std::unique_ptr<experiment::Specimen> specimen;
  std::unique_ptr<Tire> tire;
  std::unique_ptr<const road::Road> road;
  double height = 0.0;
};

class EveryTire : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Fmi,
                         EveryTire,
                         testing::Values(Case{FmiVersion::fmi2, kRing},
                                         Case{FmiVersion::fmi2, kRigidRing},
                                         Case{FmiVersion::fmi2, kMagicFormula},
                                         Case{FmiVersion::fmi3, kRing},
                                         Case{FmiVersion::fmi3, kRigidRing},
                                         Case{FmiVersion::fmi3, kMagicFormula}),
                         name_of);

TEST_P(EveryTire, AnswersOverACleatAsTheTireAskedDirectlyToTheLastBit) {
  const Package package(GetParam().version, GetParam().model, kCleat);
  const auto slave = instantiate(package);
  ASSERT_TRUE(slave->there());
  Direct direct(GetParam().model);
  Drive drive(package, *slave, direct.height);
  drive.start();
  const auto rest = direct.tire->settle(direct.motion(0), *direct.road, 0.0);
  ASSERT_TRUE(rest);
  expect_same_bits(drive.answer(), answer_of(*rest));
  double highest = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    drive.step(i);
    const WheelMotion end = carried_on(direct.motion(i), kStep);
    const auto hub = direct.tire->advance(end, *direct.road, kStep * i + kStep, kStep);
    ASSERT_TRUE(hub);
    expect_same_bits(drive.answer(), answer_of(*hub));
    highest = std::max(highest, hub->force.z());
  }
  EXPECT_GT(highest, 1.1 * rest->force.z());  // the cleat raised the force
}

TEST_P(EveryTire, GoesBackToAStateAndOnToTheSameBits) {
  const Package package(GetParam().version, GetParam().model, kCleat);
  const auto slave = instantiate(package);
  const Direct direct(GetParam().model);
  Drive drive(package, *slave, direct.height);
  drive.start();
  for (int i = 0; i < 10; ++i) drive.step(i);
  void* state = nullptr;
  ASSERT_EQ(slave->copy(&state), CallStatus::ok);
  const Answer there = drive.answer();
  std::vector<Answer> first;
  for (int i = 10; i < kSteps; ++i) {
    drive.step(i);
    first.push_back(drive.answer());
  }
  for (int again = 0; again < 2; ++again) {
    ASSERT_EQ(slave->restore(state), CallStatus::ok);
    expect_same_bits(drive.answer(), there);
    for (int i = 10; i < kSteps; ++i) {
      drive.step(i);
      expect_same_bits(drive.answer(), first[static_cast<std::size_t>(i - 10)]);
    }
  }
  ASSERT_EQ(slave->free(&state), CallStatus::ok);
  EXPECT_EQ(state, nullptr);
}

TEST_P(EveryTire, InstancesOfOneProcessDoNotFeelEachOther) {
  const Package package(GetParam().version, GetParam().model, kCleat);
  const Direct direct(GetParam().model);
  const auto run_alone = [&](double height) {
    const auto slave = instantiate(package);
    Drive drive(package, *slave, height);
    drive.start();
    std::vector<Answer> answers;
    for (int i = 0; i < 20; ++i) {
      drive.step(i);
      answers.push_back(drive.answer());
    }
    return answers;
  };
  const double low = direct.height - 0.005;
  const auto a = run_alone(direct.height), b = run_alone(low);
  const auto one = instantiate(package), two = instantiate(package);
  Drive drive_one(package, *one, direct.height), drive_two(package, *two, low);
  drive_one.start();
  drive_two.start();
  for (std::size_t i = 0; i < a.size(); ++i) {
    drive_one.step(static_cast<int>(i));
    drive_two.step(static_cast<int>(i));
    expect_same_bits(drive_one.answer(), a[i]);
    expect_same_bits(drive_two.answer(), b[i]);
  }
}

class EveryVersion : public testing::TestWithParam<FmiVersion> {
 protected:
  static void expect_logged(const Slave& slave, CallStatus status, const std::string& part) {
    ASSERT_FALSE(slave.log.empty());
    EXPECT_EQ(slave.log.back().first, status);
    EXPECT_NE(slave.log.back().second.find(part), std::string::npos) << slave.log.back().second;
  }
};
INSTANTIATE_TEST_SUITE_P(Fmi,
                         EveryVersion,
                         testing::Values(FmiVersion::fmi2, FmiVersion::fmi3),
                         [](const auto& info) {
                           return info.param == FmiVersion::fmi2 ? "fmi2" : "fmi3";
                         });

TEST_P(EveryVersion, RefusesAnotherTokenAndAFolderWithoutAUnit) {
  const Package package(GetParam(), kMagicFormula, "");
  const auto other = instantiate(package, "{00000000-0000-0000-0000-000000000000}");
  EXPECT_FALSE(other->there());
  expect_logged(*other, CallStatus::error, "not of one package");
  const std::string nowhere =
      GetParam() == FmiVersion::fmi2 ? "file:///no/such%20folder" : "/no/such folder";
  const auto missing = instantiate(package, "", nowhere);
  EXPECT_FALSE(missing->there());
  expect_logged(*missing, CallStatus::error, "/no/such folder");
}

TEST_P(EveryVersion, RefusesAMissingResource) {
  const Package package(GetParam(), kMagicFormula, "");
  fs::remove(package.file("resources") / "model.toml");
  const auto slave = instantiate(package);
  EXPECT_FALSE(slave->there());
  expect_logged(*slave, CallStatus::error, "model.toml");
}

TEST_P(EveryVersion, RefusesWhatIsWrongAndGoesOn) {
  const Package package(GetParam(), kMagicFormula, "");
  const auto slave = instantiate(package);
  double value = 0.0;
  EXPECT_EQ(slave->step(0.0, kStep), CallStatus::error);
  expect_logged(*slave, CallStatus::error, "not initialized");
  EXPECT_EQ(slave->get(package.reference("hub.Fz"), value), CallStatus::error);
  EXPECT_EQ(slave->leave(), CallStatus::error);
  EXPECT_EQ(slave->terminate(), CallStatus::error);
  ASSERT_EQ(slave->initialize(0.0), CallStatus::ok);
  EXPECT_EQ(slave->initialize(0.0), CallStatus::error);

  EXPECT_EQ(slave->get(4711, value), CallStatus::error);
  expect_logged(*slave, CallStatus::error, "value reference 4711");
  EXPECT_EQ(slave->set(4711, 0.0), CallStatus::error);
  EXPECT_EQ(slave->set(kTimeReference, 0.0), CallStatus::error);
  EXPECT_EQ(slave->set(package.reference("hub.Fz"), 0.0), CallStatus::error);
  expect_logged(*slave, CallStatus::error, "hub.Fz is an output");
  EXPECT_EQ(slave->set(package.reference("pressure"), 2e5), CallStatus::error);
  expect_logged(*slave, CallStatus::error, "pressure is fixed");
  EXPECT_EQ(slave->ask_for_integer(), CallStatus::error);

  EXPECT_EQ(slave->set(package.reference("wheel.z"), NAN), CallStatus::discard);
  expect_logged(*slave, CallStatus::discard, "wheel.z = nan");
  EXPECT_EQ(slave->step(0.0, -kStep), CallStatus::error);
  expect_logged(*slave, CallStatus::error, "-0.001 s");
  EXPECT_EQ(slave->step(0.0, 0.0), CallStatus::error);
  EXPECT_EQ(slave->step(0.0, NAN), CallStatus::error);
  EXPECT_EQ(slave->step(1.0, kStep), CallStatus::error);
  expect_logged(*slave, CallStatus::error, "begins at 1 s");
  EXPECT_EQ(slave->restore(nullptr), CallStatus::error);
  EXPECT_EQ(slave->copy(nullptr), CallStatus::error);

  ASSERT_EQ(slave->get(package.reference("wheel.z"), value), CallStatus::ok);
  EXPECT_GT(value, 0.2);  // the refused calls have not changed the value
  EXPECT_EQ(slave->step(0.0, kStep), CallStatus::ok);
  ASSERT_EQ(slave->get(kTimeReference, value), CallStatus::ok);
  EXPECT_EQ(value, kStep);
}

TEST_P(EveryVersion, DiscardsAStepThatHasNoEndAndGoesOnFromTheStateBefore) {
  const Package package(GetParam(), kRing, "");
  const auto slave = instantiate(package);
  ASSERT_EQ(slave->initialize(0.0), CallStatus::ok);
  void* state = nullptr;
  ASSERT_EQ(slave->copy(&state), CallStatus::ok);
  ASSERT_EQ(slave->set(package.reference("wheel.z"), -10.0), CallStatus::ok);
  EXPECT_EQ(slave->step(0.0, kStep), CallStatus::discard);
  EXPECT_EQ(slave->log.back().first, CallStatus::discard);
  EXPECT_FALSE(slave->log.back().second.empty());
  ASSERT_EQ(slave->restore(state), CallStatus::ok);
  EXPECT_EQ(slave->step(0.0, kStep), CallStatus::ok);
  slave->free(&state);
}

TEST_P(EveryVersion, BeginsAnewAfterTerminateAndReset) {
  const Package package(GetParam(), kMagicFormula, "");
  const auto slave = instantiate(package);
  const Direct direct(kMagicFormula);
  Drive drive(package, *slave, direct.height);
  drive.start();
  const Answer rest = drive.answer();
  drive.step(0);
  const Answer first = drive.answer();
  ASSERT_EQ(slave->terminate(), CallStatus::ok);
  expect_same_bits(drive.answer(), first);
  EXPECT_EQ(slave->set(package.reference("wheel.x"), 0.0), CallStatus::error);
  EXPECT_EQ(slave->step(kStep, kStep), CallStatus::error);
  ASSERT_EQ(slave->reset(), CallStatus::ok);
  double height = 0.0;
  ASSERT_EQ(slave->get(package.reference("wheel.z"), height), CallStatus::ok);
  // the start value that the model description states
  EXPECT_EQ(height, direct.tire->free_radius());
  drive.start();
  expect_same_bits(drive.answer(), rest);
  drive.step(0);
  expect_same_bits(drive.answer(), first);
}

TEST_P(EveryVersion, FollowsInputsWhileItIsInitialized) {
  const Package package(GetParam(), kMagicFormula, "");
  const auto slave = instantiate(package);
  const Direct direct(kMagicFormula);
  const unsigned z = package.reference("wheel.z"), Fz = package.reference("hub.Fz");
  ASSERT_EQ(slave->enter(0.0), CallStatus::ok);
  double at_touch = 0.0, pressed = 0.0, ran = 0.0;
  ASSERT_EQ(slave->get(Fz, at_touch), CallStatus::ok);
  EXPECT_NEAR(at_touch, 0.0, 1e-6);  // at its start value of wheel.z the tire just touches the road
  ASSERT_EQ(slave->set(z, direct.height), CallStatus::ok);
  ASSERT_EQ(slave->get(Fz, pressed), CallStatus::ok);
  EXPECT_GT(pressed, 1000.0);
  ASSERT_EQ(slave->leave(), CallStatus::ok);
  ASSERT_EQ(slave->set(z, direct.height - 0.01), CallStatus::ok);
  ASSERT_EQ(slave->get(Fz, ran), CallStatus::ok);
  EXPECT_EQ(ran, pressed);  // the outputs are those of the last communication point
}

TEST_P(EveryVersion, TakesTheInputsAsTheEndOfAStepWhereItIsToldSo) {
  const Package package(GetParam(), kMagicFormula, "");
  const auto force = [&](double carried_on, double z, double vz) {
    const auto slave = instantiate(package);
    const unsigned height = package.reference("wheel.z");
    EXPECT_EQ(slave->set(package.reference("inputs.carried_on"), carried_on), CallStatus::ok);
    EXPECT_EQ(slave->set(height, Direct(kMagicFormula).height), CallStatus::ok);
    EXPECT_EQ(slave->initialize(0.0), CallStatus::ok);
    EXPECT_EQ(slave->set(height, z), CallStatus::ok);
    EXPECT_EQ(slave->set(package.reference("wheel.vz"), vz), CallStatus::ok);
    EXPECT_EQ(slave->step(0.0, kStep), CallStatus::ok);
    double radius = 0.0;
    EXPECT_EQ(slave->get(package.reference("loaded_radius"), radius), CallStatus::ok);
    return radius;
  };
  EXPECT_DOUBLE_EQ(force(1.0, 0.3, -1.0), 0.3 - kStep);
  EXPECT_DOUBLE_EQ(force(0.0, 0.3, -1.0), 0.3);
}

TEST_P(EveryVersion, ShowsTheFunctionsOfItsStandardAndNothingOfTheLibrary) {
  const Package package(GetParam(), kMagicFormula, "");
  const bool two = GetParam() == FmiVersion::fmi2;
  using Version = const char*();
  auto* version = package.binary->function<Version>(two ? "fmi2GetVersion" : "fmi3GetVersion");
  ASSERT_NE(version, nullptr);
  EXPECT_STREQ(version(), two ? "2.0" : "3.0");
  EXPECT_EQ(package.binary->find(two ? "fmi3GetVersion" : "fmi2GetVersion"), nullptr);
  EXPECT_EQ(
      package.binary->find("_ZN6latsch8exchange9read_unitERKNSt10filesystem7__cxx114pathERKNS0"
                           "_10UnitModelsE"),
      nullptr);
}

TEST(Uri, IsAFolderOfThisMachine) {
  const Package package(FmiVersion::fmi2, kMagicFormula, "");
  const std::string folder = package.file("resources").string();
  for (const std::string& uri : {"file://" + folder,
                                 "file:" + folder,
                                 "file://localhost" + folder,
                                 "file://" + folder + "/",
                                 folder})
    EXPECT_TRUE(instantiate(package, "", uri)->there()) << uri;
  for (const std::string& uri : {std::string("https://example.org/resources"),
                                 "file://elsewhere" + folder,
                                 std::string("file://%2"),
                                 std::string("file:///%zz"),
                                 std::string("x")}) {
    const auto slave = instantiate(package, "", uri);
    EXPECT_FALSE(slave->there()) << uri;
    EXPECT_EQ(slave->log.size(), 1u) << uri;
  }
}

TEST(LoadedRadius, IsThatOfAnInclinedWheelOnASlope) {
  ScratchFolder folder;
  write_text_file(folder / "slope.toml", "kind = \"flat\"\ngrade = 0.1\nheight = \"0.2 m\"\n");
  const auto road = formats::read_road_file(folder / "slope.toml").road;
  WheelMotion motion;
  motion.center = {1.0, 0.0, 0.6};
  const double gamma = 0.3;
  motion.carrier = Eigen::AngleAxisd(gamma, Eigen::Vector3d::UnitX()).toRotationMatrix();
  // The road below the wheel center is 0.3 m away; measured in the plane of the inclined wheel it
  // is farther by 1/cos of the inclination.
  EXPECT_NEAR(loaded_radius(motion, *road, 0.0), 0.3 / std::cos(gamma), 1e-12);
  motion.carrier =
      Eigen::AngleAxisd(std::acos(-1.0) / 2.0, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_GT(loaded_radius(motion, *road, 0.0), 1e6);
}

}  // namespace
}  // namespace latsch::exchange
