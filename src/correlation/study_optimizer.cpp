// SPDX-License-Identifier: Apache-2.0
#include "correlation/study_optimizer.h"

#include "correlation/study.h"

namespace latsch::correlation {
namespace {

constexpr long kMostOutstanding = 1024;
constexpr long kMostRestarts = 1000;
constexpr long kMostIndividuals = 1'000'000;

GssOptions read_gss(const Node& node) {
  GssOptions d;
  const Range share{0.0, 1.0, true};
  d.initial_step = node.quantity("initial_step", "1", share, d.initial_step);
  d.step_tolerance = node.quantity("step_tolerance", "1", share, d.step_tolerance);
  d.contraction = node.quantity("contraction", "1", share, d.contraction);
  d.sufficient_decrease =
      node.quantity("sufficient_decrease", "1", Range::not_negative(), d.sufficient_decrease);
  d.outstanding = static_cast<int>(node.integer("outstanding", 1, kMostOutstanding, d.outstanding));
  return d;
}

ResidualTrustRegionOptions read_trust_region(const Node& node) {
  ResidualTrustRegionOptions d;
  d.initial_radius = node.quantity("initial_step", "1", Range{0.0, 0.5, true}, d.initial_radius);
  d.step_tolerance = node.quantity("step_tolerance", "1", Range{0.0, 0.5, true}, d.step_tolerance);
  d.outstanding = static_cast<int>(node.integer("outstanding", 1, kMostOutstanding, d.outstanding));
  d.restarts = static_cast<int>(node.integer("restarts", 0, kMostRestarts, d.restarts));
  d.seed = static_cast<std::uint64_t>(node.integer("seed", 0, kMostIndividuals, 1));
  return d;
}

NelderMeadOptions read_nelder_mead(const Node& node) {
  NelderMeadOptions d;
  const Range share{0.0, 0.5, true};
  d.initial_step = node.quantity("initial_step", "1", share, d.initial_step);
  d.step_tolerance = node.quantity("step_tolerance", "1", share, d.step_tolerance);
  return d;
}

GeneticOptions read_genetic(const Node& node) {
  GeneticOptions d;
  d.step_tolerance = node.quantity("step_tolerance", "1", Range{0.0, 1.0, true}, d.step_tolerance);
  d.population = static_cast<int>(node.integer("population", 4, kMostIndividuals, d.population));
  d.generations = static_cast<int>(node.integer("generations", 1, kMostIndividuals, d.generations));
  d.seed = static_cast<std::uint64_t>(node.integer("seed", 0, kMostIndividuals, 1));
  return d;
}

/// A study's target is made of residuals.
ProblemTraits traits(const DesignSpace& space) {
  return {.variables = space.size(),
          .has_residuals = true,
          .has_linear_constraints = !space.constraints().empty()};
}

}  // namespace

OptimizerSettings read_optimizer(const Node& table, const DesignSpace& space) {
  OptimizerSettings settings;
  settings.method = table.choice("method", method_names(), settings.method);
  // Only the keys of the method are read: one of another method is reported as unknown.
  const Method method = latsch::method_of(settings, traits(space)).method;
  switch (method) {
    case Method::gss:
      settings.gss = read_gss(table);
      break;
    case Method::residual_trust_region:
      settings.residual_trust_region = read_trust_region(table);
      break;
    case Method::nelder_mead:
      settings.nelder_mead = read_nelder_mead(table);
      break;
    case Method::genetic:
      settings.genetic = read_genetic(table);
      break;
  }
  try {  // the method itself is to complain now, not before the first trial
    latsch::make_optimizer(method, space, settings);
  } catch (const InputError& error) {
    if (!error.place().file.empty()) throw;
    throw InputError(table.place(), error.what());
  }
  return settings;
}

MethodChoice method_of(const Study& study) {
  return latsch::method_of(study.optimizer, traits(study.space));
}

std::unique_ptr<Optimizer> make_optimizer(const Study& study) {
  return latsch::make_optimizer(method_of(study).method, study.space, study.optimizer);
}

}  // namespace latsch::correlation
