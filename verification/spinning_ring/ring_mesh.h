// SPDX-License-Identifier: Apache-2.0
// Rings of rectangular section for the tests of this folder.
#pragma once

#include <vector>

#include "models/fe_tire/mesh/materials.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::verification {

/// A rectangle of elements in the cross section, made of one material.
struct SectionBlock {
  std::vector<double> radii;  // m, radii of the faces between rows of elements, ascending
  std::vector<double> sides;  // m, y of the faces between columns of elements, descending
  int solid = 0;
};

/// Returns a ring of equal sectors of these blocks; nodes at the same position are merged. Nodes at
/// the radius `clamped` (m) are fixed. All outer faces of the last block are tread.
fe_tire::Mesh ring_mesh(const std::vector<SectionBlock>& blocks, int sectors, double clamped);

/// Returns an isotropic St. Venant-Kirchhoff solid from Young's modulus (Pa), Poisson's ratio and
/// density (kg/m^3).
fe_tire::Solid linear_solid(double E, double nu, double density);

/// A thin ring of the mean radius 0.3 m, 2 mm thick and 10 mm wide, on a foundation so soft and
/// light that the ring is free: its rigid motion on the foundation has 1 Hz. On a foundation of a
/// tenth of this stiffness the error of arcs that turn about their tangents (hex8_shape.cpp) would
/// be larger than what holds the ring upright. The ring is stiff, so that it hardly grows by
/// rotation. `nu` is Poisson's ratio of the ring.
inline constexpr double kFreeRingModulus = 2e9, kFreeRingDensity = 1200.0;  // Pa, kg/m^3
fe_tire::Mesh free_ring_mesh(int sectors);
fe_tire::Materials free_ring_materials(double nu);

/// The ring of the CalculiX deck gyro_ring.inp: a band on a disc that is clamped at its inner edge.
fe_tire::Mesh gyro_ring_mesh(int sectors = 36);
fe_tire::Materials gyro_ring_materials();

}  // namespace latsch::verification
