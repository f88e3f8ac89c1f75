// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/contact/tread_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {
namespace {

/// Abscissae and weights of three Gauss points on [-1, 1].
constexpr double kThree[3] = {-0.77459666924148337704, 0.0, 0.77459666924148337704};
constexpr double kThreeWeight[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
/// Along each side of a facet: with eight, Fz where the patch is shorter than two facets is 1 % off
/// that of sixteen, with twelve not 0.1 %; with two, at Gauss' places, 24 %.
constexpr int kFacetPoints = 12;

/// Weights of four neighbors, the second and third being the ends of a face, and their derivatives
/// by u in [-1, 1].
struct Cubic {
  Eigen::Vector4d value, slope;
};

/// Slope at the middle one of three abscissae, of the parabola through them.
Eigen::Vector3d middle_slope(double h0, double h1) {
  return {-h1 / (h0 * (h0 + h1)), (h1 - h0) / (h0 * h1), h0 / (h1 * (h0 + h1))};
}

/// Slope at the first one of three abscissae.
Eigen::Vector3d end_slope(double h0, double h1) {
  return {-(2.0 * h0 + h1) / (h0 * (h0 + h1)), (h0 + h1) / (h0 * h1), -h0 / (h1 * (h0 + h1))};
}

/// Of a face of length h; h0 and h2 are those of its neighbors, none where the surface ends.
Cubic hermite(std::optional<double> h0, double h, std::optional<double> h2, double u) {
  Eigen::Vector4d m1 = Eigen::Vector4d::Zero(), m2 = Eigen::Vector4d::Zero();
  if (h0) {
    m1.head<3>() = middle_slope(*h0, h);
  } else if (h2) {
    m1.tail<3>() = end_slope(h, *h2);
  } else {
    m1.segment<2>(1) = Eigen::Vector2d(-1.0, 1.0) / h;
  }
  if (h2) {
    m2.tail<3>() = middle_slope(h, *h2);
  } else if (h0) {
    m2.head<3>() = -end_slope(h, *h0).reverse();
  } else {
    m2.segment<2>(1) = Eigen::Vector2d(-1.0, 1.0) / h;
  }
  const double t = 0.5 * (u + 1.0), r = 1.0 - t;
  Cubic cubic;
  cubic.value = h * (t * r * r * m1 - t * t * r * m2);
  cubic.value[1] += r * r * (1.0 + 2.0 * t);
  cubic.value[2] += t * t * (1.0 + 2.0 * r);
  cubic.slope = h * (r * (r - 2.0 * t) * m1 + t * (t - 2.0 * r) * m2);
  cubic.slope[1] -= 6.0 * t * r;
  cubic.slope[2] += 6.0 * t * r;
  cubic.slope *= 0.5;  // dt/du
  return cubic;
}

/// (T.3) of the node between the second and the third of four faces beside each other, those that
/// are there, by their lengths.
double share_of_uniform(const std::array<std::optional<double>, 4>& h) {
  // What a slope at a node adds: its faces' lengths squared over 12.
  const auto weight = [&h](int left) {
    return (*h[left + 1] * *h[left + 1] - *h[left] * *h[left]) / 12.0;
  };
  double more = 0.0;
  for (const int left : {0, 1, 2}) {  // face before a node whose slope this one tells
    if (!h[left] || !h[left + 1]) continue;
    more += weight(left) * middle_slope(*h[left], *h[left + 1])[2 - left];
  }
  return 1.0 - more / (0.5 * (h[1].value_or(0.0) + h[2].value_or(0.0)));
}

Cubic linear(double u) {
  return {{0.0, 0.5 * (1.0 - u), 0.5 * (1.0 + u), 0.0}, {0.0, -0.5, 0.5, 0.0}};
}

}  // namespace

/// Tread faces of a section, one beside the other: the nodes between them.
struct TreadSurface::Strip {
  std::vector<int> nodes;    // of the section
  std::vector<double> span;  // m, from one node to the next

  std::optional<double> span_at(int face) const {
    if (face < 0 || face >= static_cast<int>(span.size())) return std::nullopt;
    return span[face];
  }
};

/// Runs of tread faces; none where faces do not lie beside each other from plane to plane.
std::vector<TreadSurface::Strip> TreadSurface::strips_of(const Mesh& mesh) {
  const int n = mesh.nodes_per_sector();
  if (mesh.sectors == 1) return {};
  std::map<int, int> next;  // node -> node
  std::map<int, int> before;
  for (const Element& element : mesh.elements) {
    if (!element.tread) continue;
    const auto& node = element.node;
    if (node[5] != node[4] + n || node[6] != node[7] + n || node[4] >= n || node[7] >= n) return {};
    if (!next.emplace(node[4], node[7]).second || !before.emplace(node[7], node[4]).second)
      return {};
  }
  std::vector<Strip> strips;
  for (const auto& [first, second] : next) {
    if (before.contains(first)) continue;
    Strip& strip = strips.emplace_back();
    strip.nodes.push_back(first);
    for (auto at = next.find(first); at != next.end(); at = next.find(at->second)) {
      strip.nodes.push_back(at->second);
      strip.span.push_back((mesh.X.col(at->second) - mesh.X.col(at->first)).norm());
    }
  }
  return strips;
}

TreadSurface::TreadSurface(const RingUnknowns& unknowns, TreadShape shape, double half_angle)
    : unknowns_(unknowns), shape_(shape) {
  const Mesh& mesh = unknowns.ring().mesh();
  const int n = mesh.nodes_per_sector();
  const std::vector<Strip> strips = strips_of(mesh);
  if (strips.empty()) shape_ = TreadShape::facets;
  place_index_.assign(mesh.sectors, std::vector<int>(n, -1));
  std::vector<std::vector<bool>> is_here(mesh.sectors, std::vector<bool>(n, false));
  const auto is_near = [&](double angle) {
    return std::min(angle, 2.0 * std::numbers::pi - angle) < half_angle;
  };
  for (int s = 0; s < unknowns.sectors() && !strips.empty(); ++s) {
    if (!is_near(mesh.angle(s)) && !is_near(mesh.angle(s + 1))) continue;
    for (const Strip& strip : strips) {
      for (int f = 0; f < static_cast<int>(strip.span.size()); ++f) {
        if (shape_ == TreadShape::smooth) {
          const auto [grid, weights_at] = smooth_face(s, f, strip);
          add_samples({grid[5], grid[9], grid[10], grid[6]}, grid, weights_at);
          continue;
        }
        const int next = (s + 1) % mesh.sectors;
        add_facet({{{s, strip.nodes[f]},
                    {next, strip.nodes[f]},
                    {next, strip.nodes[f + 1]},
                    {s, strip.nodes[f + 1]}}});
        for (const int plane : {s, next})
          is_here[plane][strip.nodes[f]] = is_here[plane][strip.nodes[f + 1]] = true;
      }
    }
  }
  for (const Element& element : mesh.elements) {
    if (!element.tread || !strips.empty()) continue;
    std::array<std::pair<int, int>, 4> corner;
    bool near = false;
    for (int a = 0; a < 4; ++a) {
      corner[a] = {element.node[4 + a] / n % mesh.sectors, element.node[4 + a] % n};
      const Eigen::Vector3d X = mesh.frame(corner[a].first) * mesh.X.col(corner[a].second);
      near = near || std::abs(std::atan2(X.x(), -X.z())) < half_angle;
    }
    if (!near) continue;
    add_facet(corner);
    for (const auto& [plane, node] : corner) is_here[plane][node] = true;
  }
  const int planes = unknowns.multiplicity() > 1.0 ? unknowns.sectors() + 1 : mesh.sectors;
  for (int plane = 0; plane < planes && shape_ == TreadShape::smooth; ++plane) {
    if (!is_near(mesh.angle(plane))) continue;
    for (const Strip& strip : strips) {
      for (int j = 0; j < static_cast<int>(strip.nodes.size()); ++j) {
        add_mean_point(plane, j, strip);
        is_here[plane][strip.nodes[j]] = true;
      }
    }
  }
  for (const Element& element : mesh.elements) {
    for (int a = 4; element.tread && a < 8; ++a) {
      const int node = element.node[a] % n;
      for (int plane = 0; plane < planes; ++plane) {
        if (is_here[plane][node]) continue;
        is_here[plane][node] = true;
        beyond_.emplace_back(plane, node);
      }
    }
  }
  place_index_.clear();
}

int TreadSurface::place_of(int plane, int node) {
  int& index = place_index_[plane][node];
  if (index >= 0) return index;
  const Mesh& mesh = unknowns_.ring().mesh();
  const RingUnknowns::NodeUnknowns unknowns = unknowns_.of_node(plane, node);
  Place place{-1,
              mesh.frame(plane) * unknowns.sign.asDiagonal(),
              mesh.frame(plane) * mesh.X.col(node),
              plane,
              node};
  if (unknowns.first >= 0) {
    const auto known = std::ranges::find(nodes_, unknowns.first / 3);
    place.node = static_cast<int>(known - nodes_.begin());
    if (known == nodes_.end()) nodes_.push_back(unknowns.first / 3);
  }
  places_.push_back(place);
  index = static_cast<int>(places_.size()) - 1;
  return index;
}

TreadSurface::Point TreadSurface::point_at(const Grid& grid, const Tangents& at, double share) {
  Point point{static_cast<int>(weights_.size()), 0, share, 0.0, 0.0};
  Eigen::Vector3d along = Eigen::Vector3d::Zero(), across = along;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (grid[k] < 0) continue;
    along += at.by_u[k] * places_[grid[k]].X;
    across += at.by_v[k] * places_[grid[k]].X;
    weights_.push_back({grid[k], at.value[k], at.by_u[k], at.by_v[k]});
    ++point.weights;
  }
  point.dA = along.cross(across).norm() * share;
  point.around = along.norm() * std::sqrt(share);
  return point;
}

void TreadSurface::add_samples(const std::array<int, 4>& corner,
                               const Grid& grid,
                               const Weights& weights_at) {
  faces_.push_back({corner, static_cast<int>(samples_.size())});
  for (int j = 0; j < kSamples; ++j) {
    for (int i = 0; i < kSamples; ++i) {
      const auto place = [](int k) { return (2.0 * k + 1.0) / kSamples - 1.0; };
      constexpr double kShare = 4.0 / (kSamples * kSamples);
      samples_.push_back(point_at(grid, weights_at(place(i), place(j)), kShare));
    }
  }
}

void TreadSurface::add_facet(const std::array<std::pair<int, int>, 4>& corner) {
  Grid grid;
  for (const auto& [plane, node] : corner) grid.push_back(place_of(plane, node));
  const Weights weights_at = [](double u, double v) {
    const Cubic around = linear(u), across = linear(v);
    Tangents at;
    for (int a = 0; a < 4; ++a) {
      const int i = kXi[a] < 0.0 ? 1 : 2, j = kEta[a] < 0.0 ? 1 : 2;
      at.value[a] = around.value[i] * across.value[j];
      at.by_u[a] = around.slope[i] * across.value[j];
      at.by_v[a] = around.value[i] * across.slope[j];
    }
    return at;
  };
  const auto place = [](int k) { return (2.0 * k + 1.0) / kFacetPoints - 1.0; };
  constexpr double kShare = 4.0 / (kFacetPoints * kFacetPoints);
  for (int i = 0; i < kFacetPoints; ++i) {
    for (int j = 0; j < kFacetPoints; ++j)
      points_.push_back(point_at(grid, weights_at(place(i), place(j)), kShare));
  }
  add_samples({grid[0], grid[1], grid[2], grid[3]}, grid, weights_at);
}

/// Places and weights of the surface on a face.
std::pair<TreadSurface::Grid, TreadSurface::Weights> TreadSurface::smooth_face(int sector,
                                                                               int face,
                                                                               const Strip& strip) {
  const Mesh& mesh = unknowns_.ring().mesh();
  const int S = mesh.sectors;
  std::array<double, 4> theta;
  Grid grid;
  for (int i = 0; i < 4; ++i) {
    const int plane = sector - 1 + i, wrapped = (plane + S) % S;
    theta[i] = mesh.angle(wrapped) + (plane < 0 ? -1 : plane >= S ? 1 : 0) * 2.0 * std::numbers::pi;
    for (int j = 0; j < 4; ++j) {
      const int at = face - 1 + j;
      const bool is_there = at >= 0 && at < static_cast<int>(strip.nodes.size());
      grid.push_back(is_there ? place_of(wrapped, strip.nodes[at]) : -1);
    }
  }
  const auto before = strip.span_at(face - 1), after = strip.span_at(face + 1);
  const double span = strip.span[face];
  return {grid, [theta, before, span, after](double u, double v) {
            const Cubic around =
                hermite(theta[1] - theta[0], theta[2] - theta[1], theta[3] - theta[2], u);
            const Cubic across = hermite(before, span, after, v);
            Tangents at;
            for (int i = 0; i < 4; ++i) {
              for (int j = 0; j < 4; ++j) {
                at.value[4 * i + j] = around.value[i] * across.value[j];
                at.by_u[4 * i + j] = around.slope[i] * across.value[j];
                at.by_v[4 * i + j] = around.value[i] * across.slope[j];
              }
            }
            return at;
          }};
}

/// rad
double TreadSurface::width(int sector) const {
  const Mesh& mesh = unknowns_.ring().mesh();
  if (sector + 1 == mesh.sectors) return 2.0 * std::numbers::pi - mesh.angle(sector);
  return mesh.angle(sector + 1) - mesh.angle(sector);
}

/// What (T.1) adds at a node whose undeformed mean it has, by (T.2).
Eigen::Vector3d TreadSurface::offset_of(int plane,
                                        int node,
                                        const Strip& strip,
                                        const Eigen::Vector3d& mean) {
  const int S = unknowns_.ring().mesh().sectors, before = (plane - 1 + S) % S;
  Eigen::Vector3d along = Eigen::Vector3d::Zero(), across = along;
  for (const int sector : {before, plane}) {
    for (const int face : {node - 1, node}) {
      if (face < 0 || face >= static_cast<int>(strip.span.size())) continue;
      const auto [grid, weights_at] = smooth_face(sector, face, strip);
      const Tangents at = weights_at(sector == plane ? -1.0 : 1.0, face == node ? -1.0 : 1.0);
      for (std::size_t k = 0; k < grid.size(); ++k) {
        if (grid[k] < 0) continue;
        along += at.by_u[k] * places_[grid[k]].X;
        across += at.by_v[k] * places_[grid[k]].X;
      }
    }
  }
  const Eigen::Vector3d n = along.cross(across).normalized();
  const Eigen::Vector3d X = places_[place_of(plane, strip.nodes[node])].X;
  const double h0 = width(before), h1 = width(plane);
  const Eigen::Vector3d radial(X.x(), 0.0, X.z());
  const double around = n.dot(radial) * (h0 * h0 * h0 + h1 * h1 * h1) / (12.0 * (h0 + h1));
  const double all = n.dot(X - mean);
  const double most = std::abs(around);  // below the widest place n points to the axis
  return 0.5 * n * (around + std::clamp(all - around, -most, most));
}

/// (T.1) of a node of a strip, by three Gauss points along each side of the faces around it. Where
/// half the ring stands for all of it, half of a node on its own image's plane belongs to the
/// image.
void TreadSurface::add_mean_point(int plane, int node, const Strip& strip) {
  const int S = unknowns_.ring().mesh().sectors;
  std::map<int, double> mean;  // by place
  double area = 0.0;
  for (const int side : {-1, 0}) {
    for (const int face : {node - 1, node}) {
      if (face < 0 || face >= static_cast<int>(strip.span.size())) continue;
      const auto [grid, weights_at] = smooth_face((plane + side + S) % S, face, strip);
      for (int q = 0; q < 9; ++q) {
        const double u = kThree[q % 3], v = kThree[q / 3];
        const Tangents at = weights_at(u, v);
        Eigen::Vector3d along = Eigen::Vector3d::Zero(), across = along;
        for (std::size_t k = 0; k < grid.size(); ++k) {
          if (grid[k] < 0) continue;
          along += at.by_u[k] * places_[grid[k]].X;
          across += at.by_v[k] * places_[grid[k]].X;
        }
        const double N = 0.25 * (side < 0 ? 1.0 + u : 1.0 - u) * (face < node ? 1.0 + v : 1.0 - v);
        const double dA =
            along.cross(across).norm() * kThreeWeight[q % 3] * kThreeWeight[q / 3] * N;
        area += dA;
        for (std::size_t k = 0; k < grid.size(); ++k) {
          if (grid[k] >= 0) mean[grid[k]] += dA * at.value[k];
        }
      }
    }
  }
  const bool is_own_image =
      unknowns_.multiplicity() > 1.0 && (plane == 0 || plane == unknowns_.sectors());
  Eigen::Vector3d undeformed = Eigen::Vector3d::Zero();
  for (const auto& [place, weight] : mean) undeformed += weight / area * places_[place].X;
  const double radius = std::hypot(undeformed.x(), undeformed.z());
  const auto width_at = [&](int sector) { return width((plane + sector + S) % S); };
  const double around = share_of_uniform({width_at(-2), width_at(-1), width_at(0), width_at(1)});
  const double across = share_of_uniform({strip.span_at(node - 2),
                                          strip.span_at(node - 1),
                                          strip.span_at(node),
                                          strip.span_at(node + 1)});
  const double share = (is_own_image ? 0.5 : 1.0) * around * across;
  const Point point{static_cast<int>(weights_.size()),
                    static_cast<int>(mean.size()),
                    0.0,
                    share * area,
                    0.5 * radius * around * (width_at(-1) + width_at(0)),
                    offset_of(plane, node, strip, undeformed),
                    is_own_image};
  for (const auto& [place, weight] : mean) {
    weights_.push_back({place, weight / area, 0.0, 0.0});
  }
  points_.push_back(point);
}

Eigen::Vector3d TreadSurface::motion(int point, const Eigen::Matrix3Xd& shape) const {
  const Mesh& mesh = unknowns_.ring().mesh();
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  for (int k = 0; k < points_[point].weights; ++k) {
    const Weight& weight = weights_[points_[point].first_weight + k];
    const Place& place = places_[weight.place];
    motion += weight.w * (mesh.frame(place.plane) *
                          shape.col(place.plane * mesh.nodes_per_sector() + place.section_node));
  }
  return motion;
}

double TreadSurface::area(const Point& point, const Eigen::Matrix3Xd& positions) const {
  Eigen::Vector3d along = Eigen::Vector3d::Zero(), across = along;
  for (int k = 0; k < point.weights; ++k) {
    const Weight& weight = weights_[point.first_weight + k];
    along += weight.by_u * positions.col(weight.place);
    across += weight.by_v * positions.col(weight.place);
  }
  return along.cross(across).norm() * point.share;
}

std::vector<int> TreadSurface::nodes_of(const Point& point) const {
  std::vector<int> nodes;
  for (int k = 0; k < point.weights; ++k) {
    const int node = places_[weights_[point.first_weight + k].place].node;
    if (node >= 0 && std::ranges::find(nodes, node) == nodes.end()) nodes.push_back(node);
  }
  return nodes;
}

/// Faces one behind the other, each having the corners `front` where the next one has `back`.
std::vector<std::vector<int>> TreadSurface::rows_of_faces(std::array<int, 2> back,
                                                          std::array<int, 2> front) const {
  const auto edge = [this](int face, const std::array<int, 2>& ends) {
    return std::pair(faces_[face].corner[ends[0]], faces_[face].corner[ends[1]]);
  };
  const int count = static_cast<int>(faces_.size());
  std::map<std::pair<int, int>, int> behind;  // by the edge they begin at
  for (int face = 0; face < count; ++face) behind[edge(face, back)] = face;
  std::vector<bool> follows(count, false), is_done(count, false);
  const auto next_of = [&](int face) {
    const auto next = behind.find(edge(face, front));
    return next == behind.end() ? -1 : next->second;
  };
  for (int face = 0; face < count; ++face) {
    if (const int next = next_of(face); next >= 0) follows[next] = true;
  }
  std::vector<std::vector<int>> rows;
  for (const bool rings : {false, true}) {  // what is left after all beginnings goes all around
    for (int first = 0; first < count; ++first) {
      if (is_done[first] || (follows[first] && !rings)) continue;
      rows.emplace_back();
      for (int face = first; face >= 0 && !is_done[face]; face = next_of(face)) {
        is_done[face] = true;
        rows.back().push_back(face);
      }
    }
  }
  return rows;
}

std::vector<std::vector<int>> TreadSurface::lines_around() const {
  std::vector<std::vector<int>> lines;
  for (const std::vector<int>& faces : rows_of_faces({0, 3}, {1, 2})) {
    for (int row = 0; row < kSamples; ++row) {
      std::vector<int>& line = lines.emplace_back();
      for (const int face : faces) {
        for (int k = 0; k < kSamples; ++k)
          line.push_back(faces_[face].first_sample + row * kSamples + k);
      }
    }
  }
  return lines;
}

std::vector<std::vector<int>> TreadSurface::lines_across() const {
  std::vector<std::vector<int>> lines;
  for (const std::vector<int>& faces : rows_of_faces({0, 1}, {3, 2})) {
    for (int column = 0; column < kSamples; ++column) {
      std::vector<int>& line = lines.emplace_back();
      for (const int face : faces) {
        for (int k = 0; k < kSamples; ++k)
          line.push_back(faces_[face].first_sample + k * kSamples + column);
      }
    }
  }
  return lines;
}

std::vector<std::vector<int>> TreadSurface::connectivity() const {
  std::vector<std::vector<int>> lists;
  for (const Point& point : points_) {
    std::vector<int>& unknowns = lists.emplace_back();
    for (const int node : nodes_of(point)) {
      for (int k = 0; k < 3; ++k) unknowns.push_back(3 * nodes_[node] + k);
    }
  }
  return lists;
}

Eigen::Matrix3Xd TreadSurface::displacements(const Eigen::VectorXd& x) const {
  Eigen::Matrix3Xd u(3, nodes());
  for (int k = 0; k < nodes(); ++k) u.col(k) = x.segment<3>(3 * nodes_[k]);
  return u;
}

Eigen::Matrix3Xd TreadSurface::positions(const Eigen::Matrix3Xd& displacements) const {
  Eigen::Matrix3Xd x(3, places_.size());
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Place& place = places_[k];
    x.col(k) = place.X;
    if (place.node >= 0) x.col(k) += place.T * displacements.col(place.node);
  }
  return x;
}

Eigen::Matrix3Xd TreadSurface::beyond(const Eigen::VectorXd& x) const {
  const Mesh& mesh = unknowns_.ring().mesh();
  Eigen::Matrix3Xd p(3, beyond_.size());
  for (std::size_t k = 0; k < beyond_.size(); ++k) {
    const auto& [plane, node] = beyond_[k];
    const RingUnknowns::NodeUnknowns unknowns = unknowns_.of_node(plane, node);
    Eigen::Vector3d local = mesh.X.col(node);
    if (unknowns.first >= 0) local += unknowns.sign.cwiseProduct(x.segment<3>(unknowns.first));
    p.col(k) = mesh.frame(plane) * local;
  }
  return p;
}

}  // namespace latsch::fe_tire
