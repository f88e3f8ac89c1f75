// SPDX-License-Identifier: Apache-2.0
#include "optimization/optimizer_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cassert>

namespace latsch {
namespace {

constexpr std::array kMethods{
    Method::gss, Method::residual_trust_region, Method::nelder_mead, Method::genetic};

constexpr double kMostFailures = 0.5;  // more, and models have nothing to stand on
constexpr int kMostPolled = 40;        // variables: a poll is that many evaluations

bool knows_linear_constraints(Method method) { return method == Method::gss; }

void check_constraints(Method method, const DesignSpace& space) {
  if (space.constraints().empty() || knows_linear_constraints(method)) return;
  std::vector<std::string_view> able;
  for (const Method other : kMethods) {
    if (knows_linear_constraints(other)) able.push_back(name(other));
  }
  const LinearConstraint& first = space.constraints().front();
  throw InputError(first.place,
                   fmt::format("linear constraint \"{}\": method {} knows bounds alone, expected "
                               "one of {}, auto",
                               first.name,
                               name(method),
                               fmt::join(able, ", ")));
}

}  // namespace

std::string_view name(Method method) {
  switch (method) {
    case Method::gss:
      return "gss";
    case Method::residual_trust_region:
      return "residual_trust_region";
    case Method::nelder_mead:
      return "nelder_mead";
    case Method::genetic:
      return "genetic";
  }
  return "";
}

std::string_view in_words(Method method) {
  switch (method) {
    case Method::gss:
      return "generating-set search";
    case Method::residual_trust_region:
      return "residual trust region";
    case Method::nelder_mead:
      return "Nelder-Mead";
    case Method::genetic:
      return "genetic algorithm";
  }
  return "";
}

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Method method : kMethods) all.emplace_back(name(method));
    all.emplace_back("auto");
    return all;
  }();
  return names;
}

MethodChoice choose_method(const ProblemTraits& traits) {
  if (traits.failed_share > kMostFailures) {
    return {Method::gss,
            fmt::format("{:.0f} % of the points failed; a search by directions needs no model of "
                        "what lies between them",
                        100.0 * traits.failed_share)};
  }
  if (traits.has_linear_constraints) {
    return {Method::gss, "there are linear constraints, along which it searches"};
  }
  if (traits.has_residuals) {
    return {Method::residual_trust_region,
            fmt::format("the target is a sum over residuals; models of each of them need the "
                        "fewest evaluations, about {} for {} variables before the first step",
                        traits.variables + 1,
                        traits.variables)};
  }
  if (traits.basins > 1) {
    return {Method::genetic,
            fmt::format("the target has no residuals and {} basins", traits.basins)};
  }
  if (traits.variables > kMostPolled) {
    return {Method::genetic,
            fmt::format("the target has no residuals and {} variables, more than directions can "
                        "poll",
                        traits.variables)};
  }
  return {Method::gss, "the target has no residuals; a search by directions bears kinks"};
}

MethodChoice method_of(const OptimizerSettings& settings, const ProblemTraits& traits) {
  if (settings.method == "auto") return choose_method(traits);
  for (const Method method : kMethods) {
    if (settings.method == name(method)) return {method, "as the study says"};
  }
  throw InputError(fmt::format("optimizer method is \"{}\", expected one of {}",
                               settings.method,
                               fmt::join(method_names(), ", ")));
}

std::unique_ptr<Optimizer> make_optimizer(Method method,
                                          const DesignSpace& space,
                                          const OptimizerSettings& settings) {
  check_constraints(method, space);
  switch (method) {
    case Method::gss:
      return std::make_unique<Gss>(space, settings.gss);
    case Method::residual_trust_region:
      return std::make_unique<ResidualTrustRegion>(space, settings.residual_trust_region);
    case Method::nelder_mead:
      return std::make_unique<NelderMead>(space, settings.nelder_mead);
    case Method::genetic:
      return std::make_unique<Genetic>(space, settings.genetic);
  }
  assert(false);
  return nullptr;
}

}  // namespace latsch
