// SPDX-License-Identifier: Apache-2.0
// Whether 95 % intervals hold the truth 95 times of 100, and every verdict is the right one
//
// 500 synthetic data sets of a decay y = A exp(-k t) + c, observed at 20 times with Gaussian noise
// of 2 % of A. Each is fitted by least squares and asked for its intervals. The standard error of a
// coverage of 0.95 over 500 data sets is 0.0097: 93 to 97 % is two of them.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "base/random.h"
#include "optimization/identification.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using Model = std::function<Eigen::VectorXd(const std::vector<double>&)>;

constexpr int kDataSets = 500;
constexpr int kTimes = 20;
constexpr double kNoise = 0.02;
constexpr std::uint64_t kSeed = 2026;
const std::vector<double> kTruth{1.0, 1.5, 0.2};  // A, k, c

DesignSpace decay_space() {
  return DesignSpace(
      {{.name = "A", .lower = 0.1, .upper = 3.0, .initial = 0.8},
       {.name = "k", .lower = 0.1, .upper = 10.0, .initial = 1.2, .scale = Scale::logarithmic},
       {.name = "c", .lower = -1.0, .upper = 1.0, .initial = 0.3}});
}

double decay(const std::vector<double>& x, int j) {
  return x[0] * std::exp(-x[1] * 3.0 * j / (kTimes - 1)) + x[2];
}

struct Analyzed {
  Identification identification;
  long evaluations = 0;
};

Analyzed analyze(const DesignSpace& space,
                 const DesignPoint& point,
                 const Model& model,
                 const IdentificationOptions& options) {
  Analyzed a{Identification(space, point, options)};
  while (!a.identification.wanted().empty()) {
    std::vector<Result<Eigen::VectorXd>> residuals;
    for (const DesignPoint& p : a.identification.wanted()) residuals.push_back(model(p.values));
    a.evaluations += std::ssize(residuals);
    a.identification.observe(residuals);
  }
  return a;
}

/// The least squares, by refits from the initial point until nothing is gained.
DesignPoint fitted(const DesignSpace& space, const Model& model) {
  DesignPoint point = space.initial();
  std::vector<int> all(space.size());
  std::iota(all.begin(), all.end(), 0);
  for (int round = 0; round < 3; ++round) {
    const auto points = difference_points(space, point, 1e-4);
    std::vector<Eigen::VectorXd> residuals;
    for (const DesignPoint& p : points) residuals.push_back(model(p.values));
    Refit refit(differences(space, points, residuals), all, {.most_evaluations = 50});
    while (refit.wanted()) {
      refit.observe(
          model(space.from_unit({refit.wanted()->begin(), refit.wanted()->end()}).values));
    }
    point = space.from_unit({refit.best().u.begin(), refit.best().u.end()});
  }
  return point;
}

struct Coverage {
  std::vector<int> linear = std::vector<int>(3), profile = std::vector<int>(3);
  int identifiable = 0;  // verdicts
  long evaluations = 0;
};

bool holds(const Interval& interval, double u) {
  return interval.lower <= u && u <= interval.upper;
}

Coverage cover(bool noise_is_known) {
  const DesignSpace space = decay_space();
  const std::vector<double> truth = space.to_unit({kTruth});
  Coverage coverage;
  for (int set = 0; set < kDataSets; ++set) {
    RandomStream random(kSeed, set);
    Eigen::VectorXd y(kTimes);
    for (int j = 0; j < kTimes; ++j) y[j] = decay(kTruth, j) + kNoise * random.normal();
    const Model model = [&](const std::vector<double>& x) {
      Eigen::VectorXd r(kTimes);
      for (int j = 0; j < kTimes; ++j) r[j] = y[j] - decay(x, j);
      return r;
    };
    IdentificationOptions options;
    if (noise_is_known) options.confidence.sigma = kNoise;
    options.step = 1e-3;
    const Analyzed a = analyze(space, fitted(space, model), model, options);
    coverage.evaluations += a.evaluations;
    for (int i = 0; i < 3; ++i) {
      const Profile& profile = a.identification.profiles()[i];
      coverage.linear[i] += holds(a.identification.confidence().intervals[i], truth[i]);
      coverage.profile[i] += holds(profile.interval, truth[i]);
      coverage.identifiable += profile.verdict == Verdict::identifiable;
    }
  }
  return coverage;
}

void coverage_rows(Table& table, bool noise_is_known) {
  const Coverage coverage = cover(noise_is_known);
  const DesignSpace space = decay_space();
  const char* noise = noise_is_known ? "noise known" : "noise estimated";
  const auto row = [&](const std::string& what, int hits) {
    const double share = static_cast<double>(hits) / kDataSets;
    table.row(fmt::format("{}, {}", what, noise),
              fmt::format("{:.1f} %", 100 * share),
              "93 - 97 %",
              0.93 <= share && share <= 0.97);
  };
  for (int i = 0; i < 3; ++i) {
    row(fmt::format("linear interval of {} holds the truth", space[i].name), coverage.linear[i]);
    row(fmt::format("profile interval of {} holds the truth", space[i].name), coverage.profile[i]);
  }
  table.row(fmt::format("verdict identifiable, {}", noise),
            fmt::format("{} of {}", coverage.identifiable, 3 * kDataSets),
            "all",
            coverage.identifiable == 3 * kDataSets);
  table.note("evaluations an analysis with profiles",
             fmt::format("{:.0f}", static_cast<double>(coverage.evaluations) / kDataSets));
}

struct Case {
  std::string name;
  std::vector<DesignVariable> variables;  // initial: the fitted point
  Model model;
  std::vector<Verdict> right;
};

DesignVariable variable(const char* name, double lower, double fitted, double upper) {
  return {.name = name, .lower = lower, .upper = upper, .initial = fitted};
}

constexpr Verdict kIdentifiable = Verdict::identifiable, kOneSided = Verdict::one_sided,
                  kFlat = Verdict::flat, kSeveral = Verdict::several_minima;

/// Noise 1 % in all; every verdict follows from the formula.
std::vector<Case> constructed_cases() {
  const auto series = [](double a, double b) { return a * b / (a + b); };
  return {
      {"two springs, each measured",
       {variable("a", 1, 4, 10), variable("b", 1, 4, 10)},
       [](const auto& x) {
         return Eigen::VectorXd{{x[0] / 4 - 1, x[1] / 4 - 1}};
       },
       {kIdentifiable, kIdentifiable}},
      {"springs in series: neither is softer than both",
       {variable("a", 1, 4, 100), variable("b", 1, 4, 100)},
       [=](const auto& x) { return Eigen::VectorXd{{series(x[0], x[1]) / 2 - 1}}; },
       {kOneSided, kOneSided}},
      {"springs in parallel, narrow bounds: only their sum",
       {variable("a", 1, 4, 7), variable("b", 1, 4, 7)},
       [](const auto& x) { return Eigen::VectorXd{{(x[0] + x[1]) / 8 - 1}}; },
       {kFlat, kFlat}},
      {"a third spring that nothing measures",
       {variable("a", 1, 4, 7), variable("b", 1, 3, 7), variable("idle", 1, 3, 7)},
       [](const auto& x) {
         return Eigen::VectorXd{{x[0] / 4 - 1, x[1] / 3 - 1, x[0] * x[1] / 12 - 1}};
       },
       {kIdentifiable, kIdentifiable, kFlat}},
      {"a decay that is over before the first sample",
       {variable("A", 0.5, 1, 2), variable("k", 1, 30, 60)},
       [](const auto& x) {
         return Eigen::VectorXd{{x[0] - 1,
                                 x[0] * std::exp(-x[1]) - std::exp(-30.0),
                                 x[0] * std::exp(-2 * x[1]) - std::exp(-60.0)}};
       },
       {kIdentifiable, kOneSided}},
      {"the paper's Fig. 1: two basins in y",
       {variable("x", -2, -0.15, 2), variable("y", -2, -1.15, 2)},
       [](const auto& x) {
         const double a = 0.79, b = -1.15, y = x[1];
         const auto f = [&](double y) {
           return y * y * y * y / 4 - (a + b) * y * y * y / 3 + a * b * y * y / 2;
         };
         return Eigen::VectorXd{{x[0] + 0.15, std::sqrt(std::max(0.0, f(y) - f(b)))}};
       },
       {kIdentifiable, kSeveral}},
      {"a square is measured: the sign is not seen",
       {variable("w", -2, 1, 2), variable("c", 0, 0.5, 1)},
       [](const auto& x) {
         return Eigen::VectorXd{{x[0] * x[0] - 1, x[1] - 0.5}};
       },
       {kSeveral, kIdentifiable}},
      {"at its bound: the best value lies beyond",
       {variable("a", 1, 1, 4), variable("b", 1, 2, 4)},
       [](const auto& x) {
         return Eigen::VectorXd{{x[0] - 0.9, x[1] - 2}};
       },
       {kOneSided, kIdentifiable}},
  };
}

int run() {
  Table table("statistics");
  coverage_rows(table, /*noise_is_known=*/false);
  coverage_rows(table, /*noise_is_known=*/true);
  for (const Case& c : constructed_cases()) {
    const DesignSpace space(c.variables);
    const Analyzed a = analyze(space, space.initial(), c.model, {.confidence = {.sigma = 0.01}});
    std::string verdicts;
    int right = 0;
    for (int i = 0; i < space.size(); ++i) {
      const Profile& profile = a.identification.profiles()[i];
      verdicts += fmt::format("{}{}: {}", i > 0 ? "; " : "", space[i].name, name(profile.verdict));
      right += profile.verdict == c.right[i];
    }
    table.row(c.name, verdicts, "right", right == space.size());
  }
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main() { return latsch::benchmarks::guarded(latsch::benchmarks::run); }
