// SPDX-License-Identifier: Apache-2.0
// Checks the friction ellipse of a tire against the convex hull of its forces.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "models/magic_formula/sanity/sanity_checks.h"

namespace latsch::magic_formula {
namespace {

// Smallest force in a direction, as a share of the convex hull of the forces.
constexpr double kConvex = 0.8;

struct Point {
  double x, y;
};

/// The convex hull of points, counterclockwise [Andrew, Inf. Process. Lett. 9 (1979) 216].
std::vector<Point> hull_of(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  });
  const auto turn = [](const Point& o, const Point& a, const Point& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  };
  std::vector<Point> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Point& point : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0.0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Returns the distance from the origin to the boundary of a polygon in a direction (rad).
double reach(const std::vector<Point>& hull, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  double most = 0.0;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Point &a = hull[k], &b = hull[(k + 1) % hull.size()];
    const double across_a = c * a.y - s * a.x, across_b = c * b.y - s * b.x;
    if ((across_a > 0.0) == (across_b > 0.0)) continue;
    const double t = across_a / (across_a - across_b);
    most = std::max(most, c * (a.x + t * (b.x - a.x)) + s * (a.y + t * (b.y - a.y)));
  }
  return most;
}

}  // namespace

WorstViolation ellipse_is_convex(const Parameters& p, const Lattice& at) {
  constexpr int kAlphas = 61, kKappas = 61, kDirections = 64;
  const MagicFormula tire(p);
  WorstViolation found;
  for (const double Fz : {at.loads.front(), at.loads[at.loads.size() / 2], at.loads.back()}) {
    std::vector<Point> forces;
    std::vector<double> farthest(kDirections, 0.0);
    std::vector<State> states;
    for (int i = 0; i < kAlphas; ++i)
      for (int k = 0; k < kKappas; ++k)  // points are denser where the forces are steep
        states.push_back({Fz,
                          at.kappa * std::pow(2.0 * k / (kKappas - 1) - 1.0, 3),
                          at.alpha * std::pow(2.0 * i / (kAlphas - 1) - 1.0, 3),
                          0.0,
                          0.0,
                          at.speed,
                          at.nominal_pressure});
    std::vector<SteadyState> answers(states.size());
    tire.evaluate(states, answers);
    for (const SteadyState& s : answers) {
      forces.push_back({s.Fx, s.Fy});
      const double turns = std::atan2(s.Fy, s.Fx) / (2.0 * std::numbers::pi) + 1.0;
      double& far = farthest[static_cast<std::size_t>(turns * kDirections) % kDirections];
      far = std::max(far, std::hypot(s.Fx, s.Fy));
    }
    const std::vector<Point> hull = hull_of(std::move(forces));
    for (int d = 0; d < kDirections; ++d) {
      const double angle = 2.0 * std::numbers::pi * (d + 0.5) / kDirections;
      const double whole = reach(hull, angle);
      if (!(whole > 0.0)) continue;
      const double share = farthest[static_cast<std::size_t>(d)] / whole;
      found.worsen(kConvex - share, [&] {
        return fmt::format(
            "the friction ellipse is dented: {:.0f} % of its convex hull {:.0f} deg "
            "from Fx, at {:.0f} N",
            100.0 * share,
            angle * 180.0 / std::numbers::pi,
            Fz);
      });
    }
  }
  return found;
}

}  // namespace latsch::magic_formula
