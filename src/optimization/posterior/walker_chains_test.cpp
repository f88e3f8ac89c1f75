// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/walker_chains.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "numerics/dense/cholesky.h"
#include "optimization/posterior/posterior_samples.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

/// A normal density whose variables have the same correlation with each other.
struct EqualCorrelation {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;

  EqualCorrelation(Eigen::Index n, double deviation, double correlation) {
    mean = Eigen::VectorXd::LinSpaced(n, 0.45, 0.55);
    covariance = Eigen::MatrixXd::Constant(n, n, correlation * deviation * deviation);
    covariance.diagonal().setConstant(deviation * deviation);
  }
  LogDensityAt density() const {
    return [factor = numerics::Cholesky(covariance), mean = mean](const Eigen::VectorXd& u) {
      return -0.5 * factor.solve_lower(Eigen::VectorXd(u - mean)).squaredNorm();
    };
  }
  WhitenedFrame frame() const { return {mean, 2.0 * numerics::Cholesky(covariance).L()}; }
};

PosteriorSamples walker_samples(const LogDensityAt& density,
                                const WhitenedFrame& frame,
                                const Eigen::MatrixXd& modes = {},
                                int count = 20'000) {
  const auto starts = walker_starts(frame, modes, density, 7);
  return draw_samples(WalkerChains(density, *starts, 7), {.samples = count});
}

double mean_of_draws(const Eigen::VectorXd& x) { return x.mean(); }
double deviation_of_draws(const Eigen::VectorXd& x) {
  return std::sqrt((x.array() - x.mean()).square().mean());
}

TEST(WalkerChains, SamplesAGaussianWithItsMeansDeviationsAndCorrelations) {
  for (const Eigen::Index n : {1, 2, 5, 12, 20}) {
    const EqualCorrelation gaussian(n, 0.03, n == 1 ? 0.0 : 0.99);
    const PosteriorSamples s = walker_samples(gaussian.density(), gaussian.frame());
    EXPECT_TRUE(s.unmixed.empty()) << n;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::VectorXd x = s.u.row(i).transpose();
      EXPECT_NEAR(mean_of_draws(x), gaussian.mean[i], 0.05 * 0.03) << n;
      EXPECT_NEAR(deviation_of_draws(x), 0.03, 0.03 * 0.03) << n;
      const Eigen::VectorXd first = s.u.row(0).transpose();
      const double product = ((x.array() - x.mean()) * (first.array() - first.mean())).mean();
      const double correlation = product / deviation_of_draws(x) / deviation_of_draws(first);
      EXPECT_NEAR(correlation, i > 0 ? 0.99 : 1.0, 0.02) << n;
    }
  }
}

TEST(WalkerChains, HaveTheSameBitsForAnyNumberOfThreads) {
  const EqualCorrelation gaussian(3, 0.05, 0.9);
  const auto starts = walker_starts(gaussian.frame(), {}, gaussian.density(), 3);
  WalkerChains alone(gaussian.density(), *starts, 3);
  alone.advance(150);
  for (const int threads : {2, 3, 7, 64}) {
    WalkerChains together(gaussian.density(), *starts, 3);
    together.advance(100, threads);
    together.advance(50, threads);
    EXPECT_EQ(together.places(), alone.places()) << threads;
    EXPECT_EQ(together.record().places, alone.record().places) << threads;
  }
}

// A density that rises linearly to its bound at 1: P(u < x) = x^2.
TEST(WalkerChains, FillADensityUpToItsBounds) {
  const LogDensityAt rising = [](const Eigen::VectorXd& u) { return std::log(u[0]); };
  const WhitenedFrame frame{Eigen::VectorXd::Constant(1, 0.7),
                            Eigen::MatrixXd::Constant(1, 1, 0.4)};
  const PosteriorSamples s = walker_samples(rising, frame);
  for (const double p : {0.025, 0.5, 0.975})
    EXPECT_NEAR(quantile_of(s.u.row(0).transpose(), p), std::sqrt(p), 0.015) << p;
}

// A narrow ridge u_0 + u_1 = 0.3 that ends at two bounds. Moves along the ridge have correlated
// coordinates, which a reflection at the bounds would turn off the ridge.
TEST(WalkerChains, FillACorrelatedRidgeUpToTheBounds) {
  const LogDensityAt ridge = [](const Eigen::VectorXd& u) {
    return -0.5 * std::pow((u.sum() - 0.3) / 0.03, 2) + 4.0 * u[0];
  };
  const WhitenedFrame frame{Eigen::VectorXd::Constant(2, 0.15),
                            0.05 * Eigen::MatrixXd::Identity(2, 2)};
  const PosteriorSamples s = walker_samples(ridge, frame);
  constexpr int kCells = 600;
  Eigen::VectorXd marginal = Eigen::VectorXd::Zero(kCells);
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j)
      marginal[i] += std::exp(ridge(Eigen::Vector2d((i + 0.5) / kCells, (j + 0.5) / kCells)));
  marginal /= marginal.sum();
  const Eigen::VectorXd x = s.u.row(0).transpose();
  double below = 0.0;
  for (int i = 0; i < kCells; ++i) {
    below += marginal[i];
    if (i % 25 != 24 || below > 0.999) continue;
    EXPECT_NEAR((x.array() < (i + 1.0) / kCells).cast<double>().mean(), below, 0.02) << i;
  }
}

// Weights 0.7 and 0.3, eight deviations apart.
TEST(WalkerChains, WeighTwoModesThatAreBothKnown) {
  const auto mixture = [](const Eigen::VectorXd& u) {
    const auto mode = [&](double center) {
      return std::exp(-0.5 * (u.array() - center).square().sum() / (0.05 * 0.05));
    };
    return std::log(0.7 * mode(0.3) + 0.3 * mode(0.7));
  };
  const WhitenedFrame frame{Eigen::VectorXd::Constant(2, 0.3),
                            0.1 * Eigen::MatrixXd::Identity(2, 2)};
  const PosteriorSamples s = walker_samples(mixture, frame, Eigen::MatrixXd::Constant(2, 1, 0.7));
  EXPECT_NEAR((s.u.row(0).array() < 0.5).cast<double>().mean(), 0.7, 0.05);
}

// Eight groups with means theta_j = mu + tau z_j and one value y_j of deviation 1 each; the group
// means are integrated in closed form: y_j has the variance 1 + tau^2. The density of (mu, tau) is
// integrated on a grid. The ten variables (mu, tau, theta) form a funnel.
TEST(WalkerChains, SampleAHierarchicalModelOrNameWhatDoesNotMix) {
  const Eigen::VectorXd y = to_vector({2.8, 0.8, -0.3, 0.7, -0.1, 0.1, 1.8, 1.2});
  // u in the cube: mu = 20 u - 10, tau = 10 u, theta = 20 u - 10
  const LogDensityAt density = [&](const Eigen::VectorXd& u) {
    const double mu = 20.0 * u[0] - 10.0, tau = 10.0 * u[1];
    if (!(tau > 0.0)) return kNoDensity;
    const Eigen::ArrayXd theta = 20.0 * u.tail(8).array() - 10.0;
    return -0.5 * (y.array() - theta).square().sum() -
           0.5 * (theta - mu).square().sum() / (tau * tau) - 8.0 * std::log(tau);
  };
  Eigen::VectorXd center = Eigen::VectorXd::Constant(10, 0.55);
  center[1] = 0.15;
  const WhitenedFrame frame{center, 0.05 * Eigen::MatrixXd::Identity(10, 10)};
  const PosteriorSamples s = walker_samples(density, frame);
  constexpr int kCells = 400;
  Eigen::VectorXd of_mu = Eigen::VectorXd::Zero(kCells);
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const double mu = 20.0 * (i + 0.5) / kCells - 10.0, tau = 10.0 * (j + 0.5) / kCells;
      const double v = 1.0 + tau * tau;
      of_mu[i] += std::exp(-0.5 * (y.array() - mu).square().sum() / v - 4.0 * std::log(v));
    }
  }
  of_mu /= of_mu.sum();
  const auto quantile = [&](double p) {
    double sum = 0.0;
    for (int i = 0; i < kCells; ++i) {
      if (sum + of_mu[i] >= p) return (i + (p - sum) / of_mu[i]) / kCells;
      sum += of_mu[i];
    }
    return 1.0;
  };
  const Eigen::VectorXd mu = s.u.row(0).transpose();
  const bool mixed = std::find_if(s.unmixed.begin(), s.unmixed.end(), [](int i) {
                       return i < 2;
                     }) == s.unmixed.end();
  for (const double p : {0.025, 0.5, 0.975}) {
    const double error = std::abs(quantile_of(mu, p) - quantile(p)) / deviation_of_draws(mu);
    // A variable that is called mixed has to be right; the rest is named.
    EXPECT_TRUE(!mixed || error < 0.1) << p << ' ' << error;
  }
  for (const ChainDiagnostics& d : s.diagnostics) {
    const bool is_good = d.rhat <= 1.01 && d.bulk >= 400.0 && d.tail >= 400.0;
    const auto i = static_cast<int>(&d - s.diagnostics.data());
    EXPECT_EQ(is_good, std::find(s.unmixed.begin(), s.unmixed.end(), i) == s.unmixed.end());
  }
  RecordProperty("mixed", mixed ? "yes" : "no");
}

// Walkers that a new density leaves without density go beside others and not onto them: a half of
// walkers at one place would have no differences to move along.
TEST(WalkerChains, StandApartWhereADensityEndedMostOfThem) {
  const EqualCorrelation gaussian(3, 0.03, 0.5);
  const auto starts = walker_starts(gaussian.frame(), {}, gaussian.density(), 7);
  WalkerChains chains(gaussian.density(), *starts, 7);
  chains.advance(200);
  const Eigen::VectorXd first = chains.places().row(0).transpose();
  const Eigen::Index half = first.size() / 2;
  const auto third_lowest = [](Eigen::VectorXd values) {
    std::nth_element(values.begin(), values.begin() + 2, values.end());
    return values[2];
  };
  const double limit = std::max(third_lowest(first.head(half)), third_lowest(first.tail(half)));
  ASSERT_TRUE(chains.change_density(
      [&](const Eigen::VectorXd& u) { return u[0] > limit ? kNoDensity : gaussian.density()(u); }));
  const Eigen::MatrixXd& places = chains.places();
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    EXPECT_LE(places(0, i), limit);
    for (Eigen::Index j = 0; j < i; ++j) {
      EXPECT_GT((places.col(i) - places.col(j)).norm(), 0.0) << i << ' ' << j;
    }
  }
}

// Two springs in series whose compliances add up to a known one, in logarithms over a factor of
// 200: a valley a hundred times as long as it is wide, which turns by a right angle. Three further
// variables are normal around a place that moves along the valley, so the marginal of the first is
// that of the two.
struct SpringsInSeries {
  static constexpr double kWidth = 0.01, kOthers = 0.01;
  static double misfit(double a, double b) {
    const auto soft = [](double u) { return std::pow(200.0, 0.5 - u); };
    return std::log(0.5 * (soft(a) + soft(b))) / kWidth;
  }
  static Eigen::VectorXd residuals(const Eigen::VectorXd& u) {
    Eigen::VectorXd r(4);
    r << misfit(u[0], u[1]), (u.tail(3).array() - 0.5 - 0.2 * (u[0] - 0.5)) / kOthers;
    return r;
  }
  static LogDensityAt density() {
    return [](const Eigen::VectorXd& u) { return -0.5 * residuals(u).squaredNorm(); };
  }
  static Eigen::MatrixXd slopes(const Eigen::VectorXd& u) {
    constexpr double kStep = 1e-6;
    Eigen::MatrixXd J(4, u.size());
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(u.size(), i);
      J.col(i) = (residuals(u + step) - residuals(u - step)) / (2.0 * kStep);
    }
    return J;
  }
  /// The place along the valley and the residuals.
  static Straightening straight() {
    return {[](const Eigen::VectorXd& u) {
              Eigen::VectorXd q(5);
              q << residuals(u), u[0] - u[1];
              return q;
            },
            [](const Eigen::VectorXd& u) {
              Eigen::MatrixXd slopes_of_q = Eigen::MatrixXd::Zero(5, 5);
              slopes_of_q.topRows(4) = slopes(u);
              slopes_of_q(4, 0) = 1.0;
              slopes_of_q(4, 1) = -1.0;
              return slopes_of_q;
            }};
  }
  /// Returns the probability of each of 400 cells of the first variable.
  static Eigen::VectorXd marginal() {
    constexpr int kCells = 400, kFine = 20'000;
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(kCells);
    for (int i = 0; i < kCells; ++i)
      for (int j = 0; j < kFine; ++j)
        sums[i] += std::exp(-0.5 * std::pow(misfit((i + 0.5) / kCells, (j + 0.5) / kFine), 2));
    return sums / sums.sum();
  }
  static PosteriorSamples samples(const Straightening& straight) {
    const Eigen::VectorXd center = Eigen::VectorXd::Constant(5, 0.5);
    const WhitenedFrame frame = whitened_frame(center, slopes(center));
    const auto starts = walker_starts(frame, {}, density(), 7);
    return draw_samples(WalkerChains(density(), *starts, 7, straight), {.samples = 20'000});
  }
};

TEST(WalkerChains, FillANarrowCurvedValleyInStraightCoordinates) {
  const PosteriorSamples s = SpringsInSeries::samples(SpringsInSeries::straight());
  EXPECT_TRUE(s.unmixed.empty());
  const Eigen::VectorXd x = s.u.row(0).transpose();
  const Eigen::VectorXd marginal = SpringsInSeries::marginal();
  double below = 0.0;
  for (Eigen::Index i = 0; i < marginal.size(); ++i) {
    below += marginal[i];
    if (i % 20 != 19) continue;
    // 20,000 draws are worth some 2000: three deviations of a share are 0.033
    const double edge = static_cast<double>(i + 1) / static_cast<double>(marginal.size());
    EXPECT_NEAR((x.array() < edge).cast<double>().mean(), below, 0.033) << i;
  }
}

TEST(WalkerChains, NameVariablesOfANarrowValleyWithoutThem) {
  EXPECT_FALSE(SpringsInSeries::samples(Straightening{}).unmixed.empty());
}

TEST(WalkerChains, MoveAlongAValleyWithTheSameBitsForAnyNumberOfThreads) {
  const Eigen::VectorXd center = Eigen::VectorXd::Constant(5, 0.5);
  const WhitenedFrame frame = whitened_frame(center, SpringsInSeries::slopes(center));
  const auto starts = walker_starts(frame, {}, SpringsInSeries::density(), 3);
  const auto places = [&](int threads) {
    WalkerChains chains(SpringsInSeries::density(), *starts, 3, SpringsInSeries::straight());
    chains.advance(100, threads);
    EXPECT_TRUE(chains.straighten());
    chains.advance(100, threads);
    return chains.places();
  };
  const Eigen::MatrixXd alone = places(1);
  for (const int threads : {2, 7}) EXPECT_EQ(places(threads), alone) << threads;
}

TEST(WalkerChains, ReflectAtTheFacesOfTheCube) {
  const Eigen::VectorXd u = to_vector({-0.25, 1.25, 2.25, 0.5});
  const Eigen::VectorXd expected = to_vector({0.25, 0.75, 0.25, 0.5});
  EXPECT_EQ(reflected_into_cube(u), expected);
}

TEST(WalkerChains, KeepStepsOfEvenDistanceWhenThereAreTooMany) {
  const EqualCorrelation gaussian(1, 0.05, 0.0);
  const auto starts = walker_starts(gaussian.frame(), {}, gaussian.density(), 3);
  WalkerChains chains(gaussian.density(), *starts, 3);
  WalkerChains again(gaussian.density(), *starts, 3);
  chains.advance(5000);
  const auto& record = chains.record();
  ASSERT_EQ(record.stride, 4);
  for (std::size_t k = 0; k < 10; ++k) {
    again.advance(record.stride);
    EXPECT_EQ(again.places(), record.places[k]) << k;
  }
}

}  // namespace
}  // namespace latsch
