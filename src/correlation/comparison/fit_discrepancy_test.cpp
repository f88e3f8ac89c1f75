// SPDX-License-Identifier: Apache-2.0
// Discrepancies of a fit of springs with dampers, F = k x + c v, in cases with a closed form.
#include "correlation/comparison/fit_discrepancy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <set>

#include "base/scratch_folder_testing.h"
#include "correlation/comparison/shaken_springs_testing.h"
#include "correlation/target/study_trials.h"
#include "evaluation/executors/inline_executor.h"

namespace latsch::correlation {
namespace {

constexpr double kTrueStiffness = 20e3, kTrueDamping = 300.0;  // N/m, N s/m

class SpringsThatMiss : public testing::Test {
 protected:
  SpringsThatMiss() { write("model.toml", spring_file(kTrueStiffness, kTrueDamping)); }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }

  /// A fit that begins and ends at the true parameters of the model.
  struct Fit {
    Study study;
    Journal journal;
    Identifiability what;
  };
  Fit fit(const std::string& tests_and_experiments) {
    write("fit.toml", R"(model = "model.toml"
[variable.stiffness]
path = "stiffness"
lower = "1 N/mm"
upper = "200 N/mm"
initial = "20 N/mm"
)" + tests_and_experiments);
    Study study = read_study(folder_ / "fit.toml", shaken_springs());
    Journal journal = Journal::open(study.run.journal, identity(study));
    InlineExecutor executor(evaluator(study));
    EXPECT_TRUE(
        identify(study, study.space.initial(), Depth::intervals, executor, journal, RunOptions{}));
    auto what = recorded_identifiability(study, journal);
    EXPECT_TRUE(what);
    return {std::move(study), std::move(journal), std::move(*what)};
  }

  ScratchFolder folder_;
};

// The measured tones are 1.4, 0.5 and 1.1 times as large as those of the model. The changes add up
// to no force along x nor along v,
//   0.4 - 0.5 + 0.1 = 0,    0.4 10^2 - 0.5 20^2 + 0.1 40^2 = 0
// so no number of the model can reproduce them, and the logarithm of a line is off by 2 ln of the
// gain around 10, 20 and 40 Hz. This includes the lines beside the tone, to which a Hann window
// gives a quarter of it. The bands of the two correct tones show no discrepancy.
TEST_F(SpringsThatMiss, AreOffByTheGainOfTheirTones) {
  const std::array<double, 5> gains = {1.0, 1.4, 0.5, 1.1, 1.0};
  std::string table = "time [s],force [N]\n";
  for (int i = 0; i < static_cast<int>(kShakenLength * kShakenRate); ++i) {
    const double t = i / kShakenRate;
    double force = 0.0;
    for (std::size_t k = 0; k < gains.size(); ++k) {
      const double w = 2.0 * std::numbers::pi * kShakenTones[k];
      force += gains[k] * kShakenAmplitude *
               (kTrueStiffness * std::sin(w * t) + kTrueDamping * w * std::cos(w * t));
    }
    table += fmt::format("{:.17g},{:.17g}\n", t, force);
  }
  write("shaken.csv", table);
  const Fit found = fit(R"([variable.damping]
path = "damping"
lower = "1 N s/m"
upper = "3000 N s/m"
initial = "300 N s/m"
[test.shake]
kind = "shake"
[experiment.shaken]
kind = "curve"
x = "shake/time"
y = "shake/force"
measurement = "shaken.csv"
noise = "0.01 N"
exponent = 2
)");
  const Eigen::MatrixXd exactly_there(2, 0);
  const SpectralDiscrepancy missed =
      spectral_discrepancy(found.study, found.what, exactly_there, kShakenLength);
  ASSERT_EQ(missed.frequency.size(), missed.deviation.size());
  // Only the spectral lines of the tones and the neighboring lines, 2 Hz away, count.
  const auto gain_at = [&](double center) {
    for (std::size_t k = 0; k < gains.size(); ++k)
      if (std::abs(std::log2(kShakenTones[k] / center)) < 1.0 / 6.0) return gains[k];
    return 0.0;
  };
  std::set<double> seen;
  for (std::size_t i = 0; i < missed.frequency.size(); ++i) {
    const double gain = gain_at(missed.frequency[i]);
    if (gain == 0.0) continue;  // a line beside a tone
    seen.insert(gain);
    EXPECT_NEAR(missed.deviation[i], 2.0 * std::abs(std::log(gain)), 1e-3) << missed.frequency[i];
  }
  EXPECT_EQ(seen.size(), 4u);  // two tones have 1.0
  EXPECT_EQ(missed.at(0.1), missed.deviation.front());
  EXPECT_EQ(missed.at(400.0), missed.deviation.back());
}

// Two recordings of n travels x differ as springs stiffer and softer by d. Each, predicted from the
// other, is off by 2 d x, and the prediction is as uncertain along x as a recording itself. With Q
// = d^2 sum x^2 / noise^2 and s the spread in units of the noise,
//   chi^2 / values = 2 (2^2 Q / 2) / (s^2 2 n) = 2 Q / (s^2 n)
// up to the prior of a stiffness that is uniform in its bounds, 12 s^2 noise^2 over sum x^2 and the
// square of their width, which is below 1e-5.
TEST_F(SpringsThatMiss, PredictEachOtherAsFarOffAsTheirStiffnessesAre) {
  constexpr int n = 24;
  constexpr double d = 2e3, noise = 3.0, kSpeed = 0.4;
  std::string travels, stiff = "travel [m],force [N]\n", soft = stiff;
  double squares = 0.0;
  for (int i = 1; i <= n; ++i) {
    const double x = 5e-4 * i;
    squares += x * x;
    travels += fmt::format("{}\"{:.17g} m\"", i > 1 ? ", " : "", x);
    const double force = kTrueStiffness * x + kTrueDamping * kSpeed;
    stiff += fmt::format("{:.17g},{:.17g}\n", x, force + d * x);
    soft += fmt::format("{:.17g},{:.17g}\n", x, force - d * x);
  }
  const auto experiment = [](const char* name) {
    return fmt::format(
        "[experiment.{}]\nkind = \"curve\"\nx = \"pull/travel\"\ny = \"pull/force\"\n"
        "measurement = \"{}.csv\"\nnoise = \"3 N\"\nexponent = 2\n",
        name,
        name);
  };
  write("stiff.csv", stiff);
  write("soft.csv", soft);
  const Fit found = fit("[test.pull]\nkind = \"pull\"\nspeed = \"0.4 m/s\"\ntravels = [" + travels +
                        "]\n" + experiment("stiff") + experiment("soft"));
  const double s = found.what.identification.confidence().sigma;
  const double expected = 2.0 * d * d * squares / (noise * noise) / (s * s * n);
  ASSERT_GT(expected, rare_ratio(2.0 * n));  // no chance
  EXPECT_NEAR(held_out_error(found.study, found.what, found.journal), std::sqrt(expected), 1e-4);
}

// Recordings that differ only by their noise show no model error.
TEST_F(SpringsThatMiss, AreNotBlamedForChance) {
  const auto recording = [](double sign) {
    std::string table = "travel [m],force [N]\n";
    for (const double x : {0.002, 0.005, 0.009})
      table += fmt::format("{:.17g},{:.17g}\n", x, kTrueStiffness * x + 120.0 + sign);
    return table;
  };
  write("high.csv", recording(1.0));
  write("low.csv", recording(-1.0));
  const Fit found = fit(R"([test.pull]
kind = "pull"
speed = "0.4 m/s"
travels = ["2 mm", "5 mm", "9 mm"]
[experiment.high]
kind = "curve"
x = "pull/travel"
y = "pull/force"
measurement = "high.csv"
noise = "3 N"
exponent = 2
[experiment.low]
kind = "curve"
x = "pull/travel"
y = "pull/force"
measurement = "low.csv"
noise = "3 N"
exponent = 2
)");
  EXPECT_EQ(held_out_error(found.study, found.what, found.journal), 1.0);
}

}  // namespace
}  // namespace latsch::correlation
