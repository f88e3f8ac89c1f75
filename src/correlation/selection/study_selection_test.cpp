// SPDX-License-Identifier: Apache-2.0
#include "correlation/selection/study_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "correlation/observable/force_curve.h"
#include "correlation/selection/selected_study.h"
#include "correlation/study/spring_testing.h"
#include "evaluation/executors/inline_executor.h"

namespace latsch::correlation {
namespace {

constexpr int kPresses = 4;
constexpr int kDeflections = 15;

double deflection_of(int k) { return 0.002 * (k + 1); }

/// F = a x + b x^2 + c x^3, N, with x in m.
double progressive_force(const DesignPoint& point, double x) {
  return point.values[0] * x + point.values[1] * x * x + point.values[2] * x * x * x;
}

std::string press_name(int k) { return "press_" + std::to_string(k); }

/// Four measured presses of a spring with a = 4000 N/m, b = 5e4 N/m^2 and c = 0, with 1 % of noise
/// in each value.
Study progressive_spring() {
  Study study{"study.toml",
              "spring",
              "spring.toml",
              Document::parse("a = 1", "spring.toml"),
              DesignSpace({{"a", {"a"}, 1e3, 1e4, 3e3},
                           {"b", {"a"}, -1e5, 1e5, 0.0},
                           {"c", {"a"}, -1e7, 1e7, 0.0}}),
              {},
              {},
              100,
              std::nullopt,
              {}};
  RandomStream random(5, 1);
  for (int press = 0; press < kPresses; ++press) {
    std::vector<double> x, force;
    for (int k = 0; k < kDeflections; ++k) {
      x.push_back(deflection_of(k));
      force.push_back(progressive_force({{4e3, 5e4, 0.0}}, x.back()) *
                      (1.0 + 0.01 * random.normal()));
    }
    StudyExperiment experiment;
    experiment.name = press_name(press);
    experiment.observable = std::make_shared<ForceCurve>(
        press_name(press), LoadDeflectionCurve{Abscissa::deflection, x, force, {}});
    experiment.noise = {.relative = 0.01};
    study.experiments.push_back(experiment);
  }
  study.specimens = specimens_of(*experiment::spring_language().kinds.front());
  study.target_key = "spring";
  SelectionSettings settings = selection_of_all(study.space);
  settings.units.erase(settings.units.begin());
  study.selection = settings;
  return study;
}

Result<Channels> pressed_progressively(const DesignPoint& point) {
  Channels channels;
  for (int press = 0; press < kPresses; ++press) {
    std::vector<double> force;
    for (int k = 0; k < kDeflections; ++k)
      force.push_back(progressive_force(point, deflection_of(k)));
    channels.add({press_name(press) + "/force", "N", force});
  }
  return channels;
}

const StudyIdentity kProgressive{{"model", "progressive spring"}};

StudySelection selected_spring(const Study& study,
                               const std::filesystem::path& file,
                               int* trials = nullptr) {
  Journal journal = Journal::open(file, kProgressive);
  InlineExecutor executor([&](const DesignPoint& point) {
    if (trials) ++*trials;
    return pressed_progressively(point);
  });
  const auto found =
      select_coefficients(study, study.space.initial(), executor, journal, RunOptions{});
  EXPECT_TRUE(found && found->ok());
  return **found;
}

TEST(StudySelection, KeepsTheTrueTermAndHoldsTheOtherAtItsExactValue) {
  const ScratchFolder folder;
  const Study study = progressive_spring();
  const StudySelection selected = selected_spring(study, folder.path() / "spring.latsch");
  EXPECT_EQ(selected.chosen().units, std::vector<int>{0});
  const DesignPoint point = selected.point(study.space, selected.chosen());
  EXPECT_EQ(point.values[2], 0.0);
  // standard deviations by (J'J)^-1 of the relative residuals at the truth
  EXPECT_NEAR(point.values[0], 4e3, 4.0 * 10.0);
  EXPECT_NEAR(point.values[1], 5e4, 4.0 * 600.0);
}

TEST(StudySelection, AFinishedSelectionIsReadFromItsJournal) {
  const ScratchFolder folder;
  const Study study = progressive_spring();
  int first = 0, again = 0;
  const auto file = folder.path() / "spring.latsch";
  const StudySelection before = selected_spring(study, file, &first);
  const StudySelection after = selected_spring(study, file, &again);
  EXPECT_GT(first, 0);
  EXPECT_EQ(again, 0);
  EXPECT_EQ(before.chosen().at.u, after.chosen().at.u);
}

TEST(StudySelection, OneHalfChoosesAndTheOtherDeterminesTheValues) {
  const ScratchFolder folder;
  Study study = progressive_spring();
  study.selection->honest = true;
  const StudySelection selected = selected_spring(study, folder.path() / "spring.latsch");
  ASSERT_TRUE(selected.refit);
  EXPECT_EQ(selected.choosing.size(), 2u);
  EXPECT_EQ(selected.refitted.size(), 2u);
  for (const std::string& name : selected.choosing)
    EXPECT_EQ(std::count(selected.refitted.begin(), selected.refitted.end(), name), 0);
  // the refit is the least squares of the other half alone: its gradient in the kept variables is 0
  const Linearization& at = selected.reported().at;
  EXPECT_EQ(at.r.size(), 2 * kDeflections);
  const Eigen::VectorXd step = at.J(Eigen::all, {0, 1}).transpose() * at.r;
  EXPECT_LT(step.cwiseAbs().maxCoeff(), 0.05 * at.J(Eigen::all, {0, 1}).norm());
  EXPECT_NE(selected.reported().at.u, selected.chosen().at.u);
}

TEST(StudySelection, OneRecordingCannotBeSplitOrLeftOut) {
  Study study = progressive_spring();
  study.experiments.resize(1);
  EXPECT_EQ(why_no_selection(study), "");
  study.selection->honest = true;
  EXPECT_NE(why_no_selection(study).find("all values of the study are of one"), std::string::npos);
  study.selection->honest = false;
  study.selection->criterion = SelectionCriterion::cross_validation;
  EXPECT_NE(why_no_selection(study).find("cross_validation"), std::string::npos);
  study.selection->criterion = SelectionCriterion::bic;
  study.experiments.front().loss.loss = Loss::huber;
  EXPECT_NE(why_no_selection(study).find("robust loss"), std::string::npos);
}

TEST(SelectedStudy, KeepsCommentsAndHoldsDroppedVariablesAtTheirValues) {
  const ScratchFolder folder;
  Study study = progressive_spring();
  study.selection->toward[2] = 1e5;
  const StudySelection selected = selected_spring(study, folder.path() / "spring.latsch");
  ASSERT_EQ(selected.chosen().units, std::vector<int>{0});
  study.file = folder.path() / "study.toml";
  std::ofstream(study.file) << "# a spring\n"
                               "[variable.b]\ninitial = 0\n"
                               "[variable.c]\nlower = -1e7\ninitial = 0  # \"guess\"\n";
  const auto text = selected_study_text(study, selected);
  ASSERT_TRUE(text.ok());
  EXPECT_EQ(text->find("# a spring\n[variable.b]\ninitial = 0\n[variable.c]\nlower = -1e7\n"
                       "initial = 100000  # \"guess\"\n"),
            0u);
  EXPECT_NE(text->find("[stage.selected]\nfree = [\"a\", \"b\"]\n"), std::string::npos);
  std::ofstream(study.file, std::ios::app) << "[stage.coarse]\n";
  const auto refused = selected_study_text(study, selected);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.failure().reason.find("free = [\"a\", \"b\"]"), std::string::npos);
}

std::string message_of_selection(const std::string& table) {
  const DesignSpace space(
      {{"PKY1", {"a"}, -80, -15, -35}, {"PKY6", {"a"}, -4, 4, 1}, {"PVY3", {"a"}, -1, 1, 0}});
  try {
    (void)read_coefficient_selection(
        Document::parse("[selection]\n" + table, "study.toml").root().table("selection"), space);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SelectionSettings, WrongKeysAreNamedWithWhatIsExpected) {
  EXPECT_EQ(message_of_selection("of = [\"PKY*\"]\ntoward = {PKY6 = 0}"), "");
  EXPECT_NE(message_of_selection("of = [\"PKX*\"]").find("no variable"), std::string::npos);
  EXPECT_NE(message_of_selection("of = []").find("is empty"), std::string::npos);
  EXPECT_NE(message_of_selection("of = [\"PKY*\"]\ntoward = {PVY3 = 0}").find("no candidate"),
            std::string::npos);
  EXPECT_NE(message_of_selection("toward = {PKY6 = 5}").find("outside of the bounds"),
            std::string::npos);
  EXPECT_NE(message_of_selection("groups = {a = [\"PKY*\"], b = [\"PKY6\"]}").find("has too"),
            std::string::npos);
  EXPECT_NE(message_of_selection("criterion = \"bix\"").find("bic"), std::string::npos);
  EXPECT_NE(message_of_selection("refits = 0").find("refits"), std::string::npos);
}

TEST(SelectionSettings, PatternsAndGroupsMakeUnits) {
  const DesignSpace space({{"PKY1", {"a"}, -80, -15, -35},
                           {"PKY6", {"a"}, -4, 4, 1},
                           {"PVY3", {"a"}, -1, 1, 0},
                           {"PVY4", {"a"}, -1, 1, 0}});
  const SelectionSettings settings =
      read_coefficient_selection(Document::parse("[selection]\nof = [\"PKY6\", \"PV*\"]\n"
                                                 "groups = {camber = [\"PKY6\", \"PVY3\"]}\n"
                                                 "toward = {PVY4 = 0.5}\n",
                                                 "study.toml")
                                     .root()
                                     .table("selection"),
                                 space);
  ASSERT_EQ(settings.units.size(), 2u);
  EXPECT_EQ(settings.units[0].name, "camber");
  EXPECT_EQ(settings.units[0].variables, (std::vector<int>{1, 2}));
  EXPECT_EQ(settings.units[1].variables, std::vector<int>{3});
  EXPECT_EQ(settings.toward, (std::vector<double>{-35, 1, 0, 0.5}));
}

}  // namespace
}  // namespace latsch::correlation
