// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/inp_materials.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "formats/mesh/hexahedron.h"

namespace latsch::formats {
namespace {

using fe_tire::Matrix6;

fe_tire::StVenantKirchhoff isotropic(double E, double nu) {
  const double G = E / (2.0 * (1.0 + nu)), lambda = 2.0 * G * nu / (1.0 - 2.0 * nu);
  return fe_tire::StVenantKirchhoff::isotropic(G, lambda);
}

/// The upper triangle column by column, 11 22 33 12 13 23 (CalculiX, Abaqus), to 11 22 33 12 23 13.
Matrix6 anisotropic(const std::vector<double>& c) {
  Matrix6 D;
  int next = 0;
  for (int column = 0; column < 6; ++column)
    for (int row = 0; row <= column; ++row) {
      D(kVoigtOfCalculix[row], kVoigtOfCalculix[column]) = c[next];
      D(kVoigtOfCalculix[column], kVoigtOfCalculix[row]) = c[next++];
    }
  return D;
}

}  // namespace

fe_tire::Solid solid_from(const InpMaterial& material, const InpUnits& units) {
  const double stress = units.force / (units.length * units.length);
  fe_tire::Solid solid;
  if (!material.density)
    throw InputError(material.place,
                     fmt::format("material {} has no *DENSITY, expected one", material.name));
  solid.density = *material.density * units.mass / std::pow(units.length, 3);
  if (material.hyperelastic) {
    const auto& law = *material.hyperelastic;
    solid.law = fe_tire::Hyperelastic{law.C10 * stress, law.C01 * stress, 2.0 / law.D1 * stress};
  } else if (!material.elastic.empty()) {
    solid.law =
        fe_tire::StVenantKirchhoff{isotropic(material.elastic[0], material.elastic[1]).D * stress};
  } else if (!material.anisotropic.empty()) {
    const Matrix6 D = anisotropic(material.anisotropic);
    if (Eigen::LLT<Matrix6>(D).info() != Eigen::Success)
      throw InputError(
          material.place,
          fmt::format("the stiffness of material {} is not positive definite", material.name));
    solid.law = fe_tire::StVenantKirchhoff{D * stress};
  } else {
    throw InputError(
        material.place,
        fmt::format("material {} has no law, expected *HYPERELASTIC or *ELASTIC", material.name));
  }
  return solid;
}

}  // namespace latsch::formats
