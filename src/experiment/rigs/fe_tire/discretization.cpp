// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/discretization.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "models/fe_tire/description/section_grid.h"
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
                                           const Inflated& inflated,
                                           const DiscretizationSettings&,
                                           int count) {
  const Result<std::vector<Mode>> modes = tire.modes(inflated, count);
  if (!modes) return modes.failure();
  MeshQuantities quantities = {{"growth", inflated.growth}};
  add_modes(*modes, quantities);
  return quantities;
}

Result<MeshQuantities> loaded_quantities(FeTire& tire,
                                         const Inflated& inflated,
                                         const DiscretizationSettings& settings,
                                         int count) {
  // At once: without friction an equilibrium knows no way to it, and steps that are asked for cost
  // several times as much as those the loading finds necessary.
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

using Measure = Result<MeshQuantities> (*)(FeTire&,
                                           const Inflated&,
                                           const DiscretizationSettings&,
                                           int);

Result<std::vector<MeshQuantities>> refine(
    const fe_tire::TireDescription& tire,
    const DiscretizationSettings& settings,
    const std::vector<fe_tire::Refinement>& refinements,
    Measure measure,
    const std::string& what,
    const std::function<void(const std::string&)>& progress) {
  std::vector<MeshQuantities> meshes;
  fe_tire::SectionGrid grid;  // of the mesh before, inflated: a start on the next one
  std::optional<Inflated> inflated;
  for (const fe_tire::Refinement& r : refinements) {
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
    // The order of neighboring modes may change from mesh to mesh: look a little further on the
    // finer ones.
    const int modes = meshes.empty() ? settings.modes : settings.modes + 6;
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

/// The limit of the last three meshes, and how far it may be off.
void extrapolate(const std::vector<int>& refinements, DiscretizationRow& row) {
  const std::size_t last = row.values.size() - 3;
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
}

/// Of an order p, refined r times: 1 / (r^p - 1) of the way from the unrefined mesh is left.
double remainder_of(double order, int refinement) {
  return 1.0 / (std::pow(refinement, order) - 1.0);
}

/// The limit of the unrefined and another mesh.
void extrapolate(int refinement, const Remainder& left, DiscretizationRow& row) {
  const double way = row.values[1] - row.values[0];
  row.converged = row.values[1] + left.part * way;
  row.order = left.observed ? std::log1p(1.0 / left.part) / std::log(refinement) : 0.0;
  const double order = std::abs(way) * std::max(remainder_of(1.0, refinement) - left.part,
                                                left.part - remainder_of(2.0, refinement));
  row.uncertainty = std::max(order, left.part * left.apart_of(row.name) * std::abs(row.converged));
}

/// By label: of the mesh, of its sectors and columns halved, then its rows too.
std::map<std::string, double> changes_apart(std::vector<MeshQuantities> meshes) {
  std::map<std::string, double> apart;
  for (const DiscretizationRow& row : discretization_rows({1, 2, 4}, std::move(meshes))) {
    if (row.unit != "Hz" || !row.paired) continue;
    const std::vector<double>& v = row.values;
    apart[row.name] = (std::abs(v[1] - v[0]) + std::abs(v[2] - v[1])) / v[0];
  }
  return apart;
}

}  // namespace

double Remainder::apart_of(const std::string& row) const {
  std::string label = row.substr(0, row.find(" #"));
  if (label.ends_with(" s") || label.ends_with(" a")) label.resize(label.size() - 2);
  if (const auto found = apart.find(label); found != apart.end()) return found->second;
  double squares = 0.0;
  for (const auto& [name, changed] : apart) squares += changed * changed;
  return apart.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(apart.size()));
}

std::vector<DiscretizationRow> discretization_rows(const std::vector<int>& refinements,
                                                   std::vector<MeshQuantities> meshes,
                                                   const Remainder& left) {
  assert(meshes.size() >= 2 && meshes.size() == refinements.size());
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
    if (meshes.size() == 2) {
      extrapolate(refinements[1], left, row);
    } else {
      extrapolate(refinements, row);
    }
    table.push_back(std::move(row));
  }
  return table;
}

Remainder remainder(const std::vector<int>& refinements,
                    const std::vector<DiscretizationRow>& rows,
                    int refinement) {
  const auto at = std::ranges::find(refinements, refinement) - refinements.begin();
  double left = 0.0, of = 0.0;
  for (const DiscretizationRow& row : rows) {
    if (row.unit != "Hz" || !row.asymptotic() || at == std::ssize(refinements)) continue;
    const double way = (row.values[at] - row.values[0]) / row.converged;
    left += way * (row.converged - row.values[at]) / row.converged;
    of += way * way;
  }
  const double first = remainder_of(1.0, refinement), second = remainder_of(2.0, refinement);
  if (of == 0.0) return {second, false};
  return {std::clamp(left / of, second, first), true};
}

namespace {

/// Of the loaded ring on four meshes: 1, (2, 2, 1), (4, 4, 1) and (2, 2, 2).
std::vector<DiscretizationRow> thorough_rows(std::vector<MeshQuantities> meshes) {
  constexpr double kLeft = 4.0 / 3.0;  // of the first change, of an error of second order
  std::vector<DiscretizationRow> rows =
      discretization_rows({1, 2, 4}, {meshes.begin(), meshes.end() - 1});
  rename_as_first(meshes);
  for (DiscretizationRow& row : rows) {
    const double* through = find(meshes.back(), row.name);
    if (!row.paired || !through) {
      row.paired = false;
      row.values.resize(1);
      continue;
    }
    row.converged += kLeft * (*through - row.values[1]);
  }
  return rows;
}

}  // namespace

Result<DiscretizationStudy> study_discretization(
    const fe_tire::TireDescription& tire,
    const DiscretizationSettings& settings,
    const std::function<void(const std::string&)>& progress) {
  DiscretizationStudy study;
  auto unloaded = refine(tire,
                         settings,
                         {settings.refinements.begin(), settings.refinements.end()},
                         unloaded_quantities,
                         "unloaded",
                         progress);
  if (!unloaded) return unloaded.failure();
  study.unloaded = discretization_rows(settings.refinements, *unloaded);
  if (settings.deflection <= 0.0) return study;
  using Meshes = std::vector<fe_tire::Refinement>;
  const Meshes meshes =
      settings.loaded_thoroughly ? Meshes{1, {2, 2, 1}, {4, 4, 1}, {2, 2, 2}} : Meshes{1, 2};
  auto loaded = refine(tire, settings, meshes, loaded_quantities, "loaded", progress);
  if (!loaded) return loaded.failure();
  if (settings.loaded_thoroughly) {
    study.loaded = thorough_rows(std::move(*loaded));
    return study;
  }
  auto halves = refine(tire, settings, {1, {2, 2, 1}, 2}, unloaded_quantities, "unloaded", {});
  if (!halves) return halves.failure();
  Remainder left = remainder(settings.refinements, study.unloaded, 2);
  left.apart = changes_apart(std::move(*halves));
  study.loaded = discretization_rows({1, 2}, std::move(*loaded), left);
  return study;
}

}  // namespace latsch
