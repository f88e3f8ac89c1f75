// SPDX-License-Identifier: Apache-2.0
// The section of a tire as polygons and lines for drawing.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "report/report.h"

namespace latsch::report {

/// Returns the positions (y, radius) of a sector's nodes as built, m.
std::vector<Eigen::Vector2d> section_nodes(const fe_tire::Mesh& mesh);

/// Returns the corners of an element's face xi = -1: inner - +, outer + -. Tied corners lie between
/// their nodes.
std::array<Eigen::Vector2d, 4> section_corners(const fe_tire::Element& element,
                                               const std::vector<Eigen::Vector2d>& nodes);

/// Returns the cord's ends at which its layer leaves the element, at parametric thickness zeta, m.
std::array<Eigen::Vector2d, 2> cord_ends(const fe_tire::Mesh& mesh,
                                         const fe_tire::Element& element,
                                         double zeta);

struct TireSection {
  struct Part {
    std::string part;                      // region of its rubber, or its ply
    std::vector<Eigen::Vector2d> corners;  // (y, radius), m
  };
  std::vector<Part> polygons, cords;
};
TireSection tire_section(const TirePictures& pictures);

}  // namespace latsch::report
