// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/inp_cords.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "formats/mesh/ccx_cords.h"
#include "models/fe_tire/element/cord_law.h"

namespace latsch::formats {
namespace {

using fe_tire::CordLayer;

constexpr double kThickness = 1e-3;  // m, of every layer
constexpr double kSameDepth = 1e-4;
/// Relative difference up to which two springs belong to the same layer.
constexpr double kSameLayer = 1e-5;
/// Share of the largest force: if the law of a spring deviates more from the law of cords, it is no
/// cord.
constexpr double kSameForce = 1e-3;

/// A layer in an element: its position in depth, and its cords with moduli and density for the
/// thickness kThickness.
struct Part {
  double depth = 0.0;
  CordLayer cords;
};

class CordPlacer {
 public:
  CordPlacer(const InpDeck& deck,
             const InpHosts& hosts,
             const std::function<Eigen::Vector3d(int)>& place,
             const std::function<std::array<int, 2>(int)>& line,
             InpPlacedRebars& placed)
      : deck_(deck), hosts_(hosts), place_(place), placed_(placed) {
    for (std::size_t e = 0; e < hosts.elements.size(); ++e)
      for (const int corner : hosts.elements[e])
        for (const int node : line(corner)) elements_at_[node].insert(static_cast<int>(e));
  }

  void place() {
    for (const InpSpring& spring : deck_.springs) {
      const auto [host, part] = part_of(spring);
      placed_.of_element[static_cast<std::size_t>(host)].push_back({layer(part.cords), part.depth});
    }
  }

 private:
  Hex corners_of(int e) const {
    Hex X;
    for (int a = 0; a < 8; ++a)
      X.col(a) = hosts_.X.col(hosts_.elements[static_cast<std::size_t>(e)][a]);
    return X;
  }

  /// Returns the elements whose corners carry both ends of the spring.
  std::set<int> candidates(const InpSpring& spring) const {
    std::set<int> all;
    bool first = true;
    for (const int end : spring.node) {
      const auto mean = deck_.means.find(end);
      if (mean == deck_.means.end())
        refuse(spring, fmt::format("node {} is held at no mean of other nodes", end));
      for (const auto& [node, weight] : mean->second.weights) {
        const auto index = hosts_.of_node.find(node);
        const auto at =
            index == hosts_.of_node.end() ? elements_at_.end() : elements_at_.find(index->second);
        if (at == elements_at_.end())
          refuse(spring, fmt::format("node {} is not of the tire", node));
        if (first) all = at->second;
        std::erase_if(all, [&](int e) { return !at->second.count(e); });
        first = false;
      }
    }
    return all;
  }

  std::pair<int, Part> part_of(const InpSpring& spring) const {
    const Eigen::Vector3d from = place_(spring.node[0]), to = place_(spring.node[1]);
    int host = -1;
    Eigen::Vector3d a, b;
    for (const int e : candidates(spring)) {
      const auto first = local_coordinates(corners_of(e), from);
      const auto second = local_coordinates(corners_of(e), to);
      const auto inside = [](const Eigen::Vector3d& at) {
        return at.cwiseAbs().maxCoeff() < 1.0 + kSameDepth;
      };
      if (!first || !second || !inside(*first) || !inside(*second)) continue;
      // if the cord lies between two elements, the inner one is chosen as host
      if (host >= 0 && first->z() < a.z()) continue;
      host = e;
      a = *first;
      b = *second;
    }
    if (host < 0 || std::abs(a.z() - b.z()) > kSameDepth || (a + b).head<2>().norm() > kSameDepth)
      refuse(spring, "it does not lead at one depth through the middle of one element");
    Part part;
    part.depth = std::clamp(0.5 * (a.z() + b.z()), -1.0, 1.0);
    const CordSurface surface(corners_of(host), part.depth);
    const Eigen::Vector3d along = surface.tangents() * (b - a).head<2>();
    const Eigen::Vector2d d = surface.axes().transpose() * along;
    part.cords = law_of(spring, (to - from).norm(), surface.area());
    part.cords.angle = std::atan2(d[1], d[0]);
    // Angles of cords that differ by 180 degrees are equal; they are stored above -90 and up to 90
    // degrees.
    const double half = 0.5 * std::numbers::pi;
    if (part.cords.angle > half + kSameDepth) part.cords.angle -= 2.0 * half;
    if (part.cords.angle <= -half + kSameDepth) part.cords.angle += 2.0 * half;
    return {host, part};
  }

  /// Returns the cord law whose moduli are scaled so that the layer has the thickness kThickness.
  CordLayer law_of(const InpSpring& spring, double length, double surface) const {
    const double force = deck_.units.force, meter = deck_.units.length;
    // The cross section of the cord times its length is kThickness times the area of the layer's
    // surface.
    const double area = kThickness * surface / length;
    std::vector<double> e, S;
    for (const InpSpring::Point& point : spring.law) {
      const double lambda = 1.0 + point.elongation * meter / length;
      e.push_back(0.5 * (lambda * lambda - 1.0));
      S.push_back(point.force * force / (area * lambda));
    }
    const std::size_t last = e.size() - 1;
    CordLayer cords;
    cords.thickness = kThickness;
    cords.E_tension = (S[last] - S[last - 1]) / (e[last] - e[last - 1]);
    cords.E_compression = (S[1] - S[0]) / (e[1] - e[0]);
    const auto middle = std::min_element(
        e.begin(), e.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    if (!(cords.E_tension > 0.0) || std::abs(*middle) > 1e-9)
      refuse(spring, "its force does not rise from an elongation of 0 on");
    if (cords.E_compression < kSameLayer * cords.E_tension) cords.E_compression = 0.0;
    cords.pretension = S[static_cast<std::size_t>(middle - e.begin())];
    const double largest = std::abs(*std::max_element(
        S.begin(), S.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    if (std::abs(cords.pretension) < kSameLayer * kSameLayer * largest) cords.pretension = 0.0;
    for (std::size_t i = 0; i <= last; ++i)
      if (std::abs(fe_tire::stress(cords, e[i]).S - S[i]) > kSameForce * largest)
        refuse(spring,
               "its force is not that of cords with one modulus in tension and one in compression");
    double mass = 0.0;
    for (const int node : spring.node)
      if (const auto at = deck_.masses.find(node); at != deck_.masses.end())
        mass += at->second * deck_.units.mass;
    cords.density = mass / (kThickness * surface);
    return cords;
  }

  [[noreturn]] static void refuse(const InpSpring& spring, const std::string& why) {
    throw InputError(
        spring.place,
        fmt::format(
            "spring {} is no cord as latsch export --ccx writes it: {}", spring.number, why));
  }

  int layer(const CordLayer& cords) {
    const auto same = [](double a, double b, double scale) {
      return std::abs(a - b) <= kSameLayer * scale;
    };
    for (std::size_t i = 0; i < placed_.layers.size(); ++i) {
      if (placed_.layers[i].cords < 0) continue;
      const CordLayer& known = placed_.cords[static_cast<std::size_t>(placed_.layers[i].cords)];
      if (same(known.E_tension, cords.E_tension, cords.E_tension) &&
          same(known.E_compression, cords.E_compression, cords.E_tension) &&
          same(known.pretension, cords.pretension, cords.E_tension) &&
          same(known.density, cords.density, cords.density) && same(known.angle, cords.angle, 1.0))
        return static_cast<int>(i);
    }
    placed_.layers.push_back({-1, 1, static_cast<int>(placed_.cords.size())});
    placed_.cords.push_back(cords);
    return static_cast<int>(placed_.layers.size()) - 1;
  }

  const InpDeck& deck_;
  const InpHosts& hosts_;
  const std::function<Eigen::Vector3d(int)>& place_;
  InpPlacedRebars& placed_;
  std::map<int, std::set<int>> elements_at_;
};

}  // namespace

void place_cords(const InpDeck& deck,
                 const InpHosts& hosts,
                 const std::function<Eigen::Vector3d(int)>& place,
                 const std::function<std::array<int, 2>(int)>& line,
                 InpPlacedRebars& placed) {
  if (!deck.springs.empty()) CordPlacer(deck, hosts, place, line, placed).place();
}

}  // namespace latsch::formats
