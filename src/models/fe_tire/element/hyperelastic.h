// SPDX-License-Identifier: Apache-2.0
// Stress and tangent of the solids from the Green-Lagrange strain, C = I + 2 E.
#pragma once

#include "models/fe_tire/element/materials.h"

namespace latsch::fe_tire {

/// Second Piola-Kirchhoff stress S and, where asked for, D = dS/dE of the strain E (Voigt,
/// engineering shear). False where det C <= 0: the material is turned inside out.
bool stress(const Hyperelastic& law, const Vector6& E, Vector6& S, Matrix6* D);
bool stress(const StVenantKirchhoff& law, const Vector6& E, Vector6& S, Matrix6* D);

/// Stored energy per reference volume, J/m^3. NaN where det C <= 0.
double energy(const Hyperelastic& law, const Vector6& E);
double energy(const StVenantKirchhoff& law, const Vector6& E);

}  // namespace latsch::fe_tire
