// SPDX-License-Identifier: Apache-2.0
// Checks a spring F = c x + d v whose derivatives are either correct, dF/dc = x and dF/dd = v, or
// wrong.
#include "correlation/target/derivative_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "correlation/study/spring_testing.h"

namespace latsch::correlation {
namespace {

using namespace latsch::experiment;

class SlopingSpring : public SpringKind {
 public:
  bool knows_slopes_in(const std::string& path) const override {
    return path == "stiffness" || path == "damping";
  }
};

/// Errors of the derivatives of a pull test. `kink` is the change of the derivative by the damping
/// at the damping `at`.
struct Pull {
  double wrong = 1.0, kink = 0.0, at = 0.0;
};

class SlopingPull : public PullTest {
 public:
  SlopingPull(double speed, const Pull& pull)
      : PullTest({0.01, 0.02, 0.03}, speed, 0.0), speed_(speed), pull_(pull) {}
  bool tells_slopes(const SpecimenKind&, const std::string&) const override { return true; }
  Result<Channels> run(Specimen& specimen) const override {
    const auto straight = PullTest::run(specimen);
    Channels channels;
    for (Channel channel : straight->all()) {
      const double more = pull_.kink * speed_ * std::max(0.0, damping(specimen) - pull_.at);
      for (double& value : channel.values) value += channel.name == "force" ? more : 0.0;
      channels.add(std::move(channel));
    }
    return channels;
  }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    const auto plain = run(specimen);
    const double by_damping =
        pull_.wrong * speed_ * (1.0 + (damping(specimen) > pull_.at ? pull_.kink : 0.0));
    Channels sloping;
    for (Channel channel : plain->all()) {
      for (const std::string& path : asked.paths) {
        for (const double x : (*plain)["travel"]) {
          const double slope = path == "stiffness" ? x : by_damping;
          channel.slopes.push_back(channel.name == "force" ? slope : 0.0);
        }
      }
      sloping.add(std::move(channel));
    }
    return sloping;
  }

 private:
  static double damping(Specimen& specimen) { return specimen.find<Spring>()->force(0.0, 1.0); }
  double speed_;
  Pull pull_;
};

class DerivativeCheck : public testing::Test {
 protected:
  /// Reads a study whose measured values lie between the travels that the test runs.
  Study read(const Pull& how, const std::string& x = "x = \"pull/travel\"\n") {
    pull_ = how;
    write_text_file(folder_ / "spring.toml",
                    "kind = \"spring\"\nstiffness = \"2000 N/m\"\ndamping = \"30 N s/m\"\n");
    write_text_file(folder_ / "pull.toml", "kind = \"pull\"\n");
    write_text_file(folder_ / "measured.csv", "travel [mm],force [N]\n10,21\n15,28\n30,60\n");
    write_text_file(
        folder_ / "study.toml",
        "model = \"spring.toml\"\n[test.pull]\nfile = \"pull.toml\"\n"
        "[variable.c]\npath = \"stiffness\"\nlower = \"500 N/m\"\nupper = \"5000 N/m\"\n"
        "initial = \"1000 N/m\"\nscale = \"logarithmic\"\n"
        "[variable.d]\npath = \"damping\"\nlower = \"0 N s/m\"\nupper = \"50 N s/m\"\n"
        "initial = \"0 N s/m\"\n"
        "[experiment.force]\nkind = \"curve\"\n" +
            x +
            "y = \"pull/force\"\n"
            "measurement = \"measured.csv\"\nexponent = 2\n");
    static const SlopingSpring kind;
    static const TestKind pull = {
        "pull", "is pulled", {Spring::kName}, [](const Node&, const experiment::TestSource&) {
          return std::unique_ptr<experiment::Test>(std::make_unique<SlopingPull>(0.5, pull_));
        }};
    static const Language language = {{&kind}, {&pull}};
    return read_study(folder_ / "study.toml", language);
  }

  static inline Pull pull_;
  ScratchFolder folder_;
};

TEST_F(DerivativeCheck, RightSlopesAgreeAlsoBesideABound) {
  const Study study = read({});
  const auto slopes = check_slopes(study, study.space.initial());
  ASSERT_TRUE(slopes) << slopes.failure().reason;
  ASSERT_EQ(slopes->size(), 2u);
  for (const CheckedSlope& one : *slopes) {
    EXPECT_TRUE(one.agrees) << one.variable << " " << one.off;
    EXPECT_LT(one.off, 1e-8);
  }
  // the curve is compared sample by sample
  EXPECT_TRUE(check_slopes(read({}, ""), study.space.initial()));
}

// If a kink lies a thousandth of a step from the point, both differences contain half of it.
TEST_F(DerivativeCheck, AKinkBesideThePointIsNoWrongSlope) {
  constexpr double kPoint = 0.05;  // bound, which is moved inward by a thousandth of the range
  for (const double at : {kPoint - 5e-5, kPoint + 5e-5}) {
    const Study study = read({.kink = 3e-4, .at = at});
    const auto slopes = check_slopes(study, study.space.initial());
    ASSERT_TRUE(slopes);
    EXPECT_TRUE((*slopes)[1].agrees) << (*slopes)[1].off;
    EXPECT_GT((*slopes)[1].off, 1e-4);
    const auto wrong =
        check_slopes(read({.wrong = 1.01, .kink = 3e-4, .at = at}), study.space.initial());
    ASSERT_TRUE(wrong);
    EXPECT_FALSE((*wrong)[1].agrees);
  }
}

TEST_F(DerivativeCheck, NamesTheVariableWhoseSlopeIsWrong) {
  const Study study = read({.wrong = 1.01});
  const auto slopes = check_slopes(study, study.space.initial());
  ASSERT_TRUE(slopes);
  EXPECT_TRUE((*slopes)[0].agrees);
  EXPECT_FALSE((*slopes)[1].agrees);
  EXPECT_EQ((*slopes)[1].variable, "d");
  EXPECT_NEAR((*slopes)[1].off, 0.01 / 1.01, 1e-6);
  EXPECT_EQ((*slopes)[1].row.find("force: pull/force at "), 0u) << (*slopes)[1].row;
}

}  // namespace
}  // namespace latsch::correlation
