// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/method_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace latsch {
namespace {

constexpr long kMostOutstanding = 1024;
constexpr long kMostRestarts = 1000;
constexpr long kMostBudget = 10'000;
constexpr long kMostIndividuals = 1'000'000;
// Share of the noise's contribution to the target below which a gain is ignored. If values are in
// units of their noise, a step of one standard deviation in one variable increases the target by 1.
// A model that predicts a gain of a thousandth of that is a thirtieth of a standard deviation away
// from its minimum.
constexpr double kFeltByNobody = 1e-3;

/// Reads the initial step and the step tolerance, which most methods have; `longest` limits the
/// first step.
void read_lengths(const Node& node, double longest, double& initial, double& tolerance) {
  initial = node.quantity("initial_step", "1", Range{0.0, longest, true}, initial);
  tolerance = node.quantity("step_tolerance", "1", Range{0.0, longest, true}, tolerance);
}

/// Reads `batch`. A text such as "workers" is refused: the steps of a search depend on this number,
/// and they must not depend on the machine.
int batch_of(const Node& node, int fallback) {
  try {
    return static_cast<int>(node.integer("batch", 1, kMostOutstanding, fallback));
  } catch (const InputError&) {
    node.reject(
        "batch",
        "is not an integer from 1 to 1024. The steps of the search depend on it, so it is a "
        "number of the study and never that of the workers of a machine; for 8 workers "
        "write batch = 8, which gives the same bits on any number of workers");
  }
}

/// Reads `batch`, or `outstanding`, which is its former name.
void read_batch(const Node& node, int& outstanding) {
  outstanding = batch_of(node, outstanding);
  if (!node.has("outstanding")) return;
  const auto former = static_cast<int>(node.integer("outstanding", 1, kMostOutstanding));
  if (node.has("batch") && former != outstanding) {
    node.reject("outstanding",
                "is the former name of batch, which states another number: remove it");
  }
  outstanding = former;
}

void read_gss(const Node& node, GssOptions& d) {
  read_lengths(node, 1.0, d.initial_step, d.step_tolerance);
  d.contraction = node.quantity("contraction", "1", Range{0.0, 1.0, true}, d.contraction);
  d.sufficient_decrease =
      node.quantity("sufficient_decrease", "1", Range::not_negative(), d.sufficient_decrease);
  read_batch(node, d.outstanding);
}

/// Reads `global` with its budget and seed.
void read_basins(const Node& node, OptimizerSettings& settings) {
  settings.by_basins = node.choice("global", {"none", "basins"}, "none") == "basins";
  if (node.has("budget") && !settings.by_basins)
    node.reject("budget", "is that of global = \"basins\", which is not asked for");
  settings.basins.budget =
      static_cast<int>(node.integer("budget", 1, kMostBudget, settings.basins.budget));
  settings.basins.seed = static_cast<std::uint64_t>(node.integer("seed", 0, kMostIndividuals, 1));
}

void read_trust_region(const Node& node, OptimizerSettings& settings) {
  read_basins(node, settings);
  ResidualTrustRegionOptions& d = settings.residual_trust_region;
  read_lengths(node, 0.5, d.initial_radius, d.step_tolerance);
  read_batch(node, d.outstanding);
  if (settings.by_basins) {
    d.restarts = 0;  // a restart leaves a minimum for another
    d.tests_end = false;
  }
  d.restarts = static_cast<int>(node.integer("restarts", 0, kMostRestarts, d.restarts));
  d.seed = static_cast<std::uint64_t>(node.integer("seed", 0, kMostIndividuals, 1));
}

void read_levenberg_marquardt(const Node& node, OptimizerSettings& settings) {
  read_basins(node, settings);
  if (node.has("seed") && !settings.by_basins)
    node.reject("seed", "selects the points of global = \"basins\", which is not asked for");
  LevenbergMarquardtOptions& d = settings.levenberg_marquardt;
  read_lengths(node, 1.0, d.initial_step, d.step_tolerance);
  if (node.has("progress_tolerance"))
    d.progress_tolerance = node.quantity("progress_tolerance", "1", Range{0.0, 1.0, true});
}

void read_sqp(const Node& node, OptimizerSettings& settings) {
  SqpOptions& d = settings.sqp;
  read_lengths(node, 0.5, d.initial_step, d.step_tolerance);
  d.difference = node.quantity("difference", "1", Range{0.0, 0.5, true}, d.difference);
}

void read_nelder_mead(const Node& node, OptimizerSettings& settings) {
  NelderMeadOptions& d = settings.nelder_mead;
  read_lengths(node, 0.5, d.initial_step, d.step_tolerance);
}

void read_genetic(const Node& node, OptimizerSettings& settings) {
  GeneticOptions& d = settings.genetic;
  d.step_tolerance = node.quantity("step_tolerance", "1", Range{0.0, 1.0, true}, d.step_tolerance);
  if (node.has("population"))
    d.population = static_cast<int>(node.integer("population", 4, kMostIndividuals));
  d.generations = static_cast<int>(node.integer("generations", 1, kMostIndividuals, d.generations));
  d.seed = static_cast<std::uint64_t>(node.integer("seed", 0, kMostIndividuals, 1));
}

void read_gss_nlc(const Node& node, OptimizerSettings& settings) {
  GssNlcOptions& d = settings.gss_nlc;
  read_gss(node, d.gss);
  d.penalty = penalty_of(node.choice("penalty", penalty_names(), name(d.penalty)));
  d.rho = node.quantity("penalty_parameter", "1", Range{0.0, d.largest_rho, true}, d.rho);
}

std::unique_ptr<Optimizer> make_trust_region(const DesignSpace& space,
                                             const OptimizerSettings& settings,
                                             const ProblemTraits& traits) {
  ResidualTrustRegionOptions options = settings.residual_trust_region;
  options.noise_alone = traits.noise_alone;
  options.square_of_data = traits.square_of_data;
  return std::make_unique<ResidualTrustRegion>(space, options);
}

std::unique_ptr<Optimizer> make_levenberg_marquardt(const DesignSpace& space,
                                                    const OptimizerSettings& settings,
                                                    const ProblemTraits& traits) {
  LevenbergMarquardtOptions options = settings.levenberg_marquardt;
  if (traits.values > 0) {
    const double one = 1.0 / static_cast<double>(traits.values);
    options.gain_tolerance = kFeltByNobody * one;
    if (options.progress_tolerance == 0.0) options.progress_tolerance = one;
  }
  return std::make_unique<LevenbergMarquardt>(space, options);
}

std::unique_ptr<Optimizer> make_ensemble(const DesignSpace& space,
                                         const OptimizerSettings& settings,
                                         const ProblemTraits& traits) {
  std::vector<EnsembleMember> members;
  for (const MemberSettings& member : settings.members) {
    const Method method = method_of(member.settings, traits).method;
    if (method == Method::ensemble) {
      throw InputError(fmt::format(
          "ensemble: member \"{}\" is an ensemble itself, expected another method", member.name));
    }
    if (member.settings.by_basins) {
      throw InputError(
          fmt::format("ensemble: member \"{}\" has global = \"basins\", whose count of basins an "
                      "ensemble does not tell; ask for it without an ensemble",
                      member.name));
    }
    members.push_back({make_optimizer(method, space, member.settings, traits), member.priority});
  }
  return std::make_unique<Ensemble>(std::move(members), settings.ensemble_end);
}

// Keys that have the same meaning in several methods.
const MethodKey kInitialStep = {"initial_step", "0.1"},
                kStepTolerance = {"step_tolerance", "0.001"}, kBatch = {"batch", "1"},
                kOutstanding = {"outstanding", "1"}, kContraction = {"contraction", "0.25"},
                kSufficientDecrease = {"sufficient_decrease", "0.01"}, kSeed = {"seed", "1"},
                kGlobal = {"global", "\"basins\""}, kBudget = {"budget", "100"};

using Space = DesignSpace;
using Settings = OptimizerSettings;
using Traits = ProblemTraits;
using Made = std::unique_ptr<Optimizer>;

MethodKind gss_kind() {
  return {Method::gss,
          "gss",
          "generating-set search",
          false,
          {kInitialStep, kStepTolerance, kContraction, kSufficientDecrease, kBatch, kOutstanding},
          [](const Node& table, Settings& settings) { read_gss(table, settings.gss); },
          [](const Space& space, const Settings& settings, const Traits&) -> Made {
            return std::make_unique<Gss>(space, settings.gss);
          }};
}

MethodKind trust_region_kind() {
  return {Method::residual_trust_region,
          "residual_trust_region",
          "residual trust region",
          false,
          {kInitialStep,
           kStepTolerance,
           kBatch,
           kOutstanding,
           kGlobal,
           kBudget,
           {"restarts",
            "4",
            "residual_trust_region: most restarts, if the error exceeds the stated noise or, if "
            "none is stated, a thousandth of the first target: to leave local minima, or if "
            "variables may be lost.",
            "4; 0 with global"},
           kSeed},
          read_trust_region,
          make_trust_region};
}

MethodKind levenberg_marquardt_kind() {
  return {Method::levenberg_marquardt,
          "levenberg_marquardt",
          "Levenberg-Marquardt",
          false,
          {{"initial_step", "0.5"},
           {"step_tolerance", "0.000001"},
           {"progress_tolerance",
            "0.001",
            "levenberg_marquardt: least gain of three steps together, as a share of the target, if "
            "the slopes predict little more.",
            "that of one measured value"},
           kGlobal,
           kBudget,
           kSeed},
          read_levenberg_marquardt,
          make_levenberg_marquardt};
}

MethodKind sqp_kind() {
  return {Method::sqp,
          "sqp",
          "sequential quadratic programming",
          true,
          {kInitialStep,
           kStepTolerance,
           {"difference", "0.0001", "sqp: step of differences, as a share of the range."}},
          read_sqp,
          [](const Space& space, const Settings& settings, const Traits&) -> Made {
            return std::make_unique<Sqp>(space, settings.sqp);
          }};
}

MethodKind gss_nlc_kind() {
  return {Method::gss_nlc,
          "gss_nlc",
          "generating-set search with penalties",
          true,
          {kInitialStep,
           kStepTolerance,
           {"contraction", "0.5"},
           kSufficientDecrease,
           kBatch,
           kOutstanding,
           {"penalty", "\"l2_squared\"", "gss_nlc: penalty of violated constraints."},
           {"penalty_parameter", "1", "gss_nlc: rho at first.", "", "above 0"}},
          read_gss_nlc,
          [](const Space& space, const Settings& settings, const Traits&) -> Made {
            return std::make_unique<GssNlc>(space, settings.gss_nlc);
          }};
}

MethodKind nelder_mead_kind() {
  return {Method::nelder_mead,
          "nelder_mead",
          "Nelder-Mead",
          false,
          {kInitialStep, kStepTolerance},
          read_nelder_mead,
          [](const Space& space, const Settings& settings, const Traits&) -> Made {
            return std::make_unique<NelderMead>(space, settings.nelder_mead);
          }};
}

MethodKind genetic_kind() {
  return {Method::genetic,
          "genetic",
          "genetic algorithm",
          false,
          {kStepTolerance,
           {"population",
            "40",
            "genetic: number of individuals.",
            "ten for each variable, at least 20"},
           {"generations", "50", "genetic: number of generations."},
           kSeed},
          read_genetic,
          [](const Space& space, const Settings& settings, const Traits&) -> Made {
            return std::make_unique<Genetic>(space, settings.genetic);
          }};
}

MethodKind ensemble_kind() {
  return {Method::ensemble,
          "ensemble",
          "ensemble",
          true,  // supports nonlinear constraints if each member does, which is checked elsewhere
          {{"member", ""}, {"ends_with", "\"all\""}},
          nullptr,
          make_ensemble};
}

}  // namespace

const std::vector<MethodKind>& method_kinds() {
  static const std::vector<MethodKind> kinds = {gss_kind(),
                                                trust_region_kind(),
                                                levenberg_marquardt_kind(),
                                                sqp_kind(),
                                                gss_nlc_kind(),
                                                nelder_mead_kind(),
                                                genetic_kind(),
                                                ensemble_kind()};
  return kinds;
}

const MethodKind& kind_of(Method method) {
  const auto is_it = [&](const MethodKind& kind) { return kind.method == method; };
  const auto found = std::find_if(method_kinds().begin(), method_kinds().end(), is_it);
  assert(found != method_kinds().end());
  return *found;
}

}  // namespace latsch
