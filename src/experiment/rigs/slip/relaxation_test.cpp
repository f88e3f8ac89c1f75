// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/relaxation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/scratch_folder_testing.h"
#include "experiment/kinds/sparse_tir_testing.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"

namespace latsch::experiment {
namespace {

constexpr double kLongitudinal = 1.2e5, kLateral = 6e4;  // stiffnesses of the carcass, N/m

std::unique_ptr<Specimen> lagging_tire() {
  const ScratchFolder folder;
  std::ofstream(folder.path() / "tire.tir") << sparse_tir(
      std::string(kLongitudinalForce) + kSideForce +
      fmt::format("[STRUCTURAL]\nLONGITUDINAL_STIFFNESS = {}\nLATERAL_STIFFNESS = {}\n",
                  kLongitudinal,
                  kLateral));
  const SpecimenKind& kind = *language().find_kind("magic_formula");
  return kind.build(kind.read(folder.path() / "tire.tir"));
}

// σ = K/c [Pacejka 2012, 7.2].
TEST(Relaxation, OfAMagicFormulaIsItsSlipStiffnessOverTheCarcass) {
  const auto tire = lagging_tire()->find<Rolls>()->tire();
  const SlipSweep brake{.speed = 20.0, .kappa_from = -0.3, .kappa_to = 0.3};
  const auto along = relaxation(*tire, brake);
  ASSERT_TRUE(along) << along.failure().reason;
  EXPECT_NEAR(along->stiffness, 88e3, 0.01 * 88e3);
  EXPECT_NEAR(along->length, 88e3 / kLongitudinal, 0.02 * 88e3 / kLongitudinal);
  const SlipSweep steer{.speed = 20.0, .alpha_from = -0.1, .alpha_to = 0.1};
  const auto across = relaxation(*tire, steer);
  ASSERT_TRUE(across) << across.failure().reason;
  EXPECT_NEAR(across->length, std::abs(across->stiffness) / kLateral, 0.02 * across->length);
  EXPECT_LT(across->stiffness, 0.0);
}

std::vector<std::string> notes_of(const std::string& keys) {
  const auto test = language().read_test(Document::parse(keys, "test.toml").root(), {});
  const auto notes = test->run_in_blocks(*lagging_tire(), [](const Channels&) {});
  EXPECT_TRUE(notes) << notes.failure().reason;
  return notes ? *notes : std::vector<std::string>();
}

bool lags(const std::vector<std::string>& notes) {
  return std::ranges::any_of(notes, [](const std::string& note) {
    return note.find("relaxation length of") != std::string::npos;
  });
}

// With default settings the sweep moves the tire farther than ten radii, and yet the tire lags.
TEST(Relaxation, ASweepThatLagsIsSaidAtTheDefaults) {
  const std::string sweep = "kind = \"slip_sweep\"\nload = \"4 kN\"\nspeed = \"60 km/h\"\n";
  EXPECT_TRUE(lags(notes_of(sweep + "kappa = [-0.3, 0.3]\n")));
  EXPECT_FALSE(lags(notes_of(sweep + "kappa = [-0.3, 0.3]\nduration = \"60 s\"\n"
                                     "step = \"1 ms\"\nsample_step = \"0.1 s\"\n")));
}

TEST(Relaxation, ASteeredSweepThatLagsIsSaidToo) {
  const std::string sweep = "kind = \"slip_sweep\"\nload = \"4 kN\"\nspeed = \"60 km/h\"\n";
  EXPECT_TRUE(lags(notes_of(sweep + "alpha = [\"-10 deg\", \"10 deg\"]\n")));
  EXPECT_FALSE(lags(notes_of(sweep + "alpha = [\"-10 deg\", \"10 deg\"]\nduration = \"60 s\"\n"
                                     "step = \"1 ms\"\nsample_step = \"0.1 s\"\n")));
}

}  // namespace
}  // namespace latsch::experiment
