// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/contact/tread_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {
namespace {

/// Number of contact points along each side of a facet. If the patch is shorter than two facets, Fz
/// with eight points differs by 1 % from Fz with sixteen, with twelve by less than 0.1 %, and with
/// two at Gauss points by 24 %.
constexpr int kFacetPoints = 12;

/// Share s in (T.1): the offset of a point as a share of the sag (T.2).
constexpr double kOfSag = 0.53;

/// Returns true if an angle from the lowest point, 0 to 2 pi, is within the half angle on either
/// side.
bool is_near(double angle, double half_angle) {
  return std::min(angle, 2.0 * std::numbers::pi - angle) < half_angle;
}

}  // namespace

TreadSurface::TreadSurface(const RingUnknowns& unknowns, TreadShape shape, double half_angle)
    : unknowns_(unknowns), shape_(shape) {
  const Mesh& mesh = unknowns.ring().mesh();
  const int n = mesh.nodes_per_sector();
  const std::vector<TreadStrip> strips = tread_strips(mesh);
  if (strips.empty()) shape_ = TreadShape::facets;
  place_index_.assign(mesh.sectors, std::vector<int>(n, -1));
  Covered covered(mesh.sectors, std::vector<bool>(n, false));
  add_faces(strips, half_angle, covered);
  if (strips.empty()) add_single_faces(half_angle, covered);
  if (shape_ == TreadShape::smooth) add_means(strips, half_angle, covered);
  find_cell_nodes();
  find_beyond(covered);
  place_index_.clear();
}

/// Returns the number of section planes in the part of the ring that is computed.
int TreadSurface::planes() const {
  return is_halved() ? unknowns_.sectors() + 1 : unknowns_.ring().mesh().sectors;
}

/// Adds the faces near the lowest point of the tire: sampling points of a smooth surface, or
/// facets.
void TreadSurface::add_faces(const std::vector<TreadStrip>& strips,
                             double half_angle,
                             Covered& covered) {
  const Mesh& mesh = unknowns_.ring().mesh();
  for (int s = 0; s < unknowns_.sectors() && !strips.empty(); ++s) {
    if (!is_near(mesh.angle(s), half_angle) && !is_near(mesh.angle(s + 1), half_angle)) continue;
    for (const TreadStrip& strip : strips) {
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
          covered[plane][strip.nodes[f]] = covered[plane][strip.nodes[f + 1]] = true;
      }
    }
  }
}

/// Adds the facets of a mesh whose tread faces form no rows.
void TreadSurface::add_single_faces(double half_angle, Covered& covered) {
  const Mesh& mesh = unknowns_.ring().mesh();
  const int n = mesh.nodes_per_sector();
  for (const Element& element : mesh.elements) {
    if (!element.tread) continue;
    std::array<std::pair<int, int>, 4> corner;
    bool near = false;
    for (int a = 0; a < 4; ++a) {
      corner[a] = {element.node[4 + a] / n % mesh.sectors, element.node[4 + a] % n};
      const Eigen::Vector3d X = mesh.frame(corner[a].first) * mesh.X.col(corner[a].second);
      near = near || std::abs(std::atan2(X.x(), -X.z())) < half_angle;
    }
    if (!near) continue;
    add_facet(corner);
    for (const auto& [plane, node] : corner) covered[plane][node] = true;
  }
}

/// Adds the averaged points of a smooth surface, position by position around the ring and row by
/// row across. Each face is a cell.
void TreadSurface::add_means(const std::vector<TreadStrip>& strips,
                             double half_angle,
                             Covered& covered) {
  const Mesh& mesh = unknowns_.ring().mesh();
  const auto is_plane_near = [&](int plane) {
    return is_near(mesh.angle(plane % mesh.sectors), half_angle);
  };
  std::vector<std::vector<MeanAcross>> means;
  means.reserve(strips.size());
  for (const TreadStrip& strip : strips) means.push_back(means_across(mesh, strip));
  std::vector<std::vector<int>> lines(strips.size(), std::vector<int>(mesh.sectors, -1));
  // Number of positions around the tire: half a ring has those up to its last section plane, a
  // whole ring those before its first plane is reached again.
  const int places = is_halved() ? kPlaces * (planes() - 1) + 1 : kPlaces * planes();
  // Numbers of cells; index of the current row of faces around.
  int cells = 0, first_cell = 0, row = -1;
  for (int along = 0; along < places; ++along) {
    if (!is_plane_near(face_of(along)) || !is_plane_near(face_of(along + kPlaces - 1))) continue;
    const MeanAround around = mean_around(mesh, along);
    if (face_of(along) != row) first_cell = cells;
    row = face_of(along);
    cells = first_cell;
    for (std::size_t k = 0; k < strips.size(); ++k) {
      add_mean_points(around, means[k], strips[k], cells, lines[k]);
      cells += static_cast<int>(strips[k].span.size());
      for (const int node : strips[k].nodes) covered[face_of(along)][node] = true;
    }
  }
}

/// Finds the tread nodes on which no face depends.
void TreadSurface::find_beyond(Covered& covered) {
  const Mesh& mesh = unknowns_.ring().mesh();
  for (const Element& element : mesh.elements) {
    for (int a = 4; element.tread && a < 8; ++a) {
      const int node = element.node[a] % mesh.nodes_per_sector();
      for (int plane = 0; plane < planes(); ++plane) {
        if (covered[plane][node]) continue;
        covered[plane][node] = true;
        beyond_.emplace_back(plane, node);
      }
    }
  }
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
  const int cell = points_.empty() ? 0 : points_.back().cell + 1;
  const int line = static_cast<int>(first_across_.size()) - 1;
  for (const int corner : grid) {
    across_.push_back({corner, 1.0});
    first_across_.push_back(static_cast<int>(across_.size()));
  }
  for (int i = 0; i < kFacetPoints; ++i) {
    for (int j = 0; j < kFacetPoints; ++j) {
      Point& point = points_.emplace_back(point_at(grid, weights_at(place(i), place(j)), kShare));
      point.cell = cell;
      point.first_around = static_cast<int>(around_.size());
      point.arounds = static_cast<int>(grid.size());
      for (int k = 0; k < point.arounds; ++k) around_.push_back({line + k, weights(point)[k].w});
    }
  }
  add_samples({grid[0], grid[1], grid[2], grid[3]}, grid, weights_at);
}

/// Returns the nodes on which the smooth surface of a face depends, and the function that computes
/// their weights.
std::pair<TreadSurface::Grid, TreadSurface::Weights> TreadSurface::smooth_face(
    int sector, int face, const TreadStrip& strip) {
  const Mesh& mesh = unknowns_.ring().mesh();
  const int S = mesh.sectors;
  std::array<double, 4> theta;
  Grid grid;
  for (int i = 0; i < 4; ++i) {
    const int plane = sector - 1 + i, wrapped = (plane + S) % S;
    theta[i] = angle_of_plane(mesh, plane);
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

/// Adds the averages across the tread in one section plane. Returns the index of the first.
int TreadSurface::add_line(int plane,
                           const std::vector<MeanAcross>& means,
                           const TreadStrip& strip) {
  const int line = static_cast<int>(first_across_.size()) - 1;
  for (const MeanAcross& across : means) {
    const HatMean& mean = across.mean;
    for (std::size_t j = 0; j < mean.weight.size(); ++j) {
      if (mean.weight[j] == 0.0) continue;
      const int node = strip.nodes[mean.first + static_cast<int>(j)];
      across_.push_back({place_of(plane, node), mean.weight[j] / mean.size});
    }
    first_across_.push_back(static_cast<int>(across_.size()));
  }
  return line;
}

/// Adds the averaged points (T.1) of a row of faces. `lines` holds, for every section plane, the
/// index of its first average across, or -1 if it was not added yet. In half a ring, a point in one
/// of its two end planes belongs by half to its image.
void TreadSurface::add_mean_points(const MeanAround& around,
                                   const std::vector<MeanAcross>& means,
                                   const TreadStrip& strip,
                                   int first_cell,
                                   std::vector<int>& lines) {
  const int S = unknowns_.ring().mesh().sectors, faces = static_cast<int>(strip.span.size());
  const HatMean& hat = around.mean;
  const bool is_own_image = unknowns_.multiplicity() > 1.0 &&
                            (around.place == 0 || around.place == kPlaces * unknowns_.sectors());
  // Index of the first average across the tread in each section plane, with the plane's weight.
  std::vector<Part> planes;
  for (std::size_t i = 0; i < hat.weight.size(); ++i) {
    if (hat.weight[i] == 0.0) continue;
    const int plane = ((hat.first + static_cast<int>(i)) % S + S) % S;
    if (lines[plane] < 0) lines[plane] = add_line(plane, means, strip);
    planes.push_back({lines[plane], hat.weight[i] / hat.size});
  }
  using Vector = Eigen::Vector3d;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(-around.theta, Vector::UnitY()).toRotationMatrix();
  for (int k = 0; k < static_cast<int>(means.size()); ++k) {
    const MeanAcross& across = means[k];
    Point point{static_cast<int>(weights_.size()), 0, 0.0, 0.0, 0.0};
    point.is_own_image = is_own_image;
    point.dA = (is_own_image ? 0.5 : 1.0) / (kPlaces * kPlaces) * around.share * across.share *
               hat.size * across.mean.size;
    point.cell = first_cell + std::min(face_of(k), faces - 1);
    point.first_around = static_cast<int>(around_.size());
    Vector mean = Vector::Zero();
    for (const auto& [line, w] : planes) {
      around_.push_back({line + k, w});
      for (int j = first_across_[line + k]; j < first_across_[line + k + 1]; ++j) {
        const Part& part = across_[j];
        weights_.push_back({part.of, w * part.w, 0.0, 0.0});
        mean += w * part.w * places_[part.of].X;
        ++point.weights;
      }
    }
    point.arounds = static_cast<int>(around_.size()) - point.first_around;
    point.around = std::hypot(mean.x(), mean.z()) / kPlaces * around.share * hat.size;

    const Vector X = turn * across.X;
    const Vector n = turn * Vector::UnitX().cross(across.slope).normalized();
    const double sag_around = n.dot(Vector(X.x(), 0.0, X.z())) * around.moment / (2.0 * hat.size);
    const double sag = n.dot(X - mean);
    // Above the widest point of the wall, n points toward the axis.
    const double most = std::abs(sag_around);
    point.offset = kOfSag * n * (sag_around + std::clamp(sag - sag_around, -most, most));
    points_.push_back(point);
  }
}

void TreadSurface::find_cell_nodes() {
  std::vector<std::vector<char>> is_there;
  for (const Point& point : points_) {
    if (point.cell >= static_cast<int>(cell_nodes_.size())) {
      cell_nodes_.resize(point.cell + 1);
      is_there.resize(point.cell + 1, std::vector<char>(nodes_.size(), 0));
    }
    for (int k = 0; k < point.weights; ++k) {
      const int node = places_[weights_[point.first_weight + k].place].node;
      if (node < 0 || is_there[point.cell][node]) continue;
      is_there[point.cell][node] = 1;
      cell_nodes_[point.cell].push_back(node);
    }
  }
}

Eigen::Matrix3Xd TreadSurface::points_at(const Eigen::Matrix3Xd& positions) const {
  Eigen::Matrix3Xd across(3, std::ssize(first_across_) - 1), all(3, std::ssize(points_));
  for (Eigen::Index k = 0; k < across.cols(); ++k) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (int j = first_across_[k]; j < first_across_[k + 1]; ++j)
      x += across_[j].w * positions.col(across_[j].of);
    across.col(k) = x;
  }
  for (Eigen::Index k = 0; k < all.cols(); ++k) {
    const Point& point = points_[k];
    Eigen::Vector3d x = point.offset;
    for (int j = point.first_around; j < point.first_around + point.arounds; ++j)
      x += around_[j].w * across.col(around_[j].of);
    all.col(k) = x;
  }
  return all;
}

Eigen::Matrix3Xd TreadSurface::motions(const Eigen::Matrix3Xd& shape) const {
  const Mesh& mesh = unknowns_.ring().mesh();
  Eigen::Matrix3Xd moved(3, std::ssize(places_));
  for (Eigen::Index k = 0; k < moved.cols(); ++k) {
    const Place& place = places_[static_cast<std::size_t>(k)];
    moved.col(k) = mesh.frame(place.plane) *
                   shape.col(place.plane * mesh.nodes_per_sector() + place.section_node);
  }
  Eigen::Matrix3Xd motions = points_at(moved);
  for (Eigen::Index k = 0; k < motions.cols(); ++k)
    motions.col(k) -= points_[static_cast<std::size_t>(k)].offset;
  return motions;
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

/// Returns rows of faces. In a row, the edge with the corners `front` of each face is the edge with
/// the corners `back` of the next.
std::vector<std::vector<int>> TreadSurface::rows_of_faces(std::array<int, 2> back,
                                                          std::array<int, 2> front) const {
  const auto edge = [this](int face, const std::array<int, 2>& ends) {
    return std::pair(faces_[face].corner[ends[0]], faces_[face].corner[ends[1]]);
  };
  const int count = static_cast<int>(faces_.size());
  std::map<std::pair<int, int>, int> behind;  // index of each face by its rear edge
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
  // In the second pass only faces in closed rings are left.
  for (const bool rings : {false, true}) {
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
  for (const std::vector<int>& cell : cell_nodes_) {
    std::vector<int>& unknowns = lists.emplace_back();
    for (const int node : cell) {
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
