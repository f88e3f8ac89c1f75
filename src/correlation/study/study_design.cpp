// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study_design.h"

#include <fmt/format.h>

#include <cassert>
#include <limits>

#include "optimization/design/full_factorial.h"
#include "optimization/design/latin_hypercube.h"
#include "optimization/design/sobol.h"
#include "optimization/surrogate/variance_shares.h"

namespace latsch::correlation {
namespace {

constexpr long kMostFactorialLevels = 1000;
constexpr long kMostDesignPoints = 100'000;
constexpr int kFewestTrajectories = 2;  // sigma needs at least two trajectories

struct NamedDesign {
  DesignKind kind;
  const char* key;
  const char* name;
};
constexpr NamedDesign kDesigns[] = {
    {DesignKind::full_factorial, "full_factorial", "full factorial grid"},
    {DesignKind::latin_hypercube, "latin_hypercube", "maximin Latin hypercube"},
    {DesignKind::sobol, "sobol", "Sobol sequence"},
    {DesignKind::morris, "morris", "Morris trajectories"},
};

DesignKind read_kind(const Node& doe) {
  std::vector<std::string> keys;
  for (const NamedDesign& design : kDesigns) keys.emplace_back(design.key);
  const std::string key = doe.choice("design", keys, keys.front());
  DesignKind kind = DesignKind::full_factorial;
  for (const NamedDesign& design : kDesigns) {
    if (key == design.key) kind = design.kind;
  }
  return kind;
}

std::vector<int> read_levels(const Node& doe, const DesignSpace& space) {
  const int all = static_cast<int>(doe.integer("levels", 1, kMostFactorialLevels));
  std::vector<int> levels(space.size(), all);
  if (const auto table = doe.find_table("levels_of")) {
    for (int i = 0; i < space.size(); ++i) {
      levels[i] = static_cast<int>(table->integer(space[i].name, 1, kMostFactorialLevels, all));
    }
  }
  return levels;
}

void reject_keys_of_another(const Node& doe, const std::vector<const char*>& keys) {
  for (const char* key : keys) {
    if (!doe.has(key)) continue;
    doe.reject(key,
               std::string("does not belong to this design") +
                   (doe.has("design") ? "" : ", a full factorial because no design is stated") +
                   "; design = \"full_factorial\" has levels, "
                   "the others have points and seed, and \"latin_hypercube\" and \"sobol\" may "
                   "have effects");
  }
}

long most_points(DesignKind kind) {
  if (kind == DesignKind::latin_hypercube) return kMostLatinHypercubePoints;
  return kMostDesignPoints;
}

int trajectories(const StudyDesign& design, const DesignSpace& space) {
  return design.points / (space.size() + 1);
}

}  // namespace

std::string StudyDesign::name() const {
  for (const NamedDesign& design : kDesigns) {
    if (kind == design.kind) return design.name;
  }
  assert(false);
  return "";
}

StudyDesign read_design(const Node& doe, const DesignSpace& space) {
  StudyDesign design;
  design.kind = read_kind(doe);
  if (design.kind == DesignKind::full_factorial) {
    reject_keys_of_another(doe, {"points", "seed", "effects"});
    design.levels = read_levels(doe, space);
    return design;
  }
  reject_keys_of_another(doe, {"levels", "levels_of"});
  design.points = static_cast<int>(doe.integer("points", 2, most_points(design.kind)));
  design.seed = doe.integer("seed", 0, std::numeric_limits<int>::max(), 0);
  if (design.kind == DesignKind::sobol && space.size() > kMostSobolVariables) {
    doe.reject("design",
               fmt::format("is \"sobol\" with {} variables, expected at most {}; "
                           "\"latin_hypercube\" has no such limit",
                           space.size(),
                           kMostSobolVariables));
  }
  if (doe.has("effects")) {
    doe.choice("effects", {"sobol"});
    if (design.kind == DesignKind::morris)
      doe.reject("effects",
                 "is \"sobol\" beside design = \"morris\", which has effects of its own; expected "
                 "design = \"latin_hypercube\" or \"sobol\"");
    if (design.points < kFewestPointsOfShares)
      doe.reject(
          "points",
          fmt::format("is {}, expected at least {} beside effects = \"sobol\"; about ten for "
                      "each variable that matters",
                      design.points,
                      kFewestPointsOfShares));
    design.asks_shares = true;
  }
  if (design.kind == DesignKind::morris && trajectories(design, space) < kFewestTrajectories) {
    doe.reject("points",
               fmt::format("is {}, expected at least {}: {} trajectories of {} points each",
                           design.points,
                           kFewestTrajectories * (space.size() + 1),
                           kFewestTrajectories,
                           space.size() + 1));
  }
  return design;
}

SamplingPlan plan(const StudyDesign& design, const DesignSpace& space) {
  switch (design.kind) {
    case DesignKind::full_factorial:
      return full_factorial(space, design.levels);
    case DesignKind::latin_hypercube:
      return latin_hypercube(space, design.points, design.seed);
    case DesignKind::sobol:
      return sobol(space, design.points, design.seed);
    case DesignKind::morris:
      return morris_design(design, space).plan();
  }
  assert(false);
  return {};
}

MorrisDesign morris_design(const StudyDesign& design, const DesignSpace& space) {
  return morris(space, trajectories(design, space), design.seed);
}

}  // namespace latsch::correlation
