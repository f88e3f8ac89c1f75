// SPDX-License-Identifier: Apache-2.0
// Common interface of the two kinds of eight-node elements, and the mass matrix.
#include "models/fe_tire/element/hex8.h"

#include <fmt/format.h>

#include "base/error.h"
#include "models/fe_tire/element/element_law.h"
#include "models/fe_tire/element/hex8_batch.h"
#include "models/fe_tire/element/hex8_rebar.h"
#include "models/fe_tire/element/hex8_shape.h"
#include "models/fe_tire/element/hex8_solid_shell.h"

namespace latsch::fe_tire {
namespace {

/// Coordinate along xi and eta at which the shape functions are sampled for the mass of the
/// solid-shell: sqrt(2/3). The mass is then the mean of the consistent and the lumped mass, whose
/// errors in the wave speed cancel to fourth order in the element's length [Guddati & Yue 2004,
/// CMAME 193].
constexpr double kMassPoint = 0.81649658092772603273;

}  // namespace

int internal_parameters(ElementKind kind) {
  return kind == ElementKind::solid_shell ? SolidShellShape::kEnhanced : 0;
}

ElementLaw element_law(const HexShape& shape, const Materials& materials, const Element& element) {
  if (element.rebars.size() > ElementLaw::kCordLayers) {
    throw InputError(
        fmt::format("mesh: an element holds {} cord layers, expected at most {}; use more "
                    "rows of elements through the wall",
                    element.rebars.size(),
                    ElementLaw::kCordLayers));
  }
  ElementLaw law;
  law.shape = &shape;
  law.tie = element.tie;
  law.cords = cord_sheets(shape, materials, element);
  const Solid& solid = materials.solids[element.solid];
  if (const auto* rubber = std::get_if<Hyperelastic>(&solid.law)) {
    law.rubber = *rubber;
    // Stiffness against gradients of the thickness strain. If it is small, the nodes of a thick
    // tread can move alternately in and out along the belt. In a wall these gradients occur in
    // bending, so they must stay soft.
    const double G = 2.0 * (rubber->C10 + rubber->C01);
    law.relaxation = element.wall > 0.0 ? G : 4.0 * G;
    return law;
  }
  const Matrix6& D = std::get<StVenantKirchhoff>(solid.law).D;
  law.linear = true;
  law.relaxation = D.diagonal().tail<3>().minCoeff();
  Matrix6::Map(&law.D[0][0]) = shape.kind == ElementKind::solid_shell
                                   ? layer_stiffness(D, shape.solid_shell, element.layer_rows)
                                   : D;
  return law;
}

bool evaluate(const HexShape& shape,
              const Materials& materials,
              const Element& element,
              const Matrix38& u,
              double* alpha,
              Vector24& f,
              Matrix24* K) {
  ElementBatch batch;
  batch.count = 1;
  const int alphas = internal_parameters(shape.kind);
  batch.set(0, u, alpha, alphas);
  const Stiffness stiffness = K != nullptr ? Stiffness::exact : Stiffness::none;
  if (!evaluate(element_law(shape, materials, element), {}, stiffness, batch)) return false;
  batch.take(0, f, K, alpha, alphas);
  return true;
}

Matrix8 mass(const HexShape& shape, const Materials& materials, const Element& element) {
  const double point = shape.kind == ElementKind::solid_shell ? kMassPoint : kGauss;
  Matrix8 M = rebar_mass(shape, materials, element, point);
  const double density = materials.solids[element.solid].density;
  for (int q = 0; q < 8; ++q) {
    const Vector8 N = shape_functions(point * kXi[q], point * kEta[q], kGauss * kZeta[q]);
    M.noalias() += density * shape.dV[q] * N * N.transpose();
  }
  return between_nodes(element, M);
}

Matrix8 between_nodes(const Element& element, const Matrix8& between_corners) {
  const Matrix8& M = between_corners;
  if (element.tie.eta == 0) return M;
  Matrix8 T = Matrix8::Identity();  // matrix from the displacements of nodes to those of corners
  for (const auto& [lower, upper] : element.tie.pairs()) {
    T.row(lower) *= 0.0;
    T.row(upper) *= 0.0;
    T(lower, lower) = 1.0 - element.tie.lower;
    T(lower, upper) = element.tie.lower;
    T(upper, lower) = 1.0 - element.tie.upper;
    T(upper, upper) = element.tie.upper;
  }
  return T.transpose() * M * T;
}

}  // namespace latsch::fe_tire
