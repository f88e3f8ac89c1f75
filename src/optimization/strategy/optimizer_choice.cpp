// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/optimizer_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "optimization/strategy/method_kinds.h"

namespace latsch {
namespace {

// Share of failed points above which models have too few samples.
constexpr double kMostFailures = 0.5;
// Largest number of variables for which polling is chosen: a poll takes an evaluation for each.
constexpr int kMostPolled = 40;

void check_constraints(Method method, const ProblemTraits& traits) {
  if (!traits.has_nonlinear_constraints || kind_of(method).knows_nonlinear) return;
  std::vector<std::string_view> able;
  for (const MethodKind& kind : method_kinds()) {
    if (kind.knows_nonlinear) able.push_back(kind.name);
  }
  throw InputError(
      fmt::format("method {} supports no constraints that a trial reports, expected one of {}, "
                  "auto",
                  name(method),
                  fmt::join(able, ", ")));
}

}  // namespace

std::string_view name(Method method) { return kind_of(method).name; }
std::string_view in_words(Method method) { return kind_of(method).words; }

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const MethodKind& method : method_kinds()) all.emplace_back(method.name);
    all.emplace_back("auto");
    return all;
  }();
  return names;
}

MethodChoice choose_method(const ProblemTraits& traits) {
  const bool constrained = traits.has_linear_constraints || traits.has_nonlinear_constraints;
  const Method by_directions = traits.has_nonlinear_constraints ? Method::gss_nlc : Method::gss;
  if (traits.failed_share > kMostFailures) {
    return {by_directions,
            fmt::format("{:.0f} % of the points failed; a search by directions needs no model of "
                        "what lies between them",
                        100.0 * traits.failed_share)};
  }
  if (traits.has_nonlinear_constraints && traits.has_residuals) {
    return {Method::sqp, "the target is a sum over residuals, among nonlinear constraints"};
  }
  if (traits.has_residuals && traits.has_jacobian) {
    return {Method::levenberg_marquardt,
            "the target is a sum over residuals, and trials bring their derivatives"};
  }
  if (constrained && !traits.has_residuals) {
    return {by_directions, "there are constraints and no residuals; it searches along them"};
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
  return {Method::gss, "the target has no residuals; a search by directions tolerates kinks"};
}

namespace {

/// Adds to the reason how the method searches for several basins, if the settings ask for it.
MethodChoice with_basins(MethodChoice choice,
                         const OptimizerSettings& settings,
                         const ProblemTraits& traits) {
  if (settings.by_basins)
    choice.reason += fmt::format(
        "; it searches for one minimum after the other, from points spread over the ranges, with "
        "at "
        "most {} trials",
        settings.basins.budget * (traits.variables + 1));
  return choice;
}

}  // namespace

MethodChoice method_of(const OptimizerSettings& settings, const ProblemTraits& traits) {
  if (settings.method == "auto") return with_basins(choose_method(traits), settings, traits);
  for (const MethodKind& method : method_kinds()) {
    if (settings.method != method.name) continue;
    if (method.method != Method::ensemble)
      return with_basins({method.method, "as the study says"}, settings, traits);
    std::string members;
    for (const MemberSettings& member : settings.members) {
      members += fmt::format("{}{} ({}, priority {})",
                             members.empty() ? "" : ", ",
                             member.name,
                             in_words(method_of(member.settings, traits).method),
                             member.priority);
    }
    return {Method::ensemble, members};
  }
  throw InputError(fmt::format("optimizer method is \"{}\", expected one of {}",
                               settings.method,
                               fmt::join(method_names(), ", ")));
}

std::unique_ptr<Optimizer> make_optimizer(Method method,
                                          const DesignSpace& space,
                                          const OptimizerSettings& settings,
                                          const ProblemTraits& traits) {
  check_constraints(method, traits);
  if (!settings.by_basins) return kind_of(method).make(space, settings, traits);
  OptimizerSettings of_one = settings;
  of_one.by_basins = false;
  return std::make_unique<BasinSearch>(
      space, settings.basins, [method, of_one, traits](const DesignSpace& from) {
        return make_optimizer(method, from, of_one, traits);
      });
}

}  // namespace latsch
