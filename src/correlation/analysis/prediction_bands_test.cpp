// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/prediction_bands.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/random.h"
#include "correlation/analysis/measurement_gains.h"
#include "correlation/search/study_reuse_testing.h"
#include "correlation/study/spring_testing.h"
#include "correlation/study_report/study_report.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/predictions.h"
#include "report/html_text.h"

namespace latsch::correlation {
namespace {

constexpr double kNormal = 1.959964;

Identifiability identified(const Study& study, Depth depth) {
  Journal journal = Journal::open(study.run.journal, identity(study));
  InlineExecutor executor(evaluator(study));
  auto what = identify(study, study.space.initial(), depth, executor, journal, {});
  EXPECT_TRUE(what && *what);
  return std::move(**what);
}

std::vector<ExperimentBand> bands_of(const Study& study, const Identifiability& what) {
  return prediction_bands(study, what, Journal::read(study.run.journal));
}

/// A spring with a damper, F = k x + c v, is pulled at 0.4 m/s to 2, 5 and 9 mm and measured to 3
/// N. It is to be predicted at 1.2 m/s.
class SpringBands : public testing::Test {
 protected:
  SpringBands() {
    write("spring.toml", "kind = \"spring\"\nstiffness = \"20 N/mm\"\ndamping = \"300 N s/m\"\n");
    write("slow.toml",
          "kind = \"pull\"\nspeed = \"0.4 m/s\"\ntravels = [\"2 mm\", \"5 mm\", \"9 mm\"]\n");
    write("fast.toml", "kind = \"pull\"\nspeed = \"1.2 m/s\"\ntravels = [\"4 mm\", \"20 mm\"]\n");
    write("slow.csv", "travel [m],force [N]\n0.002,160\n0.005,220\n0.009,300\n");
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  Study read(const std::string& upper_damping, const std::string& more = "") {
    write("study.toml",
          R"(model = "spring.toml"
[test.slow]
file = "slow.toml"
[test.fast]
file = "fast.toml"
[variable.stiffness]
path = "stiffness"
lower = "5 N/mm"
upper = "60 N/mm"
initial = "20 N/mm"
[variable.damping]
path = "damping"
lower = "50 N s/m"
upper = ")" + upper_damping +
              R"("
initial = "300 N s/m"
[experiment.slowly]
kind = "curve"
x = "slow/travel"
y = "slow/force"
measurement = "slow.csv"
noise = "3 N"
exponent = 2
[experiment.swiftly]
kind = "values"
channel = "fast/force"
values = ["441 N", "730 N"]
noise = "4 N"
use = "predict"
)" + more);
    return read_study(folder_ / "study.toml", experiment::spring_language());
  }
  /// Simulates the predicted experiments at the best point and at points near it, as `latsch
  /// identify` does.
  static void predict_beside(const Study& study, const Identifiability& what) {
    InlineExecutor executor(evaluator(with_predictions(study)));
    ASSERT_TRUE(predict(study, prediction_points(study, what), executor, {}));
  }

  ScratchFolder folder_;
};

// The fitted line a + k x has a = c v; at the other speed the force is 3 a + k x. With the mean and
// the sum of squares Sxx of the m travels about it,
//   var k = sigma^2 / Sxx, var a = sigma^2 (1/m + mean^2 / Sxx), cov = -sigma^2 mean / Sxx.
TEST_F(SpringBands, OfALinearModelAreThoseByHand) {
  const Study study = read("900 N s/m");
  const Identifiability what = identified(study, Depth::intervals);
  EXPECT_FALSE(bands_of(study, what)[1].is_known());
  EXPECT_NE(bands_of(study, what)[1].remarks.at(0).find("latsch identify"), std::string::npos);
  predict_beside(study, what);
  const auto bands = bands_of(study, what);
  const double x[] = {0.002, 0.005, 0.009}, sigma = 3.0, mean = 0.016 / 3.0;
  double Sxx = 0.0;
  for (const double one : x) Sxx += (one - mean) * (one - mean);
  const auto half = [&](double at, double speed) {  // in units of the speed of the fitted test
    return kNormal * sigma *
           std::sqrt(speed * speed * (1.0 / 3.0 + mean * mean / Sxx) + at * at / Sxx -
                     2.0 * speed * at * mean / Sxx);
  };
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(bands[0].computed[i], 20e3 * x[i] + 120.0, 1e-6);
    EXPECT_NEAR(bands[0].upper[i] - bands[0].computed[i], half(x[i], 1.0), 1e-3) << i;
    EXPECT_NEAR(bands[0].noise[i], 3.0, 1e-9);
  }
  const double to[] = {0.004, 0.02};
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(bands[1].computed[i], 20e3 * to[i] + 360.0, 1e-6);
    EXPECT_NEAR(bands[1].upper[i] - bands[1].computed[i], half(to[i], 3.0), 1e-3) << i;
    EXPECT_NEAR(bands[1].computed[i] - bands[1].lower[i], half(to[i], 3.0), 1e-3) << i;
    EXPECT_NEAR(bands[1].noise[i], 4.0, 1e-9);
  }
  EXPECT_TRUE(bands[1].remarks.empty());
  // The simulated value 441 N differs by 1 N and lies inside its band; 730 N differs by 30 N and
  // lies inside its band of 40 N. The values of the first experiment are fitted exactly.
  EXPECT_EQ(bands[0].inside, 3);
  EXPECT_EQ(bands[1].compared, 2);
  EXPECT_EQ(bands[1].inside, half(0.02, 3.0) > 30.0 ? 2 : 1);
  EXPECT_EQ(widest_text(study.experiments[0], bands[0]).substr(0, 5), "+- 5.");
  EXPECT_EQ(inside_text(bands[0]), "3 of 3 measured values");
}

// The band of a value of 2 mm is 0.2 mm wide and is shown in the unit of the value's measurement.
TEST(WidestBand, IsToldInTheUnitOfItsMeasurement) {
  class Lengths : public Observable {
   public:
    explicit Lengths(std::string shown)
        : Observable({.kind = "values",
                      .compared = "dz",
                      .rows = {"dz"},
                      .unit = "m",
                      .shown = std::move(shown),
                      .measured = {2e-3},
                      .scales = {2e-3}}) {}
    Result<Comparison> compare(const Channels&, const ObjectiveSettings&) const override {
      return Failure{};
    }
    std::vector<std::filesystem::path> write(const Channels&,
                                             const MeasurementFiles&) const override {
      return {};
    }
    void draw(const ShownExperiment&, report::StudyReport&) const override {}
    std::string table(const Channels&, const Comparison&) const override { return ""; }
    std::pair<std::string, nlohmann::ordered_json> answer(const Channels&,
                                                          const Comparison&) const override {
      return {"", nullptr};
    }
  };
  const ExperimentBand band{{2e-3}, {1.8e-3}, {2.2e-3}, {}, 0, 0, {}};
  StudyExperiment experiment;
  experiment.observable = std::make_unique<Lengths>("mm");
  EXPECT_EQ(widest_text(experiment, band), "+- 0.2 mm (10 %), dz");
  experiment.observable = std::make_unique<Lengths>("");
  EXPECT_EQ(widest_text(experiment, band), "+- 0.0002 m (10 %), dz");
}

// The identification needs at most two trials for each variable, one more, and those of the ranking
// of measurements; the bands need no further trial.
TEST_F(SpringBands, CostNoTrial) {
  const Study study = read("900 N s/m");
  const Identifiability what = identified(study, Depth::intervals);
  predict_beside(study, what);
  const Study all = with_predictions(study);
  const long trials = Journal::read(study.run.journal).size(),
             predicted = Journal::read(all.run.journal).size();
  EXPECT_TRUE(bands_of(study, what)[1].is_known());
  EXPECT_EQ(Journal::read(study.run.journal).size(), trials);
  EXPECT_EQ(predicted, 3);
}

// The bound of the damping lies at the value found, and the measurement requires more damping. Only
// lower forces are possible inside the bounds.
TEST_F(SpringBands, AreOneSidedWhereAVariableIsHeldAtItsBound) {
  write("slow.csv", "travel [m],force [N]\n0.002,165\n0.005,226\n0.009,304\n");
  const Study study = read("300 N s/m");
  const Identifiability what = identified(study, Depth::intervals);
  ASSERT_EQ(what.identification.confidence().held[1], Bound::upper);
  predict_beside(study, what);
  const ExperimentBand band = bands_of(study, what)[1];
  EXPECT_GT(band.computed[0] - band.lower[0], 2.0 * (band.upper[0] - band.computed[0]));
  ASSERT_FALSE(band.remarks.empty());
  EXPECT_NE(band.remarks[0].find("damping is held at its bound"), std::string::npos);
}

// The force is measured at one speed only: k x + c v is known at this speed and not at any other.
TEST_F(SpringBands, SayWhatTheDataLeaveOpen) {
  write("slow.toml", "kind = \"pull\"\nspeed = \"0.4 m/s\"\ntravels = [\"5 mm\"]\n");
  write("slow.csv", "travel [m],force [N]\n0.005,220\n");
  Study study = read("900 N s/m");
  study.experiments[0].noise = {.relative = 0.001};
  const Identifiability what = identified(study, Depth::intervals);
  predict_beside(study, what);
  const auto bands = bands_of(study, what);
  EXPECT_TRUE(bands[0].remarks.empty());
  EXPECT_NEAR(bands[0].upper[0] - bands[0].computed[0], kNormal * 0.22, 1e-3);
  ASSERT_EQ(bands[1].remarks.size(), 1u);
  EXPECT_NE(bands[1].remarks[0].find("do not determine"), std::string::npos) << bands[1].remarks[0];
  // On the line F = k x + c v of equal forces, the damping ranges from 50 to 550 N s/m, limited by
  // the bounds of the stiffness.
  EXPECT_GE(bands[1].upper[0] - bands[1].computed[0], (550 - 300) * 0.8);
  EXPECT_GE(bands[1].computed[0] - bands[1].lower[0], (300 - 50) * 0.8);
}

// A prior of the damping acts like a measurement of it.
TEST_F(SpringBands, CountAPriorAsTheIntervalsDo) {
  write("slow.toml", "kind = \"pull\"\nspeed = \"0.4 m/s\"\ntravels = [\"5 mm\"]\n");
  write("slow.csv", "travel [m],force [N]\n0.005,220\n");
  Study study = read("900 N s/m");
  std::vector<DesignVariable> variables = study.space.variables();
  variables[1].prior = Prior{300.0, 10.0};
  study.space = DesignSpace(variables);
  const Identifiability what = identified(study, Depth::intervals);
  predict_beside(study, what);
  const ExperimentBand band = bands_of(study, what)[1];
  EXPECT_TRUE(band.remarks.empty());
  // The derivatives of y = k x + c v' with k = (F - c v) / 5 mm are dy/dc = v' - v x / 5 mm and
  // dy/dF = x / 5 mm.
  const double half = kNormal * std::hypot(10.0 * (1.2 - 0.4 * 0.8), 3.0 * 0.8);
  EXPECT_NEAR(band.upper[0] - band.computed[0], half, 1e-3);
}

const std::string kHeldOut = R"(exponent = 2
noise = "60 N"
[test.beyond]
file = "beyond.toml"
[experiment.held_out]
kind = "curve"
y = "beyond/Fy"
measurement = "beyond.csv"
use = "predict"
)";

/// A Magic Formula of two numbers, 1.3 and -22, is measured at 25 states; two others are held out.
class MagicBands : public FittedStudy {
 protected:
  MagicBands() {
    write("beyond.csv", "Fy [N]\n1\n1\n");
    write("beyond_states.csv", "Fz [N],alpha [deg]\n5000,2.5\n6500,14\n");
    write("beyond.toml", "kind = \"steady_states\"\nstates = \"beyond_states.csv\"\n");
  }
  void measure(const std::vector<double>& true_forces, double noise, std::uint64_t draw) {
    RandomStream random(17, draw);
    std::vector<double> Fy = true_forces;
    for (double& force : Fy) force += noise * random.normal();
    Channels measured;
    measured.add({"Fy", "N", Fy});
    write("measured.csv", formats::csv_text(measured));
  }
  const DesignPoint truth_{{1.3, -22.0}};
};

// At both held-out states the band contains the true tire's force in 95 of 100 draws of the noise
// on average. Fewer than 90 occur by chance once in ninety times.
TEST_F(MagicBands, HoldTheTruthNineteenTimesOfTwenty) {
  const Channels truth = *simulate_all(read(kHeldOut), truth_);
  int held[] = {0, 0};
  for (int draw = 0; draw < 100; ++draw) {
    measure(truth["steady/Fy"], 60.0, static_cast<std::uint64_t>(draw));
    Study study = read(kHeldOut);
    // Starting at the true values saves time; the fit ends elsewhere because of the noise.
    study.space = study.space.starting_at(truth_);
    std::filesystem::remove(study.run.journal);
    fit_all(study);
    const Journal journal = Journal::read(study.run.journal);
    const auto what = recorded_identifiability(study, journal);
    ASSERT_TRUE(what);
    const auto bands =
        prediction_bands(study, *what, journal, {{what->best, *simulate_all(study, what->best)}});
    ASSERT_TRUE(bands[1].is_known());
    for (int i = 0; i < 2; ++i) {
      const double Fy = truth["beyond/Fy"][static_cast<std::size_t>(i)];
      if (bands[1].lower[i] <= Fy && Fy <= bands[1].upper[i]) ++held[i];
    }
  }
  for (const int count : held) {
    EXPECT_GE(count, 90);
    EXPECT_LT(count, 100);
  }
}

// Derivatives from the recording and differences over trials give equal bands.
TEST_F(MagicBands, AreTheSameBySlopesAndByDifferences) {
  const Channels truth = *simulate_all(read(kHeldOut), truth_);
  measure(truth["steady/Fy"], 60.0, 1);
  Study study = read(kHeldOut);
  ASSERT_TRUE(study.asks_slopes);
  fit_all(study);
  const Journal journal = Journal::read(study.run.journal);
  const auto by_slopes = recorded_identifiability(study, journal);
  ASSERT_TRUE(by_slopes);
  const auto slopes = prediction_bands(
      study, *by_slopes, journal, {{by_slopes->best, *simulate_all(study, by_slopes->best)}});
  Study plain = study;
  plain.asks_slopes = false;
  plain.run.journal = folder_ / "plain.latsch";
  plain.space = plain.space.starting_at(by_slopes->best);
  Journal other = Journal::open(plain.run.journal, identity(plain));
  InlineExecutor executor(evaluator(plain));
  const auto what = identify(plain, by_slopes->best, Depth::at_the_point, executor, other, {});
  ASSERT_TRUE(what && *what);
  InlineExecutor predicted(evaluator(with_predictions(plain)));
  ASSERT_TRUE(predict(plain, prediction_points(plain, **what), predicted, {}));
  const auto differences = prediction_bands(plain, **what, other);
  for (std::size_t e = 0; e < 2; ++e) {
    ASSERT_EQ(slopes[e].upper.size(), differences[e].upper.size());
    for (std::size_t i = 0; i < slopes[e].upper.size(); ++i) {
      const double half = slopes[e].upper[i] - slopes[e].computed[i];
      EXPECT_GE(half, 0.0);  // 0 without slip
      // Differences over a hundredth of the range contain an error due to the curvature.
      EXPECT_NEAR(differences[e].upper[i] - differences[e].computed[i], half, 0.05 * half)
          << e << ", " << i;
    }
  }
}

// If the recordings contain derivatives, likelihood profiles need fewer recordings: none near the
// center, and none to update the derivatives along the profile.
TEST_F(MagicBands, ProfilesBySlopesAreThoseByDifferencesWithFewerRecordings) {
  const Channels truth = *simulate_all(read(kHeldOut), truth_);
  measure(truth["steady/Fy"], 60.0, 1);
  Study study = read(kHeldOut);
  fit_all(study);
  const DesignPoint best = best_trial(study, Journal::read(study.run.journal))->point;
  std::vector<TargetProfile> profiles[2];
  std::vector<ExperimentBand> bands[2];
  long recordings[2];
  for (const bool by_slopes : {false, true}) {
    study.asks_slopes = by_slopes;
    study.run.journal = folder_ / (by_slopes ? "slopes.latsch" : "differences.latsch");
    Journal journal = Journal::open(study.run.journal, identity(study));
    InlineExecutor executor(evaluator(study));
    const auto what = identify(study, best, Depth::profiles, executor, journal, {});
    ASSERT_TRUE(what && *what);
    profiles[by_slopes] = (*what)->identification.profiles();
    bands[by_slopes] = prediction_bands(study, **what, journal);
    recordings[by_slopes] = journal.size();
    const auto read = recorded_identifiability(study, journal);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->identification.profiles().size(), 2u);
  }
  EXPECT_LT(3 * recordings[true], 2 * recordings[false]);
  for (int i = 0; i < 2; ++i) {
    const Interval &one = profiles[false][i].interval, &other = profiles[true][i].interval;
    EXPECT_EQ(profiles[true][i].verdict, profiles[false][i].verdict);
    // Each refit may end when a fiftieth of the threshold is left, which changes an end by a
    // hundredth of the interval.
    EXPECT_NEAR(other.lower, one.lower, 0.02 * (one.upper - one.lower));
    EXPECT_NEAR(other.upper, one.upper, 0.02 * (one.upper - one.lower));
  }
  for (std::size_t k = 0; k < bands[true][0].upper.size(); ++k)
    EXPECT_NEAR(bands[true][0].upper[k],
                bands[false][0].upper[k],
                0.02 * (bands[false][0].upper[k] - bands[false][0].lower[k]));
}

TEST_F(MagicBands, AreDrawnAndTabledOnThePage) {
  const Channels truth = *simulate_all(read(kHeldOut), truth_);
  measure(truth["steady/Fy"], 60.0, 1);
  const Study study = read(kHeldOut);
  fit_all(study);
  const auto page = study_report(study, Journal::read(study.run.journal), {});
  ASSERT_TRUE(page && page->identifiability);
  ASSERT_EQ(page->curves.size(), 2u);
  for (const report::MeasuredCurve& curve : page->curves) {
    ASSERT_EQ(curve.band.lower.size(), curve.y_simulated.size());
    for (std::size_t i = 0; i < curve.y_simulated.size(); ++i) {
      EXPECT_LE(curve.band.lower[i], curve.y_simulated[i]);
      EXPECT_GE(curve.band.upper[i], curve.y_simulated[i]);
    }
  }
  ASSERT_EQ(page->identifiability->bands.size(), 2u);
  EXPECT_FALSE(page->identifiability->bands[1].fitted);
  const std::string html = report::html(*page);
  EXPECT_NE(html.find("class=\"band\""), std::string::npos);
  EXPECT_NE(html.find(report::typeset_words(page->identifiability->bands[1].widest)),
            std::string::npos);
  EXPECT_NE(html.find("of 25 measured values inside band and noise"), std::string::npos);
}

}  // namespace
}  // namespace latsch::correlation
