// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/elimination.h"

#include <metis.h>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <utility>

namespace latsch::numerics {
namespace {

using Lists = std::vector<std::vector<int>>;

/// Returns the position of every block row by nested dissection (METIS) of the graph of the block
/// rows. Rows whose `number` is -1 are left out.
std::vector<int> dissect(const SymmetricPattern& pattern, const std::vector<int>& number, int n) {
  Lists neighbors(n);
  for (int i = 0; i < pattern.block_rows(); ++i) {
    for (int k = pattern.row_start()[i]; k < pattern.row_start()[i + 1] - 1; ++k) {
      const int a = number[i], b = number[pattern.column()[k]];
      if (a < 0 || b < 0) continue;
      neighbors[a].push_back(b);
      neighbors[b].push_back(a);
    }
  }
  std::vector<idx_t> first(1, 0), neighbor;
  for (const std::vector<int>& row : neighbors) {
    neighbor.insert(neighbor.end(), row.begin(), row.end());
    first.push_back(static_cast<idx_t>(neighbor.size()));
  }
  std::vector<idx_t> order(n), position(n);
  std::iota(position.begin(), position.end(), 0);
  if (!neighbor.empty()) {
    idx_t options[METIS_NOPTIONS];
    METIS_SetDefaultOptions(options);
    idx_t vertices = n;
    // METIS draws from the one random sequence of the process, which it restarts in each call. Two
    // threads in METIS at the same time would change each other's numbers.
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    METIS_NodeND(
        &vertices, first.data(), neighbor.data(), nullptr, options, order.data(), position.data());
  }
  return {position.begin(), position.end()};
}

/// Returns the positions of all block rows, with those of the interface at the end.
std::vector<int> order(const SymmetricPattern& pattern, const std::vector<int>& interface) {
  std::vector<int> number(pattern.block_rows(), 0);
  for (int row : interface) number[row] = -1;
  int inside = 0;
  for (int& row : number) {
    if (row == 0) row = inside++;
  }
  std::vector<int> position = dissect(pattern, number, inside), all(number.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (number[i] >= 0) all[i] = position[number[i]];
  }
  for (int row : interface) all[row] = inside++;
  return all;
}

/// Returns the given positions with those of the interface moved to the end.
std::vector<int> moved_last(const std::vector<int>& position, const std::vector<int>& interface) {
  std::vector<int> order(position.size()), moved(position.size(), 0);
  for (std::size_t row = 0; row < position.size(); ++row)
    order[position[row]] = static_cast<int>(row);
  for (int row : interface) moved[row] = -1;
  int next = 0;
  for (int row : order) {
    if (moved[row] == 0) moved[row] = next++;
  }
  for (int row : interface) moved[row] = next++;
  return moved;
}

/// Returns the rows below the diagonal of every column, in the order of `position`. The last
/// `interface` columns are all coupled.
Lists lower_columns(const SymmetricPattern& pattern,
                    const std::vector<int>& position,
                    int interface) {
  Lists columns(position.size());
  for (int i = 0; i < pattern.block_rows(); ++i) {
    for (int k = pattern.row_start()[i]; k < pattern.row_start()[i + 1] - 1; ++k) {
      const auto [column, row] = std::minmax(position[i], position[pattern.column()[k]]);
      columns[column].push_back(row);
    }
  }
  const int n = pattern.block_rows();
  for (int j = n - interface; j < n; ++j) {
    for (int row = j + 1; row < n; ++row) columns[j].push_back(row);
  }
  return columns;
}

/// Adds to the columns the entries that the elimination fills. Returns the parent of every column:
/// its first row below the diagonal.
std::vector<int> fill(Lists& columns) {
  const int n = static_cast<int>(columns.size());
  std::vector<int> parent(n, -1), seen(n, -1);
  Lists children(n);
  for (int j = 0; j < n; ++j) {
    std::vector<int> rows;
    const auto add = [&](const std::vector<int>& some) {
      for (int row : some) {
        if (row <= j || seen[row] == j) continue;
        seen[row] = j;
        rows.push_back(row);
      }
    };
    add(columns[j]);
    for (int child : children[j]) add(columns[child]);
    std::sort(rows.begin(), rows.end());
    columns[j] = std::move(rows);
    if (columns[j].empty()) continue;
    parent[j] = columns[j].front();
    children[parent[j]].push_back(j);
  }
  return parent;
}

/// Returns an order with children before parents, and the child with the most rows last, so that it
/// may join its parent. The last `interface` columns remain the last ones.
std::vector<int> postorder(const std::vector<int>& parent, const Lists& columns, int interface) {
  const int all = static_cast<int>(parent.size()), n = all - interface;
  Lists children(n + 1);
  for (int j = 0; j < n; ++j) {
    children[parent[j] < 0 || parent[j] >= n ? n : parent[j]].push_back(j);
  }
  for (std::vector<int>& some : children) {
    std::stable_sort(some.begin(), some.end(), [&](int a, int b) {
      return columns[a].size() < columns[b].size();
    });
  }
  std::vector<int> position(all), next(n + 1, 0), path{n};
  std::iota(position.begin() + n, position.end(), n);
  int count = 0;
  while (!path.empty()) {
    const int j = path.back();
    if (next[j] < static_cast<int>(children[j].size())) {
      path.push_back(children[j][next[j]++]);
    } else {
      if (j < n) position[j] = count++;
      path.pop_back();
    }
  }
  return position;
}

/// Renumbers columns and parents to another order that has parents after their children. The rows
/// of a column are its ancestors, so they stay in order.
void renumber(const std::vector<int>& after, Lists& columns, std::vector<int>& parent) {
  Lists moved(columns.size());
  std::vector<int> of_moved(parent.size(), -1);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    for (int& row : columns[j]) row = after[row];
    moved[after[j]] = std::move(columns[j]);
    if (parent[j] >= 0) of_moved[after[j]] = after[parent[j]];
  }
  columns = std::move(moved);
  parent = std::move(of_moved);
}

/// Returns fronts of successive columns with the same rows.
std::vector<Front> fundamental_fronts(const std::vector<int>& parent,
                                      const Lists& columns,
                                      int interface) {
  std::vector<Front> fronts;
  const int first_of_interface = static_cast<int>(parent.size()) - interface;
  for (int j = 0; j < static_cast<int>(parent.size()); ++j) {
    const bool joins = j > 0 && j != first_of_interface && parent[j - 1] == j &&
                       columns[j - 1].size() == columns[j].size() + 1;
    if (!joins) fronts.push_back({j, 0, {}, -1});
    ++fronts.back().columns;
    fronts.back().below = columns[j];
  }
  return fronts;
}

/// True if a front that is `columns` unknowns wide may store this share of zeros.
bool may_store(double zeros, int columns) {
  if (columns <= 16) return true;
  if (columns <= 48) return zeros < 0.25;
  return zeros < (columns <= 96 ? 0.1 : 0.05);
}

/// Joins fronts with the parent that directly follows them, from the last to the first, so that a
/// parent has joined its own parent before.
std::vector<Front> joined(std::vector<Front> fronts, int block, int first_of_interface) {
  std::vector<Front> kept;  // last first
  std::vector<double> zeros;
  for (int s = static_cast<int>(fronts.size()) - 1; s >= 0; --s) {
    Front& front = fronts[s];
    if (!kept.empty() && !front.below.empty() && front.below.front() == kept.back().first &&
        kept.back().first != first_of_interface) {
      Front& parent = kept.back();
      const double columns = front.columns + parent.columns;
      const double height = front.columns + parent.rows();
      const double all = columns * height - 0.5 * columns * (columns - 1.0);
      const double none = zeros.back() + front.columns * (height - front.rows());
      if (may_store(none / all, static_cast<int>(columns) * block)) {
        parent.first = front.first;
        parent.columns = static_cast<int>(columns);
        zeros.back() = none;
        continue;
      }
    }
    kept.push_back(std::move(front));
    zeros.push_back(0.0);
  }
  std::reverse(kept.begin(), kept.end());
  return kept;
}

void find_parents(std::vector<Front>& fronts, int columns) {
  std::vector<int> front_of(columns);
  for (int s = 0; s < static_cast<int>(fronts.size()); ++s) {
    std::fill_n(front_of.begin() + fronts[s].first, fronts[s].columns, s);
  }
  for (Front& front : fronts) {
    if (!front.below.empty()) front.parent = front_of[front.below.front()];
  }
}

/// Builds the elimination in the order of these positions, up to reordering that leaves the fronts
/// unchanged.
Elimination in_order(const SymmetricPattern& pattern, std::vector<int> position, int interface) {
  Elimination result;
  result.interface = interface;
  result.position = std::move(position);
  Lists columns = lower_columns(pattern, result.position, interface);
  std::vector<int> parent = fill(columns);
  const std::vector<int> after = postorder(parent, columns, interface);
  for (int& place : result.position) place = after[place];
  renumber(after, columns, parent);
  result.fronts = joined(fundamental_fronts(parent, columns, interface),
                         pattern.block_size(),
                         pattern.block_rows() - interface);
  find_parents(result.fronts, pattern.block_rows());
  return result;
}

}  // namespace

Elimination eliminate(const SymmetricPattern& pattern) { return eliminate(pattern, {}); }

Elimination eliminate(const SymmetricPattern& pattern, const std::vector<int>& interface) {
  return in_order(pattern, order(pattern, interface), static_cast<int>(interface.size()));
}

Elimination eliminate(const SymmetricPattern& pattern,
                      const std::vector<int>& interface,
                      const Elimination& whole) {
  return in_order(
      pattern, moved_last(whole.position, interface), static_cast<int>(interface.size()));
}

}  // namespace latsch::numerics
