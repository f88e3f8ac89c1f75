// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/inp_materials.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "formats/mesh/hexahedron.h"

namespace latsch::formats {
namespace {

using fe_tire::Matrix6;
using Law = InpMaterial::Law;

std::vector<double> values_of(const InpDeck& deck, const InpMaterial& material) {
  std::vector<double> values;
  for (const int number : material.constants) values.push_back(deck.value(number));
  return values;
}

Matrix6 isotropic(double E, double nu) {
  const double G = E / (2.0 * (1.0 + nu)), lambda = 2.0 * G * nu / (1.0 - 2.0 * nu);
  return fe_tire::StVenantKirchhoff::isotropic(G, lambda).D;
}

/// Converts the upper triangle of an elasticity matrix, column by column, from the order 11, 22,
/// 33, 12, 13, 23 (CalculiX, Abaqus) to 11, 22, 33, 12, 23, 13.
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

/// Reads D1111 D1122 D2222 D1133 D2233 D3333 D1212 D1313 D2323.
Matrix6 orthotropic(const std::vector<double>& c) {
  return anisotropic(
      {c[0], c[1], c[2], c[3], c[4], c[5], 0, 0, 0, c[6], 0, 0, 0, 0, c[7], 0, 0, 0, 0, 0, c[8]});
}

/// Returns the elasticity matrix for E1 E2 E3 nu12 nu13 nu23 G12 G13 G23, where strain_22 = -nu12 /
/// E1 stress_11.
Matrix6 engineering(const std::vector<double>& c) {
  Eigen::Matrix3d compliance;
  compliance << 1.0 / c[0], -c[3] / c[0], -c[4] / c[0],  //
      -c[3] / c[0], 1.0 / c[1], -c[5] / c[1],            //
      -c[4] / c[0], -c[5] / c[1], 1.0 / c[2];
  Matrix6 D = Matrix6::Zero();
  D.topLeftCorner<3, 3>() = compliance.inverse();
  for (int k = 0; k < 3; ++k) D(kVoigtOfCalculix[3 + k], kVoigtOfCalculix[3 + k]) = c[6 + k];
  return D;
}

/// Rotates the elasticity tensor of a material: D'_ijkl = R_ip R_jq R_kr R_ls D_pqrs.
Matrix6 turned(const Matrix6& D, const Eigen::Matrix3d& R) {
  using namespace fe_tire::voigt;
  Matrix6 T;  // S' = T S
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      const int i = kRow[a], j = kColumn[a], p = kRow[b], q = kColumn[b];
      T(a, b) = p == q ? R(i, p) * R(j, p) : R(i, p) * R(j, q) + R(i, q) * R(j, p);
    }
  return T * D * T.transpose();
}

Eigen::Matrix3d rotation(const InpDeck& deck, const InpOrientation& orientation) {
  if (orientation.angle < 0) return Eigen::Matrix3d::Identity();
  const double angle = deck.value(orientation.angle) * std::numbers::pi / 180.0;
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(orientation.axis - 1)).toRotationMatrix();
}

fe_tire::Hyperelastic rubber(const InpMaterial& material, const std::vector<double>& c) {
  const double C10 = c[0], C01 = material.law == Law::neo_hooke ? 0.0 : c[1], D1 = c.back();
  if (!(D1 > 0.0))
    throw InputError(material.place,
                     fmt::format("material {}: D1 is {}, expected more than 0 (the law is "
                                 "compressible)",
                                 material.name,
                                 D1));
  if (!(C10 > 0.0) || C01 < 0.0)
    throw InputError(
        material.place,
        fmt::format("material {}: C10 and C01 give no positive shear modulus", material.name));
  return {C10, C01, 2.0 / D1};
}

void expect_elastic(const InpMaterial& material, double E, double nu) {
  if (!(E > 0.0) || !(nu > -1.0 && nu < 0.5))
    throw InputError(material.place,
                     fmt::format("material {}: E = {}, nu = {}, expected E > 0 and -1 < nu < 0.5",
                                 material.name,
                                 E,
                                 nu));
}

Matrix6 stiffness(const InpMaterial& material, const std::vector<double>& c) {
  if (material.law == Law::isotropic) {
    expect_elastic(material, c[0], c[1]);
    return isotropic(c[0], c[1]);
  }
  if (material.law == Law::engineering_constants)
    for (const int k : {0, 1, 2, 6, 7, 8})
      if (!(c[k] > 0.0))
        throw InputError(
            material.place,
            fmt::format("material {}: a modulus of {}, expected more than 0", material.name, c[k]));
  const Matrix6 D = material.law == Law::engineering_constants ? engineering(c)
                    : material.law == Law::orthotropic         ? orthotropic(c)
                                                               : anisotropic(c);
  if (Eigen::LLT<Matrix6>(D).info() != Eigen::Success)
    throw InputError(
        material.place,
        fmt::format("the stiffness of material {} is not positive definite", material.name));
  return D;
}

double density(const InpDeck& deck, const InpMaterial& material) {
  const double value = deck.value(material.density);
  if (!(value > 0.0))
    throw InputError(
        material.place,
        fmt::format("material {}: density {}, expected more than 0", material.name, value));
  return to_si(value, InpQuantity::density, deck.units);
}

}  // namespace

bool has_directions(const InpMaterial& material) {
  return material.law == Law::engineering_constants || material.law == Law::orthotropic ||
         material.law == Law::anisotropic;
}

fe_tire::Solid solid_from(const InpDeck& deck,
                          const InpMaterial& material,
                          const InpOrientation* orientation) {
  if (material.density < 0)
    throw InputError(material.place,
                     fmt::format("material {} has no *DENSITY, expected one", material.name));
  if (material.law == Law::none)
    throw InputError(
        material.place,
        fmt::format("material {} has no law, expected *HYPERELASTIC or *ELASTIC", material.name));
  if (material.no_compression)
    throw InputError(material.place,
                     fmt::format("material {} is a *NO COMPRESSION in solids, expected it of "
                                 "rebars only",
                                 material.name));
  const double stress = factor_of(InpQuantity::stress, deck.units);
  const std::vector<double> c = values_of(deck, material);
  fe_tire::Solid solid;
  solid.density = density(deck, material);
  if (material.law == Law::neo_hooke || material.law == Law::mooney_rivlin) {
    const fe_tire::Hyperelastic law = rubber(material, c);
    solid.law = fe_tire::Hyperelastic{law.C10 * stress, law.C01 * stress, law.K * stress};
    return solid;
  }
  Matrix6 D = stiffness(material, c);
  if (has_directions(material)) {
    if (!orientation || !orientation->cylindrical)
      throw InputError(material.place,
                       fmt::format("the anisotropic material {} needs a cylindrical ORIENTATION",
                                   material.name));
    if (orientation->angle >= 0) D = turned(D, rotation(deck, *orientation));
  }
  solid.law = fe_tire::StVenantKirchhoff{D * stress};
  return solid;
}

fe_tire::CordLayer layer_from(const InpDeck& deck, const InpRebars& rebars, int sign) {
  const InpMaterial& material = deck.materials.at(rebars.material);
  if (material.law != Law::isotropic)
    throw InputError(
        rebars.place,
        fmt::format("rebars of material {}, expected one with *ELASTIC, TYPE=ISO", material.name));
  const double area = deck.value(rebars.area), spacing = deck.value(rebars.spacing);
  if (!(area > 0.0) || !(spacing > 0.0))
    throw InputError(
        rebars.place,
        fmt::format("rebars of area {} and spacing {}, expected more than 0", area, spacing));
  const double E = deck.value(material.constants[0]);
  expect_elastic(material, E, deck.value(material.constants[1]));
  fe_tire::CordLayer layer;
  layer.E_tension = to_si(E, InpQuantity::stress, deck.units);
  layer.E_compression = material.no_compression ? 0.0 : layer.E_tension;
  layer.thickness = area / spacing * deck.units.length;
  if (rebars.angle >= 0) layer.angle = sign * deck.value(rebars.angle) * std::numbers::pi / 180.0;
  if (material.density >= 0) layer.density = density(deck, material);
  return layer;
}

}  // namespace latsch::formats
