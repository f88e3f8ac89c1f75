// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/column_changes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/section_columns.h"

namespace latsch::placement {

using fe_tire::FeTire;
using fe_tire::Section;
using fe_tire::TireDescription;

namespace {

Result<Quantities> quantities(const TireDescription& description,
                              const Start& start,
                              int modes,
                              fe_tire::MeshRefinement refinement = 1) {
  FeTire tire(build_mesh(description, refinement),
              build_materials(description, refinement),
              {.element = description.element});
  const auto inflated = tire.inflate(
      description.pressure, on_grid(section_grid(description, refinement), start.grid, start.u));
  if (!inflated) return inflated.failure();
  const auto found = tire.modes(*inflated, modes);
  if (!found) return found.failure();
  Quantities values = {{"growth", inflated->growth}};
  for (const fe_tire::Mode& mode : *found) values.emplace(mode.label(), mode.frequency);
  return values;
}

Eigen::ArrayXd change(const Quantities& from, const Quantities& to) {
  Eigen::ArrayXd changed = Eigen::ArrayXd::Zero(std::ssize(from));
  Eigen::Index k = 0;
  for (const auto& [name, value] : from) {
    if (const auto found = to.find(name); found != to.end())
      changed[k] = found->second / value - 1.0;
    ++k;
  }
  return changed;
}

// ratio of the total error, of second order, to the change by halving the elements
constexpr double kLeftOfError = 4.0 / 3.0;

/// Extrapolates from meshes refined 2 and 3 times, assuming second order. A mode that one of these
/// meshes lacks has no change there.
Eigen::ArrayXd limit(const Eigen::ArrayXd& twice, const Eigen::ArrayXd& thrice) {
  constexpr double kBeyond = (1.0 / 9.0) / (1.0 / 4.0 - 1.0 / 9.0);
  return (twice == 0.0 || thrice == 0.0)
      .select(kLeftOfError * twice, thrice + kBeyond * (thrice - twice));
}

// number of modes that are computed in addition on finer meshes, because the order of neighboring
// modes may change
constexpr int kMore = 4;

}  // namespace

int nodes_across(const Section& section, Eigen::Index column) {
  const auto crown = section.crown_columns();
  const bool sidewall = crown && static_cast<double>(column) >= *crown;
  return (sidewall ? section.rows_inside + 1 : section.rows()) + 1;
}

Result<Start> inflated_start(const TireDescription& description) {
  const auto inflated = FeTire(description).inflate(description.pressure);
  if (!inflated) return inflated.failure();
  return Start{section_grid(description), inflated->u};
}

double loaded_part(const Section& section) {
  const std::vector<double> planes = section.sector_planes(1);
  double widest = 0.0;
  for (std::size_t s = 1; s < planes.size(); ++s) {
    widest = std::max(widest, planes[s] - planes[s - 1]);
  }
  constexpr double kRound = 2.0 * std::numbers::pi;
  double contact = 0.0;
  if (!section.sector_zones.empty()) {
    const fe_tire::SectorZone& narrowest = section.sector_zones.front();
    contact = 2.0 * narrowest.sectors * narrowest.width;
  }
  const double alike = kRound / section.sectors, free = (kRound - contact) / kRound;
  return std::max(1.0, std::pow(widest / alike / free, 2));
}

Eigen::ArrayXd together(const Eigen::ArrayXd& all,
                        const Eigen::ArrayXd& along,
                        const Eigen::ArrayXd& around,
                        double loaded) {
  return all.abs().max((all + (loaded - 1.0) * around).abs()).max(along.abs());
}

Result<std::vector<Judged>> judge(const std::vector<TireDescription>& meshes,
                                  const Start& start,
                                  int modes) {
  const std::vector<fe_tire::MeshRefinement> finer = {
      3, 2, {1, 2, 1}, {2, 1, 1}, 1};  // the slowest meshes first
  const auto each = std::ssize(finer);
  const auto found = at_once<Quantities>(std::ssize(meshes) * each, [&](Eigen::Index i) {
    const bool refined = i % each + 1 < each;
    return quantities(meshes[i / each], start, refined ? modes + kMore : modes, finer[i % each]);
  });
  if (!found) return found.failure();
  std::vector<Judged> judged;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const auto of_mesh = found->begin() + static_cast<std::ptrdiff_t>(m) * each;
    Judged one;
    one.tire = meshes[m];
    one.unknowns = build_mesh(one.tire).free_dofs();
    one.values = of_mesh[4];
    one.all = limit(change(one.values, of_mesh[1]), change(one.values, of_mesh[0])) / kLeftOfError;
    one.along = change(one.values, of_mesh[2]);
    one.around = change(one.values, of_mesh[3]);
    Eigen::Index worst = 0;
    one.error =
        kLeftOfError *
        together(one.all, one.along, one.around, loaded_part(one.tire.section)).maxCoeff(&worst);
    one.worst = std::next(one.values.begin(), worst)->first;
    judged.push_back(std::move(one));
  }
  return judged;
}

Result<ColumnChanges> changes(const Judged& mesh, const Start& start, int modes) {
  const std::vector<double>& columns = mesh.tire.section.columns;
  const auto count = std::ssize(columns) - 1;
  const auto finer = at_once<Quantities>(count, [&](Eigen::Index j) {
    std::vector<double> halved = columns;
    halved.insert(halved.begin() + j + 1, 0.5 * (columns[j] + columns[j + 1]));
    return quantities(with_columns(mesh.tire, std::move(halved)), start, modes + kMore);
  });
  if (!finer) return finer.failure();
  ColumnChanges found;
  found.column.resize(std::ssize(mesh.values), count);
  for (Eigen::Index j = 0; j < count; ++j) {
    found.column.col(j) = change(mesh.values, (*finer)[j]).abs();
  }
  // If neighboring columns share a bend, halving them together changes more than halving them one
  // by one; if their errors have opposite signs, it changes less. Errors that cancel on this mesh
  // may not cancel on the next, so half of the cancelled part is kept.
  const Eigen::ArrayXd sum = found.column.rowwise().sum().max(1e-12);
  found.column.colwise() *= (mesh.along.abs() / sum).max(0.5).min(2.0);
  return found;
}

}  // namespace latsch::placement
