// SPDX-License-Identifier: Apache-2.0
#include "exchange/unit/tire_unit.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "experiment/language.h"
#include "experiment/language/specimen_models.h"
#include "models/road/plane_road.h"

namespace latsch::exchange {
namespace {

std::unique_ptr<ExchangedModel> unit_with(const char* kind_name, const std::string& line) {
  std::string text =
      read_text_file(LATSCH_SOURCE_DIR "/studies/tire_model_comparison/rigid_ring.tir");
  text.insert(text.find("[DIMENSION]"), line + "\n");
  const ScratchFolder folder;
  write_text_file(folder.path() / "t.tir", text);
  const experiment::SpecimenKind& kind = *experiment::language().find_kind(kind_name);
  return std::make_unique<TireUnit>(
      experiment::rolling_model(kind.build(kind.read(folder.path() / "t.tir"))),
      std::make_shared<road::PlaneRoad>());
}

void set_by_name(ExchangedModel& unit, const std::string& name, double value) {
  for (std::size_t i = 0; i < unit.variables().size(); ++i)
    if (unit.variables()[i].name == name) return unit.set(i, value);
  FAIL() << name;
}

/// Rolls the tire for 20 ms under a load of about 4 kN.
void roll_on(ExchangedModel& unit) {
  constexpr double kSpeed = 10.0, kStep = 1e-3;
  set_by_name(unit, "wheel.z", 0.293);
  ASSERT_TRUE(unit.start(0.0).ok());
  set_by_name(unit, "wheel.vx", kSpeed);
  set_by_name(unit, "wheel.spin_rate", kSpeed / 0.31);
  for (int i = 0; i < 20; ++i) {
    set_by_name(unit, "wheel.x", i * kStep * kSpeed);
    ASSERT_TRUE(unit.step(i * kStep, kStep).ok());
  }
}

// An FMU logs these sentences when it is terminated.
TEST(TireUnit, TellsTheRangesThatItsTireHasLeft) {
  for (const char* kind : {"magic_formula", "rigid_ring"}) {
    const auto unit = unit_with(kind, "FZMAX = 1000");
    EXPECT_TRUE(unit->limits_met().empty());
    roll_on(*unit);
    const auto limits = unit->limits_met();
    ASSERT_FALSE(limits.empty()) << kind;
    EXPECT_NE(limits.front().find("above FZMAX = 1000 N"), std::string::npos) << limits.front();
  }
}

TEST(TireUnit, WithinItsRangesItTellsNothing) {
  const auto unit = unit_with("magic_formula", "FZMAX = 9000");
  roll_on(*unit);
  EXPECT_TRUE(unit->limits_met().empty());
}

// The pressures are 2.4 Pa, the number of bars taken as pascals, and 240 bar.
TEST(TireUnit, RefusesAPressureThatNoTireHas) {
  for (const char* kind : {"magic_formula", "rigid_ring"})
    for (const double pressure : {2.4, 2.4e7}) {
      const auto unit = unit_with(kind, "FZMAX = 9000");
      set_by_name(*unit, "pressure", pressure);
      try {
        (void)unit->start(0.0);
        ADD_FAILURE() << kind << " took " << pressure << " Pa";
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("in Pa"), std::string::npos) << error.what();
      }
    }
}

/// Returns all sentences of limits_met() after one step with these values of height, speed and
/// step.
std::string told_after(double height, double speed, double step) {
  const auto unit = unit_with("magic_formula", "FZMAX = 9000");
  set_by_name(*unit, "wheel.z", height);
  set_by_name(*unit, "wheel.vx", speed);
  set_by_name(*unit, "wheel.spin_rate", speed / 0.31);
  EXPECT_TRUE(unit->start(0.0).ok());
  EXPECT_TRUE(unit->step(0.0, step).ok());
  std::string all;
  for (const std::string& limit : unit->limits_met()) all += limit + "\n";
  return all;
}

TEST(TireUnit, TellsValuesThatATestRefuses) {
  EXPECT_EQ(told_after(0.31, 10.0, 1e-3), "");
  EXPECT_NE(told_after(0.31, 10.0, 0.05).find("a step moved the wheel by 500 mm"),
            std::string::npos);
  EXPECT_NE(told_after(0.31, 2000.0, 1e-6).find("moved at 2000 m/s"), std::string::npos);
}

}  // namespace
}  // namespace latsch::exchange
