// SPDX-License-Identifier: Apache-2.0
// Fields of a whole tire that rolls, for pictures: velocities of its nodes, and strains, stresses,
// energies and losses of its elements. They are those of the chains of rolling_chain.h: in the
// middle of an element, in the radial, circumferential and axial axes of its sector's middle.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "models/fe_tire/rolling/rolling_losses.h"

namespace latsch::fe_tire {

/// Values of a layer of cords in all elements of the ring, 0 in elements without it.
struct CordFields {
  std::string name;                   // name in the tire's file
  Eigen::RowVectorXd strain, stress;  // stress in Pa
  Eigen::RowVectorXd force;           // N/m, along the cords for each meter across them
};

/// Elements follow each other sector by sector, as in Mesh::elements.
struct RollingFields {
  Eigen::Matrix3Xd v;                      // m/s, [3 x nodes] of the whole ring, sector frames
  Eigen::MatrixXd E;                       // [6 x elements], Green-Lagrange, engineering shear
  Eigen::MatrixXd S;                       // [6 x elements], Pa, second Piola-Kirchhoff
  Eigen::RowVectorXd energy, dissipation;  // J/m^3, W/m^3, of the solid
  std::vector<CordFields> cords;           // one for each layer of the tire
};

/// Returns the fields in a state with these displacements, enhanced strains and speed, rad/s.
RollingFields rolling_fields(const LossMeter& meter,
                             const Eigen::Matrix3Xd& u,
                             const Eigen::VectorXd& alpha,
                             double Omega);

}  // namespace latsch::fe_tire
