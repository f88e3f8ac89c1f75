// SPDX-License-Identifier: Apache-2.0
// Morris' screening: which variables matter, which do not, which act together with others or in a
// curved way, from a few evaluations a variable.
//
// A trajectory starts at a random point of a grid of p levels in the unit cube and changes one
// variable after the other, in random order, by Delta = p / (2 (p - 1)). Each step gives one
// elementary effect
//   d_i = (y(x + Delta e_i) - y(x)) / Delta                                          (2.1)
// so that r trajectories give r effects of every variable for r (n + 1) evaluations [Morris,
// Technometrics 33 (1991) 161]. Over the trajectories,
//   mu_i     mean of d_i: its effect, positive and negative ones canceling
//   mu*_i    mean of |d_i|: how much it matters   [Campolongo, Cariboni, Saltelli,
//                                                   Environ. Model. Softw. 22 (2007) 1509]
//   sigma_i  standard deviation of d_i: large beside mu* where the effect is curved or depends on
//            other variables
// An effect is the change of y over the whole range of the variable. Choose 10 trajectories; fewer
// than 4 say little.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "optimization/design/sampling_plan.h"
#include "optimization/problem/design_space.h"

namespace latsch {

struct MorrisDesign {
  /// n + 1 points each; consecutive ones differ in one variable.
  std::vector<std::vector<DesignPoint>> trajectories;

  /// The points in the order of the trajectories, each once.
  SamplingPlan plan() const;
};

/// Throws InputError for less than 2 trajectories or more than 10,000, for an odd number of levels
/// or one outside 2 .. 100.
MorrisDesign morris(const DesignSpace& space,
                    int trajectories,
                    std::uint64_t seed = 0,
                    int levels = 4);

/// One variable's effects.
struct ElementaryEffects {
  double mu = 0.0, mu_star = 0.0, sigma = 0.0;
  int effects = 0;  // of which both evaluations succeeded
};

/// One entry a variable, of values in the order of the trajectories' points; a failed evaluation is
/// nullopt and takes its effects along.
std::vector<ElementaryEffects> elementary_effects(
    const DesignSpace& space,
    const MorrisDesign& design,
    const std::vector<std::vector<std::optional<double>>>& values);

}  // namespace latsch
