// SPDX-License-Identifier: Apache-2.0
// Assigns names to mode shapes: circumferential number n, type and, for the loaded tire, symmetry.
//
// An unloaded mode has one n. Its type is the direction that carries most of the kinetic energy:
// circumferential (only with n = 0: torsion, windup), along the spin axis (lateral) or in the wheel
// plane (radial). A loaded mode is named after the group of unloaded modes that it resembles most:
// the group whose span contains the largest share of its kinetic energy. Its phase says whether it
// is symmetric (s) or antisymmetric (a) to the plane through contact and spin axis.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"

namespace latsch::fe_tire {

/// Returns the shares of a mode's kinetic energy by direction [x, y, z of sector frames]: Re phi_k*
/// (M phi)_k summed over the unknowns k of a direction. They add up to phi* M phi on every mesh.
Eigen::Vector3d kinetic_energy(const Eigen::VectorXcd& phi, const Eigen::VectorXcd& M_phi);

/// Returns the type of a mode of circumferential number n by its kinetic energy in the directions
/// [x, y, z of sector frames].
ModeType type_of(int n, const Eigen::Vector3d& kinetic_energy);

/// Numbers modes of equal n and type 1, 2, ...; the two modes of a degenerate pair have the same
/// number. The modes must be in ascending order of frequency.
void number_orders(std::vector<Mode>& modes);

/// Names loaded modes after the unloaded modes that they resemble. Kinetic energies are computed
/// with the nodal masses [nodes], kg.
void name_after(const std::vector<Mode>& unloaded,
                const Eigen::VectorXd& nodal_mass,
                std::vector<Mode>& loaded);

/// Returns 's' if a shape [3 x nodes] is similar to its mirror image in the plane x = 0, 'a' if it
/// is similar to the opposite of this image, ' ' if neither holds or if the mesh is not symmetric.
char phase_of(const Mesh& mesh, const Eigen::Matrix3Xd& shape);

}  // namespace latsch::fe_tire
