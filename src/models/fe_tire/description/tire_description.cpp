// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/tire_description.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace latsch::fe_tire {

double WallProfile::at(double q) const {
  if (q <= position.front()) return length.front();
  if (q >= position.back()) return length.back();
  const auto i = std::upper_bound(position.begin(), position.end(), q) - position.begin();
  const double part = (q - position[i - 1]) / (position[i] - position[i - 1]);
  return length[i - 1] + part * (length[i] - length[i - 1]);
}

namespace {

/// Returns the number of elements between the crown and position q, if the elements have the
/// relative lengths of the profile: the integral of dq / length.
double elements_before(const SpacingProfile& spacing, double q) {
  double count = 0.0, from = 0.0;
  for (std::size_t i = 0; i + 1 < spacing.position.size() && from < q; ++i) {
    const double a = spacing.position[i], b = spacing.position[i + 1];
    const double slope = (spacing.length[i + 1] - spacing.length[i]) / (b - a);
    const double to = std::min(b, q), mean = spacing.length[i] + slope * (0.5 * (a + to) - a);
    const double x =
        // Integral of dq / length over the interval: (to - a) / mean * atanh(x) / x.
        0.5 * slope * (to - a) / mean;
    count += (to - a) / mean * (std::abs(x) < 1e-6 ? 1.0 + x * x / 3.0 : std::atanh(x) / x);
    from = to;
  }
  return count;
}

double length_at(const SpacingProfile& spacing, double q) {
  std::size_t i = 0;
  while (i + 2 < spacing.position.size() && q > spacing.position[i + 1]) ++i;
  const double a = spacing.position[i], b = spacing.position[i + 1];
  return spacing.length[i] + (spacing.length[i + 1] - spacing.length[i]) * (q - a) / (b - a);
}

/// Interpolates linearly, at a fractional index, between values y_i.
double interpolate(const std::vector<double>& y, double at) {
  const double whole = std::clamp(std::floor(at), 0.0, static_cast<double>(y.size() - 2));
  const auto i = static_cast<std::size_t>(whole);
  return y[i] + (at - whole) * (y[i + 1] - y[i]);
}

/// Returns the number of columns between the crown and position q; fractions count.
double columns_before(const Section& section, double q) {
  if (const std::vector<double>& columns = section.columns; !columns.empty()) {
    const auto next = std::upper_bound(columns.begin() + 1, columns.end() - 1, q);
    const double from = *(next - 1);
    return static_cast<double>(next - 1 - columns.begin()) + (q - from) / (*next - from);
  }
  const double part = section.spacing.position.empty() ? q
                                                       : elements_before(section.spacing, q) /
                                                             elements_before(section.spacing, 1);
  return 0.5 * section.meridional * part;
}

/// Moves the ends of columns to the positions `ends` and returns where column number `count` ends,
/// which `spacing` alone would place elsewhere. The nearest column end moves to each position of
/// `ends`, and the ends between two such positions move proportionally. A position is ignored if
/// its nearest column end is already at another one, at the crown or at the bead.
double moved_to_ends(const Section& section, double count) {
  const double half = 0.5 * section.meridional, first = half - std::floor(half);
  double from = 0.0, moved_from = 0.0;
  for (std::size_t i = 0; i <= section.ends.size(); ++i) {
    double to = half, moved_to = half;
    if (i < section.ends.size()) {
      moved_to = columns_before(section, section.ends[i]);
      to = first + std::round(moved_to - first);
      if (to <= from || to >= half) continue;
    }
    if (count <= to) return moved_from + (moved_to - moved_from) * (count - from) / (to - from);
    from = to;
    moved_from = moved_to;
  }
  return count;
}

constexpr double kSamePosition = 1e-9;

}  // namespace

double Section::face(double q, double k) const {
  const double in = -inside.at(q), out = outside.at(q);
  const int between = rows_between();
  const double base = first_face_to_bead ? faces[0].at(q) : 0.0;
  const double past = faces.empty() ? 1.0 : std::clamp((q - faces_to) / kFaceTransition, 0.0, 1.0);
  const auto on_ply = [&](int j) {
    const double sidewall = base + (out - base) * j / (between + rows_outside);
    if (past == 1.0) return sidewall;
    return faces[j].at(q) + past * (sidewall - faces[j].at(q));
  };
  const double first = on_ply(0), above = k - rows_inside;
  if (above < 0.0) return in + (first - in) * k / rows_inside;
  if (above >= between) {
    const double last = on_ply(between);
    return last + (out - last) * (above - between) / rows_outside;
  }
  const int j = static_cast<int>(above);
  const double lower = on_ply(j);
  return above > j ? lower + (above - j) * (on_ply(j + 1) - lower) : lower;
}

std::optional<double> Section::crown_columns() const {
  if (faces.empty()) return std::nullopt;
  const double half = 0.5 * meridional;
  for (double columns = half - std::floor(half); columns < half; columns += 1.0) {
    const double q = std::abs(station(half + columns));
    if (q >= faces_to + kFaceTransition - kSamePosition) return columns;
  }
  return std::nullopt;
}

std::vector<double> Section::sector_planes(int refinement) const {
  if (sector_zones.empty()) return {};
  const int half = refinement * sectors / 2;
  std::vector<double> theta = {0.0};
  double edge = 0.0;
  const auto fill = [&](int count, double to) {
    const double from = edge;
    for (int k = 1; k <= count; ++k) theta.push_back(from + (to - from) * k / count);
    edge = to;
  };
  for (const SectorZone& zone : sector_zones) {
    fill(refinement * zone.sectors, edge + zone.sectors * zone.width);
  }
  fill(half + 1 - static_cast<int>(theta.size()), std::numbers::pi);
  for (int s = half - 1; s > 0; --s) theta.push_back(2.0 * std::numbers::pi - theta[s]);
  return theta;
}

double Section::station(double column) const {
  const double s = 2.0 * column / meridional - 1.0;
  const double wanted = moved_to_ends(*this, 0.5 * meridional * std::abs(s));
  if (!columns.empty()) return std::copysign(interpolate(columns, wanted), s);
  if (spacing.position.empty()) return std::copysign(wanted / (0.5 * meridional), s);
  const double before = wanted / (0.5 * meridional) * elements_before(spacing, 1.0);
  double low = 0.0, high = 1.0, q = wanted / (0.5 * meridional);
  for (int i = 0; i < 60 && high - low > 1e-16; ++i) {  // Newton's method, limited to the bracket
    const double left = before - elements_before(spacing, q);
    if (left == 0.0) break;
    (left > 0.0 ? low : high) = q;
    const double next = q + left * length_at(spacing, q), last = q;
    q = next > low && next < high ? next : 0.5 * (low + high);
    if (std::abs(q - last) <= 1e-16) break;
  }
  return std::copysign(q, s);
}

}  // namespace latsch::fe_tire
