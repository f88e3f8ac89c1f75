// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/optimizer_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>

namespace latsch {
namespace {

struct MethodWords {
  Method method;
  std::string_view name, words;
  bool knows_nonlinear;  // supports nonlinear constraints; all methods support linear ones
};

constexpr std::array kMethods{
    MethodWords{Method::gss, "gss", "generating-set search", false},
    MethodWords{
        Method::residual_trust_region, "residual_trust_region", "residual trust region", false},
    MethodWords{Method::levenberg_marquardt, "levenberg_marquardt", "Levenberg-Marquardt", false},
    MethodWords{Method::sqp, "sqp", "sequential quadratic programming", true},
    MethodWords{Method::gss_nlc, "gss_nlc", "generating-set search with penalties", true},
    MethodWords{Method::nelder_mead, "nelder_mead", "Nelder-Mead", false},
    MethodWords{Method::genetic, "genetic", "genetic algorithm", false},
    MethodWords{Method::ensemble, "ensemble", "ensemble", true}};  // members are checked one by one

const MethodWords& entry(Method method) {
  const auto is_it = [&](const MethodWords& words) { return words.method == method; };
  const auto found = std::find_if(kMethods.begin(), kMethods.end(), is_it);
  assert(found != kMethods.end());
  return *found;
}

constexpr double kMostFailures = 0.5;  // with more failures, models have too few samples
// F is 1 for each value in units of the noise; a step of one standard deviation in one variable
// increases it by as much. A linear model that predicts a gain of a thousandth of that is a
// thirtieth of a standard deviation from its minimum.
constexpr double kFeltByNobody = 1e-3;
constexpr int kMostPolled = 40;  // number of variables, which is the number of evaluations of a
                                 // poll

void check_constraints(Method method, const ProblemTraits& traits) {
  if (!traits.has_nonlinear_constraints || entry(method).knows_nonlinear) return;
  std::vector<std::string_view> able;
  for (const MethodWords& words : kMethods) {
    if (words.knows_nonlinear) able.push_back(words.name);
  }
  throw InputError(
      fmt::format("method {} supports no constraints that a trial reports, expected one of {}, "
                  "auto",
                  name(method),
                  fmt::join(able, ", ")));
}

}  // namespace

std::string_view name(Method method) { return entry(method).name; }
std::string_view in_words(Method method) { return entry(method).words; }

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const MethodWords& method : kMethods) all.emplace_back(method.name);
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

MethodChoice method_of(const OptimizerSettings& settings, const ProblemTraits& traits) {
  if (settings.method == "auto") return choose_method(traits);
  for (const MethodWords& method : kMethods) {
    if (settings.method != method.name) continue;
    if (method.method != Method::ensemble) return {method.method, "as the study says"};
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

namespace {

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
    members.push_back({make_optimizer(method, space, member.settings, traits), member.priority});
  }
  return std::make_unique<Ensemble>(std::move(members), settings.ensemble_end);
}

}  // namespace

std::unique_ptr<Optimizer> make_optimizer(Method method,
                                          const DesignSpace& space,
                                          const OptimizerSettings& settings,
                                          const ProblemTraits& traits) {
  check_constraints(method, traits);
  switch (method) {
    case Method::gss:
      return std::make_unique<Gss>(space, settings.gss);
    case Method::residual_trust_region: {
      ResidualTrustRegionOptions options = settings.residual_trust_region;
      options.noise_alone = traits.noise_alone;
      return std::make_unique<ResidualTrustRegion>(space, options);
    }
    case Method::levenberg_marquardt: {
      LevenbergMarquardtOptions options = settings.levenberg_marquardt;
      if (traits.values > 0) {
        const double one = 1.0 / static_cast<double>(traits.values);
        options.gain_tolerance = kFeltByNobody * one;
        if (options.progress_tolerance == 0.0) options.progress_tolerance = one;
      }
      return std::make_unique<LevenbergMarquardt>(space, options);
    }
    case Method::sqp:
      return std::make_unique<Sqp>(space, settings.sqp);
    case Method::gss_nlc:
      return std::make_unique<GssNlc>(space, settings.gss_nlc);
    case Method::nelder_mead:
      return std::make_unique<NelderMead>(space, settings.nelder_mead);
    case Method::genetic:
      return std::make_unique<Genetic>(space, settings.genetic);
    case Method::ensemble:
      return make_ensemble(space, settings, traits);
  }
  assert(false);
  return nullptr;
}

}  // namespace latsch
