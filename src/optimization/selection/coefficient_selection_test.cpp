// SPDX-License-Identifier: Apache-2.0
#include "optimization/selection/coefficient_selection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/random.h"
#include "numerics/student_t.h"

namespace latsch {
namespace {

/// Residuals at a point of the unit cube; an empty vector: the evaluation failed.
using SelectionModel = std::function<Eigen::VectorXd(const Eigen::VectorXd& u)>;

Eigen::MatrixXd slopes_of(const SelectionModel& model, const Eigen::VectorXd& u) {
  constexpr double kWay = 1e-6;
  Eigen::MatrixXd J(model(u).size(), u.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    Eigen::VectorXd up = u, down = u;
    up[i] = std::min(1.0, u[i] + kWay);
    down[i] = std::max(0.0, u[i] - kWay);
    J.col(i) = (model(up) - model(down)) / (up[i] - down[i]);
  }
  return J;
}

CoefficientSelection answered_selection(SelectionProblem problem,
                                        const SelectionModel& model,
                                        bool with_slopes = true,
                                        const SelectionOptions& options = {}) {
  CoefficientSelection selection(std::move(problem), options);
  while (!selection.wanted().empty()) {
    std::vector<Result<Evaluated>> outcomes;
    for (const Eigen::VectorXd& u : selection.wanted()) {
      const Eigen::VectorXd r = model(u);
      if (r.size() == 0)
        outcomes.emplace_back(Failure{"no value"});
      else
        outcomes.emplace_back(Evaluated(r, with_slopes ? slopes_of(model, u) : Eigen::MatrixXd()));
      if (selection.is_enough(outcomes.front())) break;
    }
    selection.observe(outcomes);
  }
  return selection;
}

SelectionProblem problem_from_the_middle(int n) {
  SelectionProblem problem;
  problem.start = Eigen::VectorXd::Constant(n, 0.5);
  problem.toward = problem.start;
  for (int i = 0; i < n; ++i) problem.units.push_back({i});
  return problem;
}

/// Values of a polynomial of Legendre-like orthogonal columns: cosines over one period.
Eigen::MatrixXd orthogonal_columns(int rows, int columns) {
  Eigen::MatrixXd X(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      X(i, j) = std::sqrt(2.0) * std::cos(M_PI * (j + 1) * (i + 0.5) / rows);
  return X;
}

// With orthogonal columns, X'X = m 1, and stated noise, the estimates are independent with the
// deviation 1/sqrt(m), and BIC is least if exactly those with m b^2 > ln m are kept.
TEST(CoefficientSelection, OrthogonalColumnsAreKeptAboveTheLogarithmOfTheirNumberOfValues) {
  constexpr int kRows = 100, kColumns = 12;
  const Eigen::MatrixXd X = orthogonal_columns(kRows, kColumns);
  const double limit = std::sqrt(std::log(100.0) / kRows);
  Eigen::VectorXd b(kColumns);
  b << 1.02, 0.98, 0.2, 0.0, 0.5, 3.0, 0.9, 1.1, 0.05, 0.1, 5.0, 0.4;
  b *= limit;
  // the values are scaled so that one range of a variable is 10 limits
  SelectionProblem problem = problem_from_the_middle(kColumns);
  problem.sigma = 1.0;
  const auto selection = answered_selection(problem, [&](const Eigen::VectorXd& u) {
    return Eigen::VectorXd(X * ((20.0 * limit * (u.array() - 0.5)).matrix() - b));
  });
  ASSERT_TRUE(selection.status().ok());
  EXPECT_EQ(selection.path()[selection.best()].units, (std::vector<int>{0, 5, 7, 10}));
}

SelectionModel decays(const Eigen::VectorXd& y) {
  return [y](const Eigen::VectorXd& u) {
    Eigen::VectorXd r(y.size());
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const double t = 0.1 * static_cast<double>(i), x = 0.3 * t;
      r[i] = 4.0 * u[0] * std::exp(-3.0 * u[1] * t) + 2.0 * (u[2] - 0.5) + 2.0 * (u[3] - 0.5) * x +
             2.0 * (u[4] - 0.5) * x * x + 2.0 * (u[5] - 0.5) * std::sin(2.0 * t) - y[i];
    }
    return r;
  };
}

Eigen::VectorXd noisy_decay(std::uint64_t draw) {
  Eigen::VectorXd truth(6);
  truth << 0.5, 0.4, 0.5, 0.5, 0.5, 0.65;
  RandomStream random(9, draw);
  Eigen::VectorXd y = decays(Eigen::VectorXd::Zero(80))(truth);
  for (double& value : y) value += 0.05 * random.normal();
  return y;
}

SelectionProblem decay_problem() {
  SelectionProblem problem = problem_from_the_middle(6);
  problem.units = {{2}, {3}, {4}, {5}};
  return problem;
}

TEST(CoefficientSelection, DifferencesChooseAsSlopesDo) {
  for (const std::uint64_t draw : {1, 2, 3, 4, 5}) {
    const SelectionModel model = decays(noisy_decay(draw));
    const auto exact = answered_selection(decay_problem(), model, true);
    const auto differences = answered_selection(decay_problem(), model, false);
    ASSERT_TRUE(exact.status().ok() && differences.status().ok());
    const SelectedModel &a = exact.path()[exact.best()],
                        &b = differences.path()[differences.best()];
    EXPECT_EQ(a.units, b.units) << draw;
    EXPECT_EQ(a.units.back(), 3) << draw;  // the sine is true
    EXPECT_NEAR(a.bic, b.bic, 0.1) << draw;
  }
}

TEST(CoefficientSelection, ADroppedCoefficientHasExactlyItsValue) {
  const auto selection = answered_selection(decay_problem(), decays(noisy_decay(1)));
  const SelectedModel& best = selection.path()[selection.best()];
  ASSERT_LT(best.units.size(), 4u);
  for (std::size_t unit = 0; unit < 4; ++unit)
    if (std::find(best.units.begin(), best.units.end(), static_cast<int>(unit)) ==
        best.units.end()) {
      EXPECT_EQ(best.at.u[static_cast<Eigen::Index>(unit) + 2], 0.5);
      EXPECT_GT(selection.fates()[unit].round, 0);
    }
}

// The true coefficient lies beyond its bound, so the covariance says nothing about it.
TEST(CoefficientSelection, ACandidateHeldByItsBoundIsTestedByARefit) {
  constexpr int kRows = 100;
  const Eigen::MatrixXd X = orthogonal_columns(kRows, 4);
  Eigen::VectorXd b(4);
  b << 0.9, 0.0, 0.05, 1.5;
  SelectionProblem problem = problem_from_the_middle(4);
  problem.sigma = 1.0;
  const auto selection = answered_selection(problem, [&](const Eigen::VectorXd& u) {
    return Eigen::VectorXd(X * ((2.0 * (u.array() - 0.5)).matrix() - b));
  });
  ASSERT_TRUE(selection.status().ok());
  EXPECT_EQ(selection.path()[selection.best()].units, (std::vector<int>{0, 3}));
  const UnitFate& held = selection.fates()[3];
  EXPECT_TRUE(held.tested);
  // S rises from m (1.5 - 1)^2 to m 1.5^2
  EXPECT_NEAR(held.tested_rise, kRows * (1.5 * 1.5 - 0.5 * 0.5), 0.1);
}

TEST(CoefficientSelection, AGroupIsKeptOrDroppedAsOne) {
  const Eigen::MatrixXd X = orthogonal_columns(100, 4);
  Eigen::VectorXd b(4);
  b << 0.5, 0.0, 0.01, 0.02;
  SelectionProblem problem = problem_from_the_middle(4);
  problem.units = {{0, 1}, {2, 3}};
  problem.sigma = 1.0;
  const auto selection = answered_selection(problem, [&](const Eigen::VectorXd& u) {
    return Eigen::VectorXd(X * ((2.0 * (u.array() - 0.5)).matrix() - b));
  });
  EXPECT_EQ(selection.path()[selection.best()].units, std::vector<int>{0});
}

// Two columns that differ by only a hundredth: no value shows which of the two is the true one.
TEST(CoefficientSelection, OfTwoCandidatesThatActAlikeOneIsKeptAndTheOtherNamesIt) {
  Eigen::MatrixXd X = orthogonal_columns(100, 3);
  X.col(1) = X.col(0) + 0.01 * X.col(2);
  X.col(2).setZero();
  SelectionProblem problem = problem_from_the_middle(2);
  problem.sigma = 1.0;
  const auto selection = answered_selection(problem, [&](const Eigen::VectorXd& u) {
    return Eigen::VectorXd(X.leftCols(2) * (2.0 * (u.array() - 0.5)).matrix() -
                           0.6 * Eigen::VectorXd(X.col(0)));
  });
  ASSERT_TRUE(selection.status().ok());
  const auto& kept = selection.path()[selection.best()].units;
  ASSERT_EQ(kept.size(), 1u);
  const UnitFate& dropped = selection.fates()[static_cast<std::size_t>(1 - kept[0])];
  EXPECT_EQ(dropped.alike, kept[0]);
  EXPECT_LT(dropped.correlation, -0.95);
}

TEST(CoefficientSelection, AModelThatFailsWithoutACandidateKeepsIt) {
  const Eigen::MatrixXd X = orthogonal_columns(100, 2);
  SelectionProblem problem = problem_from_the_middle(2);
  problem.start << 0.7, 0.6;
  problem.sigma = 1.0;
  const auto selection = answered_selection(problem, [&](const Eigen::VectorXd& u) {
    if (u[0] < 0.51) return Eigen::VectorXd();
    return Eigen::VectorXd(X * (2.0 * (u.array() - 0.5)).matrix() -
                           0.11 * Eigen::VectorXd(X.col(0)));
  });
  ASSERT_TRUE(selection.status().ok());
  EXPECT_TRUE(selection.fates()[0].cannot_be_dropped);
  EXPECT_EQ(selection.path()[selection.best()].units, std::vector<int>{0});
}

/// Values of an autoregression of the first order with the deviation 1.
Eigen::VectorXd shared_noise(int rows, double phi, RandomStream& random) {
  Eigen::VectorXd e(rows);
  double last = random.normal();
  for (double& one : e) {
    one = last;
    last = phi * last + std::sqrt(1.0 - phi * phi) * random.normal();
  }
  return e;
}

// Under noise of an autoregression, m values hold as much about a mean as m (1 - phi)/(1 + phi)
// independent ones. Useless slow cosines are then kept by BIC about as seldom as under white noise,
// with a chance of that of a normal number beyond sqrt(ln m_e).
TEST(CoefficientSelection, NeighborsThatShareNoiseCountAsFewerValues) {
  constexpr int kRows = 600, kSets = 40, kUseless = 8;
  constexpr double kPhi = 0.8;
  const Eigen::MatrixXd X = orthogonal_columns(kRows, kUseless);
  double independent = 0.0;
  int kept = 0;
  for (int set = 0; set < kSets; ++set) {
    RandomStream random(12, static_cast<std::uint64_t>(set));
    const Eigen::VectorXd e = shared_noise(kRows, kPhi, random);
    SelectionProblem problem = problem_from_the_middle(kUseless);
    problem.traits.curves.assign(kRows, 0);
    const auto selection = answered_selection(problem, [&](const Eigen::VectorXd& u) {
      return Eigen::VectorXd(X * (4.0 * (u.array() - 0.5)).matrix() - e);
    });
    ASSERT_TRUE(selection.status().ok());
    independent += selection.rows().counted().independent / kSets;
    kept += static_cast<int>(selection.path()[selection.best()].units.size());
  }
  EXPECT_NEAR(independent, kRows * (1.0 - kPhi) / (1.0 + kPhi), 0.2 * kRows / 9.0);
  const double expected = kSets * kUseless * 0.042;  // P(|z| > sqrt(ln 67)) = 0.040
  EXPECT_LT(kept, expected + 3.0 * std::sqrt(expected));
}

TEST(CoefficientSelection, LeavesOutWholeRecordings) {
  // one recording has an offset of its own, which a coefficient of its pattern would explain there
  // and nowhere else
  constexpr int kRecordings = 6, kOfEach = 20;
  RandomStream random(13, 1);
  Eigen::MatrixXd X(kRecordings * kOfEach, 2);
  Eigen::VectorXd y(X.rows());
  std::vector<int> recordings;
  for (int row = 0; row < X.rows(); ++row) {
    const int recording = row / kOfEach;
    recordings.push_back(recording);
    X(row, 0) = random.normal();
    X(row, 1) = recording == 2 ? 1.0 : 0.0;
    y[row] = 0.5 * X(row, 0) + 0.4 * X(row, 1) + 0.3 * random.normal();
  }
  const SelectionModel model = [&](const Eigen::VectorXd& u) {
    return Eigen::VectorXd(X * (4.0 * (u.array() - 0.5)).matrix() - y);
  };
  SelectionProblem problem = problem_from_the_middle(2);
  problem.recordings = recordings;
  const auto by_bic = answered_selection(problem, model);
  EXPECT_EQ(by_bic.path()[by_bic.best()].units, (std::vector<int>{0, 1}));
  const auto by_recordings =
      answered_selection(problem, model, true, {.criterion = SelectionCriterion::cross_validation});
  // Least squares without each recording; the offset has no place without its own recording, and
  // the weak prior then holds it at 0.
  double left_out = 0.0;
  for (int recording = 0; recording < kRecordings; ++recording) {
    double xx = 0.0, xy = 0.0, xo = 0.0, oo = 0.0, oy = 0.0;
    for (int row = 0; row < X.rows(); ++row) {
      if (row / kOfEach == recording) continue;
      xx += X(row, 0) * X(row, 0);
      xy += X(row, 0) * y[row];
      xo += X(row, 0) * X(row, 1);
      oo += X(row, 1) * X(row, 1);
      oy += X(row, 1) * y[row];
    }
    const double det = xx * oo - xo * xo;
    const double slope = oo > 0.0 ? (xy * oo - xo * oy) / det : xy / xx;
    const double offset = oo > 0.0 ? (xx * oy - xo * xy) / det : 0.0;
    for (int row = recording * kOfEach; row < (recording + 1) * kOfEach; ++row)
      left_out += std::pow(y[row] - slope * X(row, 0) - offset * X(row, 1), 2);
  }
  EXPECT_NEAR(by_recordings.path()[0].left_out, left_out, 1e-3 * left_out);
}

// A frequency has several minima: the start is in the wrong one, the restart in the right one.
TEST(CoefficientSelection, ABetterMinimumFromTheRestartBeginsThePathAnew) {
  RandomStream random(14, 1);
  Eigen::VectorXd noise(80);
  for (double& e : noise) e = 0.1 * random.normal();
  const SelectionModel model = [&](const Eigen::VectorXd& u) {
    Eigen::VectorXd r(80);
    for (int k = 0; k < 80; ++k) {
      const double t = 0.1 * k;
      r[k] = std::sin((1.0 + 4.0 * u[0]) * t) + 2.0 * (u[1] - 0.5) * std::cos(t) +
             2.0 * (u[2] - 0.5) * std::sin(0.5 * t) -
             (std::sin(3.4 * t) + 0.4 * std::sin(0.5 * t) + noise[k]);
    }
    return r;
  };
  SelectionProblem problem = problem_from_the_middle(3);
  problem.units = {{1}, {2}};
  problem.start[0] = 0.05;
  problem.restart = problem.start;
  problem.restart[0] = 0.62;
  const auto selection = answered_selection(problem, model);
  ASSERT_TRUE(selection.status().ok());
  EXPECT_EQ(selection.passes(), 2);
  const SelectedModel& best = selection.path()[selection.best()];
  EXPECT_EQ(best.units, std::vector<int>{1});
  EXPECT_NEAR(best.at.u[0], 0.6, 0.01);
}

TEST(CoefficientSelection, MoreVariablesThanValuesNeedStatedNoise) {
  const Eigen::MatrixXd X = orthogonal_columns(5, 5);
  const auto selection = answered_selection(
      problem_from_the_middle(5), [&](const Eigen::VectorXd& u) { return Eigen::VectorXd(X * u); });
  EXPECT_FALSE(selection.status().ok());
  EXPECT_NE(selection.status().failure().reason.find("state the noise"), std::string::npos);
}

TEST(CoefficientSelection, AnExactFitIsNoGroundForAChoice) {
  const Eigen::MatrixXd X = orthogonal_columns(50, 3);
  const auto selection =
      answered_selection(problem_from_the_middle(3), [&](const Eigen::VectorXd& u) {
        return Eigen::VectorXd(X * (u - Eigen::Vector3d(0.6, 0.5, 0.4)));
      });
  EXPECT_FALSE(selection.status().ok());
}

TEST(CoefficientSelection, TheLimitOfRefitsIsTold) {
  SelectionOptions options;
  options.refits = 1;
  const auto selection = answered_selection(decay_problem(), decays(noisy_decay(1)), true, options);
  EXPECT_EQ(selection.refits(), 1);
  EXPECT_EQ(selection.ending(), SelectionEnd::refits);
}

TEST(InformationCriterion, AiccExceedsAicByTheTermOfHurvichAndTsai) {
  const CountedValues counted{.values = 30, .independent = 30, .noise_known = true};
  EXPECT_DOUBLE_EQ(aicc(10.0, 4, counted), 10.0 + 8.0 + 40.0 / 25.0);
  EXPECT_DOUBLE_EQ(bic(10.0, 4, counted), 10.0 + 4.0 * std::log(30.0));
  EXPECT_TRUE(std::isinf(aicc(10.0, 29, counted)));
}

}  // namespace
}  // namespace latsch
