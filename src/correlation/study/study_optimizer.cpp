// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study_optimizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "base/text.h"

namespace latsch::correlation {
namespace {

constexpr long kMostOutstanding = 1024;
constexpr long kMostRestarts = 1000;
constexpr long kMostPriority = 1000;
constexpr long kMostIndividuals = 1'000'000;

/// Reads the keys that methods share; `longest` limits the first step.
void read_lengths(const Node& node, double longest, double& initial, double& tolerance) {
  initial = node.quantity("initial_step", "1", Range{0.0, longest, true}, initial);
  tolerance = node.quantity("step_tolerance", "1", Range{0.0, longest, true}, tolerance);
}

void read_outstanding(const Node& node, int& outstanding) {
  outstanding = static_cast<int>(node.integer("outstanding", 1, kMostOutstanding, outstanding));
}

GssOptions read_gss(const Node& node, GssOptions d = {}) {
  read_lengths(node, 1.0, d.initial_step, d.step_tolerance);
  d.contraction = node.quantity("contraction", "1", Range{0.0, 1.0, true}, d.contraction);
  d.sufficient_decrease =
      node.quantity("sufficient_decrease", "1", Range::not_negative(), d.sufficient_decrease);
  read_outstanding(node, d.outstanding);
  return d;
}

ResidualTrustRegionOptions read_trust_region(const Node& node) {
  ResidualTrustRegionOptions d;
  read_lengths(node, 0.5, d.initial_radius, d.step_tolerance);
  read_outstanding(node, d.outstanding);
  d.restarts = static_cast<int>(node.integer("restarts", 0, kMostRestarts, d.restarts));
  d.seed = static_cast<std::uint64_t>(node.integer("seed", 0, kMostIndividuals, 1));
  return d;
}

LevenbergMarquardtOptions read_levenberg_marquardt(const Node& node) {
  LevenbergMarquardtOptions d;
  read_lengths(node, 1.0, d.initial_step, d.step_tolerance);
  if (node.has("progress_tolerance"))
    d.progress_tolerance = node.quantity("progress_tolerance", "1", Range{0.0, 1.0, true});
  return d;
}

SqpOptions read_sqp(const Node& node) {
  SqpOptions d;
  read_lengths(node, 0.5, d.initial_step, d.step_tolerance);
  d.difference = node.quantity("difference", "1", Range{0.0, 0.5, true}, d.difference);
  return d;
}

NelderMeadOptions read_nelder_mead(const Node& node) {
  NelderMeadOptions d;
  read_lengths(node, 0.5, d.initial_step, d.step_tolerance);
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

GssNlcOptions read_gss_nlc(const Node& node) {
  GssNlcOptions d;
  d.gss = read_gss(node, d.gss);
  d.penalty = penalty_of(node.choice("penalty", penalty_names(), name(d.penalty)));
  d.rho = node.quantity("penalty_parameter", "1", Range{0.0, d.largest_rho, true}, d.rho);
  return d;
}

OptimizerSettings read_settings(const Node& table,
                                const DesignSpace& space,
                                const ProblemTraits& traits,
                                std::string_view fallback,
                                const std::vector<std::string>& methods);

/// Reads [optimizer.member.NAME]: any optimizer but another ensemble.
MemberSettings read_member(const Node& table,
                           const DesignSpace& space,
                           const ProblemTraits& traits) {
  std::vector<std::string> methods = method_names();
  std::erase(methods, name(Method::ensemble));
  MemberSettings member;
  member.name = table.name();
  member.priority = static_cast<int>(table.integer("priority", 1, kMostPriority, 1));
  member.settings = read_settings(table, space, traits, table.text("method"), methods);
  return member;
}

void read_ensemble(const Node& table,
                   const DesignSpace& space,
                   const ProblemTraits& traits,
                   OptimizerSettings& settings) {
  for (const Node& member : table.named_tables("member")) {
    settings.members.push_back(read_member(member, space, traits));
  }
  if (settings.members.empty()) {
    table.reject("method",
                 "is \"ensemble\" without members, expected tables such as "
                 "[optimizer.member.fine] with method = \"gss\" and priority = 2");
  }
  const std::string ends = table.choice("ends_with", {"all", "first"}, "all");
  settings.ensemble_end = ends == "all" ? Ensemble::End::all : Ensemble::End::first;
}

/// Returns the keys of every method, as the functions above read them.
const std::vector<std::pair<Method, std::vector<std::string>>>& keys_of_methods() {
  static const std::vector<std::string> gss{
      "initial_step", "step_tolerance", "contraction", "sufficient_decrease", "outstanding"};
  static const auto with = [](std::vector<std::string> keys, std::vector<std::string> more) {
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
  };
  static const std::vector<std::pair<Method, std::vector<std::string>>> all{
      {Method::gss, gss},
      {Method::gss_nlc, with(gss, {"penalty", "penalty_parameter"})},
      {Method::residual_trust_region,
       {"initial_step", "step_tolerance", "outstanding", "restarts", "seed"}},
      {Method::levenberg_marquardt, {"initial_step", "step_tolerance", "progress_tolerance"}},
      {Method::sqp, {"initial_step", "step_tolerance", "difference"}},
      {Method::nelder_mead, {"initial_step", "step_tolerance"}},
      {Method::genetic, {"step_tolerance", "population", "generations", "seed"}},
      {Method::ensemble, {"member", "ends_with"}}};
  return all;
}

/// Rejects a key of another method with a message that names that method.
void reject_keys_of_others(const Node& table, Method method) {
  std::map<std::string, std::vector<std::string>> owners;
  for (const auto& [owner, keys] : keys_of_methods()) {
    for (const std::string& key : keys) owners[key].push_back(std::string(name(owner)));
  }
  for (const auto& [key, methods] : owners) {
    const bool is_own = std::find(methods.begin(), methods.end(), name(method)) != methods.end();
    if (is_own || !table.has(key)) continue;
    table.reject(key,
                 fmt::format("belongs to method = {}, the method here is \"{}\": remove it or "
                             "choose that method",
                             list_of(methods),
                             name(method)));
  }
}

OptimizerSettings read_settings(const Node& table,
                                const DesignSpace& space,
                                const ProblemTraits& traits,
                                std::string_view fallback,
                                const std::vector<std::string>& methods) {
  OptimizerSettings settings;
  settings.method = table.choice("method", methods, fallback);
  const Method method = latsch::method_of(settings, traits).method;
  reject_keys_of_others(table, method);
  switch (method) {
    case Method::gss:
      settings.gss = read_gss(table);
      break;
    case Method::residual_trust_region:
      settings.residual_trust_region = read_trust_region(table);
      break;
    case Method::levenberg_marquardt:
      settings.levenberg_marquardt = read_levenberg_marquardt(table);
      break;
    case Method::sqp:
      settings.sqp = read_sqp(table);
      break;
    case Method::gss_nlc:
      settings.gss_nlc = read_gss_nlc(table);
      break;
    case Method::nelder_mead:
      settings.nelder_mead = read_nelder_mead(table);
      break;
    case Method::genetic:
      settings.genetic = read_genetic(table);
      break;
    case Method::ensemble:
      read_ensemble(table, space, traits, settings);
      break;
  }
  try {  // lets the method report errors now, not before the first trial
    latsch::make_optimizer(method, space, settings, traits);
  } catch (const InputError& error) {
    if (!error.place().file.empty()) throw;
    throw InputError(table.place(), error.what());
  }
  return settings;
}

}  // namespace

ProblemTraits traits_of_residuals(const DesignSpace& space, bool constrained) {
  return {.variables = space.size(),
          .has_residuals = true,
          .has_linear_constraints = !space.constraints().empty(),
          .has_nonlinear_constraints = constrained};
}

OptimizerSettings read_optimizer(const Node& table, const DesignSpace& space, bool constrained) {
  return read_settings(table,
                       space,
                       traits_of_residuals(space, constrained),
                       OptimizerSettings().method,
                       method_names());
}

bool has_optimizer_keys(const Node& table) {
  if (table.has("method")) return true;
  for (const auto& [method, keys] : keys_of_methods()) {
    if (std::any_of(keys.begin(), keys.end(), [&](const auto& key) { return table.has(key); })) {
      return true;
    }
  }
  return false;
}

}  // namespace latsch::correlation
