// SPDX-License-Identifier: Apache-2.0
#include "optimization/direct_search/genetic.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "optimization/problem/feasible_region.h"
#include "optimization/problem/infinity.h"
#include "optimization/problem/option_check.h"
#include "optimization/problem/pending_points.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

struct Individual {
  std::vector<double> u;
  DesignPoint point;
  double f = kInfinity;
};

/// Returns the spread factor b of the crossover for a random number q.
double spread(double q, double eta) {
  return q <= 0.5 ? std::pow(2.0 * q, 1.0 / (eta + 1.0))
                  : std::pow(1.0 / (2.0 - 2.0 * q), 1.0 / (eta + 1.0));
}

double mutation(double q, double eta) {
  return q <= 0.5 ? std::pow(2.0 * q, 1.0 / (eta + 1.0)) - 1.0
                  : 1.0 - std::pow(2.0 - 2.0 * q, 1.0 / (eta + 1.0));
}

void check(const GeneticOptions& options) {
  const OptionCheck check("genetic algorithm");
  check.require(options.population == 0 || options.population >= 4,
                "population",
                options.population,
                "4 or more, or 0 for a choice by the variables");
  check.require(options.generations >= 1, "generations", options.generations, "1 or more");
  check.require(options.crossover >= 0.0 && options.crossover <= 1.0,
                "crossover",
                options.crossover,
                "a probability");
  check.require(
      options.eta_crossover >= 0.0, "eta of crossover", options.eta_crossover, "0 or more");
  check.require(options.eta_mutation >= 0.0, "eta of mutation", options.eta_mutation, "0 or more");
  check.require(
      options.step_tolerance >= 0.0, "step tolerance", options.step_tolerance, "0 or more");
}

}  // namespace

struct Genetic::State {
  DesignSpace space;
  FeasibleRegion region;
  GeneticOptions options;
  int population;
  int generation = 1;
  std::uint64_t drawn = 0;           // number of random streams used so far
  std::vector<Individual> parents;   // best first
  std::vector<Individual> children;  // known children of this generation
  PendingPoints<Individual> wanted;

  State(const DesignSpace& s, const GeneticOptions& o) : space(s), region(s), options(o) {
    population = o.population > 0 ? o.population : std::max(20, 10 * space.size());
    wanted.push_back(at(space.to_unit(space.initial())));
    while (wanted.size() < population) {
      RandomStream random(options.seed, drawn++);
      std::vector<double> u(space.size());
      for (double& x : u) x = random.uniform();
      wanted.push_back(at(u));
    }
  }

  /// Returns the individual at the point inside bounds and constraints that is nearest to u.
  Individual at(const std::vector<double>& u) const {
    const Eigen::VectorXd near = region.nearest(to_vector(u));
    const std::vector<double> inside(near.begin(), near.end());
    return {inside, space.from_unit(inside)};
  }

  const Individual& winner(RandomStream& random) const {
    const auto a = random.below(parents.size()), b = random.below(parents.size());
    return parents[std::min(a, b)];  // parents are ordered best first
  }

  void mutate(std::vector<double>& u, RandomStream& random) const {
    for (double& x : u) {
      if (random.uniform() * static_cast<double>(u.size()) < 1.0) {
        x += mutation(random.uniform(), options.eta_mutation);
      }
    }
  }

  void breed() {
    while (wanted.size() < population) {
      RandomStream random(options.seed, drawn++);
      std::vector<double> a = winner(random).u, b = winner(random).u;
      if (random.uniform() < options.crossover) {
        for (std::size_t i = 0; i < a.size(); ++i) {
          const double s = spread(random.uniform(), options.eta_crossover);
          const double sum = a[i] + b[i], difference = s * (a[i] - b[i]);
          a[i] = 0.5 * (sum + difference);
          b[i] = 0.5 * (sum - difference);
        }
      }
      mutate(a, random);
      mutate(b, random);
      wanted.push_back(at(a));
      if (wanted.size() < population) wanted.push_back(at(b));
    }
  }

  bool is_narrow() const {
    return std::all_of(parents.begin(), parents.end(), [&](const Individual& individual) {
      for (std::size_t i = 0; i < individual.u.size(); ++i) {
        if (std::abs(individual.u[i] - parents.front().u[i]) > options.step_tolerance) return false;
      }
      return true;
    });
  }

  void end_generation() {
    parents.insert(parents.end(), children.begin(), children.end());
    children.clear();
    const auto less = [](const Individual& a, const Individual& b) { return a.f < b.f; };
    std::stable_sort(parents.begin(), parents.end(), less);
    if (std::ssize(parents) > population) parents.resize(population);
    const bool is_end = generation >= options.generations || parents.front().f == kInfinity;
    if (is_end || is_narrow()) return;
    ++generation;
    breed();
  }
};

Genetic::Genetic(const DesignSpace& space, const GeneticOptions& options) {
  check(options);
  state_ = std::make_unique<State>(space, options);
}

Genetic::~Genetic() = default;

std::vector<DesignPoint> Genetic::propose(int count) const {
  assert(count >= 1);
  Plan plan(count);
  plan.add(state_->wanted);
  return plan.points();
}

void Genetic::observe(const DesignPoint& point, const Result<Score>& outcome) {
  const double f = outcome ? outcome->value : kInfinity;
  if (!state_->space.place(point)) return;
  std::optional<Individual> own = state_->wanted.take(point);
  const bool is_foreign = !own;
  Individual tried = own ? std::move(*own) : Individual{state_->space.to_unit(point), point};
  tried.f = state_->space.contains(point) ? f : kInfinity;
  state_->children.push_back(std::move(tried));
  if (!is_foreign && state_->wanted.empty()) state_->end_generation();
}

bool Genetic::converged() const { return state_->wanted.empty(); }

}  // namespace latsch
