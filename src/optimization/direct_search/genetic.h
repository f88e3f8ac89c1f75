// SPDX-License-Identifier: Apache-2.0
// Real-coded genetic algorithm for targets with many local minima, if evaluations are cheap or
// there are many workers. It needs about a hundred times the evaluations of a method that uses the
// residuals.
//
// In the unit cube, each generation makes as many children as the population has members:
//   selection  the better of two individuals drawn at random, done twice for the two parents
//   crossover  simulated binary [Deb & Agrawal, Complex Systems 9 (1995) 115]: for every variable
//              of a pair, with  b = (2 q)^(1/(eta_c+1))  or  (1 / (2 - 2 q))^(1/(eta_c+1)),
//              children  1/2 ((1 +- b) p_1 + (1 -+ b) p_2)
//   mutation   polynomial [Deb & Goyal, Computer Science and Informatics 26 (1996) 30]: on average
//              one variable of each child changes by
//              (2 q)^(1/(eta_m+1)) - 1  or  1 - (2 - 2 q)^(1/(eta_m+1))
//   survival   the best of parents and children form the next population
// q is a random number between 0 and 1. Children outside of bounds and linear constraints are
// replaced by the nearest point inside. The search ends after the last generation, or when the
// whole population is within the tolerance of its best member. Random numbers depend on the seed
// and the child's number alone, so a run is the same for any number of workers.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Options of the search: its size and its random choices.
struct GeneticOptions {
  int population = 0;         // 0: ten times the number of variables, at least 20
  int generations = 50;       // the search ends after this number of generations
  double crossover = 0.9;     // probability that a pair is crossed
  double eta_crossover = 15;  // eta_c: larger values make children more similar to their parents
  double eta_mutation = 20;   // eta_m: larger values make mutations smaller
  /// The search ends if all individuals are this close, in the unit cube.
  double step_tolerance = 1e-3;
  std::uint64_t seed = 1;  // seed of the random choices
};

class Genetic : public Optimizer {
 public:
  /// Begins with a population whose first individual is the initial point of the space. Throws
  /// InputError for options out of range.
  explicit Genetic(const DesignSpace& space, const GeneticOptions& options = {});
  ~Genetic() override;

  /// Proposes the points of the present generation whose outcomes are not known yet.
  std::vector<DesignPoint> propose(int count) const override;
  /// Observes an outcome. A point that the search did not propose joins the parents.
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace latsch
