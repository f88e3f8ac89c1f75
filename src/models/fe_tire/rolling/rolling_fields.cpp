// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_fields.h"

#include <algorithm>
#include <numbers>

#include "models/fe_tire/rolling/rolling_chain.h"
#include "numerics/periodic_spline.h"

namespace latsch::fe_tire {
namespace {

/// Returns the velocities -Omega dx/dtheta (V.1) of all nodes, in sector frames.
Eigen::Matrix3Xd velocities(const Mesh& mesh, const Eigen::Matrix3Xd& u, double Omega) {
  const int n = mesh.nodes_per_sector(), S = mesh.sectors;
  Eigen::Matrix3d J;  // J p = -e x p
  J << 0, 0, -1, 0, 0, 0, 1, 0, 0;
  std::vector<double> planes(S);
  for (int s = 0; s < S; ++s) planes[s] = mesh.angle(s);
  Eigen::Matrix3Xd v(3, mesh.nodes());
  Eigen::MatrixXd p(3, S);
  for (int node = 0; node < n; ++node) {
    for (int s = 0; s < S; ++s) p.col(s) = mesh.X.col(node) + u.col(s * n + node);
    const numerics::PeriodicSpline curve(planes, 2.0 * std::numbers::pi, p);
    for (int s = 0; s < S; ++s) {
      const Eigen::Vector3d along = curve.at(planes[s]).first, here = p.col(s);
      v.col(s * n + node) = -Omega * (along + J * here);
    }
  }
  return v;
}

/// Returns the fields of the owner's cords, which are added if there are none yet.
CordFields& of_layer(std::vector<CordFields>& all, const std::string& name, int elements) {
  const auto known = std::ranges::find(all, name, &CordFields::name);
  if (known != all.end()) return *known;
  const Eigen::RowVectorXd none = Eigen::RowVectorXd::Zero(elements);
  all.push_back({name, none, none, none});
  return all.back();
}

}  // namespace

RollingFields rolling_fields(const LossMeter& meter,
                             const Eigen::Matrix3Xd& u,
                             const Eigen::VectorXd& alpha,
                             double Omega) {
  const Mesh& mesh = meter.elements().ring().mesh();
  const int count = mesh.element_count(), own = static_cast<int>(mesh.elements.size());
  RollingFields fields;
  fields.v = velocities(mesh, u, Omega);
  fields.E.resize(6, count);
  fields.S.resize(6, count);
  fields.energy.resize(count);
  fields.dissipation.resize(count);
  const LossMaterials& materials = meter.materials();
  for (int e = 0; e < own; ++e) {
    const auto points = chain(meter, {.element = e}, u, alpha, Omega);
    for (int s = 0; s < mesh.sectors; ++s) {
      const int at = s * own + e;
      fields.E.col(at) = points[s].E;
      fields.S.col(at) = points[s].S;
      fields.energy[at] = points[s].energy;
      fields.dissipation[at] = points[s].dissipation;
    }
    const auto& rebars = mesh.elements[e].rebars;
    for (int k = 0; k < std::ssize(rebars); ++k) {
      if (rebars[k].layer >= std::ssize(materials.layers)) continue;
      const std::string& name = materials.owners[materials.layers[rebars[k].layer].owner].name;
      CordFields& cords = of_layer(fields.cords, name, count);
      const ChainPlace place{.element = e, .zeta = rebars[k].zeta, .cords = k};
      const auto along = chain(meter, place, u, alpha, Omega);
      for (int s = 0; s < mesh.sectors; ++s) {
        cords.strain[s * own + e] = along[s].cord_strain;
        cords.stress[s * own + e] = along[s].cord_stress;
        cords.force[s * own + e] = along[s].cord_force;
      }
    }
  }
  return fields;
}

}  // namespace latsch::fe_tire
