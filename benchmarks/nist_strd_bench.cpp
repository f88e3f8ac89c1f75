// SPDX-License-Identifier: Apache-2.0
// Solvers on NIST's certified nonlinear regressions and on varied Moré-Wild problems, used to
// choose between methods. `./bench.sh nist_strd --training` adds the varied problems: the Moré-Wild
// functions from other starts and in other variables, and NIST's with the same first step for all
// variables, which for some of them is ten times the largest start value. Constants of the residual
// trust region method are chosen by these problems, never by ./bench.sh more_wild. Required: every
// cell is no less than the better of SciPy's least_squares, which is made for such problems, and
// NLopt's BOBYQA in the same run.
#include <fmt/format.h>
#include <nlopt.h>

#include <algorithm>

#include "more_wild/varied_problems.h"
#include "more_wild_runs.h"
#include "nist_strd/nist_strd.h"

namespace {

using namespace latsch;
using namespace latsch::benchmarks;

const std::vector<double> kBudgets{10, 50, 100};

std::vector<more_wild::Problem> with_one_step(std::vector<more_wild::Problem> problems) {
  for (more_wild::Problem& problem : problems) problem.steps.clear();
  return problems;
}

void training(Table& table) {
  const auto add = [&](const std::string& what, const std::vector<more_wild::Problem>& problems) {
    note(table, what, measure(residual_trust_region(), {{}}, kBudgets, problems));
  };
  add("NIST, one step for all", with_one_step(nist_strd::problems()));
  for (const std::uint64_t seed : {1, 2}) {
    add(fmt::format("moved, seed {}", seed), more_wild::moved(seed));
    add(fmt::format("rotated, seed {}", seed), more_wild::rotated(seed));
    add(fmt::format("scaled, seed {}", seed), more_wild::scaled(seed));
  }
}

int bench(const Options& options) {
  Table table("nist_strd", options);
  auto problems = nist_strd::problems();
  problems.resize(options.size(problems.size(), std::size_t{3}), problems.front());
  const auto on_nist = [&](const Solver& solver) {
    return measure(solver, {{}}, kBudgets, problems);
  };
  const Profile trust = on_nist(residual_trust_region());
  const Profile bobyqa = on_nist(nlopt(NLOPT_LN_BOBYQA));
  const Profile scipy = on_nist(benchmarks::scipy());
  for (std::size_t k = 0; k < kBudgets.size(); ++k) {
    const std::string budget = fmt::format(" @{:g}", kBudgets[k]);
    const auto best = [&](auto tau) { return std::max((scipy.*tau)[k], (bobyqa.*tau)[k]); };
    reach(table, "tau 1e-3" + budget, trust.tau_1e3[k], best(&Profile::tau_1e3));
    reach(table, "tau 1e-5" + budget, trust.tau_1e5[k], best(&Profile::tau_1e5));
  }
  note(table, "residual trust region", trust);
  note(table, "SciPy least_squares", scipy);
  note(table, "NLopt BOBYQA", bobyqa);
  note(table, "NLopt Nelder-Mead", on_nist(nlopt(NLOPT_LN_NELDERMEAD)));
  note(table, "GSS", on_nist(gss()));
  if (options.has("--training")) training(table);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  return run_benchmark(argc, argv, {{"--training", "", "the varied problems besides"}}, bench);
}
