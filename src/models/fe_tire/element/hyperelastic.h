// SPDX-License-Identifier: Apache-2.0
// Stress and tangent of the solid materials as functions of the Green-Lagrange strain E, where C =
// I + 2 E.
#pragma once

#include "models/fe_tire/mesh/materials.h"

namespace latsch::fe_tire {

/// Computes the second Piola-Kirchhoff stress S and, if D is not null, the tangent D = dS/dE at the
/// strain E (Voigt order, engineering shear). Returns false if det C <= 0, that is, if the material
/// is inverted.
bool stress(const Hyperelastic& law, const Vector6& E, Vector6& S, Matrix6* D);
bool stress(const StVenantKirchhoff& law, const Vector6& E, Vector6& S, Matrix6* D);

/// Returns the stored energy per volume without load, J/m^3, or NaN if det C <= 0.
double energy(const Hyperelastic& law, const Vector6& E);
double energy(const StVenantKirchhoff& law, const Vector6& E);

}  // namespace latsch::fe_tire
