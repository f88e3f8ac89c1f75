// SPDX-License-Identifier: Apache-2.0
// Tests that a unit survives what other programs and people do to it: spoiled packages, odd
// folders, other settings of the processor, many threads, loading again. A wrong input ends in one
// sentence.
#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <array>
#include <bit>
#include <cfenv>
#include <cstdint>
#include <thread>

#include "base/file.h"
#include "fmu_testing.h"

namespace latsch::exchange {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRingTire = "ring_tires/passenger_205_55R16.toml";
constexpr const char* kFormulaTire = "tire_model_comparison/magic_formula.tir";
constexpr double kCallStep = 1.0 / 1024.0;  // s, so that times are exact in every rounding

/// Returns the bits of the vertical force after twenty steps of a wheel that rolls at 10 m/s.
std::uint64_t force_after_steps(const Package& package, Slave& slave) {
  const auto set = [&](const char* name, double value) {
    EXPECT_EQ(slave.set(package.reference(name), value), CallStatus::ok) << name;
  };
  set("wheel.z", 0.3);
  EXPECT_EQ(slave.initialize(0.0), CallStatus::ok);
  set("wheel.vx", 10.0);
  set("wheel.spin_rate", 32.0);
  for (int i = 0; i < 20; ++i) {
    set("wheel.x", 10.0 * kCallStep * i);
    set("wheel.spin", 32.0 * kCallStep * i);
    EXPECT_EQ(slave.step(kCallStep * i, kCallStep), CallStatus::ok);
  }
  double force = 0.0;
  EXPECT_EQ(slave.get(package.reference("hub.Fz"), force), CallStatus::ok);
  return std::bit_cast<std::uint64_t>(force);
}

std::uint64_t force_of(const Package& package) {
  return force_after_steps(package, *instantiate(package));
}

/// Settings of the processor that a program may have: a rounding, and denormal numbers taken as 0.
class HostArithmetic {
 public:
  explicit HostArithmetic(int rounding) : usual_(_mm_getcsr()) {
    std::fesetround(rounding);
    _mm_setcsr(_mm_getcsr() | kFlushes);
    set_ = _mm_getcsr();
  }
  ~HostArithmetic() {
    std::fesetround(FE_TONEAREST);
    _mm_setcsr(usual_);
  }
  HostArithmetic(const HostArithmetic&) = delete;
  HostArithmetic& operator=(const HostArithmetic&) = delete;

  /// True if the settings are still those of the program, apart from flags of exceptions.
  bool is_unchanged() const { return ((_mm_getcsr() ^ set_) & ~kFlags) == 0; }

 private:
  static constexpr unsigned kFlushes = 0x8040, kFlags = 0x3f;
  unsigned usual_, set_ = 0;
};

class SpoiledUnit : public testing::TestWithParam<FmiVersion> {
 protected:
  /// Returns the one sentence with which the package refuses to make an instance.
  static std::string refusal(const Package& package, const std::string& resources = "") {
    const auto slave = instantiate(package, "", resources);
    EXPECT_FALSE(slave->there());
    EXPECT_EQ(slave->log.size(), 1u);
    return slave->log.empty() ? "" : slave->log.back().second;
  }
  static void edit(const Package& package,
                   const std::string& name,
                   const std::string& old,
                   const std::string& replacement) {
    const fs::path file = package.file("resources/" + name);
    std::string text = read_text_file(file);
    const std::size_t at = text.find(old);
    ASSERT_NE(at, text.npos) << old;
    write_text_file(file, text.replace(at, old.size(), replacement));
  }
};
INSTANTIATE_TEST_SUITE_P(Fmi,
                         SpoiledUnit,
                         testing::Values(FmiVersion::fmi2, FmiVersion::fmi3),
                         [](const auto& info) {
                           return info.param == FmiVersion::fmi2 ? "fmi2" : "fmi3";
                         });

TEST_P(SpoiledUnit, RefusesAModelEditedToAnotherUnit) {
  const Package package(GetParam(), kRingTire, "");
  edit(package, "model.toml", "pressure = \"240000 Pa\"", "pressure = \"2.4 bar\"");
  const std::string said = refusal(package);
  EXPECT_NE(said.find("expected SI"), std::string::npos) << said;
  EXPECT_NE(said.find("\"bar\""), std::string::npos) << said;
}

TEST_P(SpoiledUnit, RefusesATruncatedModelAndAnEmptyFolder) {
  const Package package(GetParam(), kRingTire, "");
  const fs::path model = package.file("resources/model.toml");
  const std::string text = read_text_file(model);
  write_text_file(model, text.substr(0, text.size() / 2));
  EXPECT_NE(refusal(package).find("model.toml"), std::string::npos);
  for (const auto& file : fs::directory_iterator(package.file("resources"))) fs::remove(file);
  EXPECT_NE(refusal(package).find("unit.toml"), std::string::npos);
}

TEST_P(SpoiledUnit, RefusesAFormatThatItDoesNotRead) {
  const Package package(GetParam(), kFormulaTire, "");
  edit(package, "unit.toml", "format = 2\n", "");
  EXPECT_NE(refusal(package).find("format 1"), std::string::npos);
  edit(package, "unit.toml", "token", "format = 3\ntoken");
  EXPECT_NE(refusal(package).find("older than the package"), std::string::npos);
}

TEST_P(SpoiledUnit, RefusesARoadOutsideOfItsFolder) {
  for (const char* road : {"../unit.toml", "/etc/passwd", "a/../../b.toml"}) {
    const Package package(GetParam(), kFormulaTire, "");
    edit(package, "unit.toml", "road.toml", road);
    EXPECT_NE(refusal(package).find("expected a file in the folder"), std::string::npos) << road;
  }
}

TEST_P(SpoiledUnit, ReadsFoldersOfAnyName) {
  const Package package(GetParam(), kFormulaTire, "");
  for (const std::string& name : {std::string("with blanks"),
                                  std::string("100%20"),
                                  std::string("\xc3\xbc\xc3\xa4"),
                                  std::string("\xe8\xbd\xae\xe8\x83\x8e"),
                                  std::string(200, 'a') + "/" + std::string(200, 'b')}) {
    const fs::path folder = package.file("moved") / name;
    fs::create_directories(folder);
    fs::copy(package.file("resources"), folder, fs::copy_options::recursive);
    std::string place = folder.string();
    if (GetParam() == FmiVersion::fmi2) {  // a URI writes % as %25
      for (std::size_t i = place.find('%'); i != place.npos; i = place.find('%', i + 1))
        place.replace(i, 1, "%25");
      place = "file://" + place;
    }
    const auto slave = instantiate(package, "", place);
    EXPECT_TRUE(slave->there()) << place << ": "
                                << (slave->log.empty() ? "" : slave->log.back().second);
  }
}

TEST_P(SpoiledUnit, ComputesTheSameBitsInAProgramWithOtherArithmetic) {
  const Package package(GetParam(), kRingTire, "");
  const std::uint64_t expected = force_of(package);
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    const HostArithmetic host(rounding);
    EXPECT_EQ(force_of(package), expected) << rounding;
    EXPECT_TRUE(host.is_unchanged()) << rounding;
  }
}

TEST_P(SpoiledUnit, LoadsAndUnloadsAndLoadsAgain) {
  const Package first(GetParam(), kFormulaTire, "");
  const std::uint64_t expected = force_of(first);
  for (int i = 0; i < 3; ++i) {
    const Package again(GetParam(), kFormulaTire, "");
    EXPECT_EQ(force_of(again), expected);
  }
}

TEST(UnitsInOneProcess, AHundredInstancesInEightThreadsComputeTheSameBits) {
  // libraries of both versions are loaded at the same time
  const std::array<Package, 2> packages = {Package(FmiVersion::fmi2, kRingTire, ""),
                                           Package(FmiVersion::fmi3, kRingTire, "")};
  const std::uint64_t expected = force_of(packages[0]);
  constexpr int kThreads = 8, kInstances = 100;
  std::array<int, kThreads> equal{}, all{};
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([&, t] {
      for (int i = t; i < kInstances; i += kThreads, ++all[static_cast<std::size_t>(t)])
        equal[static_cast<std::size_t>(t)] +=
            force_of(packages[static_cast<std::size_t>(i % 2)]) == expected;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(equal, all);
}

}  // namespace
}  // namespace latsch::exchange
