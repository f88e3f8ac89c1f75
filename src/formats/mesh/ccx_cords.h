// SPDX-License-Identifier: Apache-2.0
// Cords of a tire for CalculiX, which has no rebars: a spring for every layer in an element.
//
// The spring leads along the cords through the middle of the layer's surface in the element. Linear
// equations tie its ends to the corners of the element, so it has no freedom of its own. The
// surface is bilinear, x = x_0 + xi x_1 + eta x_2 + xi eta x_12, and both ends differ from the
// middle by the same amounts, so the spring's stretch is that of a cord at the middle, whatever the
// spring's length. Its cross section is the layer's volume over the length: the layer has one
// integration point. Four points lock (hex8_rebar.cpp, terms 2 to 4): the inflated 205/55R16 grows
// by 0.8 to 1.1 mm with them in place of 1.4 mm. Two points, side by side, buckle in compression.
// One point resists no motion of neighboring sectors against each other, which only the rubber
// does: such modes of the deck alone lie above first_loose_mode().
//
// The force is that of cord_law.h, with both moduli and the pretension. Half of the layer's mass is
// at either end. inp_cords.h reads these cards back.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "models/fe_tire/element/materials.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::formats {

/// The surface of a layer in an element, x = X0 + xi X1 + eta X2 + xi eta X12, m.
struct CordSurface {
  /// Takes the element's corners in the order of Element::node, in a frame whose y axis is the spin
  /// axis.
  CordSurface(const Eigen::Matrix<double, 3, 8>& X, double zeta);

  double area() const;
  /// Columns: tangents along xi and eta at the middle.
  Eigen::Matrix<double, 3, 2> tangents() const;
  /// Columns: unit vectors in the surface at the middle, along the circumference toward increasing
  /// theta, and the outward normal's product with it.
  Eigen::Matrix<double, 3, 2> axes() const;
  /// Returns the direction of a cord at the middle in xi and eta; the larger component is of size
  /// 1.
  Eigen::Vector2d cord(double angle) const;

  Eigen::Vector3d X0, X1, X2, X12;
};

struct CordSpring {
  /// An end, as the mean of nodes with weights that add up to one. Numbers from nodes_per_sector on
  /// belong to the next sector.
  struct End {
    Eigen::Vector3d x;  // m, sector frame
    std::map<int, double> weights;
  };
  int layer = 0;  // index in the materials
  std::array<End, 2> ends;
  double length = 0.0, area = 0.0, mass = 0.0;  // m, m^2, kg
};

/// Returns the springs of a sector, element by element.
std::vector<CordSpring> cord_springs(const fe_tire::Mesh& mesh,
                                     const fe_tire::Materials& materials,
                                     int sector);

/// Returns points of force, N, over elongation, m, between which CalculiX interpolates linearly.
std::vector<std::pair<double, double>> force_law(const fe_tire::CordLayer& layer,
                                                 const CordSpring& spring);

/// Returns a frequency, Hz, from which on modes may be those of neighboring sectors moving against
/// each other, by the widest sector of the deck: the least of three measurements on the 205/55R16,
/// 31 Hz with 16 and 74 Hz with 40 equal sectors, 43.9 Hz with 40 of at most 13.1 degrees. Other
/// tires are not measured.
double first_loose_mode(const fe_tire::Mesh& mesh);

}  // namespace latsch::formats
