// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/column_exchange.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "experiment/rigs/fe_tire/column_changes.h"
#include "experiment/rigs/fe_tire/discretization.h"
#include "experiment/rigs/fe_tire/expected_columns.h"
#include "models/fe_tire/description/section_columns.h"

namespace latsch::placement {

using fe_tire::Section;
using fe_tire::TireDescription;

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

/// Returns a norm close to the largest error that also decreases if all other errors improve.
double size_of(const Eigen::ArrayXd& errors) {
  constexpr double kPower = 20.0;
  const double largest = errors.abs().maxCoeff();
  if (!std::isfinite(largest) || largest == 0.0) return largest;
  return largest * std::pow((errors.abs() / largest).pow(kPower).sum(), 1.0 / kPower);
}

/// A mesh, and the relative errors of its quantities; infinite for a quantity that could not be
/// computed on the mesh.
struct Seen {
  TireDescription tire;
  int unknowns = 0;
  Eigen::ArrayXd error;
};

/// The values to which the results of meshes of one tire converge.
class Body {
 public:
  Body(const DiscretizationStudy& study, DiscretizationSettings settings)
      : settings_(std::move(settings)) {
    const auto keep =
        [&](const std::vector<DiscretizationRow>& rows, MeshQuantities& limits, const char* where) {
          for (const DiscretizationRow& row : rows) {
            if (!row.paired) continue;
            limits.emplace_back(row.name, row.converged);
            names_.push_back(row.name + where);
          }
        };
    keep(study.unloaded, unloaded_, "");
    keep(study.loaded, loaded_, " on the ground");
  }

  Eigen::Index count() const { return std::ssize(names_); }
  const std::string& name(Eigen::Index quantity) const { return names_[quantity]; }

  Result<Seen> see(const TireDescription& tire) const {
    const auto measured = measure_mesh(tire, settings_);
    if (!measured) return measured.failure();
    Seen seen = {tire, build_mesh(tire).free_dofs(), Eigen::ArrayXd(std::ssize(names_))};
    Eigen::Index k = 0;
    for (const auto& rows :
         {paired_rows({unloaded_, measured->unloaded}), paired_rows({loaded_, measured->loaded})}) {
      for (const DiscretizationRow& row : rows) {
        seen.error[k++] = row.paired ? row.values[1] / row.values[0] - 1.0 : kNone;
      }
    }
    return seen;
  }

 private:
  DiscretizationSettings settings_;
  MeshQuantities unloaded_, loaded_;
  std::vector<std::string> names_;
};

/// An exchange of the columns [from, to) of a mesh, or of its sectors (from = -1).
struct Exchange {
  int from = 0, to = 0;
  std::vector<double> ends;  // ends of the new columns, between those of `from` and `to`
  int sectors = 0;           // number added
  int nodes = 0;             // number added in each sector
  Eigen::ArrayXd change;     // expected change of the errors

  bool meets(const Exchange& other) const { return from < other.to && other.from < to; }
};

/// Returns `change` where it increases an error, else 0: an improvement is not counted, because the
/// errors of fewer elements may cancel those of others on this mesh alone.
Eigen::ArrayXd harm(const Eigen::ArrayXd& error, const Eigen::ArrayXd& change) {
  return ((error + change).abs() > error.abs()).select(change, 0.0);
}

/// Contribution of a column to the error, of order h^3, if halving the column changes the error by
/// `halved`.
Eigen::ArrayXd part(const Eigen::ArrayXd& halved) { return -4.0 / 3.0 * halved; }

/// All exchanges at one position of a mesh.
class Exchanges {
 public:
  /// `halved` is the change by halving each column.
  Exchanges(const Seen& mesh, const std::vector<double>& fixed, const Eigen::ArrayXXd& halved)
      : mesh_(mesh), columns_(mesh.tire.section.columns) {
    for (int j = 0; j < halved.cols(); ++j) {
      const double middle = 0.5 * (columns_[j] + columns_[j + 1]);
      if (length(j) > 2.0 * kShortest) add(j, j + 1, {middle}, halved.col(j));
      const bool stays = std::ranges::any_of(
          fixed, [&](double q) { return std::abs(q - columns_[j]) < kSamePosition; });
      if (j == 0 || stays) continue;
      const Eigen::ArrayXd before = part(halved.col(j - 1)), here = part(halved.col(j));
      const double a = length(j - 1), b = length(j);
      const auto grown = [](double to, double h) { return std::pow(to / h, 3) - 1.0; };
      add(j - 1,
          j + 1,
          {},
          harm(mesh.error,
               (before + here) * (std::pow(a + b, 3) / (std::pow(a, 3) + std::pow(b, 3)) - 1.0)));
      for (const double parts : {-0.25, 0.25}) {
        const double by = parts * std::min(a, b);
        if (std::min(a + by, b - by) < kShortest) continue;
        const Eigen::ArrayXd first = before * grown(a + by, a), second = here * grown(b - by, b);
        add(j - 1,
            j + 1,
            {columns_[j] + by},
            (by > 0.0 ? second : first) + harm(mesh.error, by > 0.0 ? first : second));
      }
    }
  }

  void add_sectors(int more, const Eigen::ArrayXd& change) {
    Exchange one = {.from = -1, .to = 0, .ends = {}, .change = change};
    one.sectors = more;
    all_.push_back(std::move(one));
  }

  /// Returns at most `count` meshes with the best expected errors, with at most `most` unknowns.
  std::vector<TireDescription> best(int count, int most) const {
    std::vector<Together> found;
    std::vector<const Exchange*> chosen;
    choose(chosen, 0, mesh_.error, most, found);
    std::ranges::stable_sort(found, {}, &Together::size);
    std::vector<TireDescription> meshes;
    for (const Together& one : found) {
      if (std::ssize(meshes) == count) break;
      meshes.push_back(made(one.exchanges));
    }
    return meshes;
  }

 private:
  static constexpr double kShortest = 0.004, kSamePosition = 1e-4;

  struct Together {
    std::vector<const Exchange*> exchanges;
    double size = 0.0;
  };

  double length(int column) const { return columns_[column + 1] - columns_[column]; }

  void add(int from, int to, std::vector<double> ends, const Eigen::ArrayXd& change) {
    Exchange one = {.from = from, .to = to, .ends = std::move(ends), .change = change};
    const int columns = static_cast<int>(std::ssize(one.ends)) + 1 - (to - from);
    one.nodes = 2 * columns * nodes_across(mesh_.tire.section, from);
    all_.push_back(std::move(one));
  }

  /// Tries all sets of up to three exchanges at different positions, starting with `first`.
  void choose(std::vector<const Exchange*>& chosen,
              std::size_t first,
              const Eigen::ArrayXd& error,
              int most,
              std::vector<Together>& found) const {
    constexpr std::size_t kTogether = 3;
    if (!chosen.empty() && unknowns(chosen) <= most) found.push_back({chosen, size_of(error)});
    if (chosen.size() == kTogether) return;
    for (std::size_t i = first; i < all_.size(); ++i) {
      const Exchange& one = all_[i];
      if (std::ranges::any_of(chosen, [&](const Exchange* other) { return one.meets(*other); }))
        continue;
      chosen.push_back(&one);
      choose(chosen, i + 1, error + one.change, most, found);
      chosen.pop_back();
    }
  }

  int unknowns(const std::vector<const Exchange*>& chosen) const {
    int sectors = mesh_.tire.section.sectors;
    int of_sector = mesh_.unknowns / sectors;
    for (const Exchange* one : chosen) {
      sectors += one->sectors;
      of_sector += 3 * one->nodes;
    }
    return sectors * of_sector;
  }

  TireDescription made(const std::vector<const Exchange*>& exchanges) const {
    TireDescription tire = mesh_.tire;
    std::vector<double> columns = columns_;
    for (const Exchange* one : exchanges) {
      tire.section.sectors += one->sectors;
      for (int j = one->from + 1; j < one->to; ++j) std::erase(columns, columns_[j]);
      for (const double end : one->ends) columns.push_back(std::round(end * 1e4) / 1e4);
    }
    std::ranges::sort(columns);
    return with_columns(std::move(tire), std::move(columns));
  }

  const Seen& mesh_;
  const std::vector<double>& columns_;
  std::vector<Exchange> all_;
};

TireDescription with_more_sectors(TireDescription tire, int more) {
  tire.section.sectors += more;
  return tire;
}

/// Computes the errors of all meshes on the ground; a mesh that cannot be pressed on the ground has
/// infinite errors.
Result<std::vector<Seen>> see_all(const Body& body, const std::vector<TireDescription>& meshes) {
  return at_once<Seen>(std::ssize(meshes), [&](Eigen::Index i) -> Result<Seen> {
    if (auto seen = body.see(meshes[i])) return seen;
    return Seen{meshes[i], 0, Eigen::ArrayXd::Constant(body.count(), kNone)};
  });
}

/// Returns the difference of two values if both are known, else 0.
Eigen::ArrayXd change(const Eigen::ArrayXd& from, const Eigen::ArrayXd& to) {
  return (to.isFinite() && from.isFinite()).select(to - from, 0.0);
}

constexpr int kTwoSectors = 2;  // numbers stay even, because the ring's halves are equal

/// Returns the mesh with each column halved in turn, then with two sectors fewer and two more if
/// their number may be chosen.
std::vector<TireDescription> probes(const TireDescription& tire, bool choose_sectors) {
  const std::vector<double>& columns = tire.section.columns;
  std::vector<TireDescription> meshes;
  for (std::size_t j = 0; j + 1 < columns.size(); ++j) {
    std::vector<double> halved = columns;
    halved.insert(halved.begin() + static_cast<std::ptrdiff_t>(j) + 1,
                  0.5 * (columns[j] + columns[j + 1]));
    meshes.push_back(with_columns(tire, std::move(halved)));
  }
  if (choose_sectors && tire.section.sectors - kTwoSectors >= fewest_sectors(tire.section)) {
    meshes.push_back(with_more_sectors(tire, -kTwoSectors));
    meshes.push_back(with_more_sectors(tire, kTwoSectors));
  }
  return meshes;
}

Exchanges exchanges_of(const Seen& now,
                       const std::vector<double>& fixed,
                       const std::vector<Seen>& probed) {
  const auto columns = std::ssize(now.tire.section.columns) - 1;
  Eigen::ArrayXXd halved(now.error.size(), columns);
  for (Eigen::Index j = 0; j < columns; ++j) halved.col(j) = change(now.error, probed[j].error);
  Exchanges exchanges(now, fixed, halved);
  for (auto i = columns; i < std::ssize(probed); ++i) {
    const int more = probed[i].tire.section.sectors - now.tire.section.sectors;
    const Eigen::ArrayXd changed = change(now.error, probed[i].error);
    exchanges.add_sectors(more, more < 0 ? harm(now.error, changed) : changed);
  }
  return exchanges;
}

}  // namespace

Result<ColumnPlacement> exchange_columns(const TireDescription& tire,
                                         const ColumnPlacementSettings& settings,
                                         const std::vector<double>& fixed,
                                         const std::function<void(const std::string&)>& progress) {
  constexpr int kTried = 8;
  DiscretizationSettings limits;
  limits.element = tire.element;
  limits.pressure = tire.pressure;
  limits.deflection = settings.deflection;
  limits.modes = settings.modes;
  if (progress) progress("finer meshes of the tire on the ground");
  const auto study = study_discretization(tire, limits);
  if (!study) return study.failure();
  const Body body(*study, limits);
  auto now = body.see(tire);
  if (!now) return now.failure();
  const int most = settings.unknowns > 0 ? settings.unknowns : now->unknowns;
  const double before = now->error.abs().maxCoeff();
  for (int round = 0; round < settings.rounds; ++round) {
    if (progress) {
      progress(fmt::format("on the ground, round {} of {}: {:.2f} %, {} columns halved in turn",
                           round + 1,
                           settings.rounds,
                           1e2 * now->error.abs().maxCoeff(),
                           now->tire.section.columns.size() - 1));
    }
    const auto probed = see_all(body, probes(now->tire, settings.choose_sectors));
    if (!probed) return probed.failure();
    auto tried = see_all(body, exchanges_of(*now, fixed, *probed).best(kTried, most));
    if (!tried) return tried.failure();
    const auto least =
        std::ranges::min_element(*tried, {}, [](const Seen& mesh) { return size_of(mesh.error); });
    if (least == tried->end() || size_of(least->error) >= size_of(now->error)) break;
    *now = std::move(*least);
  }
  Eigen::Index worst = 0;
  const double error = now->error.abs().maxCoeff(&worst);
  return ColumnPlacement{now->tire.section.columns,
                         now->tire.section.sectors,
                         now->unknowns,
                         before,
                         error,
                         body.name(worst)};
}

}  // namespace latsch::placement
