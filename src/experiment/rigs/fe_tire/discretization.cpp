// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/discretization.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>

#include "numerics/richardson.h"

namespace latsch {

using fe_tire::FeTire;
using fe_tire::Inflated;
using fe_tire::Mode;

namespace {

/// Modes under names that are unique: members of a pair that share a label are told apart by their
/// rank.
void add_modes(const std::vector<Mode>& modes, MeshQuantities& quantities) {
  std::map<std::string, int> seen;
  for (const Mode& mode : modes) {
    const int rank = ++seen[mode.label()];
    const std::string name = rank == 1 ? mode.label() : fmt::format("{} #{}", mode.label(), rank);
    quantities.emplace_back(name, mode.frequency);
  }
}

Result<MeshQuantities> unloaded_quantities(FeTire& tire,
                                           const DiscretizationSettings& settings,
                                           int count) {
  const Result<Inflated> inflated = tire.inflate(settings.pressure);
  if (!inflated) return inflated.failure();
  const Result<std::vector<Mode>> modes = tire.modes(*inflated, count);
  if (!modes) return modes.failure();
  MeshQuantities quantities = {{"growth", inflated->growth}};
  add_modes(*modes, quantities);
  return quantities;
}

Result<MeshQuantities> loaded_quantities(FeTire& tire,
                                         const DiscretizationSettings& settings,
                                         int count) {
  const Result<Inflated> inflated = tire.inflate(settings.pressure);
  if (!inflated) return inflated.failure();
  // At once: without friction an equilibrium knows no way to it, and steps that are asked for cost
  // several times as much as those the loading finds necessary.
  const auto pressed = tire.press(*inflated, settings.ground, {settings.deflection});
  if (!pressed) return pressed.failure();
  const Result<std::vector<Mode>> modes = tire.modes(pressed->back(), count);
  if (!modes) return modes.failure();
  MeshQuantities quantities = {{fmt::format("Fz at {:.4g} mm", settings.deflection * 1e3),
                                tire.stand(pressed->back()).force.z()}};
  add_modes(*modes, quantities);
  return quantities;
}

std::string unit_of(const std::string& name) {
  return name == "growth" ? "m" : name.starts_with("Fz") ? "N" : "Hz";
}

double* find(MeshQuantities& mesh, const std::string& name) {
  const auto same = std::find_if(
      mesh.begin(), mesh.end(), [&name](const auto& quantity) { return quantity.first == name; });
  return same == mesh.end() ? nullptr : &same->second;
}

/// Modes of the other meshes under the names of the first one.
void rename_as_first(std::vector<MeshQuantities>& meshes) {
  constexpr double kNear = 0.025;
  for (std::size_t m = 1; m < meshes.size(); ++m) {
    for (const auto& [name, frequency] : meshes.front()) {
      if (unit_of(name) != "Hz" || find(meshes[m], name)) continue;
      std::pair<std::string, double>* nearest = nullptr;
      for (auto& other : meshes[m]) {
        if (unit_of(other.first) != "Hz" || find(meshes.front(), other.first)) continue;
        const double distance = std::abs(other.second - frequency);
        if (!nearest || distance < std::abs(nearest->second - frequency)) nearest = &other;
      }
      if (nearest && std::abs(nearest->second - frequency) < kNear * frequency) {
        nearest->first = name;
      }
    }
  }
}

using Measure = Result<MeshQuantities> (*)(FeTire&, const DiscretizationSettings&, int);

struct Study {
  const fe_tire::TireDescription& tire;
  const DiscretizationSettings& settings;
  const std::function<void(const std::string&)>& progress;

  Result<MeshQuantities> on(const fe_tire::Refinement& refinement,
                            const std::string& mesh,
                            Measure measure,
                            bool first) const {
    FeTire model(fe_tire::build_mesh(tire, refinement),
                 fe_tire::build_materials(tire, refinement),
                 {.element = settings.element});
    if (progress)
      progress(fmt::format("{}, {} elements, {} unknowns",
                           mesh,
                           model.mesh().element_count(),
                           model.mesh().free_dofs()));
    // The order of neighboring modes may change from mesh to mesh: look a little further on the
    // finer ones.
    return measure(model, settings, first ? settings.modes : settings.modes + 6);
  }
};

}  // namespace

std::vector<DiscretizationRow> discretization_rows(const std::vector<int>& refinements,
                                                   std::vector<MeshQuantities> meshes) {
  assert(meshes.size() >= 3 && meshes.size() == refinements.size());
  rename_as_first(meshes);
  std::vector<DiscretizationRow> table;
  for (const auto& [name, first] : meshes.front()) {
    DiscretizationRow row;
    row.name = name;
    row.unit = unit_of(name);
    for (MeshQuantities& mesh : meshes) {
      if (const double* value = find(mesh, name)) row.values.push_back(*value);
    }
    if (row.values.size() != meshes.size()) {
      row.values = {first};
      row.converged = std::numeric_limits<double>::quiet_NaN();
      row.paired = false;
      table.push_back(std::move(row));
      continue;
    }
    const std::size_t last = meshes.size() - 3;
    std::array<double, 3> h, v;
    for (std::size_t i = 0; i < 3; ++i) {
      h[i] = 1.0 / refinements[last + i];
      v[i] = row.values[last + i];
    }
    const numerics::Extrapolation limit = numerics::extrapolate(h, v);
    row.converged = limit.value;
    row.order = limit.observed ? limit.order : 0.0;
    const double beyond = std::abs(limit.value - v[2]);
    const double change = std::max(std::abs(v[2] - v[1]), std::abs(v[1] - v[0]));
    row.uncertainty = limit.observed ? 0.25 * beyond : 3.0 * change;
    table.push_back(std::move(row));
  }
  return table;
}

std::vector<DiscretizationRow> sum_of_directions(const std::vector<DiscretizationRow>& one,
                                                 const std::vector<DiscretizationRow>& other) {
  assert(one.size() == other.size());
  std::vector<DiscretizationRow> table = one;
  for (std::size_t i = 0; i < one.size(); ++i) {
    DiscretizationRow& row = table[i];
    const DiscretizationRow& second = other[i];
    assert(row.name == second.name && row.values.front() == second.values.front());
    const double first = row.values.front();
    if (!row.paired || !second.paired) {
      row = {.name = row.name,
             .unit = row.unit,
             .values = {first},
             .converged = std::numeric_limits<double>::quiet_NaN(),
             .paired = false};
      continue;
    }
    if (std::abs(second.converged - first) > std::abs(row.converged - first))
      row.order = second.order;
    row.values.insert(row.values.end(), second.values.begin() + 1, second.values.end());
    row.converged += second.converged - first;
    row.uncertainty += second.uncertainty;
  }
  return table;
}

namespace {

std::string times(int refinement, const char* direction = "") {
  return fmt::format("{} x{}", refinement, refinement == 1 ? "" : direction);
}

Result<bool> study_unloaded(const Study& of, DiscretizationStudy& study) {
  std::vector<MeshQuantities> meshes;
  for (const int r : of.settings.refinements) {
    study.unloaded_meshes.push_back(times(r));
    auto quantities =
        of.on(r, "unloaded: " + times(r) + " refined", unloaded_quantities, meshes.empty());
    if (!quantities) return quantities.failure();
    meshes.push_back(std::move(*quantities));
  }
  study.unloaded = discretization_rows(of.settings.refinements, std::move(meshes));
  return true;
}

Result<bool> study_loaded(const Study& of, DiscretizationStudy& study) {
  const std::vector<int>& refinements = of.settings.loaded_refinements;
  assert(refinements.front() == 1);
  auto first = of.on(1, "on the ground: as it is", loaded_quantities, true);
  if (!first) return first.failure();
  study.loaded_meshes = {times(1)};
  std::vector<std::vector<DiscretizationRow>> directions;
  for (const char* direction : {" around", " in the section"}) {
    std::vector<MeshQuantities> meshes = {*first};
    for (auto r = refinements.begin() + 1; r != refinements.end(); ++r) {
      study.loaded_meshes.push_back(times(*r, direction));
      const fe_tire::Refinement refinement =
          directions.empty() ? fe_tire::Refinement(*r, 1, 1) : fe_tire::Refinement(1, *r, *r);
      auto quantities =
          of.on(refinement, "on the ground: " + times(*r, direction), loaded_quantities, false);
      if (!quantities) return quantities.failure();
      meshes.push_back(std::move(*quantities));
    }
    directions.push_back(discretization_rows(refinements, std::move(meshes)));
  }
  study.loaded = sum_of_directions(directions[0], directions[1]);
  return true;
}

}  // namespace

Result<DiscretizationStudy> study_discretization(
    const fe_tire::TireDescription& tire,
    const DiscretizationSettings& settings,
    const std::function<void(const std::string&)>& progress) {
  const Study of{tire, settings, progress};
  DiscretizationStudy study;
  if (const auto done = study_unloaded(of, study); !done) return done.failure();
  if (settings.deflection <= 0.0) return study;
  if (const auto done = study_loaded(of, study); !done) return done.failure();
  return study;
}

}  // namespace latsch
