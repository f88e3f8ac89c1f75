// SPDX-License-Identifier: Apache-2.0
// Coverage of 95 % intervals, and correctness of every verdict.
//
// 500 synthetic data sets of a decay y = A exp(-k t) + c, observed at 20 times with Gaussian noise
// of 2 % of A, are analyzed by linear interval and profile. Then three models, a decay, a damped
// oscillation and a force over slip, have noise of unknown size:
//   independent   200 samples
//   colored       200 samples, neighbors correlated by 0.8
//   oversampled   a tenth as many samples would suffice: noise through a second-order low pass
//                 whose corner is at a fortieth of the rate, 400 samples
// There is also a twin: five numbers of a Magic Formula tire from its own side force and moment
// with 2 % of noise, fitted by auto from their usual initial values. Each model is fitted by least
// squares, and its intervals are computed. The standard error of a coverage of 0.95 over 500 data
// sets is 0.0097; the limits of 93 to 97 % are two standard errors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numeric>

#include "base/random.h"
#include "correlation/observable/curve.h"
#include "correlation/search/study_method.h"
#include "correlation/study/study.h"
#include "correlation/target/residuals.h"
#include "correlation/target/study_trials.h"
#include "optimization/identifiability/identification.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using Model = std::function<Eigen::VectorXd(const std::vector<double>&)>;

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
    std::vector<Result<Evaluated>> residuals;
    for (const DesignPoint& p : a.identification.wanted()) residuals.emplace_back(model(p.values));
    a.evaluations += std::ssize(residuals);
    a.identification.observe(residuals);
  }
  return a;
}

/// Returns the least-squares point. Fits are repeated, each from the point of the one before, until
/// the sum of squares no longer decreases.
DesignPoint fitted(const DesignSpace& space, const Model& model) {
  DesignPoint point = space.initial();
  std::vector<int> all(space.size());
  std::iota(all.begin(), all.end(), 0);
  for (int round = 0; round < 3; ++round) {
    const auto points =
        difference_points(space, point, Eigen::VectorXd::Constant(space.size(), 1e-4));
    std::vector<Eigen::VectorXd> residuals;
    for (const DesignPoint& p : points) residuals.push_back(model(p.values));
    BroydenFit refit(differences(space, points, residuals), all, {.most_evaluations = 50});
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
  int identifiable = 0;  // number of verdicts "identifiable"
  long evaluations = 0;
};

bool holds(const Interval& interval, double u) {
  return interval.lower <= u && u <= interval.upper;
}

Coverage cover(bool noise_is_known, int sets) {
  const DesignSpace space = decay_space();
  const std::vector<double> truth = space.to_unit({kTruth});
  Coverage coverage;
  for (int set = 0; set < sets; ++set) {
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
      const TargetProfile& profile = a.identification.profiles()[i];
      coverage.linear[i] += holds(a.identification.confidence().intervals[i], truth[i]);
      coverage.profile[i] += holds(profile.interval, truth[i]);
      coverage.identifiable += profile.verdict == Verdict::identifiable;
    }
  }
  return coverage;
}

void coverage_rows(Table& table, bool noise_is_known, int sets) {
  const Coverage coverage = cover(noise_is_known, sets);
  const DesignSpace space = decay_space();
  const char* noise = noise_is_known ? "noise known" : "noise estimated";
  const auto row = [&](const std::string& what, int hits) {
    const double share = static_cast<double>(hits) / sets;
    table.full_row(fmt::format("{}, {}", what, noise),
                   fmt::format("{:.1f} %", 100 * share),
                   "93 - 97 %",
                   0.93 <= share && share <= 0.97);
  };
  for (int i = 0; i < 3; ++i) {
    row(fmt::format("linear interval of {} holds the truth", space[i].name), coverage.linear[i]);
    row(fmt::format("profile interval of {} holds the truth", space[i].name), coverage.profile[i]);
  }
  table.row(fmt::format("verdict identifiable, {}", noise),
            fmt::format("{} of {}", coverage.identifiable, 3 * sets),
            "all",
            coverage.identifiable == 3 * sets);
  table.note("evaluations an analysis with profiles",
             fmt::format("{:.0f}", static_cast<double>(coverage.evaluations) / sets));
}

struct Curve {
  std::string name;
  DesignSpace space;  // its initial values are near the truth
  std::vector<double> truth;
  std::function<double(const std::vector<double>&, double)> y;  // over 0 ... 1
};

std::vector<Curve> curves() {
  return {{"decay",
           decay_space(),
           kTruth,
           [](const auto& x, double t) { return x[0] * std::exp(-3.0 * x[1] * t) + x[2]; }},
          {"oscillation",
           DesignSpace({{.name = "A", .lower = 0.2, .upper = 3, .initial = 0.9},
                        {.name = "damping", .lower = 0.2, .upper = 8, .initial = 2.2},
                        {.name = "omega", .lower = 15, .upper = 25, .initial = 20.4}}),
           {1.0, 2.0, 20.0},
           [](const auto& x, double t) { return x[0] * std::exp(-x[1] * t) * std::sin(x[2] * t); }},
          {"slip curve",
           DesignSpace({{.name = "B", .lower = 2, .upper = 20, .initial = 9},
                        {.name = "C", .lower = 1, .upper = 2, .initial = 1.4},
                        {.name = "D", .lower = 0.3, .upper = 2, .initial = 1.1}}),
           {8.0, 1.5, 1.0},
           [](const auto& x, double t) {
             return x[2] * std::sin(x[1] * std::atan(x[0] * (2.0 * t - 1.0)));
           }}};
}

struct Noise {
  std::string name;
  int samples;
  std::function<Eigen::VectorXd(int, RandomStream&)> draw;  // noise of variance 1
};

std::vector<Noise> noises() {
  const auto white = [](int count, RandomStream& random) {
    Eigen::VectorXd e(count);
    for (double& value : e) value = random.normal();
    return e;
  };
  const auto colored = [](int count, RandomStream& random) {
    constexpr double kRho = 0.8;
    Eigen::VectorXd e(count);
    e[0] = random.normal();
    for (int j = 1; j < count; ++j) {
      e[j] = kRho * e[j - 1] + std::sqrt(1.0 - kRho * kRho) * random.normal();
    }
    return e;
  };
  // The output of two equal poles p has the variance (1 + p^2) / (1 - p^2)^3.
  const auto low_pass = [](int count, RandomStream& random) {
    constexpr int kRunUp = 400;
    const double p = std::exp(-2.0 * M_PI / 40.0);
    const double deviation = std::sqrt((1.0 + p * p) / std::pow(1.0 - p * p, 3.0));
    Eigen::VectorXd e(count);
    double one = 0.0, two = 0.0;
    for (int j = -kRunUp; j < count; ++j) {
      one = p * one + random.normal();
      two = p * two + one;
      if (j >= 0) e[j] = two / deviation;
    }
    return e;
  };
  return {{"independent", 200, white}, {"colored", 200, colored}, {"oversampled", 400, low_pass}};
}

void noise_rows(Table& table, const Curve& curve, const Noise& noise, int sets) {
  const int n = curve.space.size();
  const std::vector<double> truth = curve.space.to_unit({curve.truth});
  std::vector<int> held(static_cast<size_t>(n));
  for (int set = 0; set < sets; ++set) {
    RandomStream random(kSeed + 1, set);
    const Eigen::VectorXd e = noise.draw(noise.samples, random);
    const Model model = [&](const std::vector<double>& x) {
      Eigen::VectorXd r(noise.samples);
      for (int j = 0; j < noise.samples; ++j) {
        const double t = j / (noise.samples - 1.0);
        r[j] = curve.y(curve.truth, t) + kNoise * e[j] - curve.y(x, t);
      }
      return r;
    };
    IdentificationOptions options{.profiles = false};
    options.confidence.traits.curves.assign(static_cast<size_t>(noise.samples), 0);
    const Analyzed a = analyze(curve.space, fitted(curve.space, model), model, options);
    for (size_t i = 0; i < held.size(); ++i) {
      held[i] += holds(a.identification.confidence().intervals[i], truth[i]);
    }
  }
  std::string shares;
  bool ok = true;
  for (int i = 0; i < n; ++i) {
    const double share = static_cast<double>(held[static_cast<size_t>(i)]) / sets;
    shares += fmt::format("{}{} {:.1f}", i > 0 ? ", " : "", curve.space[i].name, 100 * share);
    ok = ok && 0.93 <= share && share <= 0.97;
  }
  table.full_row(fmt::format("{}, {} noise: intervals hold the truth", curve.name, noise.name),
                 shares + " %",
                 "93 - 97 %",
                 ok);
}

constexpr int kMostEvaluations = 200;

/// Returns the study of a race tire with five of its coefficients as variables.
correlation::Study twin_study() {
  correlation::Study study = correlation::read_study(
      std::filesystem::path(LATSCH_SOURCE_DIR) / "studies" / "race_tire_mf" / "study.toml",
      experiment::language());
  std::vector<DesignVariable> five;
  for (const DesignVariable& v : study.space.variables()) {
    for (const char* name : {"PCY1", "PDY1", "PEY1", "PKY1", "PKY2"}) {
      if (v.name == name) five.push_back(v);
    }
  }
  study.space = DesignSpace(five);
  for (auto& experiment : study.experiments) {
    experiment.noise = correlation::MeasurementNoise{.relative = kNoise};
  }
  return study;
}

/// Returns the best point that the study's own optimizer finds.
DesignPoint fitted_by_auto(const correlation::Study& study, const Evaluator& evaluate) {
  const Objective objective = correlation::objective(study);
  const auto optimizer = correlation::make_optimizer(study);
  DesignPoint best = study.space.initial();
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostEvaluations && !optimizer->converged(); ++k) {
    const DesignPoint point = optimizer->propose(1).front();
    const auto channels = evaluate(point);
    const Result<Score> score = channels ? objective(*channels) : Result<Score>(channels.failure());
    if (score && score->value < least) {
      least = score->value;
      best = point;
    }
    optimizer->observe(point, score);
  }
  return best;
}

void twin_row(Table& table, int twins) {
  correlation::Study study = twin_study();
  const Evaluator evaluate = correlation::evaluator(study);
  DesignPoint truth = study.space.initial();
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& v = study.space[i];
    truth.values[static_cast<size_t>(i)] = v.initial + 0.2 * (v.upper - v.initial);
  }
  const auto exact = evaluate(truth);
  if (!exact) throw InputError("the twin: " + exact.failure().reason);
  const auto u = study.space.to_unit(truth);
  std::vector<int> held(u.size()), held_by_linear(u.size());
  for (int set = 0; set < twins; ++set) {
    RandomStream random(kSeed + 2, set);
    for (auto& experiment : study.experiments) {
      const auto& curve = dynamic_cast<const correlation::Curve&>(*experiment.observable);
      correlation::CurveMeasurement noisy = curve.measured();
      noisy.y_compared = curve.simulated(*exact)->values;
      for (double& value : noisy.y_compared) value += kNoise * noisy.scale * random.normal();
      experiment.observable = std::make_shared<correlation::Curve>(std::move(noisy));
    }
    const Objective residuals = correlation::residual_objective(study);
    const Model model = [&](const std::vector<double>& x) {
      const auto r = residuals(*evaluate({x}))->residuals;
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(r.data(), std::ssize(r)));
    };
    const IdentificationOptions options{
        .confidence = {.sigma = correlation::residual_sigma(study),
                       .traits = correlation::residual_traits(study)}};
    const Analyzed a = analyze(study.space, fitted_by_auto(study, evaluate), model, options);
    for (size_t i = 0; i < held.size(); ++i) {
      held[i] += holds(a.identification.profiles()[i].interval, u[i]);
      held_by_linear[i] += holds(a.identification.confidence().intervals[i], u[i]);
    }
  }
  const auto counts = [&](const std::vector<int>& of) {
    std::string text;
    for (size_t i = 0; i < of.size(); ++i) {
      text +=
          fmt::format("{}{} {}", i > 0 ? ", " : "", study.space[static_cast<int>(i)].name, of[i]);
    }
    return text;
  };
  const int least = *std::min_element(held.begin(), held.end());
  table.full_row("twin of a Magic Formula tire with 2 % of noise: of 100 intervals hold the truth",
                 counts(held),
                 ">= 90",
                 least >= 90);
  // PCY1 and PEY1 have similar effects on the curve. Only the likelihood profile shows how far both
  // may change together, so the linear intervals are shown but not judged.
  table.note("  the linear intervals of the same fits", counts(held_by_linear));
}

struct Case {
  std::string name;
  std::vector<DesignVariable> variables;  // their initial values are the fitted point
  Model model;
  std::vector<Verdict> right;
};

DesignVariable variable(const char* name, double lower, double fitted, double upper) {
  return {.name = name, .lower = lower, .upper = upper, .initial = fitted};
}

constexpr Verdict kIdentifiable = Verdict::identifiable, kOneSided = Verdict::one_sided,
                  kFlat = Verdict::flat, kSeveral = Verdict::several_minima;

/// The data of these cases have 1 % of noise, and every correct verdict follows from the formula of
/// the model.
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

int run(const Options& options) {
  Table table("statistics", options);
  const int sets = options.size(500, 4);
  coverage_rows(table, /*noise_is_known=*/false, sets);
  coverage_rows(table, /*noise_is_known=*/true, sets);
  for (const Curve& curve : curves()) {
    for (const Noise& noise : noises()) noise_rows(table, curve, noise, sets);
  }
  twin_row(table, options.size(100, 1));
  for (const Case& c : constructed_cases()) {
    const DesignSpace space(c.variables);
    const Analyzed a = analyze(space, space.initial(), c.model, {.confidence = {.sigma = 0.01}});
    std::string verdicts;
    int right = 0;
    for (int i = 0; i < space.size(); ++i) {
      const TargetProfile& profile = a.identification.profiles()[i];
      verdicts += fmt::format("{}{}: {}", i > 0 ? "; " : "", space[i].name, name(profile.verdict));
      right += profile.verdict == c.right[i];
    }
    table.row(c.name, verdicts, "right", right == space.size());
  }
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
