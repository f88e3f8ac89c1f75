// SPDX-License-Identifier: Apache-2.0
// Magic Formula 5.2, 6.1, 6.2: agreement with an independent program, one evaluation, 10^6 at once
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "base/random.h"
#include "magic_formula/magic_formula_points.h"
#include "table.h"

namespace {

using namespace latsch;
using namespace latsch::magic_formula;

double cpu_time() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU seconds of the fastest of several runs.
template <class Run>
double fastest(int runs, Run run) {
  double best = 1e9;
  for (int i = 0; i < runs; ++i) {
    const double start = cpu_time();
    run();
    best = std::min(best, cpu_time() - start);
  }
  return best;
}

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
      table.note(what, "the sample tires are not beside the source tree");
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

void speed(benchmarks::Table& table) {
  const auto sample = verification::sample_tire(Version::mf61);
  if (!sample) return;
  const MagicFormula tire(*sample);
  constexpr std::size_t kOnes = 100000, kMany = 1000000;
  const std::vector<State> states = random_states(kMany, *sample);
  double sum = 0.0;
  const double one = fastest(30,
                             [&] {
                               for (std::size_t i = 0; i < kOnes; ++i)
                                 sum += tire.evaluate(states[i]).Fy;
                             }) /
                     kOnes;
  table.row("one combined evaluation: forces, moments, radii, patch, relaxation",
            fmt::format("{:.3f} us CPU", one * 1e6),
            "<= 0.3 us",
            one <= 0.3e-6);
  std::vector<double> in[7], out[5];
  double State::*const members[] = {
      &State::Fz, &State::kappa, &State::alpha, &State::gamma, &State::phit, &State::Vx, &State::p};
  for (int k = 0; k < 7; ++k)
    for (const State& s : states) in[k].push_back(s.*members[k]);
  for (auto& column : out) column.resize(kMany);
  const double columns = fastest(3, [&] {
    tire.forces({in[0], in[1], in[2], in[3], in[4], in[5], in[6]},
                {out[0], out[1], out[2], out[3], out[4]});
  });
  table.row("10^6 states at once, forces and moments, one core",
            fmt::format("{:.3f} s CPU", columns),
            "<= 0.2 s",
            columns <= 0.2);
  std::vector<SteadyState> results(kMany);
  const double all = fastest(3, [&] { tire.evaluate(states, results); });
  table.row("10^6 states at once, everything, one core",
            fmt::format("{:.3f} s CPU", all),
            "<= 0.2 s",
            all <= 0.2);
  table.note("sum of side forces, so that nothing is left out", fmt::format("{:.3f} N", sum));
}

int bench() {
  benchmarks::Table table("magic_formula");
  agreement(table);
  speed(table);
  return table.exit_code();
}

}  // namespace

int main() { return latsch::benchmarks::guarded(bench); }
