// SPDX-License-Identifier: Apache-2.0
// Selects the optimization method: by name, or by what is known about the problem.
//
//   residual_trust_region  the target is a sum over residuals, smooth between failures, with or
//                          without linear constraints: fewest evaluations by far
//   levenberg_marquardt    the same, if trials also return the derivatives of their residuals
//   gss                    no residuals, a target with kinks, or most points fail
//   sqp                    nonlinear constraints, and residuals or a smooth target
//   gss_nlc                nonlinear constraints and no residuals
//   nelder_mead            only on request: few variables, no assumptions
//   genetic                no residuals and many local minima, or too many variables for polling
//   ensemble               only on request: several of these at once, each observing all points
//
// The first two methods search one basin after the other if the settings ask for it.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "optimization/direct_search/genetic.h"
#include "optimization/direct_search/gss.h"
#include "optimization/direct_search/gss_nlc.h"
#include "optimization/direct_search/nelder_mead.h"
#include "optimization/least_squares/levenberg_marquardt.h"
#include "optimization/sqp/sqp.h"
#include "optimization/strategy/basin_search.h"
#include "optimization/strategy/ensemble.h"
#include "optimization/trust_region/residual_trust_region.h"

namespace latsch {

/// The methods of search.
enum class Method {
  gss,
  residual_trust_region,
  levenberg_marquardt,
  sqp,
  gss_nlc,
  nelder_mead,
  genetic,
  ensemble
};

/// Returns the name used in a study, for example "gss".
std::string_view name(Method method);
/// Returns the name used in a report, for example "generating-set search".
std::string_view in_words(Method method);
/// Returns the names of all methods, and "auto".
const std::vector<std::string>& method_names();

/// The properties of a problem on which the choice of a method depends.
struct ProblemTraits {
  int variables = 1;           // their number
  bool has_residuals = false;  // the target is a sum over residuals
  /// Every outcome contains the derivatives of its residuals.
  bool has_jacobian = false;
  double failed_share = 0.0;  // share of failed points among all points evaluated so far
  /// Number of local minima found by a design of experiments.
  int basins = 1;
  bool has_linear_constraints = false;     // true if there are linear constraints on the variables
  bool has_nonlinear_constraints = false;  // true if evaluations report nonlinear constraints
  long values = 0;                         // number of measured values in a fit; 0: not known
  /// Expected sum of squares due to noise, if noise is stated.
  double noise_alone = 0.0;
  /// Sum of squares of errors that are as large as the measured values; 0: not known.
  double square_of_data = 0.0;
};

/// The chosen method, and the reason for the choice.
struct MethodChoice {
  Method method;       // the chosen method
  std::string reason;  // a full sentence
};

/// Returns the method that suits a problem with these traits.
MethodChoice choose_method(const ProblemTraits& traits);

struct MemberSettings;

/// A method and its options. Only the options of the chosen method have an effect.
struct OptimizerSettings {
  std::string method = "auto";  // "auto" or the name of a method
  /// True: the method searches from points spread over the space, each of its searches for one
  /// minimum (basin_search.h). Only methods that minimize residuals can. Restarts of the residual
  /// trust region, which leave a minimum for another, should then be 0.
  bool by_basins = false;
  BasinSearchOptions basins = {};                         // options of the search by basins
  GssOptions gss = {};                                    // options of generating-set search
  ResidualTrustRegionOptions residual_trust_region = {};  // options of residual trust region
  LevenbergMarquardtOptions levenberg_marquardt = {};     // options of Levenberg-Marquardt
  NelderMeadOptions nelder_mead = {};                     // options of Nelder-Mead
  GeneticOptions genetic = {};                            // options of genetic algorithm
  SqpOptions sqp = {};                                    // options of SQP
  GssNlcOptions gss_nlc = {};           // options of generating-set search with constraints
  std::vector<MemberSettings> members;  // members of an ensemble
  Ensemble::End ensemble_end = Ensemble::End::all;  // condition for the end of an ensemble
};

/// One member of an ensemble.
struct MemberSettings {
  std::string name;            // name of the member's method
  int priority = 1;            // weight of the member when steps are shared
  OptimizerSettings settings;  // options of the member's method, which is no ensemble
};

/// Returns the method that the settings name; if they say "auto", the one that suits the traits.
/// Throws InputError for an unknown name.
MethodChoice method_of(const OptimizerSettings& settings, const ProblemTraits& traits);

/// Creates the optimizer. Throws InputError if the traits include constraints that the method, or a
/// member of an ensemble, does not support, and for an ensemble without members or inside another
/// ensemble. `traits` also determine the method of a member whose settings say "auto".
std::unique_ptr<Optimizer> make_optimizer(Method method,
                                          const DesignSpace& space,
                                          const OptimizerSettings& settings,
                                          const ProblemTraits& traits = {});

}  // namespace latsch
