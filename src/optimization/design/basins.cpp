// SPDX-License-Identifier: Apache-2.0
#include "optimization/design/basins.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "numerics/dense/orthogonal_factors.h"

namespace latsch {
namespace {

// Least number of levels along a line that has a fourth difference.
constexpr int kFewestLevels = 5;
// Largest number of variables for which diagonal neighbors count, so that a point has up to 3^6 - 1
// of them. With more variables only the neighbors along the axes count.
constexpr int kMostDiagonals = 6;
// Smallest share of the variance that a plane must explain at points that were left out of its fit.
// Below it, a scattered design is too thin.
constexpr double kLeastExplained = 0.5;

/// Returns, for each variable, the difference of the indices of adjacent grid points, if the points
/// are numbered with the last variable changing fastest.
std::vector<int> strides(const std::vector<int>& levels) {
  std::vector<int> stride(levels.size(), 1);
  for (int i = static_cast<int>(levels.size()) - 2; i >= 0; --i)
    stride[i] = stride[i + 1] * levels[i + 1];
  return stride;
}

int level_at(int place, int i, const std::vector<int>& stride, const std::vector<int>& levels) {
  return place / stride[i] % levels[i];
}

/// Returns the possible error of interpolation, |delta^4 f| / 96, for the cell between the points
/// `place` and place + stride: the larger of the values centered at these two points. It is 0 if no
/// fourth difference can be computed.
double missed_by_interpolation(
    const std::vector<double>& f, int place, int level, int count, int stride) {
  double missed = 0.0;
  for (int middle : {level, level + 1}) {
    if (middle < 2 || middle + 2 >= count) continue;
    const int m = place + (middle - level) * stride;
    const double fourth =
        f[m - 2 * stride] - 4 * f[m - stride] + 6 * f[m] - 4 * f[m + stride] + f[m + 2 * stride];
    if (std::isfinite(fourth)) missed = std::max(missed, std::abs(fourth) / 96.0);
  }
  return missed;
}

/// True if the point is an extremum along its grid line.
bool is_extremum(const std::vector<double>& f, int place, int level, int count, int stride) {
  if (level == 0 || level + 1 == count) return true;
  return (f[place] - f[place - stride]) * (f[place] - f[place + stride]) >= 0.0;
}

/// Counts the cells along variable i that may hide a minimum between their two points.
int hiding_cells(const std::vector<double>& f, const std::vector<int>& levels, int i) {
  const auto stride = strides(levels);
  int cells = 0;
  for (int place = 0; place < static_cast<int>(f.size()); ++place) {
    const int level = level_at(place, i, stride, levels), next = place + stride[i];
    if (level + 1 == levels[i]) continue;
    if (is_extremum(f, place, level, levels[i], stride[i]) ||
        is_extremum(f, next, level + 1, levels[i], stride[i]))
      continue;
    const double missed = missed_by_interpolation(f, place, level, levels[i], stride[i]);
    if (missed > 0.0 && std::abs(f[next] - f[place]) <= missed) ++cells;
  }
  return cells;
}

/// The grid without every second level of the variables that have an odd number of levels.
struct Thinned {
  std::vector<int> levels;
  std::vector<double> values;
};

Thinned thinned(const std::vector<double>& values, const std::vector<int>& levels) {
  const auto stride = strides(levels);
  Thinned thin;
  for (int n : levels) thin.levels.push_back(n >= kFewestLevels && n % 2 == 1 ? (n + 1) / 2 : n);
  for (int place = 0; place < static_cast<int>(values.size()); ++place) {
    bool kept = true;
    for (size_t i = 0; i < levels.size(); ++i) {
      if (thin.levels[i] != levels[i] && level_at(place, i, stride, levels) % 2 == 1) kept = false;
    }
    if (kept) thin.values.push_back(values[place]);
  }
  return thin;
}

}  // namespace

Neighbors grid_neighbors(const std::vector<int>& levels) {
  const auto stride = strides(levels);
  const int points = levels.empty() ? 0 : stride[0] * levels[0];
  std::vector<int> varied;
  for (size_t i = 0; i < levels.size(); ++i) {
    if (levels[i] > 1) varied.push_back(static_cast<int>(i));
  }
  const bool diagonals = std::ssize(varied) <= kMostDiagonals;
  int around = 1;  // number of combinations of the offsets -1, 0, +1 of all levels
  for (size_t i = 0; diagonals && i < varied.size(); ++i) around *= 3;

  Neighbors neighbors(points);
  for (int place = 0; place < points; ++place) {
    const auto add = [&](const std::vector<int>& steps) {
      int other = place;
      for (size_t k = 0; k < varied.size(); ++k) {
        const int level = level_at(place, varied[k], stride, levels) + steps[k];
        if (level < 0 || level >= levels[varied[k]]) return;
        other += steps[k] * stride[varied[k]];
      }
      if (other != place) neighbors[place].push_back(other);
    };
    std::vector<int> steps(varied.size(), 0);
    for (int code = 0; diagonals && code < around; ++code) {
      int rest = code;
      for (int& step : steps) {
        step = rest % 3 - 1;
        rest /= 3;
      }
      add(steps);
    }
    for (size_t k = 0; !diagonals && k < varied.size(); ++k) {
      for (int step : {-1, +1}) {
        steps[k] = step;
        add(steps);
      }
      steps[k] = 0;
    }
  }
  return neighbors;
}

Neighbors nearest_neighbors(const std::vector<Eigen::VectorXd>& points, int count) {
  Neighbors neighbors;
  for (size_t p = 0; p < points.size(); ++p) {
    std::vector<std::pair<double, int>> others;
    for (size_t q = 0; q < points.size(); ++q) {
      if (q != p) others.emplace_back((points[q] - points[p]).squaredNorm(), q);
    }
    std::sort(others.begin(), others.end());
    neighbors.emplace_back();
    for (const auto& other : others) {
      if (std::ssize(neighbors.back()) == count) break;
      neighbors.back().push_back(other.second);
    }
  }
  return neighbors;
}

std::vector<Basin> find_basins(const std::vector<double>& values, const Neighbors& neighbors) {
  assert(values.size() == neighbors.size());
  // The first of several equal values counts as the lowest, so that a plateau leads to one minimum.
  const auto lower = [&](int a, int b) {
    return values[a] < values[b] || (values[a] == values[b] && a < b);
  };
  const auto downhill = [&](int place) {
    int to = place;
    for (int other : neighbors[place]) {
      if (std::isfinite(values[other]) && lower(other, to)) to = other;
    }
    return to;
  };
  std::vector<int> count(values.size(), 0);
  for (int place = 0; place < static_cast<int>(values.size()); ++place) {
    if (!std::isfinite(values[place])) continue;
    int at = place;
    for (int to = downhill(at); to != at; to = downhill(at)) at = to;
    ++count[at];
  }
  std::vector<Basin> basins;
  for (int place = 0; place < static_cast<int>(values.size()); ++place) {
    if (count[place] > 0) basins.push_back({place, count[place], values[place]});
  }
  std::stable_sort(basins.begin(), basins.end(), [](const Basin& a, const Basin& b) {
    return a.value < b.value;
  });
  return basins;
}

std::string grid_doubt(const std::vector<double>& values, const std::vector<int>& levels) {
  int cells = 0;
  for (int i = 0; i < static_cast<int>(levels.size()); ++i) {
    if (levels[i] > 1 && levels[i] < kFewestLevels) {
      return fmt::format(
          "fewer than {} levels of a variable do not show whether minima hide between them",
          kFewestLevels);
    }
    cells += hiding_cells(values, levels, i);
  }
  if (cells > 0) {
    return fmt::format(
        "between {} pairs of neighbors the target changes by less than what "
        "interpolation can miss: minima may hide there",
        cells);
  }
  const auto all = find_basins(values, grid_neighbors(levels)).size();
  const Thinned thin = thinned(values, levels);
  const auto seen = find_basins(thin.values, grid_neighbors(thin.levels)).size();
  if (seen != all) {
    return fmt::format(
        "with every other level it shows {} minim{} instead of {}: more levels may show more still",
        seen,
        seen == 1 ? "um" : "a",
        all);
  }
  return "";
}

std::string scatter_doubt(const std::vector<double>& values,
                          const std::vector<Eigen::VectorXd>& points) {
  std::vector<double> f;
  std::vector<Eigen::VectorXd> u;
  for (size_t p = 0; p < points.size(); ++p) {
    if (!std::isfinite(values[p])) continue;
    f.push_back(values[p]);
    u.push_back(points[p]);
  }
  if (u.empty()) return "no point succeeded";
  const auto n = u.front().size();
  // Twice the number of points that determine a plane.
  const auto count = static_cast<int>(2 * n + 2);
  if (std::ssize(u) <= count) return "there are too few points to leave one out";
  const double mean = std::accumulate(f.begin(), f.end(), 0.0) / static_cast<double>(f.size());
  const Neighbors neighbors = nearest_neighbors(u, count);
  double missed = 0.0, variance = 0.0;
  for (size_t p = 0; p < u.size(); ++p) {
    Eigen::MatrixXd A(count, n + 1);
    Eigen::VectorXd b(count);
    for (int k = 0; k < count; ++k) {
      A(k, 0) = 1.0;
      A.row(k).tail(n) = (u[neighbors[p][k]] - u[p]).transpose();
      b[k] = f[neighbors[p][k]];
    }
    const double predicted = numerics::shortest_solution(A, b)[0];
    missed += (f[p] - predicted) * (f[p] - predicted);
    variance += (f[p] - mean) * (f[p] - mean);
  }
  const double explained = 1.0 - missed / variance;
  if (explained >= kLeastExplained) return "";
  return fmt::format(
      "a point left out is hardly predicted by its neighbors ({:.0f} % of the variance): "
      "there may be more minima than points to show them",
      100.0 * std::max(0.0, explained));
}

}  // namespace latsch
