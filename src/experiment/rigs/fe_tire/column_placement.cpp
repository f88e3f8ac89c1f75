// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/column_placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiment/rigs/fe_tire/column_changes.h"
#include "experiment/rigs/fe_tire/column_exchange.h"
#include "experiment/rigs/fe_tire/expected_columns.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/section_columns.h"

namespace latsch {

using fe_tire::Section;
using fe_tire::TireDescription;
using placement::ColumnChanges;
using placement::Judged;

namespace {

/// Positions at which a column must end: the ends of plies and rubbers, and the transition of the
/// rows into those of the sidewall. Of positions closer than the shortest column the first is kept.
std::vector<double> fixed_ends(const Section& section) {
  constexpr double kNearest = 0.008;
  std::vector<double> ends = section.ends;
  if (!section.faces.empty() && section.faces_to < 1.0) {
    ends.push_back(section.faces_to + Section::kFaceTransition);
  }
  std::ranges::sort(ends);
  std::vector<double> fixed = {0.0};
  for (const double end : ends) {
    if (end > fixed.back() + kNearest && end < 1.0 - kNearest) fixed.push_back(end);
  }
  fixed.push_back(1.0);
  return fixed;
}

/// Returns the integral of the density from the start to each end of a column.
std::vector<double> counted(const std::vector<double>& columns, const std::vector<double>& rho) {
  std::vector<double> sum = {0.0};
  for (std::size_t j = 0; j < rho.size(); ++j) {
    sum.push_back(sum.back() + rho[j] * (columns[j + 1] - columns[j]));
  }
  return sum;
}

/// Returns the value at x of the piecewise linear function through the points (x, y).
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto next = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  const auto i = next - x.begin();
  return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

/// Returns the ends of columns with the given density, `number` of them between each two fixed
/// positions.
std::vector<double> placed(const std::vector<int>& number,
                           const std::vector<double>& fixed,
                           const std::vector<double>& columns,
                           const std::vector<double>& rho) {
  const std::vector<double> sum = counted(columns, rho);
  std::vector<double> result = {0.0};
  for (std::size_t s = 0; s < number.size(); ++s) {
    const double from = interpolate(columns, sum, fixed[s]);
    const double to = interpolate(columns, sum, fixed[s + 1]);
    for (int k = 1; k < number[s]; ++k) {
      result.push_back(interpolate(sum, columns, from + (to - from) * k / number[s]));
    }
    result.push_back(fixed[s + 1]);
  }
  return result;
}

/// Rounds positions to the number of digits that a file contains.
std::vector<double> rounded(std::vector<double> columns) {
  for (double& q : columns) q = std::round(q * 1e4) / 1e4;
  return columns;
}

/// Returns meshes with a smaller expected error: one with the best number of sectors and, if that
/// number is free, some with a few more and fewer sectors.
Result<std::vector<TireDescription>> moved(const Judged& now,
                                           const ColumnChanges& changes,
                                           const std::vector<double>& fixed,
                                           int most,
                                           bool choose_sectors) {
  const std::vector<double>& columns = now.tire.section.columns;
  std::vector<int> wanted = {now.tire.section.sectors};
  if (choose_sectors) {
    const int best = placement::best_sectors(now, changes, fixed, most);
    wanted = {best - 2, best, best + 2};
  }
  std::vector<TireDescription> meshes;
  std::string too_many;
  for (const int sectors : wanted) {
    const placement::Way found = placement::way(now, changes, fixed, sectors, most);
    TireDescription mesh = now.tire;
    mesh.section.sectors = sectors;
    mesh = with_columns(std::move(mesh), rounded(placed(found.number, fixed, columns, found.rho)));
    if (const int least = build_mesh(mesh).free_dofs(); least > most) {
      too_many = fmt::format(
          "{} columns between the ends of plies and rubbers make {} unknowns, more than the {} "
          "allowed: allow more, or take fewer sectors or rows",
          2 * (mesh.section.columns.size() - 1),
          least,
          most);
      continue;
    }
    meshes.push_back(std::move(mesh));
  }
  if (meshes.empty()) return Failure{too_many};
  return meshes;
}

/// Moves the columns according to the errors of `now` and estimates the errors of the new mesh.
Result<std::vector<Judged>> next_round(const Judged& now,
                                       const placement::Start& start,
                                       int modes,
                                       const std::vector<double>& fixed,
                                       int most,
                                       bool choose_sectors) {
  const auto changed = placement::changes(now, start, modes);
  if (!changed) return changed.failure();
  auto meshes = moved(now, *changed, fixed, most, choose_sectors);
  if (!meshes) return meshes.failure();
  return placement::judge(*meshes, start, modes);
}

/// Fails if the tire cannot be pressed to this deflection, so that no minutes of computing are
/// spent on it.
Status check_stands(const TireDescription& tire, double deflection) {
  fe_tire::FeTire pressed(tire);
  const auto inflated = pressed.inflate(tire.pressure);
  if (!inflated) return inflated.failure();
  const auto states = pressed.press(*inflated, {}, {deflection});
  if (!states) return states.failure();
  return {};
}

}  // namespace

Result<ColumnPlacement> place_columns(const TireDescription& tire,
                                      const ColumnPlacementSettings& settings,
                                      const std::function<void(const std::string&)>& progress) {
  // number of modes computed in addition, because others may be among the lowest on the ground
  constexpr int kMoreLoaded = 2;
  const int modes = settings.modes + kMoreLoaded;
  const int most = settings.unknowns > 0 ? settings.unknowns : build_mesh(tire).free_dofs();
  const std::vector<double> fixed = fixed_ends(tire.section);
  const TireDescription first = with_columns(tire, rounded(columns_of(tire.section)));
  if (settings.deflection > 0.0) {
    if (const Status done = check_stands(first, settings.deflection); !done) return done.failure();
  }
  const auto start = placement::inflated_start(first);
  if (!start) return start.failure();
  auto judged = placement::judge({first}, *start, modes);
  if (!judged) return judged.failure();
  ColumnPlacement best;
  best.error_before = judged->front().error;
  for (int round = 0;; ++round) {
    for (const Judged& mesh : *judged) {
      if (mesh.unknowns > most || (!best.columns.empty() && mesh.error >= best.error)) continue;
      best = {mesh.tire.section.columns,
              mesh.tire.section.sectors,
              mesh.unknowns,
              best.error_before,
              mesh.error,
              mesh.worst,
              {}};
    }
    if (round == settings.rounds) break;
    const Judged& now = *std::ranges::min_element(*judged, {}, &Judged::error);
    if (progress) {
      progress(fmt::format("round {} of {}: {} columns halved in turn",
                           round + 1,
                           settings.rounds,
                           now.tire.section.columns.size() - 1));
    }
    auto next = next_round(now, *start, modes, fixed, most, settings.choose_sectors);
    if (!next) {
      if (best.columns.empty()) return next.failure();
      best.stopped = fmt::format(
          "round {} of {} was not finished: {}", round + 1, settings.rounds, next.failure().reason);
      break;
    }
    judged = std::move(next);
  }
  if (settings.deflection <= 0.0) return best;
  TireDescription placed = with_columns(tire, best.columns);
  placed.section.sectors = best.sectors;
  ColumnPlacementSettings on_ground = settings;
  on_ground.unknowns = most;
  auto exchanged = placement::exchange_columns(placed, on_ground, fixed, progress);
  if (exchanged) {
    if (exchanged->stopped.empty()) exchanged->stopped = best.stopped;
    return exchanged;
  }
  best.stopped = "columns were not exchanged on the ground: " + exchanged.failure().reason;
  return best;
}

}  // namespace latsch
