// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/surrogate_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "numerics/student_t.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

using WhitenedModel = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Returns the fit of a model at `center` with slopes by central differences.
FittedDensity fitted_density(const WhitenedModel& model,
                             const Eigen::VectorXd& center,
                             double s = 1.0) {
  constexpr double kStep = 1e-5;
  FittedDensity fit;
  fit.r_c = model(center);
  fit.J.resize(fit.r_c.size(), center.size());
  for (Eigen::Index i = 0; i < center.size(); ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(center.size(), i);
    fit.J.col(i) = (model(center + step) - model(center - step)) / (2.0 * kStep);
  }
  fit.frame = whitened_frame(center, fit.J / s);
  fit.density.values = fit.r_c.size();
  return fit;
}

/// Answers all questions with the model; one that leads to an empty vector counts as failed.
void answer_runs(SurrogateRuns& runs, const WhitenedModel& model) {
  while (!runs.wanted().empty()) {
    std::vector<std::optional<Eigen::VectorXd>> outcomes;
    for (const Eigen::VectorXd& u : runs.wanted()) {
      const Eigen::VectorXd r = model(u);
      outcomes.push_back(r.size() > 0 ? std::optional(r) : std::nullopt);
    }
    runs.observe(outcomes);
  }
}

/// Runs the chains so long that their quantiles scatter by 0.04 deviations at most.
PosteriorSamples surrogate_samples(const SurrogateRuns& runs) {
  return draw_samples(runs.chains(), {.samples = 40'000, .first_steps = 100'000});
}

Eigen::MatrixXd slopes_at_random(Eigen::Index m, Eigen::Index n) {
  RandomStream random(1, static_cast<std::uint64_t>(n));
  Eigen::MatrixXd A(m, n);
  for (double& a : A.reshaped()) a = random.normal();
  return A;
}

// With a linear model the posterior is Student's with m - n degrees of freedom if s is unknown:
// (u_i - fit_i) / deviation_i is t-distributed.
TEST(SurrogateRuns, ALinearModelWithUnknownNoiseHasStudentsDistribution) {
  constexpr Eigen::Index m = 12, n = 4;
  const Eigen::MatrixXd A = 100.0 * slopes_at_random(m, n);
  Eigen::VectorXd off(m);
  RandomStream random(2, 0);
  for (double& e : off) e = random.normal();
  const Eigen::MatrixXd N = A.transpose() * A;
  const numerics::Cholesky normal(N);
  off -= A * normal.solve(Eigen::VectorXd(A.transpose() * off));  // the fit is at the center
  const Eigen::VectorXd center = Eigen::VectorXd::Constant(n, 0.5);
  const WhitenedModel model = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    return off + A * (u - center);
  };
  const double s = std::sqrt(off.squaredNorm() / (m - n));
  FittedDensity fit = fitted_density(model, center, s);
  fit.density.s = std::nullopt;
  SurrogateRuns runs(fit, {});
  answer_runs(runs, model);
  EXPECT_EQ(runs.trials(), 22);  // two batches and the check
  EXPECT_EQ(runs.check().verdict, SurrogateVerdict::stands);
  EXPECT_LT(runs.check().deviation, 1e-3);
  const PosteriorSamples samples = surrogate_samples(runs);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double deviation =
        s * normal.solve_lower(Eigen::VectorXd(Eigen::VectorXd::Unit(n, i))).norm();
    for (const double p : {0.025, 0.5, 0.975}) {
      const double expected = 0.5 + deviation * numerics::student_t_quantile(p, m - n);
      EXPECT_NEAR(quantile_of(samples.u.row(i).transpose(), p), expected, 0.1 * deviation) << p;
    }
  }
}

/// A curved valley: v = 3 x^2 is known five times as well as x.
Eigen::VectorXd banana_residuals(const Eigen::VectorXd& u) {
  const double x = u[0] - 0.5, v = u[1] - 0.3;
  return to_vector({x / 0.15, (v - 3.0 * x * x) / 0.03});
}

/// Returns the quantile of one variable of a density in the unit square, on a grid.
double grid_quantile(const LogDensityAt& density, Eigen::Index variable, double p) {
  constexpr int kCells = 600;
  Eigen::VectorXd marginal = Eigen::VectorXd::Zero(kCells);
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      Eigen::VectorXd u(2);
      u[variable] = (i + 0.5) / kCells;
      u[1 - variable] = (j + 0.5) / kCells;
      marginal[i] += std::exp(density(u));
    }
  }
  marginal /= marginal.sum();
  double sum = 0.0;
  int i = 0;
  while (sum + marginal[i] < p) sum += marginal[i++];
  return (i + (p - sum) / marginal[i]) / kCells;
}

TEST(SurrogateRuns, SamplesABananaAsQuadratureIntegratesIt) {
  const Eigen::VectorXd center = to_vector({0.5, 0.3});
  SurrogateRuns runs(fitted_density(banana_residuals, center), {});
  answer_runs(runs, banana_residuals);
  EXPECT_EQ(runs.check().verdict, SurrogateVerdict::stands);
  EXPECT_LE(runs.trials(), 50);
  const PosteriorSamples samples = surrogate_samples(runs);
  EXPECT_TRUE(samples.unmixed.empty());
  const LogDensityAt exact = [](const Eigen::VectorXd& u) {
    return -0.5 * banana_residuals(u).squaredNorm();
  };
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Eigen::VectorXd x = samples.u.row(i).transpose();
    const double deviation = std::sqrt((x.array() - x.mean()).square().mean());
    for (const double p : {0.025, 0.5, 0.975})
      EXPECT_NEAR(quantile_of(x, p), grid_quantile(exact, i, p), 0.1 * deviation) << i << ' ' << p;
  }
}

// The surrogate learns from the straight model at the fit and is checked by the curved one.
TEST(SurrogateRuns, RefusesASurrogateThatKnowsNoCurvature) {
  const Eigen::VectorXd center = to_vector({0.5, 0.3});
  const FittedDensity fit = fitted_density(banana_residuals, center);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SurrogateRuns runs(fit, {.seed = seed});
    SurrogateRuns* asked = &runs;
    answer_runs(runs, [&](const Eigen::VectorXd& u) -> Eigen::VectorXd {
      if (asked->is_checking()) return banana_residuals(u);
      return fit.r_c + fit.J * (u - center);
    });
    EXPECT_EQ(runs.check().verdict, SurrogateVerdict::refused) << seed;
  }
}

// The model fails where x > 0.55, which is a third of a deviation beside the fit.
TEST(SurrogateRuns, GivesNoDensityToFailures) {
  const WhitenedModel failing = [](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    return u[0] > 0.55 ? Eigen::VectorXd() : banana_residuals(u);
  };
  const Eigen::VectorXd center = to_vector({0.5, 0.3});
  SurrogateRuns runs(fitted_density(failing, center), {.runs = 200});
  answer_runs(runs, failing);
  EXPECT_GT(runs.failed(), 0);
  const PosteriorSamples samples = surrogate_samples(runs);
  // the nearest sample decides, so the edge is as sharp as the samples are dense
  EXPECT_LT((samples.u.row(0).array() > 0.6).cast<double>().mean(), 0.05);
  for (const KnownSample& sample : runs.fit().known)
    EXPECT_TRUE(sample.r || runs.log_density()(sample.u) == kNoDensity);
}

// The last steps of a search lie so close to the fit that their residuals differ from the linear
// ones by rounding errors alone.
TEST(SurrogateRuns, LearnsNoCurvatureFromRoundingErrorsBesideTheFit) {
  const Eigen::MatrixXd A = 20.0 * slopes_at_random(12, 3);
  const Eigen::VectorXd center = Eigen::VectorXd::Constant(3, 0.5);
  FittedDensity fit = fitted_density(
      [&](const Eigen::VectorXd& u) { return Eigen::VectorXd(A * (u - center)); }, center);
  fit.J = A;
  fit.slopes_exact = true;
  RandomStream random(9, 0);
  for (int k = 0; k < 6; ++k) {
    Eigen::VectorXd u = center, r;
    for (double& value : u) value += 1e-7 * random.normal();
    r = A * (u - center);
    for (double& value : r) value += 1e-9 * random.normal();
    fit.known.push_back({u, r});
  }
  const SurrogateRuns runs(fit, {.runs = 0});
  const LogDensityAt density = runs.log_density();
  for (int k = 0; k < 20; ++k) {
    Eigen::VectorXd y(3);
    for (double& value : y) value = random.normal();
    const Eigen::VectorXd u = fit.frame.place(y);
    const double exact = -0.5 * (A * (u - center)).squaredNorm();
    EXPECT_NEAR(density(u), exact, 0.01) << k;
  }
}

TEST(SurrogateRuns, SayThatNothingWasCheckedWithoutRuns) {
  const Eigen::VectorXd center = to_vector({0.5, 0.3});
  const SurrogateRuns runs(fitted_density(banana_residuals, center), {.runs = 0});
  EXPECT_TRUE(runs.wanted().empty());
  EXPECT_EQ(runs.check().verdict, SurrogateVerdict::unchecked);
}

TEST(ResidualSurrogate, RepeatsAPolynomialOfTheFourthDegree) {
  const auto quartic = [](double y) {
    return to_vector({1.0 + y - 0.3 * y * y + 0.02 * y * y * y * y, 2.0 - y * y * y});
  };
  SurrogateSamples samples{Eigen::VectorXd::LinSpaced(9, -1.5, 1.5),
                           Eigen::MatrixXd(9, 2),
                           quartic(0.0),
                           (Eigen::MatrixXd(2, 1) << 1.0, 0.0).finished()};
  for (Eigen::Index k = 0; k < 9; ++k) samples.R.row(k) = quartic(samples.Y(k, 0)).transpose();
  for (const bool exact : {false, true}) {
    samples.slopes_exact = exact;
    const ResidualSurrogate surrogate(samples);
    for (const double at : {-1.3, -0.2, 0.7, 1.45}) {
      const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, at);
      EXPECT_NEAR((surrogate.residuals(y) - quartic(at)).norm(), 0.0, 2e-3) << at;
      EXPECT_NEAR(surrogate.sum_of_squares(y), surrogate.residuals(y).squaredNorm(), 1e-8) << at;
    }
  }
}

TEST(ResidualSurrogate, HasTheSlopesOfItsResiduals) {
  constexpr Eigen::Index kVariables = 3, kValues = 20;
  for (const bool is_exact : {false, true}) {
    RandomStream random(5, 0);
    SurrogateSamples samples{Eigen::MatrixXd(9, kVariables),
                             Eigen::MatrixXd(9, kValues),
                             Eigen::VectorXd::Constant(kValues, 0.3),
                             slopes_at_random(kValues, kVariables),
                             is_exact};
    for (double& y : samples.Y.reshaped()) y = random.normal();
    for (double& r : samples.R.reshaped()) r = random.normal();
    const ResidualSurrogate surrogate(samples);
    const Eigen::VectorXd y = Eigen::Vector3d(0.4, -0.7, 0.2);
    constexpr double kStep = 1e-5;
    Eigen::MatrixXd J(kValues, kVariables);
    for (Eigen::Index i = 0; i < kVariables; ++i) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(kVariables, i);
      J.col(i) = (surrogate.residuals(y + step) - surrogate.residuals(y - step)) / (2.0 * kStep);
    }
    const Eigen::MatrixXd expected = J.transpose() * J;
    const Eigen::MatrixXd reduced = surrogate.reduced() * surrogate.weight_slopes(y);
    EXPECT_LT((reduced.transpose() * reduced - expected).norm(), 1e-7 * expected.norm());
    const Eigen::VectorXd product = J.transpose() * surrogate.residuals(y);
    const Eigen::VectorXd same = reduced.transpose() * (surrogate.reduced() * surrogate.weights(y));
    EXPECT_LT((same - product).norm(), 1e-7 * product.norm()) << is_exact;
  }
}

TEST(ResidualSurrogate, KnowsLeastFarFromItsSamples) {
  SurrogateSamples samples{Eigen::VectorXd::LinSpaced(3, -0.5, 0.5),
                           Eigen::MatrixXd::Zero(3, 4),
                           Eigen::VectorXd::Zero(4),
                           Eigen::MatrixXd::Zero(4, 1)};
  const ResidualSurrogate surrogate(samples);
  EXPECT_NEAR(surrogate.variance(Eigen::VectorXd::Constant(1, 0.5)), 0.0, 1e-5);
  EXPECT_GT(surrogate.variance(Eigen::VectorXd::Constant(1, 1.5)),
            100.0 * surrogate.variance(Eigen::VectorXd::Constant(1, 0.6)));
}

}  // namespace
}  // namespace latsch
