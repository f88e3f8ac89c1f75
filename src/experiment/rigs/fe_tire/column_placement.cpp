// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/column_placement.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numbers>
#include <thread>
#include <utility>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/section_columns.h"

namespace latsch {

using fe_tire::FeTire;
using fe_tire::Section;
using fe_tire::TireDescription;

namespace {

/// Growth and frequencies by name.
using Quantities = std::map<std::string, double>;

Result<Quantities> quantities(const TireDescription& description,
                              int modes,
                              fe_tire::Refinement refinement = 1) {
  FeTire tire(build_mesh(description, refinement),
              build_materials(description, refinement),
              {.element = description.element});
  const auto inflated = tire.inflate(description.pressure);
  if (!inflated) return inflated.failure();
  const auto found = tire.modes(*inflated, modes);
  if (!found) return found.failure();
  Quantities values = {{"growth", inflated->growth}};
  for (const fe_tire::Mode& mode : *found) values.emplace(mode.label(), mode.frequency);
  return values;
}

/// Positions at which a column must end: where plies and rubbers end, and where the rows go over
/// into those of the sidewall. Of those nearer to each other than any column the first.
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

/// What finer meshes change in the quantities of one, relative.
struct Changes {
  std::vector<std::string> names;
  Eigen::ArrayXXd column;  // [quantities x columns], each column halved
  Eigen::ArrayXd around;   // all sectors halved
  Eigen::ArrayXd through;  // all rows halved
};

/// What halved sectors change on the ground, in parts of what they change of the unloaded tire: an
/// error of second order of the widest ones, for a mode bends most where it is free to, far from
/// the contact, and there sectors are widest.
double loaded_part(const Section& section) {
  const std::vector<double> planes = section.sector_planes(1);
  double widest = 0.0;
  for (std::size_t s = 1; s < planes.size(); ++s) {
    widest = std::max(widest, planes[s] - planes[s - 1]);
  }
  const double alike = 2.0 * std::numbers::pi / section.sectors;
  return std::max(1.0, std::pow(widest / alike, 2));
}

/// What elements halved everywhere change, the largest of the unloaded tire, on the ground and by
/// columns alone: what rows and sectors cancel of theirs on this mesh they may not on a finer one.
Eigen::ArrayXd together(const Eigen::ArrayXd& along,
                        const Eigen::ArrayXd& around,
                        const Eigen::ArrayXd& through,
                        double loaded) {
  const Eigen::ArrayXd unloaded = (along + around + through).abs();
  return unloaded.max((along + loaded * around + through).abs()).max(along.abs());
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

/// What `solve` gives for 0 to count - 1, on as many threads as the machine has.
Result<std::vector<Quantities>> at_once(
    Eigen::Index count, const std::function<Result<Quantities>(Eigen::Index)>& solve) {
  std::vector<Result<Quantities>> found(count, Failure{});
  std::atomic<Eigen::Index> next = 0;
  {
    std::vector<std::jthread> threads(std::max(1U, std::thread::hardware_concurrency()));
    for (std::jthread& thread : threads) {
      thread = std::jthread([&] {
        for (Eigen::Index i = next++; i < count; i = next++) found[i] = solve(i);
      });
    }
  }
  std::vector<Quantities> values;
  for (Result<Quantities>& one : found) {
    if (!one) return one.failure();
    values.push_back(*std::move(one));
  }
  return values;
}

Result<Changes> changes(const TireDescription& tire, int modes) {
  constexpr int kMore = 4;  // the order of neighboring modes may change
  const auto base = quantities(tire, modes);
  if (!base) return base.failure();
  Changes found;
  for (const auto& [name, value] : *base) found.names.push_back(name);
  const std::vector<double>& columns = tire.section.columns;
  const auto count = std::ssize(columns) - 1;
  const std::vector<fe_tire::Refinement> whole = {{2, 1, 1}, {1, 1, 2}, {1, 2, 1}};
  const auto finer = at_once(count + std::ssize(whole), [&](Eigen::Index j) {
    if (j >= count) return quantities(tire, modes + kMore, whole[j - count]);
    std::vector<double> halved = columns;
    halved.insert(halved.begin() + j + 1, 0.5 * (columns[j] + columns[j + 1]));
    return quantities(with_columns(tire, std::move(halved)), modes + kMore);
  });
  if (!finer) return finer.failure();
  found.column.resize(std::ssize(*base), count);
  for (Eigen::Index j = 0; j < count; ++j) found.column.col(j) = change(*base, (*finer)[j]);
  found.around = change(*base, (*finer)[count]);
  found.through = change(*base, (*finer)[count + 1]);
  // Halved together, columns change more than one by one where neighbors share a bend.
  const Eigen::ArrayXd all = change(*base, (*finer)[count + 2]);
  found.column.colwise() *= (all / found.column.rowwise().sum()).max(0.5).min(2.0);
  return found;
}

/// Columns per position, constant in each column, for which the largest change of a quantity is
/// least: at a density rho column j of length h_j leaves c_kj h_j / rho_j^2. A quantity counts by
/// a high power of what the density leaves of it, which is found by repetition; the sixth still
/// gave much to those that did not matter (race tire: 1.05 in place of 0.96 %).
std::vector<double> density(const TireDescription& tire, const Changes& changes) {
  constexpr double kPower = 20.0;
  const std::vector<double>& columns = tire.section.columns;
  const auto count = changes.column.cols();
  const auto crown = tire.section.crown_columns();
  Eigen::ArrayXd h(count), cost(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    h[j] = columns[j + 1] - columns[j];
    const bool sidewall = crown && static_cast<double>(j) >= *crown;
    cost[j] = (sidewall ? tire.section.rows_inside + 1 : tire.section.rows()) + 1.0;
  }
  const Eigen::ArrayXXd c = changes.column.rowwise() / h.cube().transpose();
  Eigen::ArrayXd rho = 1.0 / h;
  const double loaded = loaded_part(tire.section);
  for (int repeated = 0; repeated < 200; ++repeated) {
    // The same unknowns each time, or errors would not compare.
    rho *= cost.sum() / (rho * h * cost).sum();
    const Eigen::ArrayXd columns_change =
        (c.rowwise() * (h / rho.square()).transpose()).rowwise().sum();
    const Eigen::ArrayXd error = together(columns_change, changes.around, changes.through, loaded);
    const Eigen::ArrayXd weight = (error / error.maxCoeff()).pow(kPower);
    const Eigen::ArrayXd worth = (c.abs().colwise() * weight).colwise().sum().transpose() / cost;
    const Eigen::ArrayXd wanted = worth.max(1e-6 * worth.maxCoeff()).pow(1.0 / 3.0);
    rho = (rho * wanted / wanted.mean() * rho.mean()).sqrt();
  }
  // Lengths of neighbors are alike: elements are no better than their worst neighbor.
  std::vector<double> smooth(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const double before = rho[std::max<Eigen::Index>(j - 1, 0)];
    const double after = rho[std::min<Eigen::Index>(j + 1, count - 1)];
    smooth[j] = std::sqrt(rho[j] * std::sqrt(before * after));
  }
  return smooth;
}

/// The integral of the density up to each end of a column.
std::vector<double> counted(const std::vector<double>& columns, const std::vector<double>& rho) {
  std::vector<double> sum = {0.0};
  for (std::size_t j = 0; j < rho.size(); ++j) {
    sum.push_back(sum.back() + rho[j] * (columns[j + 1] - columns[j]));
  }
  return sum;
}

/// y at x of the piecewise linear y(x).
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto next = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  const auto i = next - x.begin();
  return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

/// `count` columns of that density that end at all fixed positions.
std::vector<double> placed(int count,
                           const std::vector<double>& fixed,
                           const std::vector<double>& columns,
                           const std::vector<double>& rho) {
  const std::vector<double> sum = counted(columns, rho);
  const auto segments = static_cast<int>(fixed.size()) - 1;
  std::vector<double> at, wanted;
  for (const double q : fixed) at.push_back(interpolate(columns, sum, q));
  for (int s = 0; s < segments; ++s) wanted.push_back(count * (at[s + 1] - at[s]) / sum.back());
  std::vector<int> number(segments, 1);  // then one by one where most are missing
  for (int left = count - segments; left > 0; --left) {
    const auto most = [&](int a, int b) { return wanted[a] / number[a] < wanted[b] / number[b]; };
    int best = 0;
    for (int s = 1; s < segments; ++s) best = most(best, s) ? s : best;
    ++number[best];
  }
  std::vector<double> result = {0.0};
  for (int s = 0; s < segments; ++s) {
    for (int k = 1; k < number[s]; ++k) {
      const double q = interpolate(sum, columns, at[s] + (at[s + 1] - at[s]) * k / number[s]);
      result.push_back(q);
    }
    result.push_back(fixed[s + 1]);
  }
  return result;
}

/// To what a file writes.
std::vector<double> rounded(std::vector<double> columns) {
  for (double& q : columns) q = std::round(q * 1e4) / 1e4;
  return columns;
}

}  // namespace

Result<ColumnPlacement> place_columns(const TireDescription& tire,
                                      const ColumnPlacementSettings& settings,
                                      const std::function<void(const std::string&)>& progress) {
  constexpr double kLeft = 4.0 / 3.0;  // of the first change, of an error of second order
  const int most = settings.unknowns > 0 ? settings.unknowns : build_mesh(tire).free_dofs();
  const std::vector<double> fixed = fixed_ends(tire.section);
  ColumnPlacement best;
  TireDescription now = with_columns(tire, rounded(columns_of(tire.section)));
  for (int round = 0; round <= settings.rounds; ++round) {
    const int unknowns = build_mesh(now).free_dofs();
    if (progress) {
      progress(fmt::format("round {} of {}: {} columns halved in turn",
                           round + 1,
                           settings.rounds + 1,
                           now.section.columns.size() - 1));
    }
    const auto changed = changes(now, settings.modes);
    if (!changed) return changed.failure();
    Eigen::Index worst = 0;
    const double error = kLeft * together(changed->column.rowwise().sum(),
                                          changed->around,
                                          changed->through,
                                          loaded_part(now.section))
                                     .maxCoeff(&worst);
    if (round == 0) best.error_before = error;
    if (unknowns <= most && (best.columns.empty() || error < best.error)) {
      best = {now.section.columns, unknowns, best.error_before, error, changed->names[worst]};
    }
    if (round == settings.rounds) break;
    const std::vector<double> rho = density(now, *changed), from = now.section.columns;
    const auto with = [&](int count) {
      return with_columns(tire, rounded(placed(count, fixed, from, rho)));
    };
    auto count = static_cast<int>(fixed.size()) - 1;
    now = with(count);
    if (const int least = build_mesh(now).free_dofs(); least > most) {
      return Failure{fmt::format(
          "{} columns between the ends of plies and rubbers make {} unknowns, more than the {} "
          "allowed: allow more, or take fewer sectors or rows",
          2 * count,
          least,
          most)};
    }
    for (TireDescription more = with(++count); build_mesh(more).free_dofs() <= most;) {
      now = std::move(more);
      more = with(++count);
    }
  }
  return best;
}

}  // namespace latsch
