// SPDX-License-Identifier: Apache-2.0
// Samples of a posterior by a surrogate of few runs, against long chains on the exact density.
//
// Nine cases with synthetic data: a linear model, a decay with few data, a banana, a valley x y,
// two exponentials, a frequency response of two modes, the Magic Formula for side force with five
// coefficients and 30 % noise and with twelve, and a chain of eight springs whose stiffnesses are
// known to a factor of ten. All start from the least squares and from the trials of its
// derivatives. The error of a case is the largest error of the 2.5, 50 and 97.5 % points of its
// variables, in deviations of the posterior. Every case is sampled by delayed acceptance, too,
// which may take 4000 runs of the model.
//
// Simulation-based calibration [Talts, Betancourt, Simpson, Vehtari, Gelman 2018,
// arXiv:1804.06788]: if the truth is drawn from the prior and the data from the truth, the rank of
// the truth among 99 samples is uniform. Its chi-square over 20 bins gives p.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "numerics/chi_square.h"
#include "numerics/dense/cholesky.h"
#include "numerics/dense/self_adjoint_eigen.h"
#include "optimization/posterior/model_chains.h"
#include "optimization/posterior/posterior_words.h"
#include "optimization/posterior/surrogate_runs.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using Curve = std::function<Eigen::VectorXd(const Eigen::VectorXd& u)>;

/// A model in the unit cube whose values have noise of deviation 1.
struct Case {
  std::string name;
  Eigen::VectorXd truth;
  Curve values;
  std::uint64_t draw = 0;  // stream of the noise
};

double between(double lower, double upper, double u) { return lower + (upper - lower) * u; }
double between_logs(double lower, double upper, double u) {
  return lower * std::pow(upper / lower, u);
}

/// Returns D sin(C atan(B x - E (B x - atan(B x)))) of the Magic Formula.
double magic(double B, double C, double D, double E, double x) {
  const double Bx = B * x;
  return D * std::sin(C * std::atan(Bx - E * (Bx - std::atan(Bx))));
}

Eigen::VectorXd repeated(Eigen::Index n, double value) {
  return Eigen::VectorXd::Constant(n, value);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  Eigen::MatrixXd A(30, 6);
  RandomStream random(11, 0);
  for (double& a : A.reshaped()) a = 8.0 * random.normal();
  all.push_back(
      {"linear, n = 6", repeated(6, 0.5), [A](const auto& u) { return Eigen::VectorXd(A * u); }});
  all.push_back({"decay with few data, n = 2", Eigen::Vector2d(0.5, 0.4), [](const auto& u) {
                   Eigen::VectorXd y(5);
                   const double a = between(0.2, 2.0, u[0]), k = between_logs(0.1, 10.0, u[1]);
                   for (int j = 0; j < 5; ++j) y[j] = a * std::exp(-k * 0.6 * (j + 0.5)) / 0.15;
                   return y;
                 }});
  all.push_back({"banana, n = 2", Eigen::Vector2d(0.5, 0.3), [](const auto& u) {
                   const double x = u[0] - 0.5;
                   return Eigen::VectorXd(Eigen::Vector2d(x / 0.12, (u[1] - 4.0 * x * x) / 0.03));
                 }});
  all.push_back({"valley x y, n = 2", Eigen::Vector2d(0.5, 0.5), [](const auto& u) {
                   const double x = between(0.2, 2.0, u[0]), y = between(0.2, 2.0, u[1]);
                   return Eigen::VectorXd(Eigen::Vector3d(x * y / 0.05, x / 0.25, y / 0.25));
                 }});
  all.push_back({"two exponentials, n = 4",
                 (Eigen::VectorXd(4) << 0.5, 0.35, 0.5, 0.7).finished(),
                 [](const auto& u) {
                   Eigen::VectorXd y(40);
                   const double a = between(0.2, 2.0, u[0]), k = between_logs(0.1, 10.0, u[1]);
                   const double b = between(0.2, 2.0, u[2]), l = between_logs(0.1, 10.0, u[3]);
                   for (int j = 0; j < 40; ++j) {
                     const double t = 0.1 * (j + 0.5);
                     y[j] = (a * std::exp(-k * t) + b * std::exp(-l * t)) / 0.05;
                   }
                   return y;
                 }});
  all.push_back({"frequency response, n = 6", repeated(6, 0.5), [](const auto& u) {
                   Eigen::VectorXd y(120);
                   for (int j = 0; j < 60; ++j) {
                     const double w = between(0.3, 3.0, j / 59.0);
                     std::complex<double> h = 0.0;
                     for (int mode = 0; mode < 2; ++mode) {
                       const double w0 = between(mode ? 1.5 : 0.7, mode ? 2.5 : 1.3, u[3 * mode]);
                       const double d = between(0.01, 0.2, u[3 * mode + 1]);
                       const double g = between(0.3, 1.7, u[3 * mode + 2]);
                       h += g / std::complex<double>(w0 * w0 - w * w, 2.0 * d * w0 * w);
                     }
                     y[2 * j] = h.real() / 0.3;
                     y[2 * j + 1] = h.imag() / 0.3;
                   }
                   return y;
                 }});
  all.push_back({"Magic Formula with 30 % noise, n = 5", repeated(5, 0.5), [](const auto& u) {
                   Eigen::VectorXd y(60);
                   const double B = between(5.0, 25.0, u[0]), C = between(1.0, 2.0, u[1]);
                   const double D = between(0.5, 1.5, u[2]), E = between(-2.0, 1.0, u[3]);
                   const double shift = between(-0.02, 0.02, u[4]);
                   for (int j = 0; j < 60; ++j)
                     y[j] = magic(B, C, D, E, between(-0.2, 0.2, j / 59.0) + shift) / 0.3;
                   return y;
                 }});
  all.push_back(
      {"Magic Formula, n = 12", repeated(12, 0.5), [](const auto& u) {
         Eigen::VectorXd y(180);
         int k = 0;
         for (int load = 0; load < 3; ++load) {
           for (int camber = 0; camber < 2; ++camber) {
             const double dfz = 0.5 * (load - 1), g = 0.08 * camber;
             const double C = between(1.0, 2.0, u[0]);
             const double D = (1.0 + dfz) *
                              (between(0.6, 1.6, u[1]) + between(-0.5, 0.5, u[2]) * dfz) *
                              (1.0 - between(-10.0, 10.0, u[3]) * g * g);
             const double E = between(-2.0, 1.0, u[4]) + between(-1.0, 1.0, u[5]) * dfz;
             const double K = between(8.0, 32.0, u[6]) *
                              std::sin(2.0 * std::atan((1.0 + dfz) / between(0.8, 2.8, u[7]))) *
                              (1.0 - between(-3.0, 3.0, u[8]) * g);
             const double SH = between(-0.01, 0.01, u[9]) + between(-0.2, 0.2, u[10]) * g;
             const double SV = (1.0 + dfz) * between(-0.1, 0.1, u[11]);
             for (int j = 0; j < 30; ++j, ++k)
               y[k] = (magic(K / (C * D), C, D, E, between(-0.2, 0.2, j / 29.0) + SH) + SV) / 0.05;
           }
         }
         return y;
       }});
  all.push_back({"chain of log stiffnesses, n = 8", repeated(8, 0.5), [](const auto& u) {
                   // deflection of every second mass of eight springs in series under a unit force
                   // at each mass, in shares of the nominal one
                   Eigen::VectorXd y(12);
                   Eigen::VectorXd soft(8);
                   for (int i = 0; i < 8; ++i) soft[i] = 1.0 / between_logs(0.316, 3.16, u[i]);
                   for (int j = 0; j < 8; ++j) y[j] = soft.head(j + 1).sum() / (j + 1) / 0.15;
                   for (int j = 0; j < 4; ++j) y[8 + j] = soft.segment(2 * j, 2).sum() / 2.0 / 0.3;
                   return y;
                 }});
  for (std::size_t k = 0; k < all.size(); ++k) all[k].draw = k + 1;
  return all;
}

/// Natural frequencies, with 2 % of noise, of a chain of four masses on four springs whose
/// stiffnesses are sought: with its end free, and held by a fifth spring of stiffness 1.
Case modes_case() {
  const auto frequencies = [](const Eigen::VectorXd& u, double last) {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(4, 4);
    for (int i = 0; i < 4; ++i) {
      const double k = between_logs(0.5, 2.0, u[i]);
      K(i, i) += k;
      if (i == 0) continue;
      K(i - 1, i - 1) += k;
      K(i - 1, i) -= k;
      K(i, i - 1) -= k;
    }
    K(3, 3) += last;
    return Eigen::VectorXd(numerics::self_adjoint_eigen(K).values.cwiseSqrt());
  };
  return {"modes, n = 4", repeated(4, 0.5), [frequencies](const Eigen::VectorXd& u) {
            Eigen::VectorXd y(8);
            y << frequencies(u, 0.0), frequencies(u, 1.0);
            return Eigen::VectorXd(y / 0.02);
          }};
}

Eigen::MatrixXd slopes(const Curve& r, const Eigen::VectorXd& u, double way) {
  const Eigen::Index n = u.size();
  Eigen::MatrixXd J(r(u).size(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::VectorXd up = u, down = u;
    up[i] = std::min(1.0, u[i] + way);
    down[i] = std::max(0.0, u[i] - way);
    J.col(i) = (r(up) - r(down)) / (up[i] - down[i]);
  }
  return J;
}

/// Returns the least squares in the cube by Levenberg-Marquardt steps that are cut off at the
/// bounds.
Eigen::VectorXd least_squares_in_cube(const Curve& r, Eigen::VectorXd u) {
  double damping = 1e-3, S = r(u).squaredNorm();
  for (int step = 0; step < 200 && damping < 1e10; ++step) {
    const Eigen::MatrixXd J = slopes(r, u, 1e-6);
    Eigen::MatrixXd N = J.transpose() * J;
    N.diagonal() += damping * N.diagonal() + repeated(u.size(), 1e-9);
    const Eigen::VectorXd moved =
        (u - numerics::Cholesky(N).solve(Eigen::VectorXd(J.transpose() * r(u))))
            .cwiseMax(0.0)
            .cwiseMin(1.0);
    const double S_moved = r(moved).squaredNorm();
    const bool is_better = S_moved < S;
    damping *= is_better ? 0.2 : 10.0;
    if (!is_better) continue;
    const bool has_ended = S - S_moved < 1e-12 * S;
    u = moved;
    S = S_moved;
    if (has_ended) break;
  }
  return u;
}

/// Normal prior of every variable of the cube, or none.
struct NormalPrior {
  double mean = 0.5, deviation = 0.0;  // 0: none

  bool is_stated() const { return deviation > 0.0; }
  Eigen::VectorXd rows(const Eigen::VectorXd& u) const { return (u.array() - mean) / deviation; }
};

struct Fitted {
  Curve r;  // residuals of the data
  FittedDensity density;
};

/// Returns the fit of values y, with the trials of central differences as known samples.
Fitted fitted(const Curve& values,
              const Eigen::VectorXd& y,
              const Eigen::VectorXd& start,
              const NormalPrior& prior = {}) {
  constexpr double kWay = 0.01;
  Fitted fit;
  fit.r = [values, y](const Eigen::VectorXd& u) { return Eigen::VectorXd(values(u) - y); };
  const Curve all = [&](const Eigen::VectorXd& u) {
    if (!prior.is_stated()) return fit.r(u);
    Eigen::VectorXd rows(y.size() + u.size());
    rows << fit.r(u), prior.rows(u);
    return rows;
  };
  const Eigen::VectorXd center = least_squares_in_cube(all, start);
  FittedDensity& density = fit.density;
  density.r_c = fit.r(center);
  density.J = slopes(fit.r, center, kWay);
  density.frame = whitened_frame(center, slopes(all, center, kWay));
  density.density.values = y.size();
  if (prior.is_stated())
    density.density.log_prior = [prior](const Eigen::VectorXd& u) {
      return -0.5 * prior.rows(u).squaredNorm();
    };
  for (Eigen::Index i = 0; i < center.size(); ++i) {
    for (const double way : {kWay, -kWay}) {
      Eigen::VectorXd u = center;
      u[i] = std::clamp(u[i] + way, 0.0, 1.0);
      density.known.push_back({u, fit.r(u)});
    }
  }
  return fit;
}

Eigen::VectorXd noisy_values(const Curve& values,
                             const Eigen::VectorXd& truth,
                             RandomStream random) {
  Eigen::VectorXd y = values(truth);
  for (double& value : y) value += random.normal();
  return y;
}

SurrogateRuns answered(const Fitted& fit, std::uint64_t seed) {
  SurrogateRuns runs(fit.density, {.seed = seed});
  while (!runs.wanted().empty()) {
    std::vector<std::optional<Eigen::VectorXd>> outcomes;
    for (const Eigen::VectorXd& u : runs.wanted()) outcomes.emplace_back(fit.r(u));
    runs.observe(outcomes);
  }
  return runs;
}

constexpr std::array kPoints{0.025, 0.5, 0.975};

/// Returns the largest difference of the three points of all variables, in deviations of `exact`.
double largest_error(const Eigen::MatrixXd& u, const Eigen::MatrixXd& exact) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    const Eigen::VectorXd x = exact.row(i).transpose();
    const double deviation = std::sqrt((x.array() - x.mean()).square().mean());
    for (const double p : kPoints)
      largest = std::max(
          largest, std::abs(quantile_of(u.row(i).transpose(), p) - quantile_of(x, p)) / deviation);
  }
  return largest;
}

/// Returns the largest error of the linear interval's ends and middle.
double linear_error(const Fitted& fit, const Eigen::MatrixXd& exact) {
  const Eigen::MatrixXd& T = fit.density.frame.T;
  Eigen::MatrixXd points(exact.rows(), 3);
  double largest = 0.0;
  for (Eigen::Index i = 0; i < exact.rows(); ++i) {
    const Eigen::VectorXd x = exact.row(i).transpose();
    const double deviation = std::sqrt((x.array() - x.mean()).square().mean());
    const double linear = 0.5 * T.row(i).norm();
    for (const auto& [p, t] : {std::pair(0.025, -1.96), {0.5, 0.0}, {0.975, 1.96}}) {
      const double end = std::clamp(fit.density.frame.center[i] + t * linear, 0.0, 1.0);
      largest = std::max(largest, std::abs(end - quantile_of(x, p)) / deviation);
    }
  }
  return largest;
}

/// Adds the error of chains on the model to which the surrogate proposes, of chain_runs = 4000.
void delayed_row(Table& table,
                 const std::string& name,
                 const Fitted& fit,
                 const SurrogateRuns& runs,
                 const Eigen::MatrixXd& exact) {
  ModelChains chains(runs.chains().places(),
                     fit.density.density,
                     runs.log_density(),
                     {.samples = 4000, .seed = 1});
  while (!chains.wanted().empty()) {
    std::vector<std::optional<double>> sums;
    for (const Eigen::VectorXd& u : chains.wanted()) sums.emplace_back(fit.r(u).squaredNorm());
    chains.observe(sums);
  }
  const PosteriorSamples samples = chains.samples();
  const double error = largest_error(samples.u, exact);
  const bool mixes = samples.unmixed.empty();
  table.full_row(fmt::format("{}: error of quantiles, delayed acceptance ({} runs, {:.0f} % "
                             "accepted, {})",
                             name,
                             chains.trials(),
                             100.0 * chains.accepted(),
                             mixes ? "mixed" : "not mixed"),
                 fmt::format("{:.2f} deviations", error),
                 mixes ? "<= 0.2" : "any: said not to mix",
                 !mixes || error <= 0.2);
}

const char* in_words(SurrogateVerdict verdict) {
  switch (verdict) {
    case SurrogateVerdict::stands:
      return "stands";
    case SurrogateVerdict::doubtful:
      return "doubtful";
    case SurrogateVerdict::refused:
      return "refused";
    case SurrogateVerdict::unchecked:
      break;
  }
  return "unchecked";
}

void case_rows(Table& table, const Options& options) {
  constexpr long kExactSteps = 60'000;
  const auto all = cases();
  const std::size_t count = options.size<std::size_t>(all.size(), 3);
  int standing = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Case& one = all[k];
    const Fitted fit = fitted(
        one.values, noisy_values(one.values, one.truth, RandomStream(21, one.draw)), one.truth);
    const SurrogateRuns runs = answered(fit, 1);
    const LogDensityAt density = [&](const Eigen::VectorXd& u) {
      return -0.5 * fit.r(u).squaredNorm();
    };
    const long steps = options.size(kExactSteps, 4000L);
    const PosteriorSamples exact =
        draw_samples(WalkerChains(density, *walker_starts(fit.density.frame, {}, density, 5), 5),
                     {.samples = 40'000, .first_steps = steps});
    const PosteriorSamples by_surrogate =
        draw_samples(runs.chains(), {.samples = 40'000, .first_steps = steps});
    const double error = largest_error(by_surrogate.u, exact.u);
    const bool stands = runs.check().verdict == SurrogateVerdict::stands;
    standing += stands;
    // a smoke run has short chains, whose quantiles scatter
    table.full_row(fmt::format("{}: error of quantiles ({} runs, {}, {:.2g}; linear {:.2g})",
                               one.name,
                               runs.trials(),
                               in_words(runs.check().verdict),
                               runs.check().deviation,
                               linear_error(fit, exact.u)),
                   fmt::format("{:.2f} deviations", error),
                   stands ? "<= 0.2" : "any: the check tells",
                   !stands || error <= 0.2);
    if (!exact.unmixed.empty() || !by_surrogate.unmixed.empty())
      table.note(fmt::format("{}: variables that do not mix, exact and surrogate", one.name),
                 fmt::format("{}, {}", exact.unmixed.size(), by_surrogate.unmixed.size()));
    delayed_row(table, one.name, fit, runs, exact.u);
    table.row(fmt::format("{}: runs beyond the fit", one.name),
              fmt::format("{}", runs.trials()),
              "<= 50",
              runs.trials() <= 50);
  }
  table.full_row(
      "cases whose check passes", fmt::format("{}", standing), ">= 6 of 9", standing >= 6);
}

/// Returns the probability of a chi-square at least that of these counts, if all are equally
/// likely.
double p_value(const std::vector<int>& counts, int all) {
  const double expected = static_cast<double>(all) / static_cast<double>(counts.size());
  double chi_square = 0.0;
  for (const int count : counts) chi_square += (count - expected) * (count - expected) / expected;
  return 1.0 -
         numerics::chi_square_probability(chi_square, static_cast<double>(counts.size()) - 1.0);
}

void calibration_rows(Table& table, const std::string& name, const Case& one, int sets) {
  constexpr int kDraws = 99, kBins = 20;
  const Eigen::Index n = one.truth.size();
  const NormalPrior prior{0.5, 0.12};
  std::vector<std::vector<int>> bins(static_cast<std::size_t>(n), std::vector<int>(kBins, 0));
  std::vector<int> in_90(static_cast<std::size_t>(n)), in_95(static_cast<std::size_t>(n));
  int refused = 0;
  long runs_made = 0;
  for (int set = 0; set < sets; ++set) {
    RandomStream random(31, static_cast<std::uint64_t>(set));
    Eigen::VectorXd truth(n);
    for (double& value : truth) {
      do value = prior.mean + prior.deviation * random.normal();
      while (value < 0.0 || value > 1.0);
    }
    const Fitted fit = fitted(one.values, noisy_values(one.values, truth, random), truth, prior);
    const SurrogateRuns runs = answered(fit, static_cast<std::uint64_t>(set));
    runs_made += runs.trials();
    refused += runs.check().verdict == SurrogateVerdict::refused;
    const PosteriorSamples samples = draw_samples(runs.chains(), {.samples = 2000});
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Eigen::VectorXd x = samples.u.row(i).transpose();
      int rank = 0;
      for (int k = 0; k < kDraws; ++k)
        rank += x[(2 * k + 1) * samples.size() / (2 * kDraws)] < truth[i];
      ++bins[at][static_cast<std::size_t>(rank * kBins / (kDraws + 1))];
      in_90[at] += quantile_of(x, 0.05) <= truth[i] && truth[i] <= quantile_of(x, 0.95);
      in_95[at] += quantile_of(x, 0.025) <= truth[i] && truth[i] <= quantile_of(x, 0.975);
    }
  }
  const auto share = [&](int hits) { return 100.0 * hits / sets; };
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double p = p_value(bins[at], sets);
    const double least = 0.005 / static_cast<double>(n);
    table.full_row(fmt::format("calibration, {}, variable {}: p of the ranks", name, i + 1),
                   fmt::format("{:.3f}", p),
                   fmt::format(">= {:.4f}", least),
                   p >= least);
    const double of_90 = share(in_90[at]), of_95 = share(in_95[at]);
    table.full_row(
        fmt::format("calibration, {}, variable {}: 90 / 95 % intervals hold", name, i + 1),
        fmt::format("{:.1f} / {:.1f} %", of_90, of_95),
        "87.5-92.5 / 93-97 %",
        87.5 <= of_90 && of_90 <= 92.5 && 93.0 <= of_95 && of_95 <= 97.0);
  }
  table.note(
      fmt::format("calibration, {}: runs in the mean, share of sets refused", name),
      fmt::format("{:.1f}, {:.1f} %", static_cast<double>(runs_made) / sets, share(refused)));
}

/// Checks surrogates that learn from the wrong model `learned` in place of that of the fit. Returns
/// how many of them are refused, and how many stand.
std::pair<int, int> refused_and_standing(const Fitted& fit, const Curve& learned, int seeds) {
  FittedDensity wrong = fit.density;
  wrong.known.clear();
  wrong.r_c = learned(wrong.frame.center);
  wrong.J = slopes(learned, wrong.frame.center, 1e-3);
  std::pair<int, int> counts{0, 0};
  for (int seed = 0; seed < seeds; ++seed) {
    SurrogateRuns runs(wrong, {.seed = static_cast<std::uint64_t>(seed)});
    while (!runs.wanted().empty()) {
      std::vector<std::optional<Eigen::VectorXd>> outcomes;
      for (const Eigen::VectorXd& u : runs.wanted())
        outcomes.emplace_back(runs.is_checking() ? fit.r(u) : learned(u));
      runs.observe(outcomes);
    }
    counts.first += runs.check().verdict == SurrogateVerdict::refused;
    counts.second += runs.check().verdict == SurrogateVerdict::stands;
  }
  return counts;
}

void spoiled_rows(Table& table, int seeds) {
  const auto all = cases();
  const auto fit_of = [](const Case& one) {
    return fitted(
        one.values, noisy_values(one.values, one.truth, RandomStream(21, one.draw)), one.truth);
  };
  const Fitted linear = fit_of(all[0]);
  const Curve too_flat = [&](const Eigen::VectorXd& u) {
    return Eigen::VectorXd(linear.density.r_c +
                           0.5 * linear.density.J * (u - linear.density.frame.center));
  };
  const int refused = refused_and_standing(linear, too_flat, seeds).first;
  table.row("a surrogate with half the slopes is refused",
            fmt::format("{} of {}", refused, seeds),
            "all",
            refused == seeds);
  const Fitted banana = fit_of(all[2]);
  const Curve straight = [&](const Eigen::VectorXd& u) {
    return Eigen::VectorXd(banana.density.r_c +
                           banana.density.J * (u - banana.density.frame.center));
  };
  const auto [of_straight, standing] = refused_and_standing(banana, straight, seeds);
  table.row("a surrogate of the banana without curvature does not stand",
            fmt::format("{} of {}", seeds - standing, seeds),
            "all",
            standing == 0);
  // ten draws may miss the ends of the banana; the surrogate is then told to be doubtful
  table.note("  refused, not doubtful", fmt::format("{} of {}", of_straight, seeds));
}

int run(const Options& options) {
  Table table("posterior", options);
  spoiled_rows(table, options.size(100, 10));
  case_rows(table, options);
  const auto all = cases();
  const int sets = options.has("--sets") ? static_cast<int>(options.integer("--sets", 500))
                                         : options.size(500, 5);
  calibration_rows(table, "decay, n = 2", all[1], sets);
  if (!options.is_smoke()) {
    calibration_rows(table, "modes, n = 4", modes_case(), sets);
    calibration_rows(table, "Magic Formula, n = 5", all[6], sets);
  }
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  using namespace latsch::benchmarks;
  return run_benchmark(
      argc, argv, {{"--sets", "N", "data sets of each calibration, 500 unless given"}}, run);
}
