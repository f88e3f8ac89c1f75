// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/section_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace latsch::fe_tire {
namespace {

constexpr int kSamples = 200;  // number of points along the wall, from bead to bead

/// Smallest thickness of a row of elements. Two plies are separated at least by their rubber
/// coating. Thinner rows would make the tangent ill-conditioned.
constexpr double kThinnestRow = 1e-4;  // m

double cross(MeridianPoint a, MeridianPoint b, MeridianPoint c) {
  return (b.y - a.y) * (c.r - a.r) - (b.r - a.r) * (c.y - a.y);
}

bool segments_cross(MeridianPoint a, MeridianPoint b, MeridianPoint c, MeridianPoint d) {
  return cross(a, b, c) * cross(a, b, d) < 0.0 && cross(c, d, a) * cross(c, d, b) < 0.0;
}

std::string here(MeridianPoint p) {
  return fmt::format("y = {:.1f} mm, r = {:.1f} mm", 1e3 * p.y, 1e3 * p.r);
}

/// Returns the closed outline: the inner face from the +y to the -y bead, then the outer face back.
std::vector<MeridianPoint> outline(const Section& section) {
  const Contour line(section.contour);
  std::vector<MeridianPoint> inner, outer;
  for (int i = 0; i <= kSamples; ++i) {
    const double s = 2.0 * i / kSamples - 1.0, q = std::abs(s);
    inner.push_back(line.offset(s, -section.inside.at(q)));
    outer.push_back(line.offset(s, section.outside.at(q)));
  }
  inner.insert(inner.end(), outer.rbegin(), outer.rend());
  return inner;
}

}  // namespace

std::string wall_conflict(const Section& section) {
  const std::vector<MeridianPoint> wall = outline(section);
  const int n = static_cast<int>(wall.size());
  for (const MeridianPoint& p : wall)
    if (p.r <= 0.0) return "reaches the spin axis at " + here(p);
  for (int i = 0; i + 1 < n; ++i)
    for (int j = i + 2; j + 1 < n; ++j)
      if (segments_cross(wall[i], wall[i + 1], wall[j], wall[j + 1]))
        return "makes a wall that crosses itself at " + here(wall[i]);
  return {};
}

std::string ply_conflict(const Section& section, const CordPly& ply) {
  for (int i = 0; i <= kSamples; ++i) {
    const double q = double(i) / kSamples;
    if (!ply.extent.contains(q)) continue;
    const double in = section.inside.at(q), out = section.outside.at(q), offset = ply.offset.at(q);
    if (offset < -in || offset > out)
      return fmt::format(
          "puts the layer outside the wall at position {:.2f}: offset {:.2f} mm, the wall reaches "
          "from {:.2f} to {:.2f} mm",
          q,
          1e3 * offset,
          -1e3 * in,
          1e3 * out);
  }
  return {};
}

std::string row_conflict(const Section& section) {
  for (int i = 0; i <= kSamples; ++i) {
    const double q = double(i) / kSamples;
    for (int k = 0; k < section.rows(); ++k) {
      const double thickness = section.face(q, k + 1) - section.face(q, k);
      if (thickness < kThinnestRow)
        return fmt::format(
            "makes a row of elements {:.2f} mm thick at position {:.2f}, expected layers from "
            "inside to outside, at least {} mm apart and as far from the faces of the wall",
            1e3 * thickness,
            q,
            1e3 * kThinnestRow);
    }
  }
  return {};
}

OuterSize outer_size(const Section& section) {
  const Contour line(section.contour);
  OuterSize size;
  for (int i = 0; i <= kSamples; ++i) {
    const double s = 2.0 * i / kSamples - 1.0;
    const MeridianPoint p = line.offset(s, section.outside.at(std::abs(s)));
    size.radius = std::max(size.radius, p.r);
    size.width = std::max(size.width, 2.0 * std::abs(p.y));
  }
  return size;
}

}  // namespace latsch::fe_tire
