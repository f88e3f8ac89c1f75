// SPDX-License-Identifier: Apache-2.0
// Optimizers on many problems of one kind, for choosing the constants of a search method.
//
// Each of the 53 Moré-Wild problems is moved, rotated and scaled (varied_problems.h), five times
// each: 795 problems in three states, namely smooth, with 1 % noise on every residual, and with a
// tenth of the points without outcome. One problem changes a share by .001, while a comparison on a
// single set of 53 depends on chance.
//
//   more_wild_varied                    the methods as shipped, with solvers of NLopt
//   more_wild_varied --contraction 0.5  GSS as shipped and with another contraction, also by family
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlopt.h>

#include <algorithm>
#include <iterator>
#include <thread>

#include "base/error.h"
#include "more_wild/varied_problems.h"
#include "more_wild_runs.h"

namespace latsch::benchmarks {
namespace {

const std::vector<double> kBudgets = {10, 20, 50, 100};

struct Family {
  const char* name;
  std::vector<more_wild::Problem> problems;
};

/// Returns the families of problems, each with five variants; in a smoke run only the first
/// families.
std::vector<Family> families(const Options& options) {
  const int variants = options.size(5, 1);
  std::vector<Family> all = {{"moved", {}}, {"rotated", {}}, {"scaled", {}}};
  const auto add = [](Family& family, std::vector<more_wild::Problem> more) {
    std::move(more.begin(), more.end(), std::back_inserter(family.problems));
  };
  for (int seed = 1; seed <= variants; ++seed) {
    add(all[0], more_wild::moved(seed));
    add(all[1], more_wild::rotated(seed));
    add(all[2], more_wild::scaled(seed));
  }
  for (Family& family : all)
    if (options.is_smoke()) family.problems.resize(4, family.problems.front());
  return all;
}

struct State {
  const char* name;
  Disturbance disturbance;
};

const State kStates[] = {
    {"smooth", {}}, {"noise", {.noise = 0.01}}, {"failing", {.failures = 0.1}}};

/// Returns the data profile of every family of problems in turn, then the profile of all problems.
std::vector<Profile> profiles(const Solver& solver,
                              const std::vector<Family>& families,
                              const Disturbance& disturbance) {
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::vector<Profile> found;
  std::vector<Solved> all;
  for (const Family& family : families) {
    const auto solved = solve(solver, {disturbance}, kBudgets.back(), family.problems, threads);
    found.push_back(profile(solved, kBudgets));
    all.insert(all.end(), solved.begin(), solved.end());
  }
  found.push_back(profile(all, kBudgets));
  return found;
}

/// Adds a row for each budget and tau: the share that a method solves, and as its requirement the
/// largest share of the other solvers.
void beside(Table& table,
            const std::string& what,
            const Profile& own,
            const std::vector<Profile>& peers) {
  for (const auto& [tau, shares] :
       {std::pair("1e-3", &Profile::tau_1e3), std::pair("1e-5", &Profile::tau_1e5)}) {
    for (std::size_t k = 0; k < kBudgets.size(); ++k) {
      double most = 0.0;
      for (const Profile& peer : peers) most = std::max(most, (peer.*shares)[k]);
      reach(table, fmt::format("{}, tau {} @{:g}", what, tau, kBudgets[k]), (own.*shares)[k], most);
    }
  }
}

int methods_as_shipped(const Options& options) {
  Table table("more_wild_varied", options);
  const auto problems = families(options);
  for (const auto& [name, disturbance] : kStates) {
    const auto all = [&](const Solver& solver) {
      return profiles(solver, problems, disturbance).back();
    };
    const Profile trust = all(residual_trust_region()), search = all(gss());
    const Profile simplex = all(nlopt(NLOPT_LN_NELDERMEAD));
    note(table, fmt::format("{}: residual trust region", name), trust);
    note(table, fmt::format("{}: GSS", name), search);
    note(table, fmt::format("{}: NLopt Nelder-Mead", name), simplex);
    std::vector<Profile> peers = {simplex};
    if (disturbance.failures == 0.0) {
      peers.push_back(all(nlopt(NLOPT_LN_BOBYQA)));
      note(table, fmt::format("{}: NLopt BOBYQA", name), peers.back());
    }
    beside(table, fmt::format("{}: residual trust region", name), trust, peers);
    beside(table, fmt::format("{}: GSS", name), search, {simplex});
  }
  return table.exit_code();
}

/// Compares two columns of shares: GSS as shipped, and GSS with the other contraction factor.
int judge_contraction(double other, const Options& options) {
  Table table("more_wild_varied", options);
  const auto problems = families(options);
  const double shipped = GssOptions{}.contraction;
  const std::string heading =
      fmt::format("@{:g}, contraction {:g} | {:g}", fmt::join(kBudgets, "/"), shipped, other);
  for (const auto& [name, disturbance] : kStates) {
    const auto one = profiles(gss(), problems, disturbance);
    const auto two = profiles(gss({.contraction = other}), problems, disturbance);
    for (std::size_t i = 0; i < one.size(); ++i) {
      const char* family = i < problems.size() ? problems[i].name : "all";
      const auto columns = [&](const char* tau, std::vector<double> Profile::*shares) {
        table.note(
            fmt::format("{}, {}: GSS, tau {} {}", name, family, tau, heading),
            fmt::format(
                "{:.3f} | {:.3f}", fmt::join(one[i].*shares, " "), fmt::join(two[i].*shares, " ")));
      };
      columns("1e-3", &Profile::tau_1e3);
      columns("1e-5", &Profile::tau_1e5);
    }
  }
  return 0;
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  using namespace latsch::benchmarks;
  return run_benchmark(
      argc,
      argv,
      {{"--contraction", "SHARE", "GSS as shipped beside one of another contraction"}},
      [](const Options& options) {
        if (!options.has("--contraction")) return methods_as_shipped(options);
        const double contraction = options.number("--contraction", 0.0);
        if (!(contraction > 0.0 && contraction < 1.0))
          throw latsch::InputError("--contraction is above 0 and below 1");
        return judge_contraction(contraction, options);
      });
}
