// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/rotational_symmetry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

namespace latsch::formats {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
// Tolerance of positions relative to the radius of the tire; decks have seven digits or more.
constexpr double kTolerance = 2e-6;

/// Node positions as (angle, ring); a ring is a set of nodes with equal radius and axial position.
class Rings {
 public:
  explicit Rings(const Eigen::Matrix3Xd& X) : angle_(X.cols()), ring_(X.cols()) {
    const double radius = X.colwise().norm().maxCoeff();
    tolerance_ = kTolerance * radius;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      angle_[i] = std::atan2(X(0, i), -X(2, i));
      ring_[i] = ring_of(X(1, i), std::hypot(X(0, i), X(2, i)));
      members_[ring_[i]].push_back(static_cast<int>(i));
    }
    angular_tolerance_ = kTolerance * radius / smallest_radius_;
    for (auto& ring : members_)
      std::sort(ring.begin(), ring.end(), [&](int a, int b) { return angle_[a] < angle_[b]; });
  }

  double angle(int node) const { return angle_[node]; }
  /// Returns the nodes of every ring in the order of their angles.
  const std::vector<std::vector<int>>& members() const { return members_; }
  double angular_tolerance() const { return angular_tolerance_; }

  int common_count() const {
    int count = 0;
    for (const auto& ring : members_) count = std::gcd(count, static_cast<int>(ring.size()));
    return count;
  }

  /// Returns for every node its image after a rotation by 2 pi / S; nothing if there is no node at
  /// an image.
  std::optional<std::vector<int>> turned(int S) const {
    std::vector<int> image(angle_.size());
    for (const auto& ring : members_) {
      const int n = static_cast<int>(ring.size()), step = n / S;
      for (int i = 0; i < n; ++i) {
        const int to = ring[(i + step) % n];
        const double error = std::remainder(angle_[to] - angle_[ring[i]] - kTurn / S, kTurn);
        if (std::abs(error) > angular_tolerance_) return {};
        image[ring[i]] = to;
      }
    }
    return image;
  }

 private:
  /// Returns the ring at (y, r). Rings are found by a grid whose cells have the size of the
  /// tolerance; neighboring cells are searched too.
  int ring_of(double y, double r) {
    if (members_.empty() || r < smallest_radius_) smallest_radius_ = r;
    const double cell = 4.0 * tolerance_;
    const auto iy = std::llround(y / cell), ir = std::llround(r / cell);
    for (auto dy = iy - 1; dy <= iy + 1; ++dy)
      for (auto dr = ir - 1; dr <= ir + 1; ++dr)
        if (const auto found = cells_.find({dy, dr}); found != cells_.end()) {
          const auto& [y0, r0, index] = found->second;
          if (std::hypot(y - y0, r - r0) < tolerance_) return index;
        }
    const int index = static_cast<int>(members_.size());
    members_.emplace_back();
    cells_[{iy, ir}] = {y, r, index};
    return index;
  }

  struct Cell {
    double y, r;
    int index;
  };
  std::vector<double> angle_;
  std::vector<int> ring_;
  std::vector<std::vector<int>> members_;
  std::map<std::pair<long long, long long>, Cell> cells_;
  double tolerance_ = 0.0, angular_tolerance_ = 0.0, smallest_radius_ = 0.0;
};

bool maps_elements(const RingOfNodes& ring, const std::vector<int>& image) {
  std::map<HexNodes, std::int64_t> known;
  for (std::size_t e = 0; e < ring.elements.size(); ++e) known[ring.elements[e]] = ring.kind[e];
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    HexNodes turned = ring.elements[e];
    for (int& node : turned) node = image[node];
    const auto found = known.find(turned);
    if (found == known.end() || found->second != ring.kind[e]) return false;
  }
  return true;
}

bool maps_held(const RingOfNodes& ring, const std::vector<int>& image) {
  for (std::size_t i = 0; i < image.size(); ++i)
    if (ring.held[i] != ring.held[image[i]]) return false;
  return true;
}

/// Returns the sector number of every node, counted from the first angle at or after the bottom.
std::vector<int> sector_numbers(const RingOfNodes& ring, const Rings& rings, int S) {
  const double tolerance = 4.0 * rings.angular_tolerance();
  const double first = -tolerance;
  std::vector<int> sector(ring.X.cols());
  for (Eigen::Index i = 0; i < ring.X.cols(); ++i) {
    double angle = rings.angle(static_cast<int>(i)) - first;
    if (angle < 0.0) angle += kTurn;
    sector[i] = std::min(S - 1, static_cast<int>(angle * S / kTurn));
  }
  return sector;
}

/// Returns the sector formed by the elements that begin in sector 0; nothing if one of them extends
/// beyond the next sector.
std::optional<Sector> cut(const RingOfNodes& ring,
                          const Rings& rings,
                          const std::vector<int>& image,
                          int S) {
  const std::vector<int> number = sector_numbers(ring, rings, S);
  Sector sector;
  sector.sectors = S;
  std::vector<int> own(ring.X.cols(), -1);
  for (Eigen::Index i = 0; i < ring.X.cols(); ++i)
    if (number[i] == 0) {
      own[i] = static_cast<int>(sector.nodes.size());
      sector.nodes.push_back(static_cast<int>(i));
    }
  const int n = static_cast<int>(sector.nodes.size());
  if (n * S != ring.X.cols()) return {};
  std::vector<int> next(ring.X.cols(), -1);
  for (int i = 0; i < n; ++i) next[image[sector.nodes[i]]] = i;
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    HexNodes nodes = ring.elements[e];
    bool starts = false, inside = true;
    for (int& node : nodes) {
      starts = starts || own[node] >= 0;
      inside = inside && (own[node] >= 0 || next[node] >= 0);
      node = own[node] >= 0 ? own[node] : next[node] + n;
    }
    if (!starts || !inside) continue;
    sector.elements.push_back(static_cast<int>(e));
    sector.connectivity.push_back(nodes);
  }
  if (sector.elements.size() * S != ring.elements.size()) return {};
  return sector;
}

/// The planes between sectors of unequal width: their angles and, for every node, the ring of nodes
/// and the plane to which it belongs.
struct Planes {
  std::vector<double> theta;
  std::vector<int> ring, plane;
};

/// Returns the planes; nothing if a ring has no node in one of them.
std::optional<Planes> find_planes(const RingOfNodes& ring, const Rings& rings) {
  const double tolerance = 4.0 * rings.angular_tolerance();
  const auto from_bottom = [&](int node) {
    const double angle = rings.angle(node);
    return angle < -tolerance ? angle + kTurn : std::max(angle, 0.0);
  };
  Planes planes;
  planes.ring.resize(ring.X.cols());
  planes.plane.resize(ring.X.cols());
  for (std::size_t r = 0; r < rings.members().size(); ++r) {
    std::vector<int> nodes = rings.members()[r];
    std::sort(
        nodes.begin(), nodes.end(), [&](int a, int b) { return from_bottom(a) < from_bottom(b); });
    if (r == 0)
      for (const int node : nodes) planes.theta.push_back(from_bottom(node));
    if (nodes.size() != planes.theta.size()) return {};
    for (std::size_t p = 0; p < nodes.size(); ++p) {
      if (std::abs(from_bottom(nodes[p]) - planes.theta[p]) > tolerance) return {};
      planes.ring[nodes[p]] = static_cast<int>(r);
      planes.plane[nodes[p]] = static_cast<int>(p);
    }
  }
  const std::size_t S = planes.theta.size();
  if (S < 3 || planes.theta[0] > tolerance) return {};
  planes.theta[0] = 0.0;
  for (std::size_t s = 1; s <= S / 2; ++s) {
    double &near = planes.theta[s], &far = planes.theta[S - s];
    if (std::abs(near + far - kTurn) > 2.0 * tolerance) return {};
    near = 0.5 * (near + kTurn - far);
    far = kTurn - near;
  }
  return planes;
}

/// Returns one of the unequal sectors; nothing if they do not have the same elements.
std::optional<Sector> cut_unequal(const RingOfNodes& ring, const Rings& rings) {
  const auto planes = find_planes(ring, rings);
  if (!planes) return {};
  const int S = static_cast<int>(planes->theta.size());
  const int n = static_cast<int>(rings.members().size());
  std::vector<int> at(static_cast<std::size_t>(n) * S);
  for (Eigen::Index i = 0; i < ring.X.cols(); ++i) at[planes->plane[i] * n + planes->ring[i]] = i;
  for (std::size_t i = 0; i < at.size(); ++i)
    if (ring.held[at[i]] != ring.held[at[i % n]]) return {};
  // The elements of every sector: their nodes as numbers within the sector, and their kinds.
  std::vector<std::map<HexNodes, std::int64_t>> kinds(S);
  std::vector<std::pair<HexNodes, int>> first;
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    HexNodes nodes = ring.elements[e];
    int low = S;
    bool wraps = false;
    for (const int node : nodes) low = std::min(low, planes->plane[node]);
    for (const int node : nodes) wraps = wraps || planes->plane[node] == S - 1;
    const int sector = low == 0 && wraps ? S - 1 : low;
    for (int& node : nodes) {
      const int ahead = (planes->plane[node] - sector + S) % S;
      if (ahead > 1) return {};
      node = planes->ring[node] + n * ahead;
    }
    kinds[sector][nodes] = ring.kind[e];
    if (sector == 0) first.emplace_back(nodes, static_cast<int>(e));
  }
  for (const auto& sector : kinds)
    if (sector != kinds[0]) return {};
  Sector sector;
  sector.sectors = S;
  sector.theta = planes->theta;
  sector.nodes.assign(at.begin(), at.begin() + n);
  for (const auto& [nodes, element] : first) {
    sector.elements.push_back(element);
    sector.connectivity.push_back(nodes);
  }
  return sector;
}

Sector whole(const RingOfNodes& ring) {
  Sector sector;
  sector.nodes.resize(ring.X.cols());
  std::iota(sector.nodes.begin(), sector.nodes.end(), 0);
  sector.elements.resize(ring.elements.size());
  std::iota(sector.elements.begin(), sector.elements.end(), 0);
  sector.connectivity = ring.elements;
  return sector;
}

}  // namespace

Sector find_sector(const RingOfNodes& ring) {
  if (ring.X.cols() == 0) return whole(ring);
  const Rings rings(ring.X);
  const int common = rings.common_count();
  for (int S = common; S >= 3; --S) {
    if (common % S != 0) continue;
    const auto image = rings.turned(S);
    if (!image || !maps_held(ring, *image) || !maps_elements(ring, *image)) continue;
    if (auto sector = cut(ring, rings, *image, S)) return *sector;
  }
  if (auto sector = cut_unequal(ring, rings)) return *sector;
  return whole(ring);
}

}  // namespace latsch::formats
