// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/discretization.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "experiment/rigs/fe_tire/loaded_limits.h"
#include "models/fe_tire/description/section_grid.h"
#include "numerics/richardson.h"

namespace latsch {

using fe_tire::FeTire;
using fe_tire::Inflated;
using fe_tire::Mode;

namespace {

/// Adds modes under unique names: members of a pair that share a label are distinguished by their
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
                                           const Inflated& inflated,
                                           const DiscretizationSettings&,
                                           int count) {
  // number of additional modes, among which those that are lowest on the ground are found
  constexpr int kMore = 8;
  const Result<std::vector<Mode>> modes = tire.modes(inflated, count + kMore);
  if (!modes) return modes.failure();
  MeshQuantities quantities = {{"growth", inflated.growth}};
  add_modes(*modes, quantities);
  return quantities;
}

Result<MeshQuantities> loaded_quantities(FeTire& tire,
                                         const Inflated& inflated,
                                         const DiscretizationSettings& settings,
                                         int count) {
  // Presses in one step: without friction an equilibrium does not depend on the path, and
  // prescribed steps cost several times as much as those that the loading finds necessary.
  const auto pressed = tire.press(inflated, settings.ground, {settings.deflection});
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

/// Gives the modes of the other meshes the names that they have on the first mesh.
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

/// The order of neighboring modes may change from mesh to mesh, so further modes are computed on
/// other meshes.
constexpr int kMoreModes = 6;

using Measure = Result<MeshQuantities> (*)(FeTire&,
                                           const Inflated&,
                                           const DiscretizationSettings&,
                                           int);

Result<std::vector<MeshQuantities>> refine(
    const fe_tire::TireDescription& tire,
    const DiscretizationSettings& settings,
    const std::vector<fe_tire::MeshRefinement>& refinements,
    Measure measure,
    const std::string& what,
    const std::function<void(const std::string&)>& progress) {
  std::vector<MeshQuantities> meshes;
  fe_tire::SectionGrid grid;  // grid of the previous mesh, inflated: a start on the next one
  std::optional<Inflated> inflated;
  for (const fe_tire::MeshRefinement& r : refinements) {
    FeTire model(fe_tire::build_mesh(tire, r),
                 fe_tire::build_materials(tire, r),
                 {.element = settings.element});
    if (progress) {
      progress(fmt::format("{}: {} x {} x {} refined, {} elements, {} unknowns",
                           what,
                           r.around,
                           r.along,
                           r.through,
                           model.mesh().element_count(),
                           model.mesh().free_dofs()));
    }
    const int modes = meshes.empty() ? settings.modes : settings.modes + kMoreModes;
    fe_tire::SectionGrid finer = section_grid(tire, r);
    auto next = inflated ? model.inflate(settings.pressure, on_grid(finer, grid, inflated->u))
                         : model.inflate(settings.pressure);
    if (!next) return next.failure();
    grid = std::move(finer);
    inflated = *std::move(next);
    Result<MeshQuantities> quantities = measure(model, *inflated, settings, modes);
    if (!quantities) return quantities.failure();
    meshes.push_back(std::move(*quantities));
  }
  return meshes;
}

}  // namespace

MeshLimit mesh_limit(const std::array<int, 3>& refinements, const std::array<double, 3>& values) {
  const auto& [v0, v1, v2] = values;
  const numerics::Extrapolation limit = numerics::extrapolate(
      {1.0 / refinements[0], 1.0 / refinements[1], 1.0 / refinements[2]}, values);
  const double change = std::max(std::abs(v2 - v1), std::abs(v1 - v0));
  return {limit.value,
          limit.observed ? limit.order : 0.0,
          limit.observed ? 0.25 * std::abs(limit.value - v2) : 3.0 * change};
}

std::vector<DiscretizationRow> paired_rows(std::vector<MeshQuantities> meshes) {
  rename_as_first(meshes);
  std::vector<DiscretizationRow> table;
  for (const auto& [name, first] : meshes.front()) {
    DiscretizationRow row;
    row.name = name;
    row.unit = unit_of(name);
    row.converged = std::numeric_limits<double>::quiet_NaN();
    for (MeshQuantities& mesh : meshes) {
      if (const double* value = find(mesh, name)) row.values.push_back(*value);
    }
    row.paired = row.values.size() == meshes.size();
    if (!row.paired) row.values = {first};
    table.push_back(std::move(row));
  }
  return table;
}

std::vector<DiscretizationRow> discretization_rows(const std::vector<int>& refinements,
                                                   std::vector<MeshQuantities> meshes) {
  assert(meshes.size() >= 3 && meshes.size() == refinements.size());
  std::vector<DiscretizationRow> table = paired_rows(std::move(meshes));
  const std::size_t last = refinements.size() - 3;
  for (DiscretizationRow& row : table) {
    if (!row.paired) continue;
    const std::vector<double>& v = row.values;
    const MeshLimit limit =
        mesh_limit({refinements[last], refinements[last + 1], refinements[last + 2]},
                   {v[last], v[last + 1], v[last + 2]});
    row.converged = limit.value;
    row.order = limit.order;
    row.uncertainty = limit.uncertainty;
  }
  return table;
}

namespace {

std::vector<DiscretizationRow> loaded_rows(const std::vector<DiscretizationRow>& limits,
                                           const std::vector<MeshQuantities>& loaded,
                                           const std::vector<MeshQuantities>& unloaded,
                                           const FewMeshes& meshes) {
  const Missed missed(limits, paired_rows(unloaded), meshes);
  std::vector<DiscretizationRow> rows = paired_rows(loaded);
  for (DiscretizationRow& row : rows) {
    if (row.paired) missed.extrapolate(row);
  }
  return rows;
}

}  // namespace

Result<MeshMeasured> measure_mesh(const fe_tire::TireDescription& tire,
                                  const DiscretizationSettings& settings) {
  FeTire model(build_mesh(tire), fe_tire::build_materials(tire), {.element = settings.element});
  const auto inflated = model.inflate(settings.pressure);
  if (!inflated) return inflated.failure();
  MeshMeasured measured;
  for (const auto& [measure, found] : {std::pair(&unloaded_quantities, &measured.unloaded),
                                       std::pair(&loaded_quantities, &measured.loaded)}) {
    if (measure == &loaded_quantities && settings.deflection <= 0.0) continue;
    auto quantities = measure(model, *inflated, settings, settings.modes + kMoreModes);
    if (!quantities) return quantities.failure();
    *found = *std::move(quantities);
  }
  return measured;
}

Result<DiscretizationStudy> study_discretization(
    const fe_tire::TireDescription& tire,
    const DiscretizationSettings& settings,
    const std::function<void(const std::string&)>& progress) {
  const auto unloaded = refine(tire,
                               settings,
                               {settings.refinements.begin(), settings.refinements.end()},
                               unloaded_quantities,
                               "unloaded",
                               progress);
  if (!unloaded) return unloaded.failure();
  const std::vector<DiscretizationRow> limits =
      discretization_rows(settings.refinements, *unloaded);
  DiscretizationStudy study;
  study.unloaded = {
      limits.begin(),
      limits.begin() + std::min(std::ssize(limits), std::ptrdiff_t{1} + settings.modes)};
  if (settings.deflection <= 0.0) return study;
  const FewMeshes& few = settings.loaded_thoroughly ? thorough_meshes() : few_meshes();
  const auto loaded =
      refine(tire, settings, few.refinements, loaded_quantities, "loaded", progress);
  if (!loaded) return loaded.failure();
  const auto same = refine(tire, settings, few.refinements, unloaded_quantities, "unloaded", {});
  if (!same) return same.failure();
  study.loaded = loaded_rows(limits, *loaded, *same, few);
  if (settings.loaded_thoroughly) {
    study.loaded_by_few =
        loaded_rows(limits, few_of_thorough(*loaded), few_of_thorough(*same), few_meshes());
  }
  return study;
}

}  // namespace latsch
