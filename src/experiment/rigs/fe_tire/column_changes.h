// SPDX-License-Identifier: Apache-2.0
// What finer meshes change in growth and unloaded modes: all elements, sectors, columns together
// and one by one. One sector serves, so a mesh takes a fraction of a second.
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

/// What `solve` gives for 0 to count - 1, on as many threads as the machine has.
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

/// Nodes of one station within a column.
int nodes_across(const fe_tire::Section& section, Eigen::Index column);

/// Growth and frequencies by name.
using Quantities = std::map<std::string, double>;

/// The tire inflated, on one mesh: a start on all others.
struct Start {
  fe_tire::SectionGrid grid;
  Eigen::Matrix3Xd u;
};

Result<Start> inflated_start(const fe_tire::TireDescription& tire);

/// A mesh and what finer ones change in its quantities, relative.
struct Judged {
  fe_tire::TireDescription tire;
  int unknowns = 0;
  Quantities values;
  Eigen::ArrayXd along;   // all columns halved
  Eigen::ArrayXd around;  // all sectors halved
  Eigen::ArrayXd all;     // 3/4 of what the limit of all three directions is away
  double error = 0.0;     // of the quantity that errs most
  std::string worst;      // its name
};

/// What columns of it do, relative.
struct ColumnChanges {
  Eigen::ArrayXXd column;  // [quantities x columns], each halved: magnitudes that make up all
};

/// What halved sectors change on the ground, in parts of what they change of the unloaded tire: an
/// error of second order of the widest ones, for a mode bends most where it is free to, far from
/// the contact, and there sectors are widest; and its waves, as many as unloaded, are shorter for
/// what the contact holds, to where the narrowest sectors end.
double loaded_part(const fe_tire::Section& section);

/// What elements halved everywhere change, the largest of the unloaded tire, on the ground and by
/// columns alone.
Eigen::ArrayXd together(const Eigen::ArrayXd& all,
                        const Eigen::ArrayXd& along,
                        const Eigen::ArrayXd& around,
                        double loaded);

/// Each of the meshes on finer ones.
Result<std::vector<Judged>> judge(const std::vector<fe_tire::TireDescription>& meshes,
                                  const Start& start,
                                  int modes);

/// Each of its columns halved in turn.
Result<ColumnChanges> changes(const Judged& mesh, const Start& start, int modes);

}  // namespace latsch::placement
