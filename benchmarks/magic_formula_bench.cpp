// SPDX-License-Identifier: Apache-2.0
// Magic Formula 5.2, 6.1 and 6.2: agreement with an independent program, and the time of one state,
// of many states, and of derivatives.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "magic_formula/magic_formula_points.h"
#include "models/magic_formula/magic_formula_slopes.h"
#include "table.h"
#include "yardstick.h"

namespace {

using namespace latsch;
using namespace latsch::magic_formula;
using benchmarks::Beside;
using benchmarks::beside;
using benchmarks::in_units;
using benchmarks::Yardstick;

std::vector<State> random_states(std::size_t count, const Parameters& p) {
  std::vector<State> states(count);
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream random(11, i);
    const auto within = [&](double a, double b) { return a + (b - a) * random.uniform(); };
    states[i] = {within(0.2, 2.0) * p.FNOMIN,
                 within(-0.3, 0.3),
                 within(-0.3, 0.3),
                 within(-0.08, 0.08),
                 0.0,
                 within(5.0, 40.0),
                 within(0.85, 1.15) * p.NOMPRES};
  }
  return states;
}

void agreement(benchmarks::Table& table) {
  const std::pair<Version, const char*> versions[] = {
      {Version::mf52, "MF 5.2"}, {Version::mf61, "MF 6.1"}, {Version::mf62, "MF 6.2"}};
  const auto points = verification::magic_formula_points();
  for (const auto& [version, name] : versions) {
    const auto tire = verification::sample_tire(version);
    const std::string what = fmt::format("{} against MFeval", name);
    if (!tire) {
      table.skip(what, "the sample tires are not beside the source tree");
      continue;
    }
    verification::Disagreement worst;
    int count = 0;
    for (const auto& point : points) {
      if (point.version != version) continue;
      ++count;
      const auto d = verification::disagreement(
          point, MagicFormula(*tire, point.conventions).evaluate(point.state));
      worst.force = std::max(worst.force, d.force);
      worst.moment = std::max(worst.moment, d.moment);
    }
    table.row(fmt::format("{}, {} states, forces", what, count),
              fmt::format("{:.1e} of the reach", worst.force),
              "|dF| <= 1e-6 N + 1e-9 |F|",
              worst.force <= 1.0);
    table.row(fmt::format("{}, {} states, moments", what, count),
              fmt::format("{:.1e} of the reach", worst.moment),
              "|dM| <= 1e-7 Nm + 1e-9 |M|",
              worst.moment <= 1.0);
  }
}

/// Time, s, of an arc tangent of the C library on a processor with AVX2 at about 3.4 GHz. The
/// limits in seconds hold for that processor; on another one the limit is the time of as many arc
/// tangents.
constexpr double kAtanThere = 9.5e-9;

void row(benchmarks::Table& table, const std::string& what, const Beside& cost, double reach) {
  table.full_row(what,
                 in_units(cost, Yardstick::atan),
                 fmt::format("<= {:.3g} atan ({})", reach / kAtanThere, benchmarks::as_time(reach)),
                 cost.ratio() <= reach / kAtanThere);
}

void speed(const benchmarks::Options& options, benchmarks::Table& table) {
  const auto sample = verification::sample_tire(Version::mf61);
  if (!sample) return;
  const MagicFormula tire(*sample);
  const std::size_t ones = options.size(100000, 1000), many = options.size(1000000, 10000);
  const std::vector<State> states = random_states(many, *sample);
  double sum = 0.0;
  const Beside one = beside(Yardstick::atan, options.size(30, 2), [&] {
                       for (std::size_t i = 0; i < ones; ++i) sum += tire.evaluate(states[i]).Fy;
                     }).per(static_cast<double>(ones));
  row(table, "one combined evaluation: forces, moments, radii, patch, relaxation", one, 0.3e-6);
  std::vector<double> in[7], out[5];
  double State::*const members[] = {
      &State::Fz, &State::kappa, &State::alpha, &State::gamma, &State::phit, &State::Vx, &State::p};
  for (int k = 0; k < 7; ++k)
    for (const State& s : states) in[k].push_back(s.*members[k]);
  for (auto& column : out) column.resize(many);
  const Beside columns = beside(Yardstick::atan, 5, [&] {
                           tire.forces({in[0], in[1], in[2], in[3], in[4], in[5], in[6]},
                                       {out[0], out[1], out[2], out[3], out[4]});
                         }).per(static_cast<double>(many));
  row(table, "of 10^6 states at once, forces and moments, one core", columns, 0.15e-6);
  std::vector<SteadyState> results(many);
  const Beside all = beside(Yardstick::atan, 5, [&] {
                       tire.evaluate(states, results);
                     }).per(static_cast<double>(many));
  row(table, "of 10^6 states at once, everything, one core", all, 0.2e-6);
  table.note("sum of side forces, so that nothing is left out", fmt::format("{:.3f} N", sum));
}

/// Compares the time of exact derivatives for a fit of usual size with that of the evaluations that
/// finite differences would need.
void slopes(const benchmarks::Options& options, benchmarks::Table& table) {
  const auto sample = verification::sample_tire(Version::mf61);
  if (!sample) return;
  const MagicFormula tire(*sample);
  const std::size_t count = options.size(6000, 600);
  const int rounds = options.size(30, 2);
  const std::vector<std::string> coefficients = {
      "PCY1", "PDY1", "PDY2", "PDY3", "PEY1", "PEY2", "PEY3", "PEY4", "PKY1", "PKY2", "PKY3",
      "PKY6", "PHY1", "PVY1", "PVY3", "QBZ1", "QBZ3", "QCZ1", "QDZ1", "QDZ3", "QDZ6", "QEZ1"};
  const std::vector<Output> outputs = {&SteadyState::Fy, &SteadyState::Mz};
  const std::vector<State> states = random_states(count, *sample);
  std::vector<double> in[7], out[5];
  double State::*const members[] = {
      &State::Fz, &State::kappa, &State::alpha, &State::gamma, &State::phit, &State::Vx, &State::p};
  for (int k = 0; k < 7; ++k)
    for (const State& s : states) in[k].push_back(s.*members[k]);
  for (auto& column : out) column.resize(count);
  const Beside plain = beside(Yardstick::atan, rounds, [&] {
                         tire.forces({in[0], in[1], in[2], in[3], in[4], in[5], in[6]},
                                     {out[0], out[1], out[2], out[3], out[4]});
                       }).per(static_cast<double>(count));
  SteadyStateSlopes found;
  const Beside exact = beside(Yardstick::atan, rounds, [&] {
                         steady_state_slopes(tire, states, coefficients, outputs, found);
                       }).per(static_cast<double>(count));
  const double evaluations = 1.0 + coefficients.size();
  const double share = exact.ratio() / (evaluations * plain.ratio());
  table.full_row(
      fmt::format("slopes of Fy and Mz in {} coefficients, {} states, beside {} evaluations",
                  coefficients.size(),
                  count,
                  evaluations),
      fmt::format("{:.2f} of their time ({} a state)", share, in_units(exact, Yardstick::atan)),
      "<= 0.5",
      share <= 0.5);
  double worst = 0.0;
  for (std::size_t j = 0; j < coefficients.size(); ++j) {
    const auto changed = [&](double by) {
      Parameters p = *sample;
      p.*find_parameter(coefficients[j])->member += by;
      std::vector<SteadyState> results(count);
      MagicFormula(p).evaluate(states, results);
      return results;
    };
    constexpr double kStep = 1e-4;
    const auto up = changed(kStep), down = changed(-kStep);
    for (std::size_t o = 0; o < outputs.size(); ++o) {
      const auto column = found.slopes[o].col(j);
      double error = 0.0;
      for (std::size_t i = 0; i < count; ++i) {
        const double d = (up[i].*outputs[o] - down[i].*outputs[o]) / (2 * kStep) - column[i];
        error += d * d;
      }
      worst = std::max(worst, std::sqrt(error) / found.slopes[o].colwise().norm().maxCoeff());
    }
  }
  table.row("those slopes against central differences, worst coefficient, over the largest slope",
            fmt::format("{:.1e}", worst),
            "<= 1e-5, what differences are good for",
            worst <= 1e-5);
}

int bench(const benchmarks::Options& options) {
  benchmarks::Table table("magic_formula", options);
  agreement(table);
  speed(options, table);
  slopes(options, table);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return latsch::benchmarks::run_benchmark(argc, argv, {}, bench); }
