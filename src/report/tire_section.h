// SPDX-License-Identifier: Apache-2.0
// The cross section of a tire as polygons and lines for drawing.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "report/report.h"

namespace latsch::report {

/// Returns the positions (y, radius), m, of the nodes of a sector as built.
std::vector<Eigen::Vector2d> section_nodes(const fe_tire::Mesh& mesh);

/// Returns the corners of an element's face xi = -1: inner at -y, inner at +y, outer at +y, outer
/// at -y. Tied corners lie between the nodes to which they are tied.
std::array<Eigen::Vector2d, 4> section_corners(const fe_tire::Element& element,
                                               const std::vector<Eigen::Vector2d>& nodes);

/// Returns the two points, m, at which a cord layer at the parametric thickness zeta enters and
/// leaves the element's cross section.
std::array<Eigen::Vector2d, 2> cord_ends(const fe_tire::Mesh& mesh,
                                         const fe_tire::Element& element,
                                         double zeta);

struct TireSection {
  struct Part {
    std::string part;                      // name of the rubber region or of the ply
    std::vector<Eigen::Vector2d> corners;  // (y, radius), m
  };
  std::vector<Part> polygons, cords;
};
TireSection tire_section(const TirePictures& pictures);

}  // namespace latsch::report
