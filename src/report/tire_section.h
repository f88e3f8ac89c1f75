// SPDX-License-Identifier: Apache-2.0
// The section of a tire as polygons and lines, for whoever draws it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "report/report.h"

namespace latsch::report {

/// Positions (y, radius) of a sector's nodes as built, m.
std::vector<Eigen::Vector2d> section_nodes(const fe_tire::Mesh& mesh);

/// Corners of an element's face xi = -1: inner - +, outer + -. Tied ones lie between their nodes.
std::array<Eigen::Vector2d, 4> section_corners(const fe_tire::Element& element,
                                               const std::vector<Eigen::Vector2d>& nodes);

/// The cord's ends where its layer leaves the element, at parametric thickness zeta, m.
std::array<Eigen::Vector2d, 2> cord_ends(const fe_tire::Mesh& mesh,
                                         const fe_tire::Element& element,
                                         double zeta);

struct TireSection {
  struct Part {
    std::string part;                      // its rubber's region, or its ply
    std::vector<Eigen::Vector2d> corners;  // (y, radius), m
  };
  std::vector<Part> polygons, cords;
};
TireSection tire_section(const TirePictures& pictures);

}  // namespace latsch::report
