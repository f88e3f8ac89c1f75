// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/mass_properties.h"

#include <cassert>

namespace latsch::fe_tire {

MassProperties mass_properties(const RingElements& elements, const Eigen::Matrix3Xd& u) {
  const Ring& ring = elements.ring();
  const Mesh& mesh = ring.mesh();
  assert(ring.widths() == 1 && u.cols() == mesh.nodes_per_sector());
  MassProperties sector;
  double across = 0.0;  // sum M y y
  for (int e = 0; e < ring.elements_per_sector(); ++e) {
    const Element& element = mesh.elements[e];
    const Matrix8 M = mass(ring.shape(0, e), elements.materials(), element);
    Matrix38 x;
    for (int a = 0; a < 8; ++a) {
      const int node = element.node[a] % mesh.nodes_per_sector();
      x.col(a) = mesh.X.col(node) + u.col(node);
    }
    x = ring.in_element_frame(0, e, x);
    const auto moment = [&](int axis) { return x.row(axis).dot(x.row(axis) * M); };
    sector.mass += M.sum();
    sector.spin_inertia += moment(0) + moment(2);
    across += moment(1);
  }
  const int S = ring.sectors();
  return {S * sector.mass, S * sector.spin_inertia, S * (0.5 * sector.spin_inertia + across)};
}

}  // namespace latsch::fe_tire
