// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/file.h"
#include "correlation/observable/force_curve.h"
#include "correlation/study/variables.h"
#include "correlation/target/residuals.h"
#include "correlation/target/study_trials.h"
#include "experiment/rigs/load_case.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStudy = R"(model = "tire.toml"

[variable.sidewall]
paths = ["rubber.upper_sidewall.young_modulus", "rubber.lower_sidewall.young_modulus"]
lower = "1 N/mm^2"
upper = "20 N/mm^2"
initial = "5 N/mm^2"
scale = "logarithmic"

[variable.angle]
path = "layer.belt_1.angle"
lower = "15 deg"
upper = "35 deg"
initial = "24 deg"

[experiment.stiffness]
kind = "load_deflection"
pressure = "2.4 bar"
measurement = "stiffness.csv"

[experiment.modes]
kind = "modes"
pressure = "35 psi"
load = "4 kN"
measurement = "modes.csv"
use = "predict"

[doe]
levels = 3
levels_of = {angle = 5}
)";

constexpr const char* kStiffness = "deflection [mm], force [N]\n18.2, 3015.5\n32.4, 6031.1\n";
constexpr const char* kModes = "frequency [Hz], n, type\n50.3, 1, lateral\n54.1, 0, torsional\n";

/// Returns the measured forces of the study's first experiment.
std::vector<double> forces_of(const Study& study) {
  return dynamic_cast<const ForceCurve&>(*study.experiments[0].observable).measured().force;
}

class StudyFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("latsch_") + info->name());
    fs::create_directories(folder_);
    fs::copy_file(LATSCH_SOURCE_DIR "/studies/tires/passenger_205_55R16.toml",
                  folder_ / "tire.toml",
                  fs::copy_options::overwrite_existing);
    write("study.toml", kStudy);
    write("stiffness.csv", kStiffness);
    write("modes.csv", kModes);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) {
    write_text_file(folder_ / name, text);
  }
  void replace(const std::string& name, const std::string& from, const std::string& to) {
    std::string text = read_text_file(folder_ / name);
    ASSERT_NE(text.find(from), std::string::npos) << from;
    write(name, text.replace(text.find(from), from.size(), to));
  }
  Study read() const { return read_study(folder_ / "study.toml", experiment::language()); }
  /// Returns the text of the InputError that reading the study throws; "" if it throws none.
  std::string complaint() const {
    try {
      read();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST_F(StudyFile, IsReadInSi) {
  const Study study = read();
  ASSERT_EQ(study.space.size(), 2);
  EXPECT_DOUBLE_EQ(study.space[0].lower, 1e6);
  EXPECT_EQ(study.space[0].scale, Scale::logarithmic);
  EXPECT_EQ(study.space[0].unit, "N/mm^2");
  EXPECT_NEAR(study.space[1].upper, 35.0 * M_PI / 180.0, 1e-15);
  ASSERT_EQ(study.experiments.size(), 2u);
  EXPECT_EQ(forces_of(study), (std::vector<double>{3015.5, 6031.1}));
  const auto& modes = *study.tests[1].test->settings_as<experiment::ModalTest>();
  EXPECT_DOUBLE_EQ(*modes.load, 4000.0);
  EXPECT_NEAR(*modes.pressure, 35.0 * 6894.757293168, 1e-4);
  EXPECT_EQ(modes.count, 2 + 8);
  EXPECT_FALSE(study.experiments[1].fitted);
  EXPECT_EQ(study.doe->levels, (std::vector<int>{3, 5}));
}

TEST_F(StudyFile, AVariableSetsAllItsPaths) {
  const Study study = read();
  const Document model = at(study.model, study.space, {{7e6, 0.5}});
  EXPECT_EQ(model.get("rubber.upper_sidewall.young_modulus"), 7e6);
  EXPECT_EQ(model.get("rubber.lower_sidewall.young_modulus"), 7e6);
  EXPECT_EQ(model.get("layer.belt_1.angle"), 0.5);
  EXPECT_NE(study.model.get("layer.belt_1.angle"), 0.5);
}

TEST_F(StudyFile, SaysWhichPathWasMeant) {
  replace("study.toml", "layer.belt_1.angle", "layer.belt_1.angel");
  EXPECT_SAYS(complaint(), "study.toml:11: variable.angle.path");
  EXPECT_SAYS(complaint(), "layer.belt_1.angle");
}

TEST_F(StudyFile, RejectsAnAngleInNewtons) {
  replace("study.toml", "\"24 deg\"", "\"24 N\"");
  EXPECT_SAYS(complaint(), "study.toml:14: variable.angle.initial is \"24 N\"");
  EXPECT_SAYS(complaint(), "deg");
}

TEST_F(StudyFile, RejectsACordAngleInNewtonsInTheModel) {
  replace("tire.toml", "angle = \"24 deg\"", "angle = \"24 N\"");
  EXPECT_SAYS(complaint(), "layer.belt_1.angle is \"24 N\"");
}

TEST_F(StudyFile, RejectsANegativeThickness) {
  replace("tire.toml", "[0.0, \"6 mm\"]", "[0.0, \"-6 mm\"]");
  EXPECT_SAYS(complaint(), "tire.toml");
  EXPECT_SAYS(complaint(), "thickness");
}

TEST_F(StudyFile, RejectsAWallThatFoldsOver) {
  replace("tire.toml", "[67, 303.5], [84, 298]", "[84, 303.5], [67, 304]");
  EXPECT_SAYS(complaint(), "tire.toml");
}

TEST_F(StudyFile, RejectsCrossedBounds) {
  replace("study.toml", "upper = \"35 deg\"", "upper = \"10 deg\"");
  EXPECT_SAYS(complaint(), "study.toml");
  EXPECT_SAYS(complaint(), "angle");
}

TEST_F(StudyFile, RejectsABoundTheModelDoesNotAccept) {
  replace("study.toml", "upper = \"35 deg\"", "upper = \"120 deg\"");
  EXPECT_SAYS(complaint(), "variable.angle.upper is a value the model does not accept");
}

TEST_F(StudyFile, RejectsNumbersOfDifferentKindsInOneVariable) {
  replace("study.toml", "rubber.lower_sidewall.young_modulus", "layer.belt_1.angle");
  EXPECT_SAYS(complaint(), "expected numbers of one unit");
}

TEST_F(StudyFile, RejectsAnUnknownKey) {
  replace("study.toml", "use = \"predict\"", "usee = \"predict\"");
  EXPECT_SAYS(complaint(), "usee");
  EXPECT_SAYS(complaint(), "use");
}

TEST_F(StudyFile, RejectsAStudyThatFitsNothing) {
  replace("study.toml",
          "measurement = \"stiffness.csv\"",
          "measurement = \"stiffness.csv\"\nweight = 0");
  EXPECT_SAYS(complaint(), "fits nothing");
}

TEST_F(StudyFile, RejectsAMeasurementThatDoesNotExist) {
  replace("study.toml", "stiffness.csv", "stifness.csv");
  EXPECT_SAYS(complaint(), "study.toml:19: experiment.stiffness.measurement is \"stifness.csv\"");
  EXPECT_SAYS(complaint(), "latsch export");
}

TEST_F(StudyFile, RejectsAnEmptyMeasurement) {
  write("stiffness.csv", "deflection [mm], force [N]\n");
  EXPECT_SAYS(complaint(), "stiffness.csv");
}

TEST_F(StudyFile, RejectsANanInAMeasurement) {
  write("stiffness.csv", "deflection [mm], force [N]\n18.2, nan\n");
  EXPECT_SAYS(complaint(), "stiffness.csv:2");
}

TEST_F(StudyFile, RejectsAMeasuredForceOfZero) {
  write("stiffness.csv", "deflection [mm], force [N]\n1, 0\n");
  EXPECT_SAYS(complaint(), "stiffness.csv:2");
}

TEST_F(StudyFile, NamesItsDesign) {
  replace("study.toml", "levels = 3\nlevels_of = {angle = 5}", "design = \"morris\"\npoints = 30");
  const Study study = read();
  EXPECT_EQ(study.doe->kind, DesignKind::morris);
  EXPECT_EQ(morris_design(*study.doe, study.space).trajectories.size(), 10u);
  replace("study.toml", "\"morris\"\npoints = 30", "\"sobol\"\npoints = 16\nseed = 3");
  EXPECT_EQ(plan(*read().doe, study.space).points.size(), 16u);
}

TEST_F(StudyFile, RejectsKeysOfAnotherDesign) {
  replace("study.toml", "levels = 3\n", "design = \"sobol\"\nlevels = 3\n");
  EXPECT_SAYS(complaint(), "study.toml:30: doe.levels does not belong to this design");
}

TEST_F(StudyFile, RejectsTooFewPointsForMorris) {
  replace("study.toml", "levels = 3\nlevels_of = {angle = 5}", "design = \"morris\"\npoints = 5");
  EXPECT_SAYS(complaint(), "doe.points is 5, expected at least 6: 2 trajectories of 3 points");
}

TEST_F(StudyFile, ReadsTheNoiseOfAnExperiment) {
  replace("study.toml",
          "measurement = \"stiffness.csv\"",
          "measurement = \"stiffness.csv\"\nnoise = \"2 %\"");
  // the other experiment is only predicted
  EXPECT_DOUBLE_EQ(read().experiments[0].noise->relative, 0.02);
}

TEST_F(StudyFile, ReadsAbsoluteNoiseAndBoth) {
  const std::string file = "measurement = \"stiffness.csv\"";
  replace("study.toml", file, file + "\nnoise = \"20 N\"");
  EXPECT_EQ(*read().experiments[0].noise, (MeasurementNoise{.absolute = 20.0}));
  replace("study.toml", "\"20 N\"", "\"0.02 kN + 2 %\"");
  EXPECT_EQ(*read().experiments[0].noise, (MeasurementNoise{.relative = 0.02, .absolute = 20.0}));
  const auto forces = forces_of(read());
  EXPECT_DOUBLE_EQ(stated_deviations(read().experiments[0])[0], std::hypot(0.02, 20.0 / forces[0]));
}

// With N values of 2 % noise and equal weights, the target is (2 %)^2 chi^2_N / N, with mean factor
// 1 and variance 2 / N.
TEST_F(StudyFile, KnowsWhatStatedNoiseMakesOfItsTarget) {
  EXPECT_EQ(noise_alone(read()), 0.0);
  replace("study.toml",
          "measurement = \"stiffness.csv\"",
          "measurement = \"stiffness.csv\"\nnoise = \"2 %\"");
  const double N = static_cast<double>(read().experiments[0].values());
  EXPECT_NEAR(noise_alone(read()), 4e-4 * (1.0 + 2.0 * std::sqrt(2.0 / N)), 1e-12);
  replace("study.toml", "noise = \"2 %\"", "noise = \"2 %\"\nloss = \"huber\"");
  EXPECT_EQ(noise_alone(read()), 0.0);
}

TEST_F(StudyFile, RejectsNoiseThatIsNone) {
  const std::string file = "measurement = \"stiffness.csv\"";
  replace("study.toml", file, file + "\nnoise = \"0 N\"");
  EXPECT_SAYS(complaint(), "noise is \"0 N\", of which \"0 N\" is not above 0");
  replace("study.toml", "\"0 N\"", "\"-2 %\"");
  EXPECT_SAYS(complaint(), "is not above 0");
  replace("study.toml", "\"-2 %\"", "\"3 mm\"");
  EXPECT_SAYS(complaint(), "noise is \"3 mm\", but what is compared is in N");
  replace("study.toml", "\"3 mm\"", "\"3 N + 4 N\"");
  EXPECT_SAYS(complaint(), "says the same twice");
}

TEST_F(StudyFile, ReadsARobustLossAndItsScale) {
  const std::string file = "measurement = \"stiffness.csv\"";
  replace("study.toml", file, file + "\nloss = \"huber\"");
  EXPECT_SAYS(complaint(), "it is not known beyond which error values count less");
  replace("study.toml", "\"huber\"", "\"huber\"\nloss_scale = \"5 %\"");
  EXPECT_DOUBLE_EQ(read().experiments[0].loss.scale, 0.05);
  replace("study.toml", "\"huber\"", "\"huger\"");
  EXPECT_SAYS(complaint(), "did you mean \"huber\"");
}

TEST_F(StudyFile, ReadsWhatIsKnownOfAVariable) {
  const std::string file = "measurement = \"stiffness.csv\"";
  replace("study.toml", "initial = \"24 deg\"\n", "initial = \"24 deg\"\nprior = \"22 deg\"\n");
  EXPECT_SAYS(complaint(), "variable.angle.prior_sigma is missing");
  replace("study.toml", "\"22 deg\"\n", "\"22 deg\"\nprior_sigma = \"0 deg\"\n");
  EXPECT_SAYS(complaint(), "study.toml:16: variable.angle.prior_sigma is");
  replace("study.toml", "\"0 deg\"", "\"2 mm\"");
  EXPECT_SAYS(complaint(), "variable.angle.prior_sigma is \"2 mm\"");
  replace("study.toml", "\"2 mm\"", "\"2 deg\"");
  EXPECT_SAYS(complaint(), "variable.angle.prior is weighed against the measured values");
  replace("study.toml", file, file + "\nnoise = \"2 %\"");
  const Study study = read();
  const double degree = M_PI / 180.0;
  EXPECT_NEAR(study.space[1].prior->residual(26.0 * degree), 2.0, 1e-12);
  EXPECT_EQ(residual_traits(study).deviations.size(), 3u);  // two forces and the prior
}

TEST_F(StudyFile, AShareIsAPriorsDeviationOfALogarithm) {
  const std::string file = "measurement = \"stiffness.csv\"";
  replace("study.toml", file, file + "\nnoise = \"2 %\"");
  replace("study.toml",
          "scale = \"logarithmic\"",
          "scale = \"logarithmic\"\nprior = \"4 N/mm^2\"\nprior_sigma = \"50 %\"");
  EXPECT_NEAR(read().space[0].prior->residual(6e6), 1.0, 1e-12);
  EXPECT_NEAR(read().space[0].prior->residual(4e6 / 1.5), -1.0, 1e-12);
}

TEST_F(StudyFile, TiesMoveWithWhatTheyFollow) {
  replace("study.toml",
          "[experiment.stiffness]",
          "[tie.outer]\npath = \"layer.belt_2.angle\"\nfollows = \"angle\"\nfactor = -1\n\n"
          "[experiment.stiffness]");
  const Study study = read();
  DesignPoint point = study.space.initial();
  point.values[1] = 0.4;
  EXPECT_DOUBLE_EQ(at(study.model, study.space, point).get("layer.belt_2.angle"), -0.4);
  EXPECT_NE(identity(study), [&] {
    replace("study.toml", "factor = -1", "factor = -0.9");
    return identity(read());
  }());
}

TEST_F(StudyFile, RejectsTiesThatFollowNothingOrThemselves) {
  replace("study.toml",
          "[experiment.stiffness]",
          "[tie.outer]\npath = \"layer.belt_2.angle\"\nfollows = \"angel\"\n\n"
          "[experiment.stiffness]");
  EXPECT_SAYS(complaint(), "tie.outer.follows is \"angel\", which is no variable and no tie");
  replace("study.toml", "\"angel\"", "\"outer\"");
  EXPECT_SAYS(complaint(), "study.toml:18: tie.outer.follows is circular");
  replace("study.toml", "\"outer\"", "\"sidewall\"");
  EXPECT_SAYS(complaint(), "tie.outer.path leads to a number in rad, but sidewall");
  replace("study.toml", "\"sidewall\"", "\"angle\"");
  replace("study.toml", "\"layer.belt_2.angle\"", "\"layer.belt_1.angle\"");
  EXPECT_SAYS(complaint(), "which variable angle moves already");
}

TEST_F(StudyFile, RejectsNoiseOfOneFittedExperimentAlone) {
  replace("study.toml",
          "measurement = \"stiffness.csv\"",
          "measurement = \"stiffness.csv\"\nnoise = \"2 %\"");
  replace("study.toml", "use = \"predict\"\n", "");
  EXPECT_SAYS(complaint(), "experiment.modes.noise is missing: another experiment states it");
}

TEST_F(StudyFile, IdentityChangesWithTheModelButNotWithNotesOrTheObjective) {
  const StudyIdentity before = identity(read());
  replace("study.toml",
          "measurement = \"stiffness.csv\"",
          "measurement = \"stiffness.csv\"\nweight = 3");
  EXPECT_EQ(identity(read()), before);
  replace("tire.toml", "[mesh]", "# a note\n[mesh]");
  EXPECT_EQ(identity(read()), before);
  replace("tire.toml", "density = \"7850 kg/m^3\"", "density = \"7800 kg/m^3\"");
  EXPECT_NE(identity(read()), before);
}

}  // namespace
}  // namespace latsch::correlation
