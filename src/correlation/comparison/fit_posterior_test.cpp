// SPDX-License-Identifier: Apache-2.0
// Bands of a predicted density from the fit behind it, on springs with dampers, F = k x + c v. The
// fit pulls them at one speed, the comparison shakes them.
#include "correlation/comparison/fit_posterior.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/comparison/model_comparison.h"
#include "correlation/comparison/model_comparison_page.h"
#include "correlation/comparison/shaken_springs_testing.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/trial_ownership.h"
#include "evaluation/executors/inline_executor.h"

namespace latsch::correlation {
namespace {

constexpr double kStiffness = 20e3, kDamping = 300.0;
constexpr double kNormal90 = 1.644854;
const std::vector<double> kTravels = {0.002, 0.005, 0.009};
constexpr double kPullSpeed = 0.4;

/// A folder in memory for journals: the test writes hundreds of them, which need not wait for a
/// disk. If the machine has no such folder, the journals are written beside their study.
class JournalInMemory {
 public:
  JournalInMemory() {
    std::string pattern = "/dev/shm/latsch_XXXXXX";
    if (::mkdtemp(pattern.data())) folder_ = pattern;
  }
  ~JournalInMemory() {
    std::error_code ignored;
    if (folder_) std::filesystem::remove_all(*folder_, ignored);
  }
  /// Returns the [run] table of a study.
  std::string run_table() const {
    return folder_ ? fmt::format("[run]\njournal = \"{}/fit.latsch\"\n", *folder_) : "";
  }

 private:
  std::optional<std::string> folder_;
};

class FittedSprings : public testing::Test {
 protected:
  FittedSprings() {
    write("model.toml", spring_file(15e3, 250.0));  // start of the fit
    write("shake.toml", "kind = \"shake\"\n");
    write("pull.toml",
          "kind = \"pull\"\nspeed = \"0.4 m/s\"\ntravels = [\"2 mm\", \"5 mm\", \"9 mm\"]\n");
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }

  /// Fits forces measured at the travels, accurate to `noise` N.
  Study fit(const std::vector<double>& forces, double noise = 3.0, const std::string& more = "") {
    std::string table = "travel [m],force [N]\n";
    for (std::size_t i = 0; i < forces.size(); ++i)
      table += fmt::format("{:.17g},{:.17g}\n", kTravels[i], forces[i]);
    write("pull.csv", table);
    write("fit.toml",
          fmt::format(R"(model = "model.toml"
[test.pull]
file = "pull.toml"
[variable.stiffness]
path = "stiffness"
lower = "1 N/mm"
upper = "200 N/mm"
initial = "15 N/mm"
[variable.damping]
path = "damping"
lower = "1 N s/m"
upper = "3000 N s/m"
initial = "250 N s/m"
[experiment.pulled]
kind = "curve"
x = "pull/travel"
y = "pull/force"
measurement = "pull.csv"
noise = "{} N"
exponent = 2
{}{})",
                      noise,
                      more,
                      journal_.run_table()));
    Study study = read_study(folder_ / "fit.toml", shaken_springs());
    std::filesystem::remove(study.run.journal);
    Journal journal = Journal::open(study.run.journal, identity(study));
    mark_target(study, journal);
    InlineExecutor executor(evaluator(study));
    EXPECT_TRUE(
        identify(study, study.space.initial(), Depth::intervals, executor, journal, RunOptions{}));
    return study;
  }

  ModelComparisonFile comparison(const std::string& more = "", const std::string& at = "") {
    write("comparison.toml",
          R"(channels = ["force"]
segment = "0.5 s"
[band.tones]
edges = ["3 Hz", "85 Hz"]
[reference]
kind = "spring"
file = "specimen.toml"
[test.shaken]
file = "shake.toml"
[model.fitted]
kind = "spring"
file = "model.toml"
fits = ["pulled"]
[fit.pulled]
study = "fit.toml"
)" + at + more);
    return read_model_comparison(folder_ / "comparison.toml", shaken_springs());
  }

  ScratchFolder folder_;
  JournalInMemory journal_;
};

std::vector<double> exact_forces(double k, double c) {
  std::vector<double> forces;
  for (const double x : kTravels) forces.push_back(k * x + c * kPullSpeed);
  return forces;
}

/// Returns the deviation of ln(k^2 + c^2 w^2) from the covariance of a line k x + v c through three
/// points.
double closed_form_deviation(double f, double sigma) {
  const double w = 2.0 * std::numbers::pi * f, mean = 0.016 / 3.0;
  double Sxx = 0.0;
  for (const double x : kTravels) Sxx += (x - mean) * (x - mean);
  const double var_k = sigma * sigma / Sxx;
  const double var_c = sigma * sigma * (1.0 / 3.0 + mean * mean / Sxx) / (kPullSpeed * kPullSpeed);
  const double cov = -sigma * sigma * mean / Sxx / kPullSpeed;
  const double S = kStiffness * kStiffness + kDamping * kDamping * w * w;
  const double g_k = 2.0 * kStiffness / S, g_c = 2.0 * kDamping * w * w / S;
  return std::sqrt(g_k * g_k * var_k + 2.0 * g_k * g_c * cov + g_c * g_c * var_c);
}

std::size_t line_of(const numerics::Density& S, double f) {
  std::size_t k = 0;
  while (S.frequency[k] < f - 1e-6) ++k;
  return k;
}

// The density of the tones is that of the travel times k^2 + c^2 w^2, so its band is known. The
// covariance matters: without it, the band at 10 Hz, where k and c matter equally, would be half as
// wide again. The tolerance of 2 % allows for the curvature of a logarithm over one deviation.
TEST_F(FittedSprings, HaveTheBandOfTheFitsCovariance) {
  write("specimen.toml", spring_file(kStiffness, kDamping));
  fit(exact_forces(kStiffness, kDamping));
  const ModelComparison found = compare_models(comparison(), shaken_springs(), 1);
  const ModelRun& run = found.cases[0].models[0];
  for (const double f : kShakenTones) {
    const std::size_t k = line_of(run.densities[0], f);
    const double S = run.densities[0].value[k];
    EXPECT_NEAR(S / found.cases[0].reference[0].value[k], 1.0, 1e-6) << f;  // at the fit's point
    const double half = kNormal90 * closed_form_deviation(f, 3.0);
    EXPECT_NEAR(std::log(run.upper[0][k] / S), half, 0.02 * half) << f;
    EXPECT_NEAR(std::log(S / run.lower[0][k]), half, 0.02 * half) << f;
  }
  EXPECT_EQ(run.coverage[0], 1.0);
  EXPECT_EQ(found.fits[0].excess, 1.0);
}

// The records have 1000 samples a second and last 0.5 s, so their spectra end at 500 Hz and have a
// line every 2 Hz.
TEST_F(FittedSprings, AreNotComparedBeyondTheirRecords) {
  write("specimen.toml", spring_file(kStiffness, kDamping));
  fit(exact_forces(kStiffness, kDamping));
  const ModelComparisonFile good = comparison();
  const auto reason = [&](const auto& change) -> std::string {
    ModelComparisonFile changed = good;
    change(changed);
    try {
      compare_models(changed, shaken_springs(), 1);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(reason([](auto& file) { file.bands[0].band = {3.0, 600.0}; }), "above 500 Hz"));
  EXPECT_TRUE(has(reason([](auto& file) { file.bands[0].band = {0.1, 1.0}; }), "has no line"));
  EXPECT_TRUE(has(reason([](auto& file) { file.segment = 1e-3; }), "1 samples of"));
  EXPECT_TRUE(has(reason([](auto& file) { file.segment = 10.0; }), "shorter segment"));
  EXPECT_TRUE(has(reason([](auto& file) { file.noise["foo"] = 5.0; }), "reference.noise.foo"));
}

// The band that is computed from samples is equal: a quantile of 400 draws is known to about 5 % of
// the half width.
TEST_F(FittedSprings, HaveTheSameBandBySamples) {
  write("specimen.toml", spring_file(kStiffness, kDamping));
  fit(exact_forces(kStiffness, kDamping));
  const ModelComparison found =
      compare_models(comparison("[bands]\nsamples = 400\n"), shaken_springs(), 1);
  const ModelRun& run = found.cases[0].models[0];
  for (const double f : kShakenTones) {
    const std::size_t k = line_of(run.densities[0], f);
    const double half = kNormal90 * closed_form_deviation(f, 3.0);
    EXPECT_NEAR(0.5 * std::log(run.upper[0][k] / run.lower[0][k]), half, 0.15 * half) << f;
  }
}

// The measurement is off by an amount orthogonal to every line, so no line can reproduce it. With
// one degree of freedom its length is the spread seen, and the band is wider than from the stated
// 0.5 N by that ratio.
TEST_F(FittedSprings, HaveABandAsWideAsTheFitIsBad) {
  write("specimen.toml", spring_file(kStiffness, kDamping));
  // The error is orthogonal to a constant and to the travels, so no k and c can reproduce it.
  const std::array<double, 3> off = {4.0, -7.0, 3.0};
  auto forces = exact_forces(kStiffness, kDamping);
  for (std::size_t i = 0; i < 3; ++i) forces[i] += 0.25 * off[i];
  fit(forces, 0.5);
  const ModelComparison found = compare_models(comparison(), shaken_springs(), 1);
  const double excess = 0.25 * std::sqrt(16.0 + 49.0 + 9.0) / 0.5;
  EXPECT_NEAR(found.fits[0].excess, excess, 1e-6 * excess);
  const ModelRun& run = found.cases[0].models[0];
  const std::size_t k = line_of(run.densities[0], 80.0);
  const double half = kNormal90 * excess * closed_form_deviation(80.0, 0.5);
  EXPECT_NEAR(std::log(run.upper[0][k] / run.densities[0].value[k]), half, 0.1 * half);
}

// The springs are of the model's kind, with noise as stated in fit and reference. The lines of one
// spring depend on each other, so 300 springs give the share to sqrt(0.9 0.1 / 300) = 1.7 %. The
// tolerance of 4 % is more than two of these deviations.
TEST_F(FittedSprings, HoldTheLinesOfSpringsOfTheirKindAsOftenAsTheySay) {
  constexpr int kSprings = 300;
  double inside = 0.0;
  for (int i = 0; i < kSprings; ++i) {
    RandomStream random(15, static_cast<std::uint64_t>(i));
    const double k = kStiffness * std::exp(0.3 * random.normal());
    const double c = kDamping * std::exp(0.3 * random.normal());
    auto forces = exact_forces(k, c);
    for (double& force : forces) force += 3.0 * random.normal();
    write("specimen.toml", spring_file(k, c));
    fit(forces);
    ModelComparisonFile file = comparison();
    file.noise["force"] = 2.0;
    file.seed = i;
    inside += compare_models(file, shaken_springs(), 1).cases[0].models[0].coverage[0] / kSprings;
  }
  EXPECT_NEAR(inside, 0.9, 0.04);
}

// A line of one segment that contains only noise is distributed exponentially: its 5 % and 95 %
// quantiles are -ln 0.95 and -ln 0.05 times the mean. The tolerance is that of kNormal90, seven
// digits.
TEST(LineNoise, IsThatOfAPeriodogramWhereThereIsNothingElse) {
  const LineNoise noise{4.0, 1.0};
  EXPECT_NEAR(std::exp(noise.log_quantile(0.0, kNormal90)), -std::log(0.05), 1e-6);
  EXPECT_NEAR(std::exp(noise.log_quantile(0.0, -kNormal90)), -std::log(0.95), 1e-6);
  // If the noise N is small beside S, ln S has the standard deviation sqrt(2 N / S); the next term
  // of the series is N / S.
  EXPECT_NEAR(noise.log_quantile(4e4, 1.0), std::sqrt(2.0 * 4.0 / 4e4), 2.0 * 4.0 / 4e4);
  EXPECT_EQ((LineNoise{0.0, 1.0}.log_quantile(1.0, 2.0)), 0.0);
}

void expect_refused(const std::function<void()>& act, const std::string& words) {
  try {
    act();
    ADD_FAILURE() << "not refused: " << words;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST_F(FittedSprings, AreRefusedWhereTheFitIsNotOfThem) {
  write("specimen.toml", spring_file(kStiffness, kDamping));
  const Study study = fit(exact_forces(kStiffness, kDamping));
  expect_refused([&] { comparison("", "at = [\"front_tire\"]\n"); },
                 "fit pulled varies stiffness, which would be \"front_tire.stiffness\" of fitted");
  expect_refused([&] { comparison("", "at = [\"\", \"\"]\n"); }, "more than once");
  std::filesystem::remove(study.run.journal);
  const ModelComparisonFile file = comparison();
  expect_refused([&] { compare_models(file, shaken_springs(), 1); }, "latsch run");
}

TEST_F(FittedSprings, SayWhatTheirBandContains) {
  write("specimen.toml", spring_file(kStiffness, kDamping));
  fit(exact_forces(kStiffness, kDamping));
  const ModelComparisonFile file = comparison();
  const ModelComparison found = compare_models(file, shaken_springs(), 1);
  const std::string page = model_comparison_page(file, found);
  EXPECT_NE(page.find("fits leave in their variables"), std::string::npos);
  EXPECT_NE(page.find("not the effect of numbers that are neither fitted nor "
                      "stated"),
            std::string::npos);
  EXPECT_NE(findings(file, found)[1].find("bands of 90 % hold 100 % of the lines"),
            std::string::npos);
}

// A covariance that was determined for another test does not apply to this model.
TEST_F(FittedSprings, OfAStudyThatWasEditedSinceAreRefused) {
  write("specimen.toml", spring_file(kStiffness, kDamping));
  fit(exact_forces(kStiffness, kDamping));
  EXPECT_NO_THROW(compare_models(comparison(), shaken_springs(), 1));
  write("pull.toml",
        "kind = \"pull\"\nspeed = \"0.5 m/s\"\ntravels = [\"2 mm\", \"5 mm\", \"9 mm\"]\n");
  expect_refused([&] { compare_models(comparison(), shaken_springs(), 1); }, "--anew");
}

}  // namespace
}  // namespace latsch::correlation
