// SPDX-License-Identifier: Apache-2.0
// Sobol's indices from few points: their error, whether their intervals hold, what is not trusted.
//
// Ishigami's function and Sobol's g of eight variables, which has kinks, have closed forms. Designs
// are Latin hypercubes and Sobol sequences in turn, each with a seed of its own. The seeds of the
// first half were looked at while the method was chosen, those of the second half were not.
#include <fmt/format.h>

#include <algorithm>

#include "cpu_time.h"
#include "optimization/design/latin_hypercube.h"
#include "optimization/design/sobol.h"
#include "optimization/surrogate/sensitivity_functions_testing.h"
#include "optimization/surrogate/variance_shares.h"
#include "options.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

Eigen::MatrixXd design(int n, int count, int seed) {
  std::vector<DesignVariable> variables;
  for (int i = 0; i < n; ++i) variables.push_back({.name = fmt::format("u{}", i)});
  const DesignSpace space(variables);
  const auto plan = seed % 2 ? sobol(space, count, seed) : latin_hypercube(space, count, seed);
  Eigen::MatrixXd points(count, n);
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < n; ++i) points(k, i) = plan.points[k].values[i];
  return points;
}

struct Repeats {
  double worst = 0.0, mean = 0.0;  // largest error of an index: of all repeats, and on average
  double held = 1.0;               // least share of repeats in which the interval of an index holds
  double trusted = 0.0;            // share of repeats
  double seconds = 0.0;            // CPU time of one
};

Repeats repeats(int n,
                int points,
                int first,
                int count,
                const ResponseOfCube& y,
                const ClosedShares& expected) {
  Repeats found;
  std::vector<int> held(2 * n, 0);
  const double began = cpu_seconds();
  for (int k = 0; k < count; ++k) {
    const Eigen::MatrixXd at = design(n, points, first + k);
    Eigen::VectorXd values(points);
    for (int row = 0; row < points; ++row) values[row] = y(at.row(row).transpose());
    const VarianceShares shares = variance_shares(at, values);
    double worst = 0.0;
    for (int i = 0; i < 2 * n; ++i) {
      const double truth = i < n ? expected.first[i] : expected.total[i - n];
      const VarianceShare& share = i < n ? shares.first[i] : shares.total[i - n];
      worst = std::max(worst, std::abs(share.value - truth));
      constexpr double kRounding = 1e-9;
      held[i] += truth >= share.lower - kRounding && truth <= share.upper + kRounding;
    }
    found.worst = std::max(found.worst, worst);
    found.mean += worst / count;
    found.trusted += shares.is_trusted() ? 1.0 / count : 0.0;
  }
  found.seconds = (cpu_seconds() - began) / count;
  found.held = *std::min_element(held.begin(), held.end()) / static_cast<double>(count);
  return found;
}

void rows(Table& table, const Options& options, const std::string& half, int first) {
  const auto error_row = [&](const std::string& what, const Repeats& r, bool is_asked) {
    if (is_asked)
      table.full_row(what + "largest error of an index, worst of the repeats",
                     fmt::format("{:.4f}", r.worst),
                     "<= 0.03",
                     r.worst <= 0.03);
    table.note(what + "largest error of an index, mean of the repeats",
               fmt::format("{:.4f}", r.mean));
  };
  const auto held_row = [&](const std::string& what, const Repeats& r) {
    table.full_row(what + "repeats in which an interval holds, least of all indices",
                   fmt::format("{:.0f} %", 100.0 * r.held),
                   ">= 90 %",
                   r.held >= 0.9);
    table.note(what + "trusted, time of one",
               fmt::format("{:.0f} %, {:.2f} CPU s", 100.0 * r.trusted, r.seconds));
  };
  for (const int points : {40, 80}) {
    const Repeats r =
        repeats(3, points, first, options.size(200, 2), ishigami, shares_of_ishigami());
    const std::string what = fmt::format("Ishigami, {} points, {}: ", points, half);
    error_row(what, r, points == 80);
    held_row(what, r);
  }
  for (const int points : {80, 160}) {
    const Repeats r =
        repeats(8, options.size(points, 30), first, options.size(200, 1), sobols_g, shares_of_g());
    const std::string what = fmt::format("g of 8, {} points, {}: ", points, half);
    error_row(what, r, points == 160);
    held_row(what, r);
  }
}

int bench(const Options& options) {
  Table table("variance_shares", options);
  rows(table, options, "looked at", 1);
  if (!options.is_smoke()) rows(table, options, "held out", 5001);
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  using namespace latsch::benchmarks;
  return run_benchmark(argc, argv, {}, bench);
}
