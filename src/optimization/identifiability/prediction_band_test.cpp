// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/prediction_band.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/QR>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/random.h"
#include "base/scratch_folder_testing.h"

namespace latsch {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Returns the linear model y = X u with variables fitted to the given values.
Linearization fitted(const MatrixXd& X, const VectorXd& values) {
  Linearization at;
  at.u = X.householderQr().solve(values);
  at.r = values - X * at.u;
  at.J = -X;
  return at;
}

MatrixXd line_through(const VectorXd& x) {
  MatrixXd X(x.size(), 2);
  X << VectorXd::Ones(x.size()), x;
  return X;
}

// The standard error of a straight line at x is s sqrt(1 / m + (x - mean)^2 / Sxx), so it grows
// under extrapolation. Here m = 5, Sxx = 10 / 4^2, the mean is 1/2 and s^2 = S / 3.
TEST(PredictionBand, OfAStraightLineIsTheTextbooks) {
  const VectorXd x = VectorXd::LinSpaced(5, 0.0, 1.0);
  const Linearization at = fitted(line_through(x), VectorXd{{0.31, 0.39, 0.52, 0.58, 0.70}});
  const double s = std::sqrt(at.sum_of_squares() / 3), t = 3.182446;
  const PredictionBands bands(at.u, confidence(at));
  for (const double to : {0.0, 0.5, 0.8, 3.0}) {
    const PredictionBand band = bands.of(Vector2d(1.0, to));
    const double half = t * s * std::sqrt(0.2 + (to - 0.5) * (to - 0.5) / 0.625);
    EXPECT_NEAR(band.upper, half, 1e-6 * half) << to;
    EXPECT_NEAR(band.lower, -half, 1e-6 * half) << to;
    EXPECT_EQ(band.open, -1);
  }
}

// The band of the value y = u_i is the interval of u_i for any data: if the search ended before the
// minimum, if a variable is held at its bound, with a prior, and with noise that neighbors share.
// Values outside of the cube do not count.
TEST(PredictionBand, OfAVariableIsItsInterval) {
  RandomStream random(3, 7);
  for (const bool colored : {false, true}) {
    Linearization at;
    at.u = VectorXd{{0.5, 0.4, 1.0}};
    at.J.resize(60, 3);
    for (double& value : at.J.reshaped()) value = random.normal();
    at.r.resize(60);
    double before = 0.0;
    for (double& value : at.r) {
      before = (colored ? 0.8 * before : 0.0) + 0.2 * random.normal();
      value = before;
    }
    at.J.row(0) = Eigen::RowVector3d(0.0, 10.0, 0.0);  // a prior
    // This holds a variable: S falls beyond its upper bound.
    at.r -= at.J.col(2) * 0.5;
    ConfidenceOptions options;
    if (colored) options.traits = {std::vector<double>(60, 1.0), std::vector<int>(60, 0)};
    const Confidence c = confidence(at, options);
    ASSERT_EQ(c.is_colored, colored);
    ASSERT_EQ(c.held[2], Bound::upper);
    const PredictionBands bands(at.u, c);
    for (int i = 0; i < 3; ++i) {
      const PredictionBand band = bands.of(VectorXd::Unit(3, i));
      const double lower = std::max(0.0, c.intervals[i].lower) - at.u[i],
                   upper = std::min(1.0, c.intervals[i].upper) - at.u[i];
      // The band is wider than the interval, because it uses the largest t of all variables and
      // contains the contribution of the held variable.
      const double more = colored ? 1.1 : 1.01;
      EXPECT_LE(band.lower, lower * (1 - 1e-9));
      EXPECT_GE(band.lower, lower * more - 1e-12);
      EXPECT_GE(band.upper, upper * (1 - 1e-9));
      EXPECT_LE(band.upper, upper * more + 1e-12);
    }
    EXPECT_EQ(bands.of(VectorXd::Unit(3, 2)).held, 2);
    EXPECT_EQ(bands.of(VectorXd::Unit(3, 0)).held, -1);
  }
}

// Only u1 + u2 is measured. Values that depend on it are known as well as if one variable were
// fitted. The difference may take any value in the cube, from -0.6 - 0.7 to 0.4 + 0.3 relative to
// the point.
TEST(PredictionBand, AlongADirectionThatTheDataLeaveOpenReachesToTheBounds) {
  Linearization at;
  at.u = Vector2d(0.6, 0.3);
  at.J = MatrixXd::Ones(4, 2);
  at.r = Eigen::Vector4d(0.01, -0.01, 0.01, -0.01);
  const PredictionBands bands(at.u, confidence(at, {.sigma = 0.01}));
  const PredictionBand sum = bands.of(Vector2d(1.0, 1.0));
  EXPECT_NEAR(sum.upper, 1.959964 * 0.01 / 2.0, 1e-8);
  EXPECT_EQ(sum.open, -1);
  const PredictionBand difference = bands.of(Vector2d(1.0, -1.0));
  EXPECT_NEAR(difference.upper, 0.4 + 0.3, 1e-9);
  EXPECT_NEAR(difference.lower, -0.6 - 0.7, 1e-9);
  EXPECT_GE(difference.open, 0);
  // u1 alone can vary from 0 to 0.9, because u1 + u2 = 0.9.
  const PredictionBand one = bands.of(Vector2d(1.0, 0.0));
  EXPECT_GT(one.upper, 0.3);
  EXPECT_LT(one.upper, 0.4);
  EXPECT_NEAR(one.lower, -0.6, 1e-9);
  // Derivatives computed by differences contain a small error in the open direction, which must not
  // change the band.
  EXPECT_NEAR(bands.of(Vector2d(1.0, 1.0 + 1e-9)).upper, sum.upper, 1e-8);
}

// S = (u1 + 0.3)^2 + (u1 + 2 u2 - 0.8)^2 in u >= 0 has its minimum at (0, 0.4), with u1 held. All
// values that y takes at points of a grid where S exceeds the minimum by no more than the threshold
// lie inside the band.
TEST(PredictionBand, ReachesToOneSideWhereAVariableIsHeldAtItsBound) {
  Linearization at{Vector2d(0.0, 0.4), Vector2d(0.3, 0.0), MatrixXd{{1.0, 0.0}, {1.0, 2.0}}};
  const Confidence c = confidence(at, {.sigma = 0.1});
  ASSERT_EQ(c.held[0], Bound::lower);
  const PredictionBands bands(at.u, c);
  for (const Vector2d& g : {Vector2d(1, 0), Vector2d(0, 1), Vector2d(2, 1), Vector2d(-3, 1)}) {
    double lower = 0.0, upper = 0.0;
    for (double u1 = 0.0; u1 < 0.2; u1 += 2e-4) {
      for (double u2 = 0.2; u2 < 0.6; u2 += 2e-4) {
        const Vector2d step(u1, u2 - 0.4);
        if ((at.r + at.J * step).squaredNorm() - at.sum_of_squares() > c.threshold()) continue;
        lower = std::min(lower, g.dot(step));
        upper = std::max(upper, g.dot(step));
      }
    }
    const PredictionBand band = bands.of(g);
    EXPECT_LE(band.lower, lower + 1e-3) << g.transpose();
    EXPECT_GE(band.upper, upper - 1e-3) << g.transpose();
    EXPECT_LE(band.upper - band.lower, 1.5 * (upper - lower)) << g.transpose();
  }
  EXPECT_EQ(bands.of(Vector2d(1.0, 0.0)).lower, 0.0);
  EXPECT_EQ(bands.of(Vector2d(1.0, 0.0)).held, 0);
}

constexpr const char* kPython = "/usr/bin/python3";
constexpr const char* kScript = R"py(
import sys
try:
    import numpy as np
    from scipy.optimize import curve_fit
    from scipy.stats import t
except ImportError:
    sys.exit(77)
x, y = np.loadtxt("xy", unpack=True)
def decay(x, a, b, k):
    return a + b * np.exp(-k * x)
p, C = curve_fit(decay, x, y, p0=(0.2, 1.0, 0.4), xtol=1e-14, ftol=1e-14)
at = np.array([0.0, 1.0, 4.0, 9.0])
g = np.stack([np.ones(4), np.exp(-p[2] * at), -p[1] * at * np.exp(-p[2] * at)])
half = t.ppf(0.975, len(x) - 3) * np.sqrt(np.einsum("ij,ik,kj->j", g, C, g))
np.savetxt("found", np.concatenate([p, half]), fmt="%.17g")
)py";

// The curve y = a + b exp(-k x) is fitted and extrapolated by SciPy's curve_fit and its covariance.
TEST(PredictionBand, OfANonlinearCurveIsThatOfSciPy) {
  const ScratchFolder folder;
  RandomStream random(5, 1);
  VectorXd x = VectorXd::LinSpaced(25, 0.0, 5.0), y(25);
  for (int i = 0; i < 25; ++i) y[i] = 0.3 + 0.9 * std::exp(-0.5 * x[i]) + 0.01 * random.normal();
  std::ofstream table(folder / "xy"), script(folder / "fit.py");
  for (int i = 0; i < 25; ++i) table << fmt::format("{:.17g} {:.17g}\n", x[i], y[i]);
  script << kScript;
  table.close();
  script.close();
  const int status = std::system(
      fmt::format("test -x {0} || exit 77; cd '{1}' && {0} fit.py", kPython, (folder / "").string())
          .c_str());
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "SciPy is not installed: nothing to compare with";
  ASSERT_EQ(status, 0);
  std::ifstream answer(folder / "found");
  std::vector<double> found(7);
  for (double& value : found) answer >> value;
  ASSERT_TRUE(answer);
  const double a = found[0], b = found[1], k = found[2];
  const auto g = [&](double at) {
    return Eigen::Vector3d(1.0, std::exp(-k * at), -b * at * std::exp(-k * at));
  };
  Linearization at{Eigen::Vector3d(a, b, k), VectorXd(25), MatrixXd(25, 3)};
  for (int i = 0; i < 25; ++i) {
    at.r[i] = a + b * std::exp(-k * x[i]) - y[i];
    at.J.row(i) = g(x[i]).transpose();
  }
  const PredictionBands bands(at.u, confidence(at));
  const double to[] = {0.0, 1.0, 4.0, 9.0};
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(bands.of(g(to[i])).upper, found[3 + i], 1e-4 * found[3 + i]) << to[i];
}

}  // namespace
}  // namespace latsch
