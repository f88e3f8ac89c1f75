// SPDX-License-Identifier: Apache-2.0
// A chain of points around a rolling tire: motion, strain, stress, stored energy and dissipation
// at one place of the section, for all sectors.
//
// Positions are those of a closed cubic spline p(theta) through the place's points on the planes
// between sectors, in axes that turn with theta: x = R(theta) p. In the steady state material
// moves along it,
//   v = -Omega dx/dtheta,   a = Omega^2 d2x/dtheta2                                    (V.1), (V.2)
// toward decreasing theta. Trilinear elements have no second derivative of their own.
//   Strains and stresses are means of the Gauss points of the element at this place, in the axes
// of the point (radial, circumferential, axial), at the middle of the sector; those of a cord layer
// are means of its four points. The dissipated power is sum of h_S : h_E/(beta tau) over the
// terms, where h_S and h_E are the histories (H.2) of stress and strain. It is what the dashpots
// take: it is nowhere negative for a linear law, and its integral is the power that is lost.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/rolling/rolling_losses.h"

namespace latsch::fe_tire {

/// A place of the section.
struct ChainPlace {
  int element = 0;    // index into Mesh::elements
  double zeta = 0.0;  // through the element, -1 inner face, +1 outer face
  int cords = -1;     // cord layer of the element; -1: none
};

/// Finds a place. `position`: along the inner face by arc length, 0 in its middle (crown), 1 at the
/// +y bead, -1 at the -y bead. `depth`: "inner" or "outer" face, or the name of a layer of the
/// tire's file. A Failure says which layers cross the wall there.
Result<ChainPlace> find_place(const Mesh& mesh,
                              const LossMaterials& materials,
                              double position,
                              const std::string& depth);

/// A point of the chain, in the middle of a sector.
struct ChainPoint {
  double theta;                     // rad, NOTATION.md
  Eigen::Vector3d x, u, v, a;       // m, m, m/s, m/s^2, axes of the wheel
  Vector6 E, S;                     // Green-Lagrange strain, second Piola-Kirchhoff stress, Pa
  double cord_strain, cord_stress;  // strain; stress of the layer, Pa; 0 without one
  double cord_force;                // N/m, along the cords for each meter across them
  double energy;                    // J/m^3, stored by the solid
  double dissipation;               // W/m^3, lost by the solid
};

/// Returns the chain in a state with these displacements, enhanced strains and speed, in the order
/// of the sectors.
std::vector<ChainPoint> chain(const LossMeter& meter,
                              const ChainPlace& place,
                              const Eigen::Matrix3Xd& u,
                              const Eigen::VectorXd& alpha,
                              double Omega);

}  // namespace latsch::fe_tire
