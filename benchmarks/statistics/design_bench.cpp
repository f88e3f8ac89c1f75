// SPDX-License-Identifier: Apache-2.0
// Designs of tests whose settings vary continuously: against closed forms, exhaustive search, a
// grid that a person would run, and simulated campaigns.
//
// Closed forms [Atkinson, Donev, Tobias, Optimum Experimental Designs, with SAS, 2007; Bates,
// Watts, Nonlinear Regression Analysis, 1988]: a decay A exp(-k t) is measured at 0 and 1/k, half
// each; a saturation V x / (K + x) over 0 .. b at K b / (2 K + b) and b; a quadratic over -1 .. 1
// at -1, 0 and 1, a third each by its determinant, 1/4, 1/2, 1/4 by its variances and its
// predictions. Their constants are drawn at random. The rivals are those of [Atkinson, Fedorov,
// Biometrika 62 (1975) 57], and random ones.
//
// The tire has seven coefficients of side force over load, slip angle and camber, drawn around a
// passenger car's, and a rig that holds load times slip angle below 40 kN deg. Eleven random tests
// are known, and others are chosen until there are as many as the admitted part of a grid of
// 3 x 6 x 3 has. They are compared with this part of the grid.
//
// Half of the problems are a reserve that was not looked at before the end.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/random.h"
#include "numerics/dense/cholesky.h"
#include "optimization/design/continuous_design.h"
#include "optimization/design/model_discrimination.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using Places = std::vector<Eigen::VectorXd>;

constexpr double kNothing = 1e-9;  // information that only makes M invertible

/// Largest distances of designs of shares from their closed forms.
struct FarOff {
  double place = 0.0, share = 0.0, ratio = 0.0;
  bool has_all = true;
};

void compare_shares(const DesignProblem& problem,
                    const std::vector<double>& places,
                    const std::vector<double>& shares,
                    FarOff& off) {
  const SharedDesign design = best_shares(problem);
  off.ratio = std::max(off.ratio, design.largest_ratio);
  if (design.places.size() != places.size()) {
    off.has_all = false;
    return;
  }
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return design.places[a][0] < design.places[b][0];
  });
  for (std::size_t k = 0; k < places.size(); ++k) {
    off.place = std::max(off.place, std::abs(design.places[order[k]][0] - places[k]));
    off.share = std::max(off.share, std::abs(design.shares[order[k]] - shares[k]));
  }
}

DesignProblem problem_of(int n, std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> rows) {
  DesignProblem problem;
  problem.rows = std::move(rows);
  problem.present = kNothing * Eigen::MatrixXd::Identity(n, n);
  return problem;
}

FarOff decays(int first, int count) {
  FarOff off;
  for (int k = first; k < first + count; ++k) {
    RandomStream random(11, static_cast<std::uint64_t>(k));
    const double A = 0.5 + 4.0 * random.uniform(), rate = 0.5 + 3.0 * random.uniform();
    const double end = (2.0 + 6.0 * random.uniform()) / rate;
    const DesignProblem problem = problem_of(2, [=](const Eigen::VectorXd& s) {
      const double t = end * s[0], e = std::exp(-rate * t);
      return Eigen::MatrixXd(Eigen::RowVector2d(e, -A * t * e));
    });
    compare_shares(problem, {0.0, 1.0 / rate / end}, {0.5, 0.5}, off);
  }
  return off;
}

FarOff saturations(int first, int count) {
  FarOff off;
  for (int k = first; k < first + count; ++k) {
    RandomStream random(12, static_cast<std::uint64_t>(k));
    const double V = 0.5 + 4.0 * random.uniform(), K = 0.2 + 2.0 * random.uniform();
    const double b = K * (0.5 + 5.0 * random.uniform());
    const DesignProblem problem = problem_of(2, [=](const Eigen::VectorXd& s) {
      const double x = b * s[0];
      return Eigen::MatrixXd(Eigen::RowVector2d(x / (K + x), -V * x / ((K + x) * (K + x))));
    });
    compare_shares(problem, {K / (2.0 * K + b), 1.0}, {0.5, 0.5}, off);
  }
  return off;
}

/// A quadratic over -1 .. 1 whose coefficients are in other units, which changes no design by the
/// determinant.
FarOff quadratics(int first, int count) {
  FarOff off;
  for (int k = first; k < first + count; ++k) {
    RandomStream random(13, static_cast<std::uint64_t>(k));
    const double scale = std::pow(10.0, 2.0 * random.uniform() - 1.0);
    const auto rows = [=](const Eigen::VectorXd& s) {
      const double x = 2.0 * s[0] - 1.0;
      return Eigen::MatrixXd(scale * Eigen::RowVector3d(1.0, x, x * x));
    };
    DesignProblem problem = problem_of(3, rows);
    compare_shares(problem, {0.0, 0.5, 1.0}, {1.0 / 3, 1.0 / 3, 1.0 / 3}, off);
    problem.W = Eigen::MatrixXd::Identity(3, 3);
    compare_shares(problem, {0.0, 0.5, 1.0}, {0.25, 0.5, 0.25}, off);
    problem.W = (Eigen::Matrix3d() << 1, 0, 1.0 / 3, 0, 1.0 / 3, 0, 1.0 / 3, 0, 1.0 / 5).finished();
    compare_shares(problem, {0.0, 0.5, 1.0}, {0.25, 0.5, 0.25}, off);
  }
  return off;
}

/// Returns a problem in which tests of one setting have to tell the curve `truth` from a quadratic.
RivalProblem quadratic_rival(std::function<double(double)> truth) {
  RivalProblem problem;
  problem.truth = [truth](const Eigen::VectorXd& s) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, truth(2.0 * s[0] - 1.0)));
  };
  problem.rival = [](const Eigen::VectorXd& s, const Eigen::VectorXd& v) {
    const double x = 2.0 * s[0] - 1.0;
    constexpr double kRange = 40.0;
    return Eigen::VectorXd(Eigen::VectorXd::Constant(
        1, kRange * ((v[0] - 0.5) + (v[1] - 0.5) * x + (v[2] - 0.5) * x * x)));
  };
  problem.start = Eigen::VectorXd::Constant(3, 0.5);
  problem.present = kNothing * Eigen::MatrixXd::Identity(3, 3);
  return problem;
}

/// Returns T of the chosen tests over the largest T of all designs of as many tests on a grid.
double over_exhaustive(const RivalProblem& problem, int tests, int grid) {
  // The rival is linear, so T is the residual of a projection.
  const auto T_of = [&](const Places& places) {
    Eigen::MatrixXd F(std::ssize(places), 3);
    Eigen::VectorXd y(std::ssize(places));
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      const double x = 2.0 * places[static_cast<std::size_t>(k)][0] - 1.0;
      F.row(k) << 1.0, x, x * x;
      y[k] = problem.truth(places[static_cast<std::size_t>(k)])[0];
    }
    const Eigen::MatrixXd normal = F.transpose() * F + 1e-12 * Eigen::Matrix3d::Identity();
    const Eigen::VectorXd b =
        numerics::PivotedCholesky(normal).solve(Eigen::VectorXd(F.transpose() * y));
    return (y - F * b).squaredNorm();
  };
  double most = 0.0;
  std::vector<int> at(static_cast<std::size_t>(tests), 0);
  for (;;) {
    Places places;
    for (const int k : at)
      places.push_back(Eigen::VectorXd::Constant(1, static_cast<double>(k) / grid));
    most = std::max(most, T_of(places));
    std::size_t next = at.size();
    while (next > 0 && at[next - 1] == grid) --next;
    if (next == 0) break;
    const int value = at[next - 1] + 1;
    for (std::size_t k = next - 1; k < at.size(); ++k) at[k] = value;
  }
  return T_of(best_tests_against(problem, tests)) / most;
}

double worst_rival(int first, int count, int tests, int grid) {
  double worst = 1e300;
  for (int k = first; k < first + count; ++k) {
    RandomStream random(14, static_cast<std::uint64_t>(k));
    const double a = k == 0 ? 1.5 : 0.5 + 2.0 * random.uniform();
    const double b = k == 0 ? 2.0 : 0.5 + 2.0 * random.uniform();
    worst = std::min(worst,
                     over_exhaustive(quadratic_rival([=](double x) {
                                       return 4.5 - a * std::exp(x) - b * std::exp(-x);
                                     }),
                                     tests,
                                     grid));
  }
  return worst;
}

/// Side force by seven coefficients, over load, slip angle and camber.
struct Tire {
  Eigen::VectorXd p;  // 7, about 1: factors on the coefficients of a passenger car's tire

  static constexpr int kCoefficients = 7;
  static constexpr double kNoise = 20.0;  // N, a third of a percent of the largest force

  /// Returns the side force, N, at a place of the unit cube: load 1 .. 8 kN, slip angle -12 .. 12
  /// deg, camber -4 .. 4 deg.
  static double force(const Eigen::VectorXd& p, const Eigen::VectorXd& s) {
    constexpr double kDegree = 3.14159265358979 / 180.0, kNominal = 4000.0;
    const double Fz = 1000.0 + 7000.0 * s[0], df = Fz / kNominal - 1.0;
    const double alpha = kDegree * (24.0 * s[1] - 12.0), gamma = kDegree * (8.0 * s[2] - 4.0);
    const double C = 1.3 * p[0];
    const double D = Fz * (1.0 * p[1] - 0.15 * p[2] * df);
    const double K =
        20.0 * p[3] * kNominal * std::sin(2.0 * std::atan(Fz / (2.0 * p[4] * kNominal)));
    const double B = K / (C * D);
    const double E = -0.5 * p[5];
    const double x = alpha + 0.1 * p[6] * gamma;
    const double Bx = B * x;
    return D * std::sin(C * std::atan(Bx - E * (Bx - std::atan(Bx))));
  }
  static Eigen::RowVectorXd slopes(const Eigen::VectorXd& p, const Eigen::VectorXd& s) {
    constexpr double kStep = 1e-5;
    Eigen::RowVectorXd J(kCoefficients);
    for (int i = 0; i < kCoefficients; ++i) {
      Eigen::VectorXd up = p, down = p;
      up[i] += kStep;
      down[i] -= kStep;
      J[i] = (force(up, s) - force(down, s)) / (2.0 * kStep);
    }
    return J;
  }
  static bool admits(const Eigen::VectorXd& s) {
    const double Fz = 1.0 + 7.0 * s[0], alpha = 24.0 * s[1] - 12.0;
    return Fz * std::abs(alpha) <= 40.0;
  }
};

Tire random_tire(int number) {
  RandomStream random(15, static_cast<std::uint64_t>(number));
  Tire tire{Eigen::VectorXd::Ones(Tire::kCoefficients)};
  for (double& one : tire.p) one += 0.3 * (random.uniform() - 0.5);
  return tire;
}

Places random_tests(int count, std::uint64_t number) {
  RandomStream random(16, number);
  Places tests;
  while (std::ssize(tests) < count) {
    Eigen::VectorXd s(3);
    for (double& one : s) one = random.uniform();
    if (Tire::admits(s)) tests.push_back(s);
  }
  return tests;
}

Places admitted_grid() {
  Places grid;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 6; ++b)
      for (int c = 0; c < 3; ++c) {
        const Eigen::VectorXd s = Eigen::Vector3d(a / 2.0, b / 5.0, c / 2.0);
        if (Tire::admits(s)) grid.push_back(s);
      }
  return grid;
}

Eigen::VectorXd tire_deviations(const Tire& tire, const Places& tests, double weight = 1.0) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(Tire::kCoefficients, Tire::kCoefficients);
  for (const Eigen::VectorXd& s : tests) {
    const Eigen::RowVectorXd J = Tire::slopes(tire.p, s) / Tire::kNoise;
    M += weight * J.transpose() * J;
  }
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(Tire::kCoefficients, Tire::kCoefficients);
  return numerics::PivotedCholesky(M).solve(one).diagonal().cwiseSqrt();
}

/// The campaign of a tire: random tests and those chosen after them.
Places campaign_of(const Tire& tire, int random, int chosen, std::uint64_t number) {
  Places tests = random_tests(random, number);
  DesignProblem problem;
  problem.settings = 3;
  problem.finest = 1e-3;
  problem.admits = Tire::admits;
  problem.rows = [&](const Eigen::VectorXd& s) {
    return Eigen::MatrixXd(Tire::slopes(tire.p, s) / Tire::kNoise);
  };
  problem.present = Eigen::MatrixXd::Zero(Tire::kCoefficients, Tire::kCoefficients);
  for (const Eigen::VectorXd& s : tests) {
    const Eigen::MatrixXd J = problem.rows(s);
    problem.present += J.transpose() * J;
  }
  for (const Eigen::VectorXd& s : best_tests(problem, chosen)) tests.push_back(s);
  return tests;
}

/// Fits the coefficients to noisy forces by steps of Gauss and Newton from the truth, each halved
/// until the sum of squares falls.
Eigen::VectorXd fitted(const Tire& tire, const Places& tests, double noise, RandomStream& random) {
  Eigen::VectorXd measured(std::ssize(tests));
  for (std::size_t k = 0; k < tests.size(); ++k)
    measured[static_cast<Eigen::Index>(k)] =
        Tire::force(tire.p, tests[k]) + noise * random.normal();
  const auto residuals = [&](const Eigen::VectorXd& p) {
    Eigen::VectorXd r = measured;
    for (std::size_t k = 0; k < tests.size(); ++k)
      r[static_cast<Eigen::Index>(k)] -= Tire::force(p, tests[k]);
    return r;
  };
  Eigen::VectorXd p = tire.p, r = residuals(p);
  constexpr int kSteps = 30, kHalvings = 12;
  for (int step = 0; step < kSteps; ++step) {
    Eigen::MatrixXd J(std::ssize(tests), p.size());
    for (std::size_t k = 0; k < tests.size(); ++k)
      J.row(static_cast<Eigen::Index>(k)) = Tire::slopes(p, tests[k]);
    Eigen::VectorXd way = numerics::PivotedCholesky(Eigen::MatrixXd(J.transpose() * J))
                              .solve(Eigen::VectorXd(J.transpose() * r));
    for (int half = 0; half < kHalvings; ++half, way *= 0.5) {
      const Eigen::VectorXd next = residuals(p + way);
      if (!(next.squaredNorm() < r.squaredNorm())) continue;
      p += way;
      r = next;
      break;
    }
  }
  return p;
}

/// Returns the root mean square over the coefficients of realized over promised deviations.
double realized_ratio(const Tire& tire,
                      const Places& tests,
                      const Eigen::VectorXd& promised,
                      double noise,
                      int simulated,
                      std::uint64_t number) {
  RandomStream random(17, number);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(Tire::kCoefficients);
  for (int one = 0; one < simulated; ++one)
    squares += (fitted(tire, tests, noise, random) - tire.p).cwiseAbs2() / simulated;
  return std::sqrt(squares.cwiseQuotient(promised.cwiseAbs2()).mean()) * Tire::kNoise / noise;
}

constexpr double kLouder = 3.0;  // factor of a noise at which the tire is no longer nearly linear

struct TireFigures {
  double of_grid = 0.0, worst_of_grid = 0.0,
         random_of_grid = 0.0;                       // mean intervals over the grid's
  double realized = 0.0, least = 1e300, most = 0.0;  // realized over promised, mean and extremes
  double realized_loud = 0.0;                        // with three times the noise, mean
};

TireFigures campaigns(int first, int tires, int simulated) {
  TireFigures figures;
  const Places grid = admitted_grid();
  constexpr int kKnown = 11;
  const auto count = static_cast<int>(grid.size());
  for (int k = first; k < first + tires; ++k) {
    const Tire tire = random_tire(k);
    const auto number = static_cast<std::uint64_t>(k);
    const Eigen::VectorXd of_grid = tire_deviations(tire, grid);
    const Places tests = campaign_of(tire, kKnown, count - kKnown, number);
    const Eigen::VectorXd promised = tire_deviations(tire, tests);
    const double ratio = promised.cwiseQuotient(of_grid).mean();
    figures.of_grid += ratio / tires;
    figures.worst_of_grid = std::max(figures.worst_of_grid, ratio);
    figures.random_of_grid +=
        tire_deviations(tire, random_tests(count, number)).cwiseQuotient(of_grid).mean() / tires;
    const double realized = realized_ratio(tire, tests, promised, Tire::kNoise, simulated, number);
    figures.realized_loud +=
        realized_ratio(tire, tests, promised, kLouder * Tire::kNoise, simulated, number) / tires;
    figures.realized += realized / tires;
    figures.least = std::min(figures.least, realized);
    figures.most = std::max(figures.most, realized);
  }
  return figures;
}

void closed_rows(Table& table, const std::string& of, int first, int count) {
  constexpr double kPlace = 1e-3, kShare = 0.01, kRatio = 1.001;
  double ratio = 0.0;
  const auto row = [&](const char* what, const FarOff& off) {
    ratio = std::max(ratio, off.ratio);
    table.row(fmt::format("{}, {} of {}", what, count, of),
              off.has_all ? fmt::format("{:.1e}, {:.1e}", off.place, off.share) : "other places",
              "<= 1e-3, 0.01",
              off.has_all && off.place <= kPlace && off.share <= kShare);
  };
  row("decays: places, shares off", decays(first, count));
  row("saturations: places, shares off", saturations(first, count));
  row("quadratics by D, A, I: places, shares off", quadratics(first, count));
  table.row(fmt::format("largest sensitivity over its mean, {}", of),
            fmt::format("{:.6f}", ratio),
            "<= 1.001",
            ratio <= kRatio);
}

void tire_rows(Table& table, const std::string& of, int first, int tires, int simulated) {
  const TireFigures f = campaigns(first, tires, simulated);
  table.row(fmt::format("intervals of 11 random and 25 chosen tests over the grid's, {}", of),
            fmt::format("{:.3f}, worst {:.3f}", f.of_grid, f.worst_of_grid),
            "<= 0.8",
            f.worst_of_grid <= 0.8);
  table.note(fmt::format("intervals of random tests alone over the grid's, {}", of),
             fmt::format("{:.3f}", f.random_of_grid));
  table.full_row(
      fmt::format("realized over promised intervals, {} campaigns each, {}", simulated, of),
      fmt::format("{:.3f}, {:.3f} .. {:.3f}", f.realized, f.least, f.most),
      "0.9 .. 1.1",
      f.least >= 0.9 && f.most <= 1.1);
  table.note(fmt::format("the same with a noise of one percent, {}", of),
             fmt::format("{:.3f}", f.realized_loud));
}

int run(const Options& options) {
  Table table("design", options);
  const int count = options.size(10, 2), rivals = options.size(4, 1), tires = options.size(4, 1);
  const int grid = options.size(60, 20), simulated = options.size(200, 5);
  constexpr int kRivalTests = 4;
  constexpr double kExhaustive = 1.0 - 1e-3;
  const auto rows = [&](const std::string& of, int first) {
    closed_rows(table, of, first * count, count);
    const double worst = worst_rival(first * rivals, rivals, kRivalTests, grid);
    table.row(fmt::format("T of {} tests over exhaustive search, worst of {} rivals, {}",
                          kRivalTests,
                          rivals,
                          of),
              fmt::format("{:.5f}", worst),
              ">= 0.999",
              worst >= kExhaustive);
    tire_rows(table, of, first * tires, tires, simulated);
  };
  rows("the first half", 0);
  constexpr int kReserve = 100;  // numbers of its problems begin at this multiple
  if (!options.is_smoke() && !options.has("--without-reserve")) rows("the reserve", kReserve);
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  using namespace latsch::benchmarks;
  return run_benchmark(
      argc, argv, {{"--without-reserve", "", "leaves out the problems of the reserve"}}, run);
}
