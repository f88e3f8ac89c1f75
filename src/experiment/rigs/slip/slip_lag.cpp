// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/slip_lag.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "experiment/rigs/slip/slip_states.h"
#include "models/magic_formula/magic_formula_slopes.h"

namespace latsch {
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

namespace {

using magic_formula::MagicFormula;
using magic_formula::State;
using magic_formula::SteadyState;

/// A slip at all samples, and its derivatives by (sample, parameter).
struct Lagged {
  std::vector<double> x;
  Eigen::MatrixXd slopes;
};

/// A relaxation length at all samples, and its derivatives.
struct Length {
  std::vector<double> sigma;
  Eigen::MatrixXd slopes;
};

/// Solves dx/ds + x = u over the distance s from 0 to a, where u changes linearly from u0 to u1.
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

namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::string gaps_in_words(const std::vector<double>& times) {
  constexpr int kNamed = 3;
  const auto gaps = gaps_of(times);
  std::string words;
  int count = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (!gaps[i] || ++count > kNamed) continue;
    words += fmt::format(
        "{}{:.4g} s behind sample {}", count == 1 ? "" : ", ", times[i] - times[i - 1], i);
  }
  if (count == 0) return "";
  return fmt::format(
      "{} step{} of time {} backward, repeated or more than three times the usual "
      "one ({}{}): slips start settled behind {}",
      count,
      count == 1 ? "" : "s",
      count == 1 ? "is" : "are",
      words,
      count > kNamed ? ", ..." : "",
      count == 1 ? "it" : "each");
}

std::string no_record(const std::vector<double>& times, std::size_t& sample) {
  sample = 0;
  if (times.size() < 2)
    return "there is a single sample: a record of slips has at least two (steady_states computes "
           "states one by one)";
  std::size_t back = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    if (back++ == 0) sample = i;
  }
  if (2 * back < times.size() - 1) return "";
  return fmt::format(
      "time does not rise in {} of {} steps (from {:.6g} s to {:.6g} s here): is the "
      "record in the order of its samples?",
      back,
      times.size() - 1,
      times[sample - 1],
      times[sample]);
}

std::vector<std::string> lag_limits(const MagicFormula& tire,
                                    const std::vector<State>& states,
                                    const std::vector<double>& times) {
  std::vector<std::string> sentences;
  if (std::string gaps = gaps_in_words(times); !gaps.empty()) sentences.push_back(std::move(gaps));
  if (states.size() < 2) return sentences;
  std::vector<SteadyState> results(states.size());
  tire.evaluate(states, results);
  std::vector<double> ways, sigmas_x, sigmas_y;
  const auto gaps = gaps_of(times);
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (gaps[i]) continue;
    ways.push_back(std::abs(states[i].Vx) * (times[i] - times[i - 1]));
    sigmas_x.push_back(results[i].sigma_x);
    sigmas_y.push_back(results[i].sigma_y);
  }
  if (ways.empty()) return sentences;
  const double way = median(std::move(ways));
  const auto changes = [&](double State::*slip) {
    return std::ranges::any_of(
        states, [&](const State& state) { return state.*slip != states.front().*slip; });
  };
  const auto tell = [&](const char* slip, double sigma, const char* keys) {
    if (!(sigma > 0.0))
      sentences.push_back(fmt::format(
          "{} does not lag: the tire has no relaxation length for it ({})", slip, keys));
    else if (way > sigma)
      sentences.push_back(
          fmt::format("samples are {:.3g} m of road apart, but {} lags by a relaxation length of "
                      "{:.3g} m: the record is too coarse to show it",
                      way,
                      slip,
                      sigma));
  };
  const bool mf52 = tire.parameters().version == magic_formula::Version::mf52;
  if (changes(&State::kappa))
    tell("kappa", median(std::move(sigmas_x)), mf52 ? "PTX1" : "LONGITUDINAL_STIFFNESS");
  if (changes(&State::alpha))
    tell("alpha", median(std::move(sigmas_y)), mf52 ? "PTY1, PTY2" : "LATERAL_STIFFNESS");
  return sentences;
}

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
    // The slips are added to the variables, because they depend on the parameters.
    std::vector<std::string> variables = parameters;
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
