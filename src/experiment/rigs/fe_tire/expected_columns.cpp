// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/expected_columns.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace latsch::placement {

using fe_tire::Section;

namespace {

/// Returns the columns per position, constant in each column, for which the largest change of a
/// quantity is least with `sectors` and that many times the unknowns of the section: at a density
/// rho, column j of length h_j has the error c_kj h_j / rho_j^2. Each quantity is weighted by a
/// high power of its remaining error, which is found by iteration. A lower power would give many
/// columns to quantities that do not matter.
std::vector<double> density(const Judged& mesh,
                            const ColumnChanges& changes,
                            int sectors,
                            double unknowns) {
  constexpr double kPower = 20.0;
  Section section = mesh.tire.section;
  const std::vector<double>& columns = mesh.tire.section.columns;
  const auto count = changes.column.cols();
  Eigen::ArrayXd h(count), cost(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    h[j] = columns[j + 1] - columns[j];
    cost[j] = nodes_across(section, j);
  }
  const Eigen::ArrayXXd c = changes.column.rowwise() / h.cube().transpose();
  const Eigen::ArrayXd sign = mesh.along.sign();
  const Eigen::ArrayXd around = mesh.around * std::pow(double(section.sectors) / sectors, 2);
  const Eigen::ArrayXd rest = mesh.all - mesh.around - mesh.along;
  section.sectors = sectors;
  const double loaded = loaded_part(section);
  Eigen::ArrayXd rho = 1.0 / h;
  for (int repeated = 0; repeated < 200; ++repeated) {
    // The number of unknowns stays constant, because otherwise errors would not be comparable.
    rho *= unknowns * cost.sum() / (rho * h * cost).sum();
    const Eigen::ArrayXd along =
        sign * (c.rowwise() * (h / rho.square()).transpose()).rowwise().sum();
    const Eigen::ArrayXd error = together(along + around + rest, along, around, loaded);
    const Eigen::ArrayXd weight = (error / error.maxCoeff()).pow(kPower);
    const Eigen::ArrayXd worth = (c.colwise() * weight).colwise().sum().transpose() / cost;
    const Eigen::ArrayXd wanted = worth.max(1e-6 * worth.maxCoeff()).pow(1.0 / 3.0);
    rho = (rho * wanted / wanted.mean() * rho.mean()).sqrt();
  }
  // Neighboring columns get similar lengths: an element is no more accurate than its least accurate
  // neighbor.
  std::vector<double> smooth;
  for (Eigen::Index j = 0; j < count; ++j) {
    const double before = rho[std::max<Eigen::Index>(j - 1, 0)];
    const double after = rho[std::min<Eigen::Index>(j + 1, count - 1)];
    smooth.push_back(std::sqrt(rho[j] * std::sqrt(before * after)));
  }
  return smooth;
}

/// Expected error of a mesh by the number of its columns between fixed ends, where they have a
/// density: between two ends the error is that of one column over the square of their number.
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

  /// Returns a power mean that is close to the largest error but also decreases if all errors
  /// except one decrease.
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

  /// Returns the numbers of columns with the least error: columns are added where they help most,
  /// then exchanged. All allowed unknowns are used, although fewer columns may have a smaller error
  /// on this mesh by cancelling those of the sectors.
  std::vector<int> best(int most) const {
    std::vector<int> number(nodes_.size(), 1);
    while (improve(number, most, {{1, 0}}, std::numeric_limits<double>::infinity())) {
    }
    while (improve(number, most, {{1, 0}, {1, -1}, {1, -2}, {2, -1}}, error(number))) {
    }
    return number;
  }

 private:
  /// Makes the best exchange of one column more at one position and one fewer at another; returns
  /// false if no exchange helps.
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

  int sectors_, others_ = 0;  // unknowns of a sector besides those of columns of both halves
  Eigen::ArrayXd sign_, around_, rest_;
  Eigen::ArrayXXd one_;     // [quantities x segments], error with one column in each segment
  std::vector<int> nodes_;  // number that a column adds in each segment
  double loaded_ = 1.0;
};

}  // namespace

int fewest_sectors(const Section& section) {
  constexpr int kAlike = 36, kAbove = 12;
  int zoned = 0;
  for (const fe_tire::SectorZone& zone : section.sector_zones) zoned += zone.sectors;
  return std::max(kAlike, 2 * zoned + kAbove);
}

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

}  // namespace latsch::placement
