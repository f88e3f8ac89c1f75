// SPDX-License-Identifier: Apache-2.0
// Tests profiles with many points, which are evaluated with a look-up table, against a search
// through all points. Positions are between points, on points, on flanks and beyond both ends.
#include "models/road/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace latsch::road {
namespace {

/// Returns the reference height: interpolated between the last point before s and the first one
/// after it, or the highest of the points at s.
double height_by_a_walk(const std::vector<Profile::Point>& points, double s) {
  if (s < points.front().s) return points.front().z;
  if (s > points.back().s) return points.back().z;
  double highest = -1e9;
  for (const auto& p : points)
    if (p.s == s) highest = std::max(highest, p.z);
  if (highest > -1e9) return highest;
  std::size_t i = 0;
  while (points[i].s < s) ++i;
  const auto &left = points[i - 1], &right = points[i];
  return left.z + (right.z - left.z) / (right.s - left.s) * (s - left.s);
}

TEST(Profile, OfManyPointsFindsThePieceThatAWalkDoes) {
  RandomStream random(3, 1);
  for (const bool even : {true, false}) {
    std::vector<Profile::Point> points;
    double s = -1.0;
    for (int i = 0; i < 300; ++i) {
      // With uneven spacing, many points are close to each other, gaps are up to a thousand times
      // as wide, and every tenth pair of points is a vertical flank.
      const double x = random.uniform();
      if (i > 0) s += even ? 0.01 : i % 10 == 0 ? 0.0 : 0.1 * std::pow(x, 8);
      points.push_back({s, random.uniform()});
    }
    const Profile profile(points);
    std::vector<double> places = {points.front().s - 1.0, points.back().s + 1.0};
    for (const auto& p : profile.points()) places.push_back(p.s);
    for (int i = 0; i < 3000; ++i)
      places.push_back(points.front().s - 0.1 +
                       (points.back().s - points.front().s + 0.2) * random.uniform());
    for (const double at : places)
      EXPECT_EQ(profile.at(at).height, height_by_a_walk(profile.points(), at)) << even << " " << at;
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      const double from = std::min(places[i], places[i + 1]),
                   to = std::max(places[i], places[i + 1]);
      const auto all = profile.points();
      const auto expected = std::count_if(
          all.begin(), all.end(), [&](const auto& p) { return p.s >= from && p.s <= to; });
      EXPECT_EQ(static_cast<std::ptrdiff_t>(profile.points_between(from, to).size()), expected);
    }
  }
}

TEST(Profile, AreaIsTheSumOfHeights) {
  RandomStream random(3, 2);
  for (const int count : {6, 300}) {
    std::vector<Profile::Point> points;
    for (int i = 0; i < count; ++i) points.push_back({0.01 * (i - i % 7 / 6), random.uniform()});
    const Profile profile(points);
    for (int i = 0; i < 50; ++i) {
      const double reach = 0.01 * count + 0.02;
      const double from = reach * random.uniform() - 0.01, to = reach * random.uniform() - 0.01;
      double sum = 0.0;
      constexpr int kPieces = 20000;
      const double piece = (to - from) / kPieces;
      for (int k = 0; k < kPieces; ++k) sum += piece * profile.at(from + (k + 0.5) * piece).height;
      // The reference sum smears a vertical flank over one piece, so the tolerance is proportional
      // to the length of a piece.
      EXPECT_NEAR(profile.area(to) - profile.area(from), sum, 60.0 * std::abs(piece)) << count;
    }
  }
}

}  // namespace
}  // namespace latsch::road
