// SPDX-License-Identifier: Apache-2.0
#include "report/tire_pictures.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "report/color_map.h"
#include "report/html_text.h"
#include "report/svg_plot.h"
#include "report/tire_section.h"

namespace latsch::report {
namespace {

constexpr double kOneMillimeter = 1e-3;
/// Returns the position in the cross section: y and radius, mm.
Point in_section(const Eigen::Vector3d& X) {
  return {X.y() / kOneMillimeter, std::hypot(X.x(), X.z()) / kOneMillimeter};
}

/// Maps a box in the real world to a box in the picture, with one scale for both axes and the
/// second coordinate upward.
struct Window {
  Eigen::AlignedBox2d world;
  Point corner;  // top left corner in the picture
  double scale;

  static Window fit(const Eigen::AlignedBox2d& world,
                    const Point& corner,
                    double width,
                    double height) {
    const Eigen::Vector2d size = world.sizes().cwiseMax(1e-9);
    return {world, corner, std::min(width / size.x(), height / size.y())};
  }
  Point operator()(const Point& p) const {
    return {corner.x() + scale * (p.x() - world.min().x()),
            corner.y() + scale * (world.max().y() - p.y())};
  }
  double width() const { return scale * world.sizes().x(); }
  double height() const { return scale * world.sizes().y(); }
};

/// Draws a scale bar with its length, such as "10 mm".
void scale_bar(Svg& svg, const Point& at, double pixels_per_mm) {
  double length = 100.0;
  for (double l : {5.0, 10.0, 20.0, 50.0}) {
    if (l * pixels_per_mm > 50.0) {
      length = l;
      break;
    }
  }
  const Point end = at + Point(length * pixels_per_mm, 0.0);
  svg.line(at, end, "class=\"ink\"");
  svg.line(at - Point(0, 3), at + Point(0, 3), "class=\"ink\"");
  svg.line(end - Point(0, 3), end + Point(0, 3), "class=\"ink\"");
  svg.text(0.5 * (at + end) + Point(0, -7), significant(length, 3) + " mm", TextAnchor::middle);
}

/// Draws every element of a sector in the color of its region; `nodes` are the positions in the
/// cross section.
void draw_elements(Svg& svg,
                   const fe_tire::Mesh& mesh,
                   const std::vector<Point>& nodes,
                   const Window& window) {
  std::vector<Point> corners(4);
  for (const fe_tire::Element& element : mesh.elements) {
    std::ranges::transform(section_corners(element, nodes), corners.begin(), window);
    svg.polygon(corners,
                fmt::format("fill=\"{}\" class=\"element\"", muted_category(element.region)),
                mesh.region_names.empty() ? "" : mesh.region_names.at(element.region));
  }
}

/// The plies in the order in which they occur, and the index of the ply of every cord layer; -1 if
/// the layer is not in the mesh or has no name.
struct Plies {
  std::vector<Layer> plies;
  std::vector<int> of_layer;
  int at(int layer) const {
    return layer < static_cast<int>(of_layer.size()) ? of_layer[layer] : -1;
  }
};

Plies plies_of(const fe_tire::Mesh& mesh, const std::vector<Layer>& layers) {
  std::set<int> used;
  for (const fe_tire::Element& element : mesh.elements) {
    for (const fe_tire::RebarPlacement& rebar : element.rebars) used.insert(rebar.layer);
  }
  Plies found{{}, std::vector<int>(layers.size(), -1)};
  for (int layer = 0; layer < static_cast<int>(layers.size()); ++layer) {
    if (!used.contains(layer)) continue;
    const auto same = std::find_if(found.plies.begin(), found.plies.end(), [&](const Layer& ply) {
      return ply.name == layers[layer].name;
    });
    found.of_layer[layer] = static_cast<int>(same - found.plies.begin());
    if (same == found.plies.end()) found.plies.push_back(layers[layer]);
  }
  return found;
}

std::string cord_color(int ply) {
  return ply < 0 ? "class=\"cord ink\""
                 : fmt::format("stroke=\"{}\" class=\"cord\"", category(ply));
}

void section_legend(
    Svg& svg, const fe_tire::Mesh& mesh, const Plies& plies, bool inflated, Point at) {
  for (size_t r = 0; r < mesh.region_names.size(); ++r) {
    svg.rectangle(
        at - Point(0, 10),
        14,
        11,
        fmt::format("fill=\"{}\" class=\"element\"", muted_category(static_cast<int>(r))));
    svg.text(at + Point(21, 0), mesh.region_names[r], TextAnchor::start, "label");
    at.y() += 20;
  }
  for (size_t p = 0; p < plies.plies.size(); ++p) {
    const Layer& ply = plies.plies[p];
    svg.line(at + Point(0, -4), at + Point(14, -4), cord_color(static_cast<int>(p)));
    svg.text(at + Point(21, 0),
             fmt::format("{}, {}°", ply.name, fixed(ply.angle * 180.0 / std::numbers::pi, 0)),
             TextAnchor::start,
             "label");
    at.y() += 20;
  }
  if (inflated) {
    svg.line(at + Point(0, -4), at + Point(14, -4), "class=\"inflated\"");
    svg.text(at + Point(21, 0), "inflated", TextAnchor::start, "label");
  }
}

/// Returns the rectangle of road that a contact point represents. It extends half way to the
/// neighboring points and, at the edge of the contact patch, as far outward as inward. The
/// rectangles of integration points meet at the edges and the centers of elements.
Eigen::AlignedBox2d cell_of(const std::vector<fe_tire::ContactPatch::Point>& points, size_t i) {
  const Eigen::Vector2d here(points[i].x, points[i].y);
  Eigen::AlignedBox2d cell;
  for (int axis = 0; axis < 2; ++axis) {
    double ahead = std::numeric_limits<double>::infinity(), behind = ahead;
    for (const auto& other : points) {
      const Eigen::Vector2d away = Eigen::Vector2d(other.x, other.y) - here;
      if (std::abs(away[1 - axis]) > 0.25 * std::abs(away[axis])) continue;
      if (away[axis] > 0.0) ahead = std::min(ahead, away[axis]);
      if (away[axis] < 0.0) behind = std::min(behind, -away[axis]);
    }
    // a point at a larger distance is no neighbor
    const double largest = 3.0 * std::sqrt(points[i].area);
    const double nearest = std::min({ahead, behind, largest / 3.0});
    cell.min()[axis] = here[axis] - 0.5 * (behind < largest ? behind : nearest);
    cell.max()[axis] = here[axis] + 0.5 * (ahead < largest ? ahead : nearest);
  }
  return {cell.min() / kOneMillimeter, cell.max() / kOneMillimeter};
}

}  // namespace

std::string section_picture(const fe_tire::Mesh& mesh,
                            const std::vector<Layer>& layers,
                            const fe_tire::Inflated* inflated) {
  std::vector<Point> nodes, grown;
  nodes.reserve(mesh.nodes_per_sector());
  Eigen::AlignedBox2d box;
  for (int k = 0; k < mesh.nodes_per_sector(); ++k) {
    nodes.push_back(in_section(mesh.X.col(k)));
    box.extend(nodes.back());
    if (inflated) {
      grown.push_back(in_section(mesh.X.col(k) + inflated->u.col(k)));
      box.extend(grown.back());
    }
  }
  const Plies plies = plies_of(mesh, layers);
  const Window window = Window::fit(box, {14, 14}, 560, 330);
  Svg svg(780, window.height() + 62, "Section of the tire");
  draw_elements(svg, mesh, nodes, window);
  for (const fe_tire::Element& element : mesh.elements) {
    for (const fe_tire::RebarPlacement& rebar : element.rebars) {
      const auto [a, b] = cord_ends(mesh, element, rebar.zeta);
      svg.line(window(a / kOneMillimeter),
               window(b / kOneMillimeter),
               cord_color(plies.at(rebar.layer)));
    }
  }
  if (inflated) {  // draws the edges of the outer faces of the inflated tire, element by element
    for (const fe_tire::Element& element : mesh.elements) {
      const std::array<Point, 4> at = section_corners(element, grown);
      if (element.inner) svg.line(window(at[0]), window(at[1]), "class=\"inflated\"");
      svg.line(window(at[3]), window(at[2]), "class=\"inflated\"");
    }
  }
  for (int k : mesh.clamped)
    svg.circle(window(nodes[k]), 2.2, "class=\"clamped\"", "held by the rim");
  section_legend(
      svg, mesh, plies, inflated != nullptr, {window.corner.x() + window.width() + 34, 30});
  scale_bar(svg, {window.corner.x(), window.height() + 46}, window.scale);
  svg.text({window.corner.x() + window.width(), window.height() + 46},
           "dots: held by the rim",
           TextAnchor::end);
  return svg.str();
}

std::string loaded_section_picture(const fe_tire::Mesh& mesh,
                                   const fe_tire::Inflated& inflated,
                                   const Eigen::Matrix3Xd& loaded,
                                   double loaded_radius) {
  std::vector<Point> before, after;
  Eigen::AlignedBox2d box;
  // sector 0 is at the bottom, where the radius points downward
  for (int k = 0; k < mesh.nodes_per_sector(); ++k) {
    const auto upright = [&](const Eigen::Vector3d& u) -> Point {
      return Point(mesh.X(1, k) + u.y(), mesh.X(2, k) + u.z()) / kOneMillimeter;
    };
    before.push_back(upright(inflated.u.col(k)));
    after.push_back(upright(loaded.col(k)));
    box.extend(before.back());
    box.extend(after.back());
  }
  const Window window = Window::fit(box, {14, 14}, 472, 330);
  Svg svg(500, window.height() + 50, "Section of the loaded tire above the contact");
  draw_elements(svg, mesh, after, window);
  for (const fe_tire::Element& element : mesh.elements) {
    const std::array<Point, 4> at = section_corners(element, before);
    svg.line(window(at[3]), window(at[2]), "class=\"inflated\"");
  }
  const double ground = window({0.0, -loaded_radius / kOneMillimeter}).y();
  svg.line({4, ground}, {window.width() + 24, ground}, "class=\"ground\"");
  scale_bar(svg, {window.corner.x(), window.height() + 40}, window.scale);
  return svg.str();
}

std::string patch_picture(const fe_tire::ContactPatch& patch) {
  if (patch.points.empty()) return "";
  double highest = 0.0;
  Eigen::AlignedBox2d box;
  std::vector<Eigen::AlignedBox2d> cells;
  for (size_t i = 0; i < patch.points.size(); ++i) {
    highest = std::max(highest, patch.points[i].pressure);
    cells.push_back(cell_of(patch.points, i));
    box.extend(cells.back());
  }
  const Window window = Window::fit(box, {70, 20}, 520, 300);
  const double bottom = window.corner.y() + window.height(),
               right = window.corner.x() + window.width();
  const Axis x(box.min().x(), box.max().x(), window.corner.x(), right);
  const Axis y(box.min().y(), box.max().y(), bottom, window.corner.y());
  const Axis kPa = Axis::around({0.0, highest / 1e3}, bottom, window.corner.y(), true);
  Svg svg(right + 120, bottom + 46, "Contact pressure");
  draw_frame(svg, x, y, "x, forward [mm]", "y, left [mm]", {.x_spacing = 40.0});
  for (size_t i = 0; i < patch.points.size(); ++i) {
    const auto& p = patch.points[i];
    // The rectangle is slightly enlarged, so that rounding to whole pixels leaves no gaps.
    const Eigen::Vector2d size = (cells[i].sizes() * window.scale).array() + 0.7;
    svg.rectangle(window({cells[i].min().x(), cells[i].max().y()}),
                  size.x(),
                  size.y(),
                  fmt::format("fill=\"{}\" shape-rendering=\"crispEdges\"",
                              viridis(p.pressure / 1e3 / kPa.upper())),
                  fmt::format("{} kPa at ({}, {}) mm",
                              fixed(p.pressure / 1e3, 0),
                              fixed(p.x / kOneMillimeter, 1),
                              fixed(p.y / kOneMillimeter, 1)));
  }
  draw_color_bar(svg, {right + 26, window.corner.y()}, window.height(), kPa, "Pressure [kPa]");
  return svg.str();
}

}  // namespace latsch::report
