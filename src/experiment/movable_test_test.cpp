// SPDX-License-Identifier: Apache-2.0
#include "experiment/movable_test.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/scratch_folder_testing.h"

namespace latsch::experiment {
namespace {

MovableTest movable(const std::string& text, const std::filesystem::path& folder = "") {
  const Document document = Document::parse(text, "test.toml");
  const auto test = language().read_test(document.root(), {folder, nullptr});
  return MovableTest({Document::parse(text, "test.toml").root(), folder}, *test, language());
}

constexpr const char* kRolling = R"(kind = "rolling"
load = "4 kN"
speed = "60 km/h"
alpha = "2 deg"
)";

TEST(MovableTest, NumbersAreFoundByNameAndMoved) {
  MovableTest test = movable(kRolling);
  EXPECT_EQ(test.find("load"), "load");
  EXPECT_EQ(test.find("laod"), std::nullopt);
  test.set("load", 5500.0);
  EXPECT_EQ(test.value("load"), 5500.0);
  EXPECT_NE(test.identified().identity.find("5500"), std::string::npos);
}

TEST(MovableTest, TheTextIsAFileOfTheTestWithItsPresentNumbers) {
  const ScratchFolder folder;
  MovableTest test = movable(kRolling);
  test.set("load", 5500.0);
  write_text_file(folder.path() / "moved.toml", test.text(folder.path()));
  EXPECT_EQ(language().read_identified_test(folder.path() / "moved.toml").identity,
            test.identified().identity);
}

TEST(MovableTest, StatesOfATableBecomeOneStateWithItsMedians) {
  const ScratchFolder folder;
  write_text_file(folder.path() / "states.csv",
                  "Fz [N],alpha [deg],p [kPa]\n1000,-4,80\n2000,0,81\n4000,8,90\n");
  MovableTest test = movable("kind = \"steady_states\"\nstates = \"states.csv\"\n", folder.path());
  EXPECT_EQ(test.test()->samples(), 1);
  EXPECT_EQ(test.test()->driven_at("Fz"), std::vector<double>{2000.0});
  EXPECT_EQ(test.test()->driven_at("p"), std::vector<double>{81e3});
  EXPECT_NE(test.assumed().find("p 81 kPa"), std::string::npos) << test.assumed();
  test.set(*test.find("alpha"), 0.1);
  EXPECT_EQ(test.test()->driven_at("alpha"), std::vector<double>{0.1});
}

TEST(MovableTest, StatesThatStandInTheTestStayThere) {
  const std::string text = "kind = \"steady_states\"\nstates = {Fz = \"1 kN\"}\n";
  EXPECT_EQ(movable(text).text("elsewhere"), text);
}

TEST(MovableTest, StatesInATestAreThoseOfATable) {
  const auto read = [](const std::string& states) {
    const Document document =
        Document::parse("kind = \"steady_states\"\nstates = " + states + "\n", "test.toml");
    return language().read_test(document.root(), {"", nullptr});
  };
  const auto test = read(R"({Fz = "4 kN", alpha = ["0 deg", "2 deg"]})");
  EXPECT_EQ(test->samples(), 2);
  EXPECT_EQ(test->driven_at("Fz"), (std::vector<double>{4000.0, 4000.0}));
  EXPECT_THROW(read(R"({Fz = ["4 kN", "5 kN"], alpha = ["0 deg", "2 deg", "4 deg"]})"), InputError);
  EXPECT_THROW(read(R"({alpha = "2 deg"})"), InputError);
  EXPECT_THROW(read(R"({Fz = "4 kN", alfa = "2 deg"})"), InputError);
}

TEST(MovableTest, SeveralStatesHaveNoNumbersToMove) {
  EXPECT_THROW(movable(R"(kind = "steady_states"
states = {Fz = "4 kN", alpha = ["0 deg", "2 deg"]}
)"),
               InputError);
}

}  // namespace
}  // namespace latsch::experiment
