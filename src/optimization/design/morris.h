// SPDX-License-Identifier: Apache-2.0
// Morris' screening: finds from a few evaluations for each variable which variables matter, which
// do not, and which act together with others or nonlinearly.
//
// A trajectory starts at a random point of a grid of p levels in the unit cube and changes one
// variable after the other, in random order, by Delta = p / (2 (p - 1)). Each step gives one
// elementary effect
//   d_i = (y(x + Delta e_i) - y(x)) / Delta                                          (2.1)
// so that r trajectories give r effects of every variable for r (n + 1) evaluations [Morris,
// Technometrics 33 (1991) 161]. Over the trajectories,
//   mu_i     mean of d_i: the effect, in which positive and negative values cancel
//   mu*_i    mean of |d_i|: how much variable i matters   [Campolongo, Cariboni, Saltelli,
//                                                   Environ. Model. Softw. 22 (2007) 1509]
//   sigma_i  standard deviation of d_i: large compared with mu* if the effect is nonlinear or
//            depends on other variables
// An effect is the change of y over the whole range of the variable. Choose 10 trajectories; fewer
// than 4 give little information.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "optimization/design/sampling_plan.h"
#include "optimization/problem/design_space.h"

namespace latsch {

/// The trajectories of a screening.
struct MorrisDesign {
  /// Each trajectory has n + 1 points; consecutive points differ in one variable.
  std::vector<std::vector<DesignPoint>> trajectories;

  /// Returns the points in the order of the trajectories, each point once.
  SamplingPlan plan() const;
};

/// Throws InputError for less than 2 trajectories or more than 10,000, for an odd number of levels
/// or one outside 2 .. 100.
MorrisDesign morris(const DesignSpace& space,
                    int trajectories,
                    std::uint64_t seed = 0,
                    int levels = 4);

/// Effects of one variable.
struct ElementaryEffects {
  double mu = 0.0, mu_star = 0.0, sigma = 0.0;  // mu, mu*, sigma, in the unit of y
  int effects = 0;                              // number of effects with two successful evaluations
};

/// Returns one entry for each variable. `values` are in the order of the trajectories' points. A
/// failed evaluation is nullopt and removes the effects computed from it.
std::vector<ElementaryEffects> elementary_effects(
    const DesignSpace& space,
    const MorrisDesign& design,
    const std::vector<std::vector<std::optional<double>>>& values);

}  // namespace latsch
