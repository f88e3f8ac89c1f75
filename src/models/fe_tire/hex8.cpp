// SPDX-License-Identifier: Apache-2.0
// The two element kinds behind one interface, and the mass they share.
#include "models/fe_tire/hex8.h"

#include "models/fe_tire/hex8_full_integration.h"
#include "models/fe_tire/hex8_rebar.h"
#include "models/fe_tire/hex8_shape.h"

namespace latsch::fe_tire {

int internal_parameters(ElementKind) { return 0; }

bool evaluate(const HexShape& shape,
              const Materials& materials,
              const Element& element,
              const Matrix38& u,
              double* /*alpha*/,
              Vector24& f,
              Matrix24* K) {
  f.setZero();
  if (K != nullptr) K->setZero();
  const Solid& solid = materials.solids[element.solid];
  if (!add_full_integration(shape, solid, u, f, K)) return false;
  add_rebars(shape.X, materials, element, u, f, K);
  return true;
}

Matrix8 mass(const HexShape& shape, const Materials& materials, const Element& element) {
  Matrix8 M = Matrix8::Zero();
  const double density = materials.solids[element.solid].density;
  for (int q = 0; q < 8; ++q) {
    const Vector8 N = shape_functions(kGauss * kXi[q], kGauss * kEta[q], kGauss * kZeta[q]);
    M.noalias() += density * shape.dV[q] * N * N.transpose();
  }
  for (const RebarPlacement& rebar : element.rebars) {
    const CordLayer& layer = materials.layers[rebar.layer];
    for (int q = 0; q < 4; ++q) {
      const RebarPoint point = rebar_point(shape.X, rebar.zeta, layer.angle, q);
      M.noalias() += layer.density * layer.thickness * point.dA * point.N * point.N.transpose();
    }
  }
  return M;
}

}  // namespace latsch::fe_tire
