// SPDX-License-Identifier: Apache-2.0
// Time of every SIMD kernel set that this processor supports, in units of a simple operation
// (yardstick.h), and equality of their results to the bit.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "models/magic_formula/magic_formula.h"
#include "models/magic_formula/round_tire_testing.h"
#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/profile_road.h"
#include "numerics/kernels/kernel_set.h"
#include "table.h"
#include "yardstick.h"

namespace {

using namespace latsch;
using namespace latsch::benchmarks;

constexpr std::size_t kStates = 4096;

/// Results and cost of a kernel.
struct Run {
  std::vector<double> results;
  Beside cost;
};

std::vector<magic_formula::State> states() {
  std::vector<magic_formula::State> list(kStates);
  for (std::size_t i = 0; i < kStates; ++i) {
    RandomStream random(11, i);
    const auto within = [&](double a, double b) { return a + (b - a) * random.uniform(); };
    list[i] = {within(800.0, 8000.0),
               within(-0.3, 0.3),
               within(-0.3, 0.3),
               within(-0.08, 0.08),
               0.0,
               within(5.0, 40.0),
               within(1.8e5, 2.6e5)};
  }
  return list;
}

std::vector<double> numbers(const std::vector<magic_formula::SteadyState>& of) {
  std::vector<double> list(of.size() * sizeof of[0] / sizeof(double));
  std::memcpy(list.data(), of.data(), list.size() * sizeof(double));
  return list;
}

Run one_by_one(int rounds) {
  const magic_formula::MagicFormula tire(magic_formula::round_tire());
  const auto all = states();
  std::vector<magic_formula::SteadyState> results(kStates);
  Run run;
  run.cost = beside(Yardstick::atan, rounds, [&] {
               for (std::size_t i = 0; i < kStates; ++i) results[i] = tire.evaluate(all[i]);
             }).per(kStates);
  run.results = numbers(results);
  return run;
}

Run many_at_once(int rounds) {
  const magic_formula::MagicFormula tire(magic_formula::round_tire());
  const auto all = states();
  std::vector<magic_formula::SteadyState> results(kStates);
  Run run;
  run.cost = beside(Yardstick::atan, rounds, [&] { tire.evaluate(all, results); }).per(kStates);
  run.results = numbers(results);
  return run;
}

/// Simulates 0.15 s at 60 km/h over a cleat of 10 x 30 mm in steps of 0.5 ms, and returns the
/// results and the time of one step.
Run ring_over_cleat(int rounds) {
  auto ring = ring_tire::passenger_ring();
  ring.nodes = 80;
  ring.sidewall.radial.dynamic_stiffening = 0.2;
  ring.tread.blocks = 50;
  ring.tread.lines = 10;
  ring.tread.damping_time = 1e-4;
  const road::ProfileRoad road = road::cleat_road(0.6, 0.01, 0.03, 0.005);
  constexpr int kSteps = 300;
  constexpr double kStep = 5e-4;
  Run run;
  run.cost = beside(Yardstick::atan, std::min(rounds, 4), [&] {
               run.results.clear();
               ring_tire::RingTire tire(ring);
               WheelMotion motion;
               motion.center.z() = tire.free_radius() - 0.022;
               motion.velocity.x() = 60.0 / 3.6;
               motion.spin_rate = motion.velocity.x() / 0.3085;
               if (!tire.settle(motion, road, 0.0)) throw InputError("the ring finds no rest");
               for (int i = 1; i <= kSteps; ++i) {
                 motion.center += kStep * motion.velocity;
                 motion.spin += kStep * motion.spin_rate;
                 const auto hub = tire.advance(motion, road, i * kStep, kStep);
                 if (!hub) throw InputError(hub.failure().reason);
                 run.results.push_back(hub->force.x());
                 run.results.push_back(hub->force.z());
               }
             }).per(kSteps);
  return run;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// Returns the FNV-1a hash of the values' bits. It is the same on every processor with fused
/// multiply-adds.
std::uint64_t digest(const std::vector<double>& values) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const double value : values)
    for (int i = 0; i < 8; ++i) {
      hash ^= (std::bit_cast<std::uint64_t>(value) >> (8 * i)) & 0xff;
      hash *= 0x100000001b3;
    }
  return hash;
}

/// Returns the largest difference between the two lists: absolute, in SI units, for small values
/// and relative for large ones.
double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]) / (1.0 + std::abs(b[i])));
  return largest;
}

void compare(Table& table, const std::string& what, const std::function<Run()>& measure) {
  std::map<KernelSet, Run> runs;
  for (const KernelSet set : kernel_sets()) {
    const WithKernelSet with(set);
    const Run& run = runs[set] = measure();
    table.note(
        fmt::format("{}, {}", what, name(set)),
        fmt::format("{}, bits {:016x}", in_units(run.cost, Yardstick::atan), digest(run.results)));
  }
  const auto has = [&](KernelSet set) { return runs.count(set) > 0; };
  if (!has(KernelSet::avx2)) return;
  const Run &baseline = runs[KernelSet::baseline], &avx2 = runs[KernelSet::avx2];
  table.row(what + ", baseline against avx2, relative",
            fmt::format("{:.1e}", largest_difference(baseline.results, avx2.results)),
            "<= 1e-5",
            largest_difference(baseline.results, avx2.results) <= 1e-5);
  table.full_row(what + ", avx2 against baseline",
                 fmt::format("{:.2f} x the time", avx2.cost.ratio() / baseline.cost.ratio()),
                 "<= 0.9",
                 avx2.cost.ratio() <= 0.9 * baseline.cost.ratio());
  if (!has(KernelSet::avx512)) {
    table.note(what + ", avx2 against avx512", "no AVX-512 here");
    return;
  }
  const Run& avx512 = runs[KernelSet::avx512];
  const bool same = same_bits(avx2.results, avx512.results);
  table.row(what + ", avx2 against avx512, bits", same ? "the same" : "others", "the same", same);
  table.full_row(what + ", avx2 against avx512",
                 fmt::format("{:.2f} x the time", avx2.cost.ratio() / avx512.cost.ratio()),
                 "<= 2.2",
                 avx2.cost.ratio() <= 2.2 * avx512.cost.ratio());
}

int bench(const Options& options) {
  Table table("kernels", options);
  const int rounds = options.size(40, 2);
  for (const KernelSet set : kernel_sets()) {
    const WithKernelSet with(set);
    const Beside fused = beside(Yardstick::multiply_add, rounds, [] {});
    table.note(fmt::format("a multiply-add of one lane, {}", name(set)), as_time(fused.yardstick));
  }
  table.note("a byte from array to array",
             as_time(beside(Yardstick::byte, options.size(5, 1), [] {}).yardstick));
  compare(table, "Magic Formula, one state", [&] { return one_by_one(rounds); });
  compare(table, "Magic Formula, of many at once", [&] { return many_at_once(rounds); });
  compare(table, "ring over a cleat, a step and its share of settling", [&] {
    return ring_over_cleat(rounds);
  });
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return latsch::benchmarks::run_benchmark(argc, argv, {}, bench); }
