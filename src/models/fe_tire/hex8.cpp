// SPDX-License-Identifier: Apache-2.0
// The two element kinds behind one interface, and the mass.
#include "models/fe_tire/hex8.h"

#include <algorithm>

#include "models/fe_tire/hex8_full_integration.h"
#include "models/fe_tire/hex8_rebar.h"
#include "models/fe_tire/hex8_shape.h"
#include "models/fe_tire/hex8_solid_shell.h"

namespace latsch::fe_tire {
namespace {

/// Where the solid-shell's mass samples the shape functions along xi and eta: sqrt(2/3). The mass
/// is then the average of the consistent and the lumped one, whose errors in the speed of
/// waves cancel to fourth order in the element's length [Guddati & Yue 2004, CMAME 193].
constexpr double kMassPoint = 0.81649658092772603273;

void set(PointLaw& law, const Matrix6& D) { Matrix6::Map(&law.D[0][0]) = D; }

bool add_solid_and_cords(const HexShape& shape,
                         const Solid& solid,
                         int layer_rows,
                         const Matrix38& x,
                         Cords& cords,
                         double* alpha,
                         bool stiffness,
                         NodalSums& sums) {
  PointLaw law;
  law.rubber = std::get_if<Hyperelastic>(&solid.law);
  const auto* linear = std::get_if<StVenantKirchhoff>(&solid.law);
  if (linear) set(law, linear->D);
  if (shape.kind == ElementKind::full_integration) {
    stretch(cords, nullptr);
    add_cords(cords, stiffness, sums, nullptr);
    return add_full_integration(shape, law, x, stiffness, sums);
  }
  if (linear) set(law, layer_stiffness(linear->D, shape.solid_shell, layer_rows));
  const double shear_modulus = linear ? linear->D.diagonal().tail<3>().minCoeff()
                                      : 2.0 * (law.rubber->C10 + law.rubber->C01);
  return add_solid_shell(shape, law, shear_modulus, x, cords, alpha, stiffness, sums);
}

}  // namespace

int internal_parameters(ElementKind kind) {
  return kind == ElementKind::solid_shell ? SolidShellShape::kEnhanced : 0;
}

bool evaluate(const HexShape& shape,
              const Materials& materials,
              const Element& element,
              const Matrix38& u,
              double* alpha,
              Vector24& f,
              Matrix24* K) {
  const bool stiffness = K != nullptr;
  const Matrix38 x = shape.X + u;
  NodalSums sums;
  sums.set_zero(stiffness);
  const Solid& solid = materials.solids[element.solid];
  Cords cords(shape, materials, element, x);
  if (!add_solid_and_cords(shape, solid, element.layer_rows, x, cords, alpha, stiffness, sums))
    return false;
  sums.write(f, K);
  return true;
}

Matrix8 mass(const HexShape& shape, const Materials& materials, const Element& element) {
  const double point = shape.kind == ElementKind::solid_shell ? kMassPoint : kGauss;
  Matrix8 M = rebar_mass(shape.X, materials, element, point);
  const double density = materials.solids[element.solid].density;
  for (int q = 0; q < 8; ++q) {
    const Vector8 N = shape_functions(point * kXi[q], point * kEta[q], kGauss * kZeta[q]);
    M.noalias() += density * shape.dV[q] * N * N.transpose();
  }
  return M;
}

}  // namespace latsch::fe_tire
