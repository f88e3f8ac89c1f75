// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/column_placement.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <thread>
#include <utility>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/section_columns.h"
#include "models/fe_tire/description/section_grid.h"

namespace latsch {

using fe_tire::FeTire;
using fe_tire::Section;
using fe_tire::TireDescription;

namespace {

/// Growth and frequencies by name.
using Quantities = std::map<std::string, double>;

/// The tire inflated, on one mesh: a start on all others.
struct Start {
  fe_tire::SectionGrid grid;
  Eigen::Matrix3Xd u;
};

Result<Start> inflated_start(const TireDescription& description) {
  const auto inflated = FeTire(description).inflate(description.pressure);
  if (!inflated) return inflated.failure();
  return Start{section_grid(description), inflated->u};
}

Result<Quantities> quantities(const TireDescription& description,
                              const Start& start,
                              int modes,
                              fe_tire::Refinement refinement = 1) {
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

/// A mesh and what finer ones change in its quantities, relative.
struct Judged {
  TireDescription tire;
  int unknowns = 0;
  Quantities values;
  Eigen::ArrayXd along;   // all columns halved
  Eigen::ArrayXd around;  // all sectors halved
  Eigen::ArrayXd all;     // all elements halved in all three directions
  double error = 0.0;     // of the quantity that errs most
  std::string worst;      // its name
};

/// What columns of it do, relative.
struct ColumnChanges {
  Eigen::ArrayXXd column;  // [quantities x columns], each halved: magnitudes that make up all
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
/// columns alone.
Eigen::ArrayXd together(const Eigen::ArrayXd& all,
                        const Eigen::ArrayXd& along,
                        const Eigen::ArrayXd& around,
                        double loaded) {
  return all.abs().max((all + (loaded - 1.0) * around).abs()).max(along.abs());
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

constexpr int kMore = 4;  // modes of finer meshes: the order of neighboring ones may change

/// Each of the meshes on finer ones.
Result<std::vector<Judged>> judge(const std::vector<TireDescription>& meshes,
                                  const Start& start,
                                  int modes) {
  constexpr double kLeft = 4.0 / 3.0;  // of the first change, of an error of second order
  const std::vector<fe_tire::Refinement> finer = {2, {1, 2, 1}, {2, 1, 1}, 1};  // the longest first
  const auto each = std::ssize(finer);
  const auto found = at_once(std::ssize(meshes) * each, [&](Eigen::Index i) {
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
    one.values = of_mesh[3];
    one.all = change(one.values, of_mesh[0]);
    one.along = change(one.values, of_mesh[1]);
    one.around = change(one.values, of_mesh[2]);
    Eigen::Index worst = 0;
    one.error =
        kLeft *
        together(one.all, one.along, one.around, loaded_part(one.tire.section)).maxCoeff(&worst);
    one.worst = std::next(one.values.begin(), worst)->first;
    judged.push_back(std::move(one));
  }
  return judged;
}

Result<ColumnChanges> changes(const Judged& mesh, const Start& start, int modes) {
  const std::vector<double>& columns = mesh.tire.section.columns;
  const auto count = std::ssize(columns) - 1;
  const auto finer = at_once(count, [&](Eigen::Index j) {
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
  // Halved together, columns change more than one by one where neighbors share a bend, and less
  // where some err to either side. What cancels on this mesh may not on the next: half of it stays.
  const Eigen::ArrayXd sum = found.column.rowwise().sum().max(1e-12);
  found.column.colwise() *= (mesh.along.abs() / sum).max(0.5).min(2.0);
  return found;
}

/// Columns per position, constant in each column, for which the largest change of a quantity is
/// least with `sectors` and that many times the unknowns of the section: at a density rho column j
/// of length h_j leaves c_kj h_j / rho_j^2. A quantity counts by a high power of what the density
/// leaves of it, which is found by repetition; the sixth still gave much to those that did not
/// matter (race tire: 1.05 in place of 0.96 %).
std::vector<double> density(const Judged& mesh,
                            const ColumnChanges& changes,
                            int sectors,
                            double unknowns) {
  constexpr double kPower = 20.0;
  Section section = mesh.tire.section;
  const std::vector<double>& columns = mesh.tire.section.columns;
  const auto count = changes.column.cols();
  const auto crown = section.crown_columns();
  Eigen::ArrayXd h(count), cost(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    h[j] = columns[j + 1] - columns[j];
    const bool sidewall = crown && static_cast<double>(j) >= *crown;
    cost[j] = (sidewall ? section.rows_inside + 1 : section.rows()) + 1.0;
  }
  const Eigen::ArrayXXd c = changes.column.rowwise() / h.cube().transpose();
  const Eigen::ArrayXd sign = mesh.along.sign();
  const Eigen::ArrayXd around = mesh.around * std::pow(double(section.sectors) / sectors, 2);
  const Eigen::ArrayXd rest = mesh.all - mesh.around - mesh.along;
  section.sectors = sectors;
  const double loaded = loaded_part(section);
  Eigen::ArrayXd rho = 1.0 / h;
  for (int repeated = 0; repeated < 200; ++repeated) {
    // The same unknowns each time, or errors would not compare.
    rho *= unknowns * cost.sum() / (rho * h * cost).sum();
    const Eigen::ArrayXd along =
        sign * (c.rowwise() * (h / rho.square()).transpose()).rowwise().sum();
    const Eigen::ArrayXd error = together(along + around + rest, along, around, loaded);
    const Eigen::ArrayXd weight = (error / error.maxCoeff()).pow(kPower);
    const Eigen::ArrayXd worth = (c.colwise() * weight).colwise().sum().transpose() / cost;
    const Eigen::ArrayXd wanted = worth.max(1e-6 * worth.maxCoeff()).pow(1.0 / 3.0);
    rho = (rho * wanted / wanted.mean() * rho.mean()).sqrt();
  }
  // Lengths of neighbors are alike: elements are no better than their worst neighbor.
  std::vector<double> smooth;
  for (Eigen::Index j = 0; j < count; ++j) {
    const double before = rho[std::max<Eigen::Index>(j - 1, 0)];
    const double after = rho[std::min<Eigen::Index>(j + 1, count - 1)];
    smooth.push_back(std::sqrt(rho[j] * std::sqrt(before * after)));
  }
  return smooth;
}

/// What a mesh is expected to leave by the number of its columns between fixed ends, where they
/// have a density: between two ends they leave what one would over the square of their number.
class Expected {
 public:
  Expected(const Judged& mesh,
           const ColumnChanges& changes,
           int sectors,
           const std::vector<double>& fixed,
           const std::vector<double>& rho)
      : sectors_(sectors), sign_(mesh.along.sign()) {
    Section section = mesh.tire.section;
    const std::vector<double>& columns = section.columns;
    around_ = mesh.around * std::pow(static_cast<double>(section.sectors) / sectors, 2);
    rest_ = mesh.all - mesh.around - mesh.along;
    const auto crown = section.crown_columns();
    const double crown_to = crown ? columns[static_cast<std::size_t>(*crown)] : 1.0;
    const auto nodes = [&](double q) {
      return (q < crown_to ? section.rows() : section.rows_inside + 1) + 1;
    };
    int now = 0;
    for (std::size_t j = 0; j + 1 < columns.size(); ++j) now += nodes(columns[j]);
    others_ = mesh.unknowns / section.sectors - 6 * now;
    const auto segments = std::ssize(fixed) - 1;
    one_ = Eigen::ArrayXXd::Zero(around_.size(), segments);
    for (Eigen::Index s = 0; s < segments; ++s) {
      nodes_.push_back(nodes(fixed[s]));
      double sum = 0.0;
      for (std::size_t j = 0; j + 1 < columns.size(); ++j) {
        const double h = columns[j + 1] - columns[j];
        const double here = std::min(columns[j + 1], fixed[s + 1]) - std::max(columns[j], fixed[s]);
        if (here <= 0.0) continue;
        sum += rho[j] * here;
        one_.col(s) += changes.column.col(static_cast<Eigen::Index>(j)) / (h * h * h) * here /
                       (rho[j] * rho[j]);
      }
      one_.col(s) *= sum * sum;
    }
    section.sectors = sectors;
    loaded_ = loaded_part(section);
  }

  int unknowns(const std::vector<int>& number) const {
    int nodes = 0;
    for (std::size_t s = 0; s < number.size(); ++s) nodes += number[s] * nodes_[s];
    return sectors_ * (others_ + 6 * nodes);
  }

  /// A power mean close to the largest, which shows also what helps all but one quantity.
  double error(const std::vector<int>& number) const {
    constexpr double kPower = 20.0;
    Eigen::ArrayXd along = Eigen::ArrayXd::Zero(sign_.size());
    for (std::size_t s = 0; s < number.size(); ++s) {
      along += one_.col(static_cast<Eigen::Index>(s)) / (number[s] * number[s]);
    }
    const Eigen::ArrayXd left = together(sign_ * along + around_ + rest_, along, around_, loaded_);
    const double largest = left.maxCoeff();
    return largest * std::pow((left / largest).pow(kPower).sum(), 1.0 / kPower);
  }

  /// The numbers for which that is least: columns are added where they help most, then exchanged.
  /// None is spared, though fewer may err by what cancels errors of sectors.
  std::vector<int> best(int most) const {
    std::vector<int> number(nodes_.size(), 1);
    while (improve(number, most, {{1, 0}}, std::numeric_limits<double>::infinity())) {
    }
    while (improve(number, most, {{1, 0}, {1, -1}, {1, -2}, {2, -1}}, error(number))) {
    }
    return number;
  }

 private:
  /// The best of all exchanges {more in one place, fewer in another}; false where none helps.
  bool improve(std::vector<int>& number,
               int most,
               const std::vector<std::pair<int, int>>& exchanges,
               double now) const {
    std::vector<int> best = number;
    double least = now * (1.0 - 1e-6);
    for (const auto& [more, fewer] : exchanges) {
      for (std::size_t a = 0; a < number.size(); ++a) {
        for (std::size_t b = 0; b < number.size(); ++b) {
          std::vector<int> tried = number;
          tried[a] += more;
          tried[b] += fewer;
          if (tried[b] < 1 || unknowns(tried) > most) continue;
          if (const double left = error(tried); left < least) {
            least = left;
            best = std::move(tried);
          }
        }
      }
    }
    return std::exchange(number, best) != best;
  }

  int sectors_, others_ = 0;  // unknowns of a sector beside those of columns of both halves
  Eigen::ArrayXd sign_, around_, rest_;
  Eigen::ArrayXXd one_;     // [quantities x segments], with one column each
  std::vector<int> nodes_;  // that a column adds there
  double loaded_ = 1.0;
};

/// Of a ring, beyond those of its zones on both sides of the contact.
int fewest_sectors(const Section& section) {
  constexpr int kAlike = 36, kAbove = 12;
  int zoned = 0;
  for (const fe_tire::SectorZone& zone : section.sector_zones) zoned += zone.sectors;
  return std::max(kAlike, 2 * zoned + kAbove);
}

/// Columns of a mesh of so many sectors that is expected to err less.
struct Way {
  int sectors = 0;
  std::vector<double> rho;
  std::vector<int> number;
  double error = std::numeric_limits<double>::infinity();
};

Way way(const Judged& mesh,
        const ColumnChanges& changes,
        const std::vector<double>& fixed,
        int sectors,
        int most) {
  const double part =
      static_cast<double>(most) / mesh.unknowns * mesh.tire.section.sectors / sectors;
  Way found = {sectors, density(mesh, changes, sectors, part), {}};
  const Expected expected(mesh, changes, sectors, fixed, found.rho);
  found.number = expected.best(most);
  found.error = expected.error(found.number);
  return found;
}

/// Of the sectors a ring may have, near those it has, those that are expected to err least.
int best_sectors(const Judged& mesh,
                 const ColumnChanges& changes,
                 const std::vector<double>& fixed,
                 int most) {
  constexpr int kFarthest = 8;
  const int now = mesh.tire.section.sectors;
  Way best;
  for (int sectors = std::max(fewest_sectors(mesh.tire.section), now - kFarthest);
       sectors <= now + kFarthest;
       sectors += 2) {
    if (Way one = way(mesh, changes, fixed, sectors, most); one.error < best.error) {
      best = std::move(one);
    }
  }
  return best.sectors > 0 ? best.sectors : now;
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

/// Columns of that density, `number` of them between two fixed positions.
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

/// To what a file writes.
std::vector<double> rounded(std::vector<double> columns) {
  for (double& q : columns) q = std::round(q * 1e4) / 1e4;
  return columns;
}

/// Meshes that are expected to err less: of the best number of sectors and, where it may be chosen,
/// of a few more and fewer.
Result<std::vector<TireDescription>> moved(const Judged& now,
                                           const ColumnChanges& changes,
                                           const std::vector<double>& fixed,
                                           int most,
                                           bool choose_sectors) {
  const std::vector<double>& columns = now.tire.section.columns;
  std::vector<int> wanted = {now.tire.section.sectors};
  if (choose_sectors) {
    const int best = best_sectors(now, changes, fixed, most);
    wanted = {best - 2, best, best + 2};
  }
  std::vector<TireDescription> meshes;
  for (const int sectors : wanted) {
    const Way found = way(now, changes, fixed, sectors, most);
    TireDescription mesh = now.tire;
    mesh.section.sectors = sectors;
    mesh = with_columns(std::move(mesh), rounded(placed(found.number, fixed, columns, found.rho)));
    if (const int least = build_mesh(mesh).free_dofs(); least > most) {
      return Failure{fmt::format(
          "{} columns between the ends of plies and rubbers make {} unknowns, more than the {} "
          "allowed: allow more, or take fewer sectors or rows",
          2 * (mesh.section.columns.size() - 1),
          least,
          most)};
    }
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

}  // namespace

Result<ColumnPlacement> place_columns(const TireDescription& tire,
                                      const ColumnPlacementSettings& settings,
                                      const std::function<void(const std::string&)>& progress) {
  constexpr int kMoreLoaded = 2;  // modes that come down among the lowest on the ground
  const int modes = settings.modes + kMoreLoaded;
  const int most = settings.unknowns > 0 ? settings.unknowns : build_mesh(tire).free_dofs();
  const std::vector<double> fixed = fixed_ends(tire.section);
  const TireDescription first = with_columns(tire, rounded(columns_of(tire.section)));
  const auto start = inflated_start(first);
  if (!start) return start.failure();
  auto judged = judge({first}, *start, modes);
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
              mesh.worst};
    }
    if (round == settings.rounds) return best;
    const Judged& now = *std::ranges::min_element(*judged, {}, &Judged::error);
    if (progress) {
      progress(fmt::format("round {} of {}: {} columns halved in turn",
                           round + 1,
                           settings.rounds,
                           now.tire.section.columns.size() - 1));
    }
    const auto changed = changes(now, *start, modes);
    if (!changed) return changed.failure();
    auto meshes = moved(now, *changed, fixed, most, settings.choose_sectors);
    if (!meshes) return meshes.failure();
    judged = judge(*meshes, *start, modes);
    if (!judged) return judged.failure();
  }
}

}  // namespace latsch
