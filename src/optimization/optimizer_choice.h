// SPDX-License-Identifier: Apache-2.0
// Which method minimizes: by name, or chosen from what is known of the problem.
//
//   residual_trust_region  the target is a sum over residuals, smooth between failures: fewest
//                          evaluations by far
//   gss                    no residuals, kinks, or most points fail; linear constraints
//   nelder_mead            on request: a few variables, nothing assumed
//   genetic                no residuals and many basins, or more variables than a pattern can poll
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "optimization/genetic.h"
#include "optimization/gss.h"
#include "optimization/nelder_mead.h"
#include "optimization/residual_trust_region.h"

namespace latsch {

enum class Method { gss, residual_trust_region, nelder_mead, genetic };

/// As in a study: "gss" ...
std::string_view name(Method method);
/// As in a report: "generating-set search" ...
std::string_view in_words(Method method);
/// The names of all methods, and "auto".
const std::vector<std::string>& method_names();

/// What a choice can go by.
struct ProblemTraits {
  int variables = 1;
  bool has_residuals = false;
  double failed_share = 0.0;  // of the points evaluated so far
  int basins = 1;             // found by a design of experiments
  bool has_linear_constraints = false;
};

struct MethodChoice {
  Method method;
  std::string reason;  // a sentence for a person
};

MethodChoice choose_method(const ProblemTraits& traits);

struct OptimizerSettings {
  std::string method = "gss";  // one of method_names()
  GssOptions gss;
  ResidualTrustRegionOptions residual_trust_region;
  NelderMeadOptions nelder_mead;
  GeneticOptions genetic;
};

/// The method of the settings; of "auto", the one chosen. Throws InputError for a name that is
/// none.
MethodChoice method_of(const OptimizerSettings& settings, const ProblemTraits& traits);

/// Throws InputError where the space has linear constraints and the method knows only bounds.
std::unique_ptr<Optimizer> make_optimizer(Method method,
                                          const DesignSpace& space,
                                          const OptimizerSettings& settings);

}  // namespace latsch
