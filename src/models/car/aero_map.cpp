// SPDX-License-Identifier: Apache-2.0
#include "models/car/aero_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <set>
#include <utility>

namespace latsch::car {
namespace {

using Eigen::Index;

std::vector<double> sorted(const std::set<double>& values) {
  return {values.begin(), values.end()};
}

Index index_in(const std::vector<double>& heights, double height) {
  return std::lower_bound(heights.begin(), heights.end(), height) - heights.begin();
}

/// Interpolation between two heights of the map: their indices, the share of the way from the lower
/// to the higher one, and the derivative of that share by height, which is 0 beyond the map.
struct Between {
  Index low, high;
  double share, slope;
};

Between find(const std::vector<double>& heights, double height) {
  if (heights.size() == 1) return {0, 0, 0.0, 0.0};
  const Index last = static_cast<Index>(heights.size()) - 1;
  const Index high = std::clamp<Index>(index_in(heights, height), 1, last), low = high - 1;
  const double from = heights[static_cast<std::size_t>(low)],
               way = heights[static_cast<std::size_t>(high)] - from;
  const double share = (height - from) / way;
  if (share < 0.0) return {low, high, 0.0, 0.0};
  if (share > 1.0) return {low, high, 1.0, 0.0};
  return {low, high, share, 1.0 / way};
}

}  // namespace

std::string AeroMap::fault(const std::vector<Row>& rows) {
  if (rows.empty()) return "has no rows";
  std::set<double> front, rear;
  std::set<std::pair<double, double>> places;
  for (const Row& row : rows) {
    front.insert(row.front_height);
    rear.insert(row.rear_height);
    if (!places.emplace(row.front_height, row.rear_height).second)
      return fmt::format(
          "has two rows of the heights {:g} m and {:g} m", row.front_height, row.rear_height);
  }
  for (const double f : front)
    for (const double r : rear)
      if (!places.contains({f, r}))
        return fmt::format(
            "has no row of the heights {:g} m and {:g} m: each front height needs each rear height",
            f,
            r);
  return {};
}

void AeroMap::set_rows(const std::vector<Row>& rows) {
  assert(fault(rows).empty());
  std::set<double> front, rear;
  for (const Row& row : rows) {
    front.insert(row.front_height);
    rear.insert(row.rear_height);
  }
  front_heights_ = sorted(front);
  rear_heights_ = sorted(rear);
  front_.resize(static_cast<Index>(front.size()), static_cast<Index>(rear.size()));
  rear_.resizeLike(front_);
  for (const Row& row : rows) {
    const Index i = index_in(front_heights_, row.front_height),
                j = index_in(rear_heights_, row.rear_height);
    front_(i, j) = row.front;
    rear_(i, j) = row.rear;
  }
}

std::array<AeroMap::Heights, 2> AeroMap::heights() const {
  const auto heights_of = [](const std::vector<double>& heights) -> Heights {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (heights.size() == 1) return {-kInfinity, kInfinity};
    return {heights.front(), heights.back()};
  };
  return {heights_of(front_heights_), heights_of(rear_heights_)};
}

AeroMap::Coefficients AeroMap::at(double front_height, double rear_height) const {
  const Between f = find(front_heights_, front_height), r = find(rear_heights_, rear_height);
  Coefficients all;
  for (const auto& [row, table] : {std::pair{0, &front_}, {1, &rear_}}) {
    const double at_low =
                     (1.0 - r.share) * (*table)(f.low, r.low) + r.share * (*table)(f.low, r.high),
                 at_high =
                     (1.0 - r.share) * (*table)(f.high, r.low) + r.share * (*table)(f.high, r.high);
    const double low_by_r = (*table)(f.low, r.high) - (*table)(f.low, r.low),
                 high_by_r = (*table)(f.high, r.high) - (*table)(f.high, r.low);
    all.downforce[row] = (1.0 - f.share) * at_low + f.share * at_high;
    all.by_height(row, 0) = f.slope * (at_high - at_low);
    all.by_height(row, 1) = r.slope * ((1.0 - f.share) * low_by_r + f.share * high_by_r);
  }
  return all;
}

}  // namespace latsch::car
