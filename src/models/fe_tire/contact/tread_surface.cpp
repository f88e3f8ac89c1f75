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

/// Means a face, around and across.
constexpr int kPlaces = 4;
/// Of the sag (T.2), what counts.
constexpr double kOfSag = 0.53;

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

/// Of a place, counted in kPlaces a face; that at a node belongs to the face behind it.
int face_of(int place) { return place >= 0 ? place / kPlaces : -((kPlaces - 1 - place) / kPlaces); }

/// On [-1, 1] of that face.
double within_face(int place) { return 2.0 * (place - kPlaces * face_of(place)) / kPlaces - 1.0; }

/// Integrals over the hat N that is 1 at a place and 0 a face before and behind it, in one
/// direction of the surface.
struct HatMean {
  int first = 0;  // node of the first weight
  std::array<double, 6> weight{};
  double size = 0.0;
};

/// `cubic` and `measure` (per u) of a face at u. Where there are ends, nothing is before node 0 nor
/// behind the `last` one: what hats of places beyond them would have, those of their images take.
template <class CubicAt, class MeasureAt>
HatMean hat_mean(int place, std::optional<int> last, CubicAt cubic_at, MeasureAt measure_at) {
  const auto hat = [](double at, int center) {
    return std::max(0.0, 1.0 - std::abs(at - static_cast<double>(center) / kPlaces));
  };
  HatMean mean;
  mean.first = face_of(place - kPlaces) - 1;
  for (int part = place - kPlaces; part < place + kPlaces; ++part) {
    const int face = face_of(part);
    if (last && (face < 0 || face >= *last)) continue;
    for (int q = 0; q < 3; ++q) {
      const double t = (part - kPlaces * face + 0.5 * (1.0 + kThree[q])) / kPlaces;
      double N = hat(face + t, place);
      if (last && place > 0) N += hat(face + t, -place);
      if (last && place < kPlaces * *last) N += hat(face + t, 2 * kPlaces * *last - place);
      const Cubic cubic = cubic_at(face, 2.0 * t - 1.0);
      const double d = kThreeWeight[q] / kPlaces * N * measure_at(face, t, cubic);
      mean.size += d;
      for (int k = 0; k < 4; ++k) mean.weight[face - 1 + k - mean.first] += d * cubic.value[k];
    }
  }
  return mean;
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
  const bool is_halved = unknowns.multiplicity() > 1.0;
  const int planes = is_halved ? unknowns.sectors() + 1 : mesh.sectors;
  const auto is_plane_near = [&](int plane) { return is_near(mesh.angle(plane % mesh.sectors)); };
  const int last_plane = is_halved ? planes - 1 : planes;  // of a place between two
  for (int along = 0; along <= kPlaces * last_plane; ++along) {
    if (shape_ != TreadShape::smooth || (!is_halved && along == kPlaces * last_plane) ||
        !is_plane_near(face_of(along)) || !is_plane_near(face_of(along + kPlaces - 1)))
      continue;
    for (const Strip& strip : strips) {
      for (int across = 0; across <= kPlaces * std::ssize(strip.span); ++across)
        add_mean_point(along, across, strip);
      for (const int node : strip.nodes) is_here[face_of(along)][node] = true;
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
    theta[i] = angle(plane);
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

/// rad, of any plane, counted on around the ring.
double TreadSurface::angle(int plane) const {
  const Mesh& mesh = unknowns_.ring().mesh();
  const int turns = static_cast<int>(std::floor(static_cast<double>(plane) / mesh.sectors));
  return mesh.angle(plane - turns * mesh.sectors) + 2.0 * std::numbers::pi * turns;
}

/// (T.1) at a place of a strip, kPlaces a face around and across. Planes being alike, its
/// weights are products of those around and those across. Where half the ring stands for all of it,
/// half of what lies on its own image's plane belongs to the image.
void TreadSurface::add_mean_point(int along, int across, const Strip& strip) {
  const Mesh& mesh = unknowns_.ring().mesh();
  const int S = mesh.sectors, faces = static_cast<int>(strip.span.size());
  const auto width = [this](int sector) { return angle(sector + 1) - angle(sector); };
  const int sector = face_of(along);
  const double theta = angle(sector) + 0.5 * (1.0 + within_face(along)) * width(sector);
  const auto cubic_around = [&](int s, double u) {
    return hermite(width(s - 1), width(s), width(s + 1), u);
  };
  const HatMean around =
      hat_mean(along, std::nullopt, cubic_around, [&](int s, double, const Cubic&) {
        return 0.5 * width(s);
      });
  const double moment =  // second one of the hat, rad^3
      hat_mean(along, std::nullopt, cubic_around, [&](int s, double t, const Cubic&) {
        const double from = angle(s) + t * width(s) - theta;
        return 0.5 * width(s) * from * from;
      }).size;

  using Vector = Eigen::Vector3d;
  const auto cubic_across = [&](int face, double v) {
    return hermite(strip.span_at(face - 1), strip.span[face], strip.span_at(face + 1), v);
  };
  const auto sum = [&](int face, const Eigen::Vector4d& weights) {
    Vector x = Vector::Zero();
    for (int k = 0; k < 4; ++k) {
      const int node = face - 1 + k;
      if (node >= 0 && node <= faces) x += weights[k] * mesh.X.col(strip.nodes[node]);
    }
    return x;
  };
  const HatMean over =
      hat_mean(across, faces, cubic_across, [&](int f, double, const Cubic& cubic) {
        return -sum(f, cubic.value).z() * sum(f, cubic.slope).norm();
      });

  const bool is_own_image =
      unknowns_.multiplicity() > 1.0 && (along == 0 || along == kPlaces * unknowns_.sectors());
  // What a node is short of, the mean around it makes up for alone.
  const auto share = [](int place, auto share_at) {
    return place % kPlaces == 0 ? 1.0 + kPlaces * (share_at(place / kPlaces) - 1.0) : 1.0;
  };
  const double share_around = share(along, [&](int s) {
    return share_of_uniform({width(s - 2), width(s - 1), width(s), width(s + 1)});
  });
  const double share_across = share(across, [&](int n) {
    return share_of_uniform(
        {strip.span_at(n - 2), strip.span_at(n - 1), strip.span_at(n), strip.span_at(n + 1)});
  });
  Point point{static_cast<int>(weights_.size()), 0, 0.0, 0.0, 0.0};
  point.is_own_image = is_own_image;
  point.dA = (is_own_image ? 0.5 : 1.0) / (kPlaces * kPlaces) * share_around * share_across *
             around.size * over.size;
  Vector mean = Vector::Zero();
  for (std::size_t i = 0; i < around.weight.size(); ++i) {
    for (std::size_t j = 0; j < over.weight.size(); ++j) {
      const double w = around.weight[i] * over.weight[j] / (around.size * over.size);
      if (w == 0.0) continue;
      const int plane = ((around.first + static_cast<int>(i)) % S + S) % S;
      const int place = place_of(plane, strip.nodes[over.first + static_cast<int>(j)]);
      weights_.push_back({place, w, 0.0, 0.0});
      mean += w * places_[place].X;
      ++point.weights;
    }
  }
  point.around = std::hypot(mean.x(), mean.z()) / kPlaces * share_around * around.size;

  const int face = std::min(face_of(across), faces - 1);
  const Cubic there = cubic_across(face, 2.0 * (across - kPlaces * face) / kPlaces - 1.0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(-theta, Vector::UnitY()).toRotationMatrix();
  const Vector X = turn * sum(face, there.value);
  const Vector n = turn * Vector::UnitX().cross(sum(face, there.slope)).normalized();
  const double sag_around = n.dot(Vector(X.x(), 0.0, X.z())) * moment / (2.0 * around.size);
  const double sag = n.dot(X - mean);
  const double most = std::abs(sag_around);  // below the widest place n points to the axis
  point.offset = kOfSag * n * (sag_around + std::clamp(sag - sag_around, -most, most));
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
