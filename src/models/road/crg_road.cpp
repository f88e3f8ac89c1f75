// SPDX-License-Identifier: Apache-2.0
#include "models/road/crg_road.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

namespace latsch::road {
namespace {

using Border = CrgGrid::Border;
using Eigen::Vector2d;

// Tolerance for points that count as lying on a straight line, relative to the line's length. It
// allows for rounding in sums along the line.
constexpr double kStraight = 1e-12;
// Differences of the spacing below this share count as equal spacing, as in OpenCRG's own
// evaluation.
constexpr double kEven = 1e-9;
// Smallest cosine of a corner of the reference line. A sharper corner occurs on no road, and its
// normals cannot be used.
constexpr double kFolded = 1e-6;
// Cosine of 60 deg. OpenCRG closes a reference line only if the directions at its two ends differ
// by less than this angle.
constexpr double kClosingCosine = 0.5;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
Vector2d left_of(const Vector2d& a) { return {-a.y(), a.x()}; }

bool is_straight(const std::vector<Vector2d>& line) {
  const Vector2d whole = line.back() - line.front();
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vector2d even = line.front() + whole * (double(i) / double(line.size() - 1));
    if ((line[i] - even).norm() > kStraight * whole.norm()) return false;
  }
  return true;
}

bool is_even(const std::vector<double>& v) {
  const double step = (v.back() - v.front()) / static_cast<double>(v.size() - 1);
  for (std::size_t i = 0; i < v.size(); ++i)
    if (std::abs(v.front() + step * static_cast<double>(i) - v[i]) > kEven * step) return false;
  return true;
}

}  // namespace

CrgRoad::CrgRoad(CrgGrid grid) : grid_(std::move(grid)) {
  assert(grid_.line.size() >= 2 && grid_.v.size() >= 2 && grid_.u_increment > 0.0);
  assert(grid_.z.size() == grid_.line.size() * grid_.v.size());
  assert(grid_.line_height.size() == grid_.line.size());
  straight_ = is_straight(grid_.line);
  even_v_ = is_even(grid_.v);
  first_ = (grid_.line[1] - grid_.line[0]).normalized();
  last_ = (grid_.line.back() - grid_.line[grid_.line.size() - 2]).normalized();
  if (!straight_) index_ = LineIndex(grid_.line);
  if (grid_.closed) find_closure();
}

/// Closes a line whose ends have a gap: finds where the straight continuations of both ends meet.
/// Each continuation bridges half of the gap.
void CrgRoad::find_closure() {
  const double cosine = first_.dot(last_);
  if (cosine <= kClosingCosine) return;
  const Vector2d gap = grid_.line.front() - grid_.line.back();
  // Distance from the end along its direction to the normal at the start.
  const double beyond = gap.dot(first_) / cosine;
  // Distance from the start, backward along its direction, to the normal at the end.
  const double before = gap.dot(last_) / cosine;
  if (beyond <= 0.0 || before <= 0.0) return;
  closed_ = true;
  close_min_ = grid_.u_begin - 0.5 * before * cosine;
  close_max_ = grid_.u_end() + 0.5 * beyond * cosine;
}

double CrgRoad::wrapped(double u) const {
  if (!closed_ || (u >= close_min_ && u <= close_max_)) return u;
  const double length = close_max_ - close_min_;
  return u - length * std::floor((u - close_min_) / length);
}

/// Returns the tangent of the reference line at one of its points, not normalized.
Vector2d CrgRoad::tangent(int point) const {
  const int last = grid_.rows() - 1;
  return grid_.line[std::min(point + 1, last)] - grid_.line[std::max(point - 1, 0)];
}

/// Returns the vector from a vertex of the reference line, at right angles to the tangent there, to
/// the parallel of the adjacent interval at v = 1; `normal` is the unit normal of this interval.
Vector2d CrgRoad::miter(int point, const Vector2d& normal) const {
  const Vector2d n = left_of(tangent(point)).normalized();
  const double cosine = n.dot(normal);
  return std::abs(cosine) > kFolded ? Vector2d(n / cosine) : normal;
}

CrgRoad::Interval CrgRoad::interval(const Vector2d& p) const {
  const std::vector<Vector2d>& P = grid_.line;
  const int last = grid_.rows() - 1;
  const auto beyond = [&](int point) { return (p - P[point]).dot(tangent(point)); };
  Interval found;
  int k = 0;
  if (straight_) {
    const double u = (p - P[0]).dot(first_) / grid_.u_increment;
    k = static_cast<int>(std::clamp(std::floor(u), 0.0, last - 1.0));
  } else {
    k = std::min(index_.nearest(P, p), last - 1);
    while (k < last - 1 && beyond(k + 1) > 0.0) ++k;
    while (k > 0 && beyond(k) < 0.0) --k;
  }
  const Vector2d d = P[k + 1] - P[k];
  const double a = beyond(k) / tangent(k).dot(d);
  const double b = -beyond(k + 1) / tangent(k + 1).dot(d);
  found.number = k;
  // Beyond a center of curvature the normals at both ends of the interval have crossed. Any point
  // of the interval is then equally good, and the middle is returned.
  found.part = a + b > 0.0 ? std::clamp(a / (a + b), 0.0, 1.0) : 0.5;
  found.v = cross(d, p - P[k]) / d.norm();
  const bool before = k == 0 && a < 0.0, behind = k == last - 1 && b < 0.0;
  if (before || behind) {
    const Vector2d& end = before ? P[0] : P[last];
    const Vector2d& direction = before ? first_ : last_;
    found.part = (p - end).dot(direction) / grid_.u_increment + (before ? 0.0 : 1.0);
    found.v = cross(direction, p - end);
    found.along_u = direction;
    found.along_v = left_of(direction);
    return found;
  }
  const Vector2d normal = left_of(d).normalized();
  const Vector2d n1 = miter(k, normal), n2 = miter(k + 1, normal);
  found.along_u = (d + found.v * (n2 - n1)) / grid_.u_increment;
  found.along_v = (1.0 - found.part) * n1 + found.part * n2;
  return found;
}

double CrgRoad::u_of(const Interval& place) const {
  return grid_.u_begin + (place.number + place.part) * grid_.u_increment;
}

CrgRoad::Position CrgRoad::locate(double x, double y) const {
  const Interval place = interval({x, y});
  return {wrapped(u_of(place)), place.v};
}

Vector2d CrgRoad::point(const Position& position) const {
  const std::vector<Vector2d>& P = grid_.line;
  const int last = grid_.rows() - 1;
  const double way = (wrapped(position.u) - grid_.u_begin) / grid_.u_increment;
  if (way < 0.0) return P[0] + way * grid_.u_increment * first_ + position.v * left_of(first_);
  if (way > last) {
    return P[last] + (way - last) * grid_.u_increment * last_ + position.v * left_of(last_);
  }
  const int k = std::min(static_cast<int>(way), last - 1);
  const Vector2d normal = left_of(P[k + 1] - P[k]).normalized();
  const Vector2d a = P[k] + position.v * miter(k, normal);
  const Vector2d b = P[k + 1] + position.v * miter(k + 1, normal);
  return a + (way - k) * (b - a);
}

namespace {

struct Folded {
  double way = 0.0;   // 0 ... length
  double sign = 1.0;  // sign of the derivative of `way` by the original position
  bool outside = false;
};

/// Returns the position within 0 ... length that the border mode uses for a position outside.
Folded fold(double way, double length, Border border) {
  if (!std::isfinite(way)) way = 0.0;  // a position too large for a double is infinite
  if (way >= 0.0 && way <= length) return {way};
  if (border == Border::repeat) return {way - length * std::floor(way / length)};
  if (border == Border::reflect) {
    const double pair = way - 2.0 * length * std::floor(way / (2.0 * length));
    if (pair <= length) return {pair};
    return {2.0 * length - pair, -1.0};
  }
  return {std::clamp(way, 0.0, length), 0.0, true};
}

}  // namespace

CrgRoad::Place CrgRoad::along(double u) const {
  const int last = grid_.rows() - 1;
  const Folded folded = fold((u - grid_.u_begin) / grid_.u_increment, last, grid_.border_u);
  const int row = std::min(static_cast<int>(folded.way), last - 1);
  return {row, folded.way - row, folded.sign, folded.outside};
}

CrgRoad::Place CrgRoad::across(double v) const {
  const std::vector<double>& at = grid_.v;
  const int last = static_cast<int>(at.size()) - 1;
  const Folded folded = fold(v - at.front(), at.back() - at.front(), grid_.border_v);
  const double place = at.front() + folded.way;
  int row = 0;
  if (even_v_) {
    row = static_cast<int>(folded.way / (at.back() - at.front()) * last);
  } else {
    row = static_cast<int>(std::upper_bound(at.begin(), at.end(), place) - at.begin()) - 1;
  }
  row = std::clamp(row, 0, last - 1);
  return {row, (place - at[row]) / (at[row + 1] - at[row]), folded.sign, folded.outside};
}

void CrgRoad::add_grid(const Place& u, const Place& v, Elevation& result) const {
  const std::size_t columns = grid_.v.size();
  const std::size_t near = u.row * columns + v.row, far = near + columns;
  const double z00 = grid_.z[near], z01 = grid_.z[near + 1];
  const double z10 = grid_.z[far] - z00, z11 = grid_.z[far + 1] - z01;
  const double left = z01 - z00;
  const double rise = z10 + v.part * (z11 - z10);
  result.z += z00 + v.part * left + u.part * rise;
  result.dz_du += u.sign * rise / grid_.u_increment;
  result.dz_dv += v.sign * (left + u.part * (z11 - z10)) / (grid_.v[v.row + 1] - grid_.v[v.row]);
  if (grid_.missing.empty()) return;
  for (const std::size_t corner : {near, near + 1, far, far + 1}) {
    result.missing = result.missing || grid_.missing[corner];
  }
}

/// Adds the height of the reference line and the banking. Where the border mode repeats the grid,
/// the banking is multiplied by the v inside the grid.
void CrgRoad::add_line(const Place& u, const Place& v, Elevation& result) const {
  const double rise = grid_.line_height[u.row + 1] - grid_.line_height[u.row];
  result.z += grid_.line_height[u.row] + u.part * rise;
  result.dz_du += u.sign * rise / grid_.u_increment;
  if (grid_.banking.empty()) return;
  const double change = grid_.banking[u.row + 1] - grid_.banking[u.row];
  const double bank = grid_.banking[u.row] + u.part * change;
  const double reach = grid_.v[v.row] + v.part * (grid_.v[v.row + 1] - grid_.v[v.row]);
  result.z += bank * reach;
  result.dz_du += u.sign * change * reach / grid_.u_increment;
  result.dz_dv += v.sign * bank;
}

void CrgRoad::smoothen(double u, Elevation& result) const {
  const auto fade = [&](double way, double zone, double base, double direction) {
    if (zone <= 0.0 || way > zone) return;
    const double scale = std::max(way, 0.0) / zone;
    const double slope = way > 0.0 ? direction / zone : 0.0;
    result.dz_du = result.dz_du * scale + (result.z - base) * slope;
    result.dz_dv *= scale;
    result.z = base + (result.z - base) * scale;
  };
  fade(u - grid_.u_begin, grid_.smooth_begin, grid_.line_height.front(), 1.0);
  fade(grid_.u_end() - u, grid_.smooth_end, grid_.line_height.back(), -1.0);
}

CrgRoad::Elevation CrgRoad::evaluate(double u, double v) const {
  const Place row = along(u), column = across(v);
  Elevation result;
  result.missing = (row.outside && grid_.border_u == Border::none) ||
                   (column.outside && grid_.border_v == Border::none);
  const auto offset_of = [](const Place& place, Border border, double offset) {
    return place.outside && border != Border::none ? offset : 0.0;
  };
  const double offset = offset_of(row, grid_.border_u, grid_.border_offset_u) +
                        offset_of(column, grid_.border_v, grid_.border_offset_v);
  if ((row.outside && grid_.border_u == Border::zero) ||
      (column.outside && grid_.border_v == Border::zero)) {
    result.z = offset;
    return result;
  }
  add_grid(row, column, result);
  add_line(row, column, result);
  result.z += offset;
  smoothen(row.outside ? u : grid_.u_begin + (row.row + row.part) * grid_.u_increment, result);
  return result;
}

std::optional<double> CrgRoad::elevation(const Position& position) const {
  const Elevation result = evaluate(wrapped(position.u), position.v);
  if (result.missing) return std::nullopt;
  return result.z;
}

double CrgRoad::height(double x, double y, double) const {
  const Interval place = interval({x, y});
  return evaluate(wrapped(u_of(place)), place.v).z;
}

double CrgRoad::mean_height(const Vector2d& from, const Vector2d& to, double time) const {
  constexpr double kMost = 8.0;  // largest number of grid lines that a line may cross
  if (!straight_ || closed_ || !even_v_) return Road::mean_height(from, to, time);
  const Position a = locate(from.x(), from.y()), b = locate(to.x(), to.y());
  const double columns = static_cast<double>(grid_.v.size() - 1);
  const double by_u = 1.0 / grid_.u_increment, by_v = columns / (grid_.v.back() - grid_.v.front());
  // Both ends are expressed in grid spacings, from the corner of the grid.
  const Vector2d begin((a.u - grid_.u_begin) * by_u, (a.v - grid_.v.front()) * by_v);
  const Vector2d end((b.u - grid_.u_begin) * by_u, (b.v - grid_.v.front()) * by_v);
  const Vector2d low = begin.cwiseMin(end), high = begin.cwiseMax(end), way = end - begin;
  if (!(low.minCoeff() >= 0.0 && high.x() <= grid_.rows() - 1.0 && high.y() <= columns &&
        way.cwiseAbs().maxCoeff() <= kMost))
    return Road::mean_height(from, to, time);
  // Finds the shares of the line at which it crosses the next row and the next column of the grid.
  Vector2d next, line;
  const auto share_at = [&](int i) {
    return way[i] == 0.0 ? 2.0 : std::max(0.0, (line[i] - begin[i]) / way[i]);
  };
  for (int i = 0; i < 2; ++i) {
    line[i] = way[i] > 0.0 ? std::floor(begin[i]) + 1.0 : std::ceil(begin[i]) - 1.0;
    next[i] = share_at(i);
  }
  const double off = 0.5 / std::sqrt(3.0);  // two-point Gauss quadrature
  double done = 0.0, sum = 0.0;
  while (done < 1.0) {
    const double until = std::min(1.0, next.minCoeff()), part = until - done;
    const double middle = 0.5 * (done + until);
    const auto z = [&](double share) {
      return evaluate(a.u + share * (b.u - a.u), a.v + share * (b.v - a.v)).z;
    };
    if (part > 0.0) sum += 0.5 * part * (z(middle - off * part) + z(middle + off * part));
    done = until;
    for (int i = 0; i < 2; ++i) {
      if (next[i] > done) continue;
      line[i] += way[i] > 0.0 ? 1.0 : -1.0;
      next[i] = share_at(i);
    }
  }
  return sum;
}

GroundPoint CrgRoad::at(double x, double y, double) const {
  const Interval place = interval({x, y});
  const Elevation surface = evaluate(wrapped(u_of(place)), place.v);
  // The gradient of z in x and y follows from its derivatives by u and v, which are the products of
  // the gradient with the derivatives of the position.
  Eigen::Matrix2d moves;
  moves.row(0) = place.along_u;
  moves.row(1) = place.along_v;
  Vector2d gradient = moves.inverse() * Vector2d(surface.dz_du, surface.dz_dv);
  if (!gradient.allFinite()) gradient.setZero();  // the point is a center of curvature
  GroundPoint ground;
  ground.height = surface.z;
  ground.normal = Eigen::Vector3d(-gradient.x(), -gradient.y(), 1.0).normalized();
  return ground;
}

std::string CrgRoad::beyond(double x, double y) const {
  const Position p = locate(x, y);
  const Place u = along(p.u), v = across(p.v);
  // Points between the two ends of a closed line count as road, because the file requests the
  // interpolation between them.
  const bool is_on_line = !u.outside || closed_;
  if (is_on_line && !v.outside) return {};
  return fmt::format(
      "u = {:.6g} m, v = {:.6g} m is beside its grid, u = {:.6g} to {:.6g} m, v = {:.6g} to {:.6g} "
      "m",
      p.u,
      p.v,
      grid_.u_begin,
      grid_.u_end(),
      grid_.v.front(),
      grid_.v.back());
}

GroundBounds CrgRoad::bounds(const GroundBox& box, double) const {
  if (!straight_ || closed_ || grid_.smooth_begin > 0.0 || grid_.smooth_end > 0.0) return {};
  // On a straight line u and v are linear in x and y, so the extreme u and v of the box occur at
  // its corners.
  double u0 = std::numeric_limits<double>::infinity(), v0 = u0, u1 = -u0, v1 = -u0;
  for (const auto& [x, y] : std::initializer_list<std::pair<double, double>>{
           {box.x0, box.y0}, {box.x1, box.y0}, {box.x0, box.y1}, {box.x1, box.y1}}) {
    const Position corner = locate(x, y);
    u0 = std::min(u0, corner.u);
    u1 = std::max(u1, corner.u);
    v0 = std::min(v0, corner.v);
    v1 = std::max(v1, corner.v);
  }
  if (!(u0 >= grid_.u_begin && u1 <= grid_.u_end() && v0 >= grid_.v.front() &&
        v1 <= grid_.v.back()))
    return {};
  const Place first = along(u0), last = along(u1), right = across(v0), left = across(v1);
  const std::size_t columns = grid_.v.size();
  double highest = -std::numeric_limits<double>::infinity();
  for (int row = first.row; row <= last.row + 1; ++row) {
    double z = -std::numeric_limits<double>::infinity();
    for (int c = right.row; c <= left.row + 1; ++c) z = std::max(z, grid_.z[row * columns + c]);
    highest = std::max(highest, z + grid_.line_height[row]);
  }
  if (grid_.banking.empty()) return {highest, false};
  // Maximum of banking * v over the cells. Both factors are linear between the rows, so the maximum
  // is at a corner.
  double lean = -std::numeric_limits<double>::infinity();
  for (int row = first.row; row <= last.row + 1; ++row) {
    for (const double v : {v0, v1}) lean = std::max(lean, grid_.banking[row] * v);
  }
  return {highest + lean, false};
}

}  // namespace latsch::road
