// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/slip_lag.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "experiment/rigs/slip/slip_states.h"
#include "models/magic_formula/magic_formula_slopes.h"

namespace latsch {
namespace {

using magic_formula::MagicFormula;
using magic_formula::State;
using magic_formula::SteadyState;

/// A slip at the samples, and its slopes by (sample, parameter).
struct Lagged {
  std::vector<double> x;
  Eigen::MatrixXd slopes;
};

/// A relaxation length at the samples, and its slopes.
struct Length {
  std::vector<double> sigma;
  Eigen::MatrixXd slopes;
};

/// Steps of time that are gaps: after each, slips start anew.
std::vector<bool> gaps_of(const std::vector<double>& times) {
  constexpr double kMost = 3.0;  // in units of the median step
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  if (steps.empty()) return {true};
  std::vector<double> sorted = steps;
  const auto middle = sorted.begin() + std::ssize(sorted) / 2;
  std::nth_element(sorted.begin(), middle, sorted.end());
  std::vector<bool> gaps = {true};
  for (const double step : steps) gaps.push_back(!(step > 0.0 && step <= kMost * *middle));
  return gaps;
}

/// Solves dx/ds + x = u over the distance s from 0 to a, u linear from u0 to u1.
struct LagStep {
  double end, by_a;  // x(a), its slope in a
};
LagStep lag_step(double x0, double u0, double u1, double a) {
  if (a == 0.0) return {x0, u0 - x0};
  const double E = std::exp(-a), g = -std::expm1(-a) / a;
  return {E * x0 + (1.0 - E) * u0 + (1.0 - g) * (u1 - u0), E * (u0 - x0) + (g - E) / a * (u1 - u0)};
}

Lagged lag(const std::vector<double>& u,
           const std::vector<State>& states,
           const std::vector<double>& times,
           const std::vector<bool>& gaps,
           const Length& length) {
  Lagged lagged{u, Eigen::MatrixXd::Zero(length.slopes.rows(), length.slopes.cols())};
  for (std::size_t i = 1; i < u.size(); ++i) {
    const double sigma = 0.5 * (length.sigma[i - 1] + length.sigma[i]);
    if (gaps[i] || !(sigma > 0.0)) continue;
    const double way =
        0.5 * (std::abs(states[i - 1].Vx) + std::abs(states[i].Vx)) * (times[i] - times[i - 1]);
    const double a = way / sigma;
    const LagStep step = lag_step(lagged.x[i - 1], u[i - 1], u[i], a);
    lagged.x[i] = step.end;
    if (lagged.slopes.cols() == 0) continue;
    const auto row = static_cast<Eigen::Index>(i);
    lagged.slopes.row(row) =
        std::exp(-a) * lagged.slopes.row(row - 1) -
        step.by_a * a / sigma * 0.5 * (length.slopes.row(row - 1) + length.slopes.row(row));
  }
  return lagged;
}

}  // namespace

Channels lagging_answers(const MagicFormula& tire,
                         const std::vector<State>& states,
                         const std::vector<double>& times,
                         const std::vector<std::string>& channels,
                         const std::vector<std::string>& parameters) {
  const auto lengths = magic_formula::steady_state_slopes(
      tire, states, parameters, std::vector{&SteadyState::sigma_x, &SteadyState::sigma_y});
  const auto length = [&](int k) {
    const Eigen::VectorXd sigma = lengths.values.col(k);
    return Length{{sigma.begin(), sigma.end()}, lengths.slopes[static_cast<std::size_t>(k)]};
  };
  const auto gaps = gaps_of(times);
  std::vector<double> kappas, tangents;
  for (const State& state : states) {
    kappas.push_back(state.kappa);
    tangents.push_back(std::tan(state.alpha));
  }
  const Lagged x = lag(kappas, states, times, gaps, length(0));
  const Lagged y = lag(tangents, states, times, gaps, length(1));
  std::vector<State> lagging = states;
  for (std::size_t i = 0; i < states.size(); ++i) {
    lagging[i].kappa = x.x[i];
    lagging[i].alpha = std::atan(y.x[i]);
  }
  Channels found = answers(tire, lagging);
  if (!parameters.empty()) {
    std::vector<std::string> variables = parameters;  // and the slips, because the parameters
                                                      // change these
    variables.insert(variables.end(), {"kappa", "alpha"});
    const auto n = static_cast<Eigen::Index>(parameters.size());
    const Eigen::VectorXd tangent = Eigen::VectorXd::Map(y.x.data(), std::ssize(y.x));
    const Eigen::ArrayXd by_tangent = 1.0 / (1.0 + tangent.array().square());
    Channels sloping;
    const Channels direct = with_slopes(found, tire, lagging, channels, variables);
    for (Channel channel : direct.all()) {
      if (!channel.slopes.empty()) {
        const auto S = Eigen::MatrixXd::Map(channel.slopes.data(), std::ssize(states), n + 2);
        const Eigen::MatrixXd whole =
            S.leftCols(n) + (x.slopes.array().colwise() * S.col(n).array()).matrix() +
            (y.slopes.array().colwise() * (S.col(n + 1).array() * by_tangent)).matrix();
        channel.slopes.assign(whole.data(), whole.data() + whole.size());
      }
      sloping.add(std::move(channel));
    }
    found = std::move(sloping);
  }
  Channel kappa{"kappa", "1", x.x}, alpha{"alpha", "rad", {}};
  for (const State& state : lagging) alpha.values.push_back(state.alpha);
  found.add(std::move(kappa));
  found.add(std::move(alpha));
  return found;
}

}  // namespace latsch
