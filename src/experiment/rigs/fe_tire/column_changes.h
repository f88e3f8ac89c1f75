// SPDX-License-Identifier: Apache-2.0
// Changes of growth and unloaded modes by finer meshes: all elements, sectors, columns together and
// one by one. The model is one sector, so a mesh needs a fraction of a second.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/description/section_grid.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::placement {

/// Returns the results of `solve` for 0 to count - 1, computed on all threads of the machine.
template <class Found>
Result<std::vector<Found>> at_once(Eigen::Index count,
                                   const std::function<Result<Found>(Eigen::Index)>& solve) {
  std::vector<Result<Found>> found(count, Failure{});
  std::atomic<Eigen::Index> next = 0;
  {
    std::vector<std::jthread> threads(std::max(1U, std::thread::hardware_concurrency()));
    for (std::jthread& thread : threads) {
      thread = std::jthread([&] {
        for (Eigen::Index i = next++; i < count; i = next++) found[i] = solve(i);
      });
    }
  }
  std::vector<Found> values;
  for (Result<Found>& one : found) {
    if (!one) return one.failure();
    values.push_back(*std::move(one));
  }
  return values;
}

/// Returns the number of nodes from the inner to the outer surface of the tire, for a column of
/// elements.
int nodes_across(const fe_tire::Section& section, Eigen::Index column);

/// Growth and frequencies, each by its name.
using Quantities = std::map<std::string, double>;

/// The inflated tire on one mesh, from which the iterations on all other meshes start.
struct Start {
  fe_tire::SectionGrid grid;
  Eigen::Matrix3Xd u;
};

Result<Start> inflated_start(const fe_tire::TireDescription& tire);

/// A mesh and the changes of its quantities by finer meshes, relative.
struct Judged {
  fe_tire::TireDescription tire;
  int unknowns = 0;
  Quantities values;
  Eigen::ArrayXd along;   // change if all columns are halved
  Eigen::ArrayXd around;  // change if all sectors are halved
  Eigen::ArrayXd all;     // 3/4 of the distance to the limit of all three directions
  double error = 0.0;     // error of the quantity with the greatest error
  std::string worst;      // name of that quantity
};

/// Relative changes of the results if one column of a mesh is halved, for each column.
struct ColumnChanges {
  /// [quantities x columns], change if each column is halved: magnitudes whose sum is the whole
  /// change.
  Eigen::ArrayXXd column;
};

/// Returns the ratio of the error caused by sectors on the ground to that of the unloaded tire. It
/// is the second-order error of the widest sectors, because a mode bends most where it is free, far
/// from the contact, where sectors are widest. Its waves, as many as unloaded, are shorter, because
/// the contact fixes a part of the circumference up to the end of the narrowest sectors.
double loaded_part(const fe_tire::Section& section);

/// Returns the change by halving all elements: the largest of that of the unloaded tire, on the
/// ground, and by columns alone.
Eigen::ArrayXd together(const Eigen::ArrayXd& all,
                        const Eigen::ArrayXd& along,
                        const Eigen::ArrayXd& around,
                        double loaded);

/// Estimates the errors of each of the meshes with finer meshes.
Result<std::vector<Judged>> judge(const std::vector<fe_tire::TireDescription>& meshes,
                                  const Start& start,
                                  int modes);

/// Halves each column of the mesh in turn.
Result<ColumnChanges> changes(const Judged& mesh, const Start& start, int modes);

}  // namespace latsch::placement
