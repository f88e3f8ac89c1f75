// SPDX-License-Identifier: Apache-2.0
#include "more_wild_runs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlopt.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>

#include "base/random.h"
#include "optimization/trust_region/residual_trust_region.h"
#include "scipy_peer.h"

namespace latsch::benchmarks {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// FNV-1a hash, used instead of std::hash so that the points that fail do not depend on the
/// standard library.
std::uint64_t number_of(const std::vector<double>& x) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : DesignPoint{x}.bits()) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  }
  return hash;
}

/// First step of the solvers as a share of the side of the box around the start.
constexpr double kStartStep = 1.0 / more_wild::kBoxWidth;
// the rounding of coordinates in the box: runs end when their budget is used up
constexpr double kTolerance = 1e-12;

void run(Optimizer& optimizer, Observed& observed, int most_evaluations) {
  while (!optimizer.converged() && !observed.is_done() &&
         observed.evaluations() < most_evaluations) {
    const DesignPoint point = optimizer.propose(1).front();
    optimizer.observe(point, observed(point.values));
  }
}

double nlopt_value(unsigned n, const double* x, double*, void* data) {
  const Result<Score> outcome = (*static_cast<Observed*>(data))({x, x + n});
  // value for residuals that overflow, because NLopt cannot represent infinity
  constexpr double kNone = 1e300;
  return outcome ? outcome->value : kNone;
}

}  // namespace

Observed::Observed(const more_wild::Problem& problem, const Disturbance& disturbance)
    : problem_(problem),
      disturbance_(disturbance),
      best_(kInfinity),
      solved_{kInfinity, kInfinity} {}

Result<Score> Observed::operator()(const std::vector<double>& x) {
  return at_time(x, evaluations_ + 1.0);
}

Result<Score> Observed::at_time(const std::vector<double>& x, double time) {
  RandomStream random(disturbance_.seed, number_of(x));
  const bool is_start = evaluations_++ == 0;
  if (!is_start && random.uniform() < disturbance_.failures) return Failure{"drawn by lot"};
  Score score;
  score.residuals = problem_.residuals(x);
  double exact = 0.0;
  for (double& r : score.residuals) {
    exact += r * r;
    r *= 1.0 + disturbance_.noise * random.normal();
    score.value += r * r;
  }
  if (!std::isfinite(score.value)) return Failure{"the residuals are not finite"};
  best_ = std::min(best_, exact);
  const double units = time / (problem_.n() + 1.0);
  if (best_ <= problem_.solved_below(1e-3)) solved_.at_1e3 = std::min(solved_.at_1e3, units);
  if (best_ <= problem_.solved_below(1e-5)) solved_.at_1e5 = std::min(solved_.at_1e5, units);
  return score;
}

bool Observed::is_done() const { return solved_.at_1e5 < kInfinity; }

Solver residual_trust_region() {
  return [](Observed& observed, int most_evaluations) {
    ResidualTrustRegion method(more_wild::space(observed.problem()),
                               {.initial_radius = kStartStep, .step_tolerance = kTolerance});
    run(method, observed, most_evaluations);
  };
}

Solver gss(GssOptions options) {
  options.initial_step = kStartStep;
  options.step_tolerance = kTolerance;
  return [options](Observed& observed, int most_evaluations) {
    Gss method(more_wild::space(observed.problem()), options);
    run(method, observed, most_evaluations);
  };
}

Solver nlopt(int algorithm) {
  return [algorithm](Observed& observed, int most_evaluations) {
    const more_wild::Problem& problem = observed.problem();
    const nlopt_opt solver =
        nlopt_create(static_cast<nlopt_algorithm>(algorithm), static_cast<unsigned>(problem.n()));
    nlopt_set_min_objective(solver, nlopt_value, &observed);
    nlopt_set_initial_step(solver, more_wild::start_steps(problem).data());
    nlopt_set_maxeval(solver, most_evaluations);
    nlopt_set_stopval(solver, problem.solved_below(1e-5));
    std::vector<double> x = problem.start;
    double value = 0.0;
    nlopt_optimize(solver, x.data(), &value);
    nlopt_destroy(solver);
  };
}

Solver scipy() {
  const auto peer = std::make_shared<SciPy>();
  return [peer](Observed& observed, int most_evaluations) {
    const more_wild::Problem& problem = observed.problem();
    const std::vector<double> steps = more_wild::start_steps(problem);
    const auto ask = [&](const std::vector<double>& moved) -> SciPy::Answer {
      if (observed.is_done() || observed.evaluations() >= most_evaluations) {
        return {.is_spent = true};
      }
      std::vector<double> x = problem.start;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += steps[i] * moved[i];
      const Result<Score> outcome = observed(x);
      if (!outcome) return {};
      return {outcome->residuals};
    };
    peer->solve(std::vector<double>(problem.start.size(), 0.0), false, 0.0, ask);
  };
}

Profile profile(const std::vector<Solved>& solved, const std::vector<double>& budgets) {
  Profile profile{budgets, {}, {}};
  for (const double k : budgets) {
    const auto share = [&](double Solved::*at) {
      const auto within = [&](const Solved& s) { return s.*at <= k; };
      return static_cast<double>(std::count_if(solved.begin(), solved.end(), within)) /
             static_cast<double>(solved.size());
    };
    profile.tau_1e3.push_back(share(&Solved::at_1e3));
    profile.tau_1e5.push_back(share(&Solved::at_1e5));
  }
  return profile;
}

std::vector<Solved> solve(const Solver& solver,
                          const std::vector<Disturbance>& disturbances,
                          double k,
                          const std::vector<more_wild::Problem>& problems,
                          int threads) {
  std::vector<Solved> solved(disturbances.size() * problems.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < solved.size();) {
      const more_wild::Problem& problem = problems[i % problems.size()];
      Observed observed(problem, disturbances[i / problems.size()]);
      solver(observed, static_cast<int>(k * (problem.n() + 1)));
      solved[i] = observed.solved();
    }
  };
  std::vector<std::jthread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back(work);
  work();
  others.clear();
  return solved;
}

Profile measure(const Solver& solver,
                const std::vector<Disturbance>& disturbances,
                const std::vector<double>& budgets,
                const std::vector<more_wild::Problem>& problems) {
  return profile(solve(solver, disturbances, budgets.back(), problems), budgets);
}

void note(Table& table, const std::string& solver, const Profile& profile) {
  table.note(fmt::format("{}, tau 1e-3 @{:g}", solver, fmt::join(profile.budgets, "/")),
             fmt::format("{:.3f}", fmt::join(profile.tau_1e3, " ")));
  table.note(fmt::format("{}, tau 1e-5 @{:g}", solver, fmt::join(profile.budgets, "/")),
             fmt::format("{:.3f}", fmt::join(profile.tau_1e5, " ")));
}

void reach(Table& table, const std::string& what, double share, double at_least) {
  // Shares and their required values are rounded to three decimals before they are compared.
  table.full_row(what,
                 fmt::format("{:.3f}", share),
                 fmt::format(">= {:.3f}", at_least),
                 std::round(1e3 * share) >= std::round(1e3 * at_least));
}

}  // namespace latsch::benchmarks
