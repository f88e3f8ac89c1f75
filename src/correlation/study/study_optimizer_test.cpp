// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study_optimizer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "correlation/search/study_method.h"

namespace latsch::correlation {
namespace {

OptimizerSettings optimizer_of(const std::string& text, bool constrained = false) {
  const Document document = Document::parse(text, "study.toml");
  const Node root = document.root();
  const OptimizerSettings settings =
      read_optimizer(root, DesignSpace({{.name = "a"}}), constrained);
  root.close();
  return settings;
}

TEST(StudyOptimizer, MakesUseOfTheResidualsUnlessTheStudySaysOtherwise) {
  EXPECT_EQ(optimizer_of("").method, "auto");
  EXPECT_EQ(OptimizerSettings().method, "auto");  // for a study without [optimizer]
  const auto choice =
      latsch::method_of(optimizer_of("restarts = 2"), {.variables = 3, .has_residuals = true});
  EXPECT_EQ(choice.method, Method::residual_trust_region);
  EXPECT_THAT(choice.reason, testing::HasSubstr("sum over residuals"));
  const OptimizerSettings gss =
      optimizer_of("method = \"gss\"\ninitial_step = 0.2\ncontraction = 0.6");
  EXPECT_EQ(gss.gss.initial_step, 0.2);
  EXPECT_EQ(gss.gss.contraction, 0.6);
  EXPECT_EQ(optimizer_of("method = \"gss_nlc\"").gss_nlc.gss.contraction,
            GssNlcOptions{}.gss.contraction);
}

TEST(StudyOptimizer, ReadsTheOptionsOfItsMethod) {
  const auto trust = optimizer_of(
      "method = \"residual_trust_region\"\ninitial_step = 0.2\nrestarts = 2\nbatch = 8");
  EXPECT_EQ(trust.residual_trust_region.initial_radius, 0.2);
  EXPECT_EQ(trust.residual_trust_region.restarts, 2);
  EXPECT_EQ(trust.residual_trust_region.outstanding, 8);
  EXPECT_EQ(optimizer_of("method = \"genetic\"\npopulation = 12").genetic.population, 12);
  EXPECT_EQ(
      optimizer_of("method = \"nelder_mead\"\nstep_tolerance = 0.01").nelder_mead.step_tolerance,
      0.01);
  EXPECT_EQ(optimizer_of("method = \"levenberg_marquardt\"\nstep_tolerance = 1e-4")
                .levenberg_marquardt.step_tolerance,
            1e-4);
  EXPECT_THROW(optimizer_of("method = \"levenberg_marquardt\"", true), InputError);
  EXPECT_EQ(optimizer_of("method = \"auto\"\nrestarts = 1").residual_trust_region.restarts, 1);
}

TEST(StudyOptimizer, RefusesOtherMethodsAndOptionsOfAnotherMethod) {
  EXPECT_THROW(optimizer_of("method = \"newton\""), InputError);
  EXPECT_THROW(optimizer_of("method = \"residual_trust_region\"\ncontraction = 0.5"), InputError);
  EXPECT_THROW(optimizer_of("method = \"gss\"\nrestarts = 1"), InputError);
  EXPECT_THROW(optimizer_of("method = \"residual_trust_region\"\ninitial_step = 0.7"), InputError);
}

TEST(StudyOptimizer, SaysWhichMethodAKeyBelongsTo) {
  const auto optimizer_complaint = [](const std::string& text) {
    try {
      optimizer_of(text);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(optimizer_complaint("method = \"sqp\"\nrestarts = 1"),
              testing::HasSubstr("restarts belongs to method = \"residual_trust_region\", the "
                                 "method here is \"sqp\""));
  // The former name still means the same, but not beside the new one.
  EXPECT_EQ(optimizer_of("outstanding = 3").residual_trust_region.outstanding, 3);
  EXPECT_THAT(optimizer_complaint("batch = 4\noutstanding = 3"),
              testing::HasSubstr("former name of batch"));
  EXPECT_THAT(optimizer_complaint("batch = 0"), testing::HasSubstr("batch"));
  EXPECT_THAT(optimizer_complaint("batch = \"workers\""),
              testing::HasSubstr("for 8 workers write batch = 8"));
  EXPECT_THAT(optimizer_complaint("method = \"nelder_mead\"\nbatch = 3"),
              testing::HasSubstr("batch"));
  EXPECT_THAT(optimizer_complaint("method = \"nelder_mead\"\noutstanding = 3"),
              testing::HasSubstr("\"gss\", \"gss_nlc\" or \"residual_trust_region\""));
  EXPECT_THAT(optimizer_complaint("restart = 1"), testing::HasSubstr("unknown key"));
}

TEST(StudyOptimizer, IsRefusedBeforeTheFirstTrialWithThePlaceOfItsTable) {
  try {
    optimizer_of("initial_step = 0.1\nstep_tolerance = 0.2");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().file, "study.toml");
  }
}

TEST(StudyOptimizer, ReadsTheMembersOfAnEnsemble) {
  const OptimizerSettings settings = optimizer_of(R"(
method = "ensemble"
ends_with = "first"
[member.wide]
method = "genetic"
generations = 7
[member.fine]
method = "sqp"
priority = 2
difference = 1e-5)");
  ASSERT_EQ(settings.members.size(), 2u);
  EXPECT_EQ(settings.ensemble_end, Ensemble::End::first);
  EXPECT_EQ(settings.members[0].settings.genetic.generations, 7);
  EXPECT_EQ(settings.members[1].name, "fine");
  EXPECT_EQ(settings.members[1].priority, 2);
  EXPECT_EQ(settings.members[1].settings.sqp.difference, 1e-5);
  EXPECT_NE(latsch::method_of(settings, {}).reason.find("fine (sequential"), std::string::npos);
}

TEST(StudyOptimizer, NeedsAMethodThatKnowsConstraintsOnChannelsWhereThereAreSome) {
  EXPECT_EQ(optimizer_of("method = \"gss_nlc\"\npenalty = \"l1\"", true).gss_nlc.penalty,
            Penalty::l1);
  EXPECT_THROW(optimizer_of("method = \"gss\"", true), InputError);
  EXPECT_THROW(optimizer_of("method = \"ensemble\"\n[member.a]\nmethod = \"gss\"", true),
               InputError);
  EXPECT_NO_THROW(optimizer_of("method = \"auto\"", true));
  EXPECT_NO_THROW(optimizer_of("method = \"ensemble\"\n[member.a]\nmethod = \"sqp\"", true));
}

std::string optimizer_complaint(const std::string& text) {
  try {
    optimizer_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StudyOptimizer, SaysWhatIsWrongWithAnEnsemble) {
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(optimizer_complaint(text).find(part), std::string::npos) << optimizer_complaint(text);
  };
  says("method = \"ensemble\"", "study.toml:1: method is \"ensemble\" without members");
  says("method = \"ensemble\"\n[member.a]\npriority = 2", "method");
  says("method = \"ensemble\"\n[member.a]\nmethod = \"ensemble\"", "study.toml:3");
  says("method = \"ensemble\"\n[member.a]\nmethod = \"gss\"\npriority = 0", "study.toml:4");
  says("method = \"gss\"\n[member.a]\nmethod = \"gss\"", "member");
}

}  // namespace
}  // namespace latsch::correlation
