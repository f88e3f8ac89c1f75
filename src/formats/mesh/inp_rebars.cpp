// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/inp_rebars.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace latsch::formats {
namespace {

/// Tolerance for the distance between a corner of a surface element and the side of its host, and
/// for the deviation from constant depth, as a share of half the host's size. A larger value
/// accepts more skewed layers.
constexpr double kOffSide = 0.02;
constexpr double kXiOfNodes[8] = {-1, 1, 1, -1, -1, 1, 1, -1},
                 kEta[8] = {-1, -1, 1, 1, -1, -1, 1, 1}, kZeta[8] = {-1, -1, -1, -1, 1, 1, 1, 1};

}  // namespace

std::optional<Eigen::Vector3d> local_coordinates(const Hex& X, const Eigen::Vector3d& x) {
  constexpr int kMostSteps = 25;
  constexpr double kFar = 4.0, kConverged = 1e-12;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::Vector3d value = -x;
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
    for (int a = 0; a < 8; ++a) {
      const Eigen::Vector3d sign(kXiOfNodes[a], kEta[a], kZeta[a]);
      const Eigen::Vector3d one = Eigen::Vector3d::Ones() + sign.cwiseProduct(at);
      value += 0.125 * one.prod() * X.col(a);
      const Eigen::Vector3d gradient(
          sign[0] * one[1] * one[2], sign[1] * one[0] * one[2], sign[2] * one[0] * one[1]);
      slope += 0.125 * X.col(a) * gradient.transpose();
    }
    const Eigen::Vector3d change = slope.partialPivLu().solve(-value);
    at += change;
    if (!at.allFinite() || at.cwiseAbs().maxCoeff() > kFar) return std::nullopt;
    if (change.norm() < kConverged) return at;
  }
  return std::nullopt;
}

namespace {

class Placer {
 public:
  Placer(const InpDeck& deck,
         const InpHosts& hosts,
         const std::function<Eigen::Vector3d(int)>& place)
      : deck_(deck), hosts_(hosts), place_(place) {
    placed_.of_element.resize(hosts.elements.size());
    for (std::size_t e = 0; e < hosts.elements.size(); ++e) {
      const Hex X = corners_of(static_cast<int>(e));
      cell_ = std::max(cell_, (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).maxCoeff());
    }
    for (std::size_t e = 0; e < hosts.elements.size(); ++e) {
      const Hex X = corners_of(static_cast<int>(e));
      const Cell low = cell_of(X.rowwise().minCoeff()), high = cell_of(X.rowwise().maxCoeff());
      for (int i = low[0]; i <= high[0]; ++i)
        for (int j = low[1]; j <= high[1]; ++j)
          for (int k = low[2]; k <= high[2]; ++k) cells_[{i, j, k}].push_back(static_cast<int>(e));
    }
    for (const InpEmbedding& embedding : deck.embeddings)
      for (const std::string& elset : embedding.elsets)
        for (const int number : deck.element_sets.at(elset)) embedding_of_[number] = &embedding;
  }

  InpPlacedRebars place() {
    for (std::size_t r = 0; r < deck_.rebars.size(); ++r) {
      const InpRebars& rebars = deck_.rebars[r];
      expect_circumference(rebars);
      for (const int number : deck_.element_sets.at(rebars.elset)) {
        const auto element = deck_.surface_elements.find(number);
        if (element == deck_.surface_elements.end())
          throw InputError(
              rebars.place,
              fmt::format(
                  "rebars {} are in element {}, expected elements SFM3D4", rebars.name, number));
        put(static_cast<int>(r), element->second);
      }
    }
    return std::move(placed_);
  }

 private:
  using Cell = std::array<int, 3>;

  Hex corners_of(int e) const {
    Hex X;
    for (int a = 0; a < 8; ++a)
      X.col(a) = hosts_.X.col(hosts_.elements[static_cast<std::size_t>(e)][a]);
    return X;
  }

  Cell cell_of(const Eigen::Vector3d& x) const {
    Cell cell;
    for (int d = 0; d < 3; ++d) cell[d] = static_cast<int>(std::floor(x[d] / cell_));
    return cell;
  }

  void expect_circumference(const InpRebars& rebars) const {
    const InpOrientation* orientation =
        rebars.orientation.empty() ? nullptr : &deck_.orientations.at(rebars.orientation);
    if (!orientation || !orientation->cylindrical)
      throw InputError(rebars.place,
                       fmt::format("rebars {} need an ORIENTATION that is cylindrical about the "
                                   "spin axis: their angle counts from the circumference",
                                   rebars.name));
    if (orientation->axis != 1 ||
        (orientation->angle >= 0 && deck_.value(orientation->angle) != 0.0))
      throw InputError(orientation->place,
                       fmt::format("the orientation of rebars {} is turned, expected none about "
                                   "its axis 1: turn the rebars",
                                   rebars.name));
  }

  /// Returns the elements that may contain the surface element, in ascending order.
  std::vector<int> candidates(const InpSurfaceElement& element, const Eigen::Vector3d& middle) {
    const bool shares = std::all_of(element.node.begin(), element.node.end(), [&](int node) {
      return hosts_.of_node.count(node) > 0;
    });
    const auto embedding = embedding_of_.find(element.number);
    if (!shares && embedding == embedding_of_.end())
      throw InputError(element.place,
                       fmt::format("surface element {} has nodes of its own, expected it to be an "
                                   "*EMBEDDED ELEMENT",
                                   element.number));
    std::vector<int> found = cells_[cell_of(middle)];
    if (embedding == embedding_of_.end() || embedding->second->host.empty()) return found;
    const std::set<int>& host = host_set(embedding->second->host);
    std::erase_if(found, [&](int e) { return !host.count(e); });
    return found;
  }

  const std::set<int>& host_set(const std::string& name) {
    const auto [entry, is_new] = host_sets_.try_emplace(name);
    if (is_new)
      for (const int number : deck_.element_sets.at(name))
        if (const auto e = hosts_.of_number.find(number); e != hosts_.of_number.end())
          entry->second.insert(e->second);
    return entry->second;
  }

  /// Returns the depth of the surface element in element e; nothing if the surface element does not
  /// extend from side to side at constant depth.
  std::optional<double> depth_in(int e, const Eigen::Matrix<double, 3, 4>& x) const {
    const Hex X = corners_of(e);
    double lowest = 2.0, highest = -2.0;
    std::set<std::pair<bool, bool>> sides;
    for (int a = 0; a < 4; ++a) {
      const auto at = local_coordinates(X, x.col(a));
      if (!at || std::abs(std::abs(at->x()) - 1.0) > kOffSide ||
          std::abs(std::abs(at->y()) - 1.0) > kOffSide)
        return std::nullopt;
      sides.insert({at->x() > 0.0, at->y() > 0.0});
      lowest = std::min(lowest, at->z());
      highest = std::max(highest, at->z());
    }
    if (sides.size() != 4 || highest - lowest > kOffSide || lowest < -1.0 - kOffSide ||
        highest > 1.0 + kOffSide)
      return std::nullopt;
    return std::clamp(0.5 * (lowest + highest), -1.0, 1.0);
  }

  void put(int rebars, const InpSurfaceElement& element) {
    Eigen::Matrix<double, 3, 4> x;
    for (int a = 0; a < 4; ++a) x.col(a) = place_(element.node[a]);
    int host = -1;
    double depth = 0.0;
    for (const int e : candidates(element, x.rowwise().mean())) {
      const auto zeta = depth_in(e, x);
      // if the rebar lies between two elements, the inner one is chosen as host
      if (!zeta || (host >= 0 && *zeta <= depth)) continue;
      host = e;
      depth = *zeta;
    }
    if (host < 0)
      throw InputError(element.place,
                       fmt::format("surface element {} does not go through one solid element of "
                                   "the tire from side to side at one depth, expected it to",
                                   element.number));
    const Eigen::Vector3d normal = (x.col(2) - x.col(0)).cross(x.col(3) - x.col(1));
    const int sign = normal.dot(span(corners_of(host), {2, 1})) > 0.0 ? 1 : -1;
    placed_.of_element[static_cast<std::size_t>(host)].push_back({layer({rebars, sign}), depth});
  }

  int layer(const InpLayer& wanted) {
    const auto found = std::find(placed_.layers.begin(), placed_.layers.end(), wanted);
    if (found == placed_.layers.end()) {
      placed_.layers.push_back(wanted);
      return static_cast<int>(placed_.layers.size()) - 1;
    }
    return static_cast<int>(found - placed_.layers.begin());
  }

  const InpDeck& deck_;
  const InpHosts& hosts_;
  const std::function<Eigen::Vector3d(int)>& place_;
  double cell_ = 0.0;
  std::map<Cell, std::vector<int>> cells_;
  std::map<int, const InpEmbedding*> embedding_of_;
  std::map<std::string, std::set<int>> host_sets_;
  InpPlacedRebars placed_;
};

}  // namespace

InpPlacedRebars place_rebars(const InpDeck& deck,
                             const InpHosts& hosts,
                             const std::function<Eigen::Vector3d(int node)>& place) {
  if (deck.rebars.empty())
    return {{}, {}, std::vector<std::vector<fe_tire::RebarPlacement>>(hosts.elements.size())};
  return Placer(deck, hosts, place).place();
}

}  // namespace latsch::formats
