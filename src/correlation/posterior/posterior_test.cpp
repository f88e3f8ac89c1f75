// SPDX-License-Identifier: Apache-2.0
#include "correlation/posterior/posterior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/scratch_folder_testing.h"
#include "correlation/observable/force_curve.h"
#include "correlation/posterior/posterior_file.h"
#include "correlation/study/spring_testing.h"
#include "correlation/target/residuals.h"
#include "evaluation/executors/inline_executor.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

/// A spring a in series with a spring b, the force at 10 mm known to 5 %, and that of a alone to
/// 8 %: k = a b / (a + b) leaves a curved valley.
Study serial_springs() {
  const auto measured = [](const std::string& test, double force) {
    return std::make_shared<ForceCurve>(
        test, LoadDeflectionCurve{Abscissa::deflection, {0.01}, {force}, {}});
  };
  StudyExperiment press;
  press.name = "press";
  press.observable = measured("press", 20.0);
  press.noise = {.relative = 0.05};
  StudyExperiment alone = press;
  alone.name = "alone";
  alone.observable = measured("alone", 40.0);
  alone.noise = {.relative = 0.08};
  Study study{"study.toml",
              "springs",
              "springs.toml",
              Document::parse("a = 1", "springs.toml"),
              DesignSpace({{"a", {"a"}, 1e3, 1e4, 4e3}, {"b", {"a"}, 1e3, 2e4, 4e3}}),
              {press, alone},
              {},
              100,
              std::nullopt,
              {}};
  study.specimens = specimens_of(*experiment::spring_language().kinds.front());
  study.target_key = "springs";
  return study;
}

Result<Channels> pressed_springs(const DesignPoint& point) {
  const double a = point.values[0], b = point.values[1], k = a * b / (a + b);
  Channels channels;
  channels.add({"press/force", "N", {k * 0.01}});
  channels.add({"alone/force", "N", {a * 0.01}});
  return channels;
}

const StudyIdentity kSprings{{"model", "springs"}};

/// The fit: a = 4000 N/m and b = 4000 N/m reproduce both forces.
const DesignPoint kFit{{4e3, 4e3}};

Posterior sampled_springs(const Study& study, const std::filesystem::path& file) {
  Journal journal = Journal::open(file, kSprings);
  InlineExecutor executor(pressed_springs);
  const auto found = sample_posterior(study, kFit, executor, journal, {});
  EXPECT_TRUE(found && *found);
  return **found;
}

/// Returns the quantile of one variable's unit coordinate, integrated on a grid.
double quadrature_quantile(const Study& study, int variable, double p) {
  constexpr int kCells = 500;
  const Objective residuals = residual_objective(study);
  std::vector<double> marginal(kCells, 0.0);
  double sum = 0.0;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      std::vector<double> u(2);
      u[static_cast<std::size_t>(variable)] = (i + 0.5) / kCells;
      u[static_cast<std::size_t>(1 - variable)] = (j + 0.5) / kCells;
      const DesignPoint point = study.space.from_unit(u);
      const double k = std::exp(-0.5 * residuals(point, *pressed_springs(point))->value);
      marginal[static_cast<std::size_t>(i)] += k;
      sum += k;
    }
  }
  double below = 0.0;
  for (int i = 0; i < kCells; ++i) {
    const double share = marginal[static_cast<std::size_t>(i)] / sum;
    if (below + share >= p) return (i + (p - below) / share) / kCells;
    below += share;
  }
  return 1.0;
}

TEST(Posterior, OfSpringsInSeriesIsThatOfQuadrature) {
  const ScratchFolder folder;
  Study study = serial_springs();
  study.posterior.samples = 20'000;
  study.posterior.seed = 1;
  const Posterior posterior = sampled_springs(study, folder / "springs.latsch");
  EXPECT_EQ(posterior.check.verdict, SurrogateVerdict::stands) << posterior.check.deviation;
  EXPECT_LE(posterior.trials, 50);
  EXPECT_TRUE(posterior.noise_stated);
  for (int i = 0; i < 2; ++i) {
    const Eigen::VectorXd x = posterior.samples.u.row(i).transpose();
    const double deviation = posterior.shapes[static_cast<std::size_t>(i)].deviation;
    for (const double p : {0.025, 0.5, 0.975})
      EXPECT_NEAR(quantile_of(x, p), quadrature_quantile(study, i, p), 0.1 * deviation)
          << i << ' ' << p;
  }
  // b follows as the curved branch b = k a / (a - k)
  EXPECT_NE(posterior.shapes[1].distance, 0.0);
  EXPECT_FALSE(posterior.shapes[1].as_linear);
}

TEST(Posterior, HasTheSameBitsAgainAndFromTheJournalAlone) {
  const ScratchFolder folder;
  const Study study = serial_springs();
  const Posterior first = sampled_springs(study, folder / "springs.latsch");
  const Posterior again = sampled_springs(study, folder / "springs.latsch");
  EXPECT_EQ(first.samples.u, again.samples.u);
  EXPECT_EQ(first.samples.log_density, again.samples.log_density);
  const auto read = recorded_posterior(study, Journal::read(folder / "springs.latsch", kSprings));
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->samples.u, first.samples.u);
  EXPECT_EQ(read->trials, first.trials);
}

// The trials of a stopped sampling are in the journal; the continued one takes the same steps.
TEST(Posterior, ContinuesAfterAStopWithTheBitsOfAnUninterruptedSampling) {
  const ScratchFolder folder;
  const Study study = serial_springs();
  const Posterior whole = sampled_springs(study, folder / "whole.latsch");
  for (const long trials : {3L, 9L, 20L}) {
    const auto file = folder / ("stopped" + std::to_string(trials) + ".latsch");
    {
      Journal journal = Journal::open(file, kSprings);
      InlineExecutor executor(pressed_springs);
      RunOptions options;
      options.stop_requested = [&] { return journal.size() >= trials; };
      EXPECT_FALSE(sample_posterior(study, kFit, executor, journal, options).has_value());
      EXPECT_FALSE(recorded_posterior(study, journal).has_value());
    }
    EXPECT_EQ(sampled_springs(study, file).samples.u, whole.samples.u) << trials;
  }
}

// The bands of both forces, by the quantiles of the same grid weighted by the density.
TEST(SampledBands, OfACurvedValleyAreThoseOfQuadrature) {
  const ScratchFolder folder;
  Study study = serial_springs();
  study.posterior.samples = 20'000;
  study.posterior.seed = 1;
  const Posterior posterior = sampled_springs(study, folder / "springs.latsch");
  ASSERT_EQ(posterior.bands.size(), 2U);
  constexpr int kCells = 400;
  const Objective residuals = residual_objective(study);
  for (const SampledBand& band : posterior.bands) {
    std::vector<std::pair<double, double>> weighted;  // force, density
    double all = 0.0, mean = 0.0, square = 0.0;
    for (int i = 0; i < kCells * kCells; ++i) {
      const DesignPoint point =
          study.space.from_unit({(i / kCells + 0.5) / kCells, (i % kCells + 0.5) / kCells});
      const Channels channels = *pressed_springs(point);
      const double force = channels[band.experiment == 0 ? "press/force" : "alone/force"].front();
      const double density = std::exp(-0.5 * residuals(point, channels)->value);
      weighted.emplace_back(force, density);
      all += density;
      mean += density * force;
      square += density * force * force;
    }
    const double deviation = std::sqrt(square / all - mean * mean / (all * all));
    std::sort(weighted.begin(), weighted.end());
    const auto quantile = [&](double p) {
      double below = 0.0;
      for (const auto& [force, density] : weighted)
        if ((below += density) >= p * all) return force;
      return weighted.back().first;
    };
    EXPECT_NEAR(band.lower[0], quantile(0.025), 0.15 * deviation) << band.experiment;
    EXPECT_NEAR(band.median[0], quantile(0.5), 0.1 * deviation) << band.experiment;
    EXPECT_NEAR(band.upper[0], quantile(0.975), 0.15 * deviation) << band.experiment;
  }
}

/// Returns the study with chains on the model of a few trials.
Study springs_with_chains(PosteriorMethod method, long chain_runs) {
  Study study = serial_springs();
  study.posterior.samples = 4000;
  study.posterior.method = method;
  study.posterior.chain_runs = chain_runs;
  if (method == PosteriorMethod::model) study.posterior.runs = 0;
  return study;
}

TEST(Posterior, OfDelayedAcceptanceIsThatOfQuadrature) {
  const ScratchFolder folder;
  const Study study = springs_with_chains(PosteriorMethod::delayed, 4000);
  const Posterior posterior = sampled_springs(study, folder / "springs.latsch");
  EXPECT_TRUE(posterior.is_mixed());
  EXPECT_LE(posterior.chain_trials, 4000);
  EXPECT_EQ(posterior.bands.size(), 2U);
  for (int i = 0; i < 2; ++i) {
    const Eigen::VectorXd x = posterior.samples.u.row(i).transpose();
    const double deviation = posterior.shapes[static_cast<std::size_t>(i)].deviation;
    // ends of an effective number of 400 draws, the least that mixes, scatter by 0.13 deviations
    for (const double p : {0.025, 0.5, 0.975})
      EXPECT_NEAR(quantile_of(x, p), quadrature_quantile(study, i, p), 0.3 * deviation)
          << i << ' ' << p;
  }
}

// Chains on the model are in the journal like all trials: after a stop they take the same steps.
TEST(Posterior, ChainsOnTheModelContinueAfterAStopWithTheSameBits) {
  const ScratchFolder folder;
  for (const PosteriorMethod method : {PosteriorMethod::delayed, PosteriorMethod::model}) {
    const std::string method_name = name(method);
    const Study study = springs_with_chains(method, 600);
    const Posterior whole = sampled_springs(study, folder / (method_name + ".latsch"));
    EXPECT_GT(whole.samples.size(), 0) << method_name;
    const auto file = folder / (method_name + "_stopped.latsch");
    {
      Journal journal = Journal::open(file, kSprings);
      InlineExecutor executor(pressed_springs);
      RunOptions options;
      options.stop_requested = [&] { return journal.size() >= 333; };
      EXPECT_FALSE(sample_posterior(study, kFit, executor, journal, options).has_value());
    }
    EXPECT_EQ(sampled_springs(study, file).samples.u, whole.samples.u) << method_name;
    const auto read = recorded_posterior(study, Journal::read(file, kSprings));
    ASSERT_TRUE(read.has_value()) << method_name;
    EXPECT_EQ(read->samples.u, whole.samples.u) << method_name;
  }
}

TEST(Posterior, RefusesWhatIsNoDensity) {
  Study study = serial_springs();
  EXPECT_EQ(why_no_posterior(study), "");
  study.experiments[1].loss = {Loss::huber, 2.0};
  EXPECT_NE(why_no_posterior(study).find("experiment.alone has a robust loss, which is no density"),
            std::string::npos);
}

// Two values determine two variables exactly, so their noise is not known.
TEST(Posterior, RefusesToGuessANoiseThatNothingTells) {
  const ScratchFolder folder;
  Study study = serial_springs();
  for (StudyExperiment& experiment : study.experiments) experiment.noise.reset();
  Journal journal = Journal::open(folder / "springs.latsch", kSprings);
  InlineExecutor executor(pressed_springs);
  const auto found = sample_posterior(study, kFit, executor, journal, {});
  ASSERT_TRUE(found.has_value());
  ASSERT_FALSE(*found);
  EXPECT_NE(found->failure().reason.find("state the noise"), std::string::npos);
}

TEST(Posterior, WritesSamplesInTheUnitsOfTheVariables) {
  const ScratchFolder folder;
  Study study = serial_springs();
  study.space = DesignSpace({{"a", {"a"}, 1e3, 1e4, 4e3, Scale::linear, "N/mm"},
                             {"b", {"a"}, 1e3, 2e4, 4e3, Scale::linear, "kN/m"}});
  study.posterior.samples = 200;
  const Posterior posterior = sampled_springs(study, folder / "springs.latsch");
  write_samples(study, posterior, folder / "samples.csv");
  std::ifstream in(folder / "samples.csv");
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "a [N/mm],b [kN/m],log density,chain,density");
  std::getline(in, line);
  const double a = std::stod(line);
  EXPECT_NEAR(1e3 * a, posterior.point(study.space, 0).values[0], 1e-6);
  EXPECT_NE(line.find(",surrogate"), std::string::npos);
  long rows = 1;
  while (std::getline(in, line)) ++rows;
  EXPECT_EQ(rows, 200);
}

}  // namespace
}  // namespace latsch::correlation
