// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study_optimizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/text.h"
#include "optimization/strategy/method_kinds.h"

namespace latsch::correlation {
namespace {

constexpr long kMostPriority = 1000;

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

/// Throws for a key that belongs to another method, with a message that names that method.
void reject_keys_of_others(const Node& table, Method method) {
  std::map<std::string, std::vector<std::string>> owners;
  for (const MethodKind& owner : method_kinds())
    for (const MethodKey& key : owner.keys) owners[key.name].emplace_back(owner.name);
  for (auto& [key, methods] : owners) {
    std::sort(methods.begin(), methods.end());
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
  if (method == Method::ensemble) {
    read_ensemble(table, space, traits, settings);
  } else {
    kind_of(method).read(table, settings);
  }
  try {  // the method reports its errors now, not before the first trial
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
  for (const MethodKind& kind : method_kinds()) {
    const auto has = [&](const MethodKey& key) { return table.has(key.name); };
    if (std::any_of(kind.keys.begin(), kind.keys.end(), has)) return true;
  }
  return false;
}

}  // namespace latsch::correlation
