// SPDX-License-Identifier: Apache-2.0
// Cords of a tire for CalculiX, which has no rebars: every layer in an element becomes one spring.
//
// The spring runs along the cords through the middle of the layer's surface in the element. Linear
// equations tie its ends to the corners of the element, so it adds no degrees of freedom. The
// surface is bilinear, x = x_0 + xi x_1 + eta x_2 + xi eta x_12, and both ends differ from the
// middle by the same amounts, so the stretch of the spring is that of a cord at the middle,
// whatever the length of the spring. Its cross section is the volume of the layer over the length:
// the layer has one integration point. Four points lock (hex8_rebar.cpp, terms 2 to 4): the
// inflated 205/55R16 grows by 0.8 to 1.1 mm with them instead of 1.4 mm. Two points, side by side,
// buckle in compression. One point does not resist motions of neighboring sectors against each
// other, which only the rubber resists; such spurious modes of the deck lie above
// first_loose_mode().
//
// The force is that of cord_law.h, with both moduli and the pretension. Half of the layer's mass is
// at either end. inp_cords.h reads these cards back.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "models/fe_tire/mesh/materials.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::formats {

/// The surface of a layer in an element, x = X0 + xi X1 + eta X2 + xi eta X12, m.
struct CordSurface {
  /// Creates the surface at the local coordinate `zeta` of an element. X has the element's corners
  /// in the order of Element::node, in a frame whose y axis is the spin axis.
  CordSurface(const Eigen::Matrix<double, 3, 8>& X, double zeta);

  double area() const;
  /// Returns the tangents along xi and eta at the middle, as columns.
  Eigen::Matrix<double, 3, 2> tangents() const;
  /// Returns two unit vectors in the surface at the middle, as columns: along the circumference
  /// toward increasing theta, and the cross product of the outward normal with it.
  Eigen::Matrix<double, 3, 2> axes() const;
  /// Returns the direction of a cord at the middle in xi and eta, scaled so that the larger
  /// component has the magnitude 1.
  Eigen::Vector2d cord(double angle) const;

  Eigen::Vector3d X0, X1, X2, X12;
};

struct CordSpring {
  /// An end of a spring, as the mean of nodes with weights that add up to one. Node numbers from
  /// nodes_per_sector on belong to the next sector.
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

/// Returns the force law of a spring as points (elongation and force, m and N), between which
/// CalculiX interpolates linearly.
std::vector<std::pair<double, double>> force_law(const fe_tire::CordLayer& layer,
                                                 const CordSpring& spring);

/// Returns a frequency, Hz, above which modes of the deck may be spurious motions of neighboring
/// sectors against each other. It depends on the widest sector and is the least of three
/// measurements on the 205/55R16: 31 Hz with 16 and 74 Hz with 40 equal sectors, 43.9 Hz with 40
/// sectors of at most 13.1 degrees. Other tires were not measured.
double first_loose_mode(const fe_tire::Mesh& mesh);

}  // namespace latsch::formats
