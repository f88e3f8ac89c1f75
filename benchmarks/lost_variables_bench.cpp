// SPDX-License-Identifier: Apache-2.0
// The optimizer `auto`, as shipped, on problems in which a variable has no effect at the start;
// smooth and noisy, compared with SciPy and BOBYQA. Half of the problems were used to design the
// treatment of such variables, half were evaluated once afterward
// (verification/identification_set/lost_problems.cpp). A problem counts as solved if 1e-5 of the
// possible decrease remains within 20 and 50 (n + 1) evaluations. Required: in every cell `auto`
// solves at least the share of the better of both.
#include <fmt/format.h>
#include <nlopt.h>

#include <algorithm>
#include <array>

#include "identification_runs.h"
#include "table.h"

namespace {

using namespace latsch;
using namespace latsch::benchmarks;
using identification_set::DisturbedProblem;
using identification_set::Variant;

constexpr double kTau = 1e-5;
constexpr std::array kWithin{20, 50};

using Counts = std::array<int, kWithin.size()>;

void count(Counts& solved, const std::vector<double>& exact, double below, int n) {
  const auto first = std::find_if(exact.begin(), exact.end(), [&](double f) { return f <= below; });
  if (first == exact.end()) return;
  for (std::size_t k = 0; k < kWithin.size(); ++k) {
    solved[k] += first - exact.begin() + 1 <= kWithin[k] * (n + 1);
  }
}

void row(Table& table, SciPy& scipy, bool is_held_out, Variant variant, int most) {
  Counts ours{}, of_scipy{}, of_bobyqa{};
  int all = 0;
  for (const auto& problem : identification_set::lost_problems()) {
    if (problem.is_held_out != is_held_out || all == most) continue;
    const DisturbedProblem disturbed(problem, variant, 0);
    Recorded own(disturbed), other(disturbed);
    shipped()(own);
    solve_by_scipy(scipy, other, variant == Variant::smooth ? 0.0 : 1e-2);
    const auto bobyqa = nlopt_values(NLOPT_LN_BOBYQA, disturbed);
    double least = reference(disturbed);
    for (const auto* values : {&own.exact(), &other.exact(), &bobyqa}) {
      for (const double f : *values) least = std::min(least, f);
    }
    const double start = disturbed.exact(problem.space.initial().values);
    const double below = least + kTau * (start - least);
    count(ours, own.exact(), below, problem.n());
    count(of_scipy, other.exact(), below, problem.n());
    count(of_bobyqa, bobyqa, below, problem.n());
    ++all;
  }
  Counts best{};
  for (std::size_t k = 0; k < kWithin.size(); ++k) best[k] = std::max(of_scipy[k], of_bobyqa[k]);
  const auto words = [all](const Counts& c) { return fmt::format("{} {} of {}", c[0], c[1], all); };
  const std::string what =
      fmt::format("{}, {} @20/50", is_held_out ? "looked at once" : "decided by", name(variant));
  table.note("  SciPy, " + what, words(of_scipy));
  table.note("  BOBYQA, " + what, words(of_bobyqa));
  table.full_row(what, words(ours), ">= " + words(best), ours[0] >= best[0] && ours[1] >= best[1]);
}

int bench(const Options& options) {
  Table table("lost_variables", options);
  const int most = options.size(1000, 1);  // largest number of problems in a row
  SciPy scipy;
  for (const bool is_held_out : {false, true}) {
    for (const Variant variant : {Variant::smooth, Variant::noisy}) {
      row(table, scipy, is_held_out, variant, most);
    }
  }
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return run_benchmark(argc, argv, {}, bench); }
