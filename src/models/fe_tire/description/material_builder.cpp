// SPDX-License-Identifier: Apache-2.0
// Computes the materials of all elements from the description of a section, in the numbering of its
// mesh.
//
// The smeared layer serves comparison with programs that have no rebars. Its law is the isotropic
// law of its rubber plus the cords' stiffness spread over the wall inside the reference line:
//   D = (K - 2/3 G) I(x)I + 2 G I4 + sum_c (E_c t_c / t_inside) d_c(x)d_c(x)d_c(x)d_c
#include <cmath>

#include "models/fe_tire/description/section_plan.h"

namespace latsch::fe_tire {
namespace {

/// Returns the dyad d (x) d of a unit vector in Voigt order, with the factors of stresses: d^T E d
/// = v . E_voigt.
Vector6 dyad(const Eigen::Vector3d& d) {
  Vector6 v;
  for (int k = 0; k < 6; ++k) v[k] = d[voigt::kRow[k]] * d[voigt::kColumn[k]];
  return v;
}

/// Geometry at the middle of a column of elements.
struct Column {
  double r = 0.0;          // m, radius of the reference line
  double thickness = 0.0;  // m, thickness of the wall inside the reference line
  // Unit vector (radial, circumferential, axial) along the wall toward the -y bead.
  Eigen::Vector3d meridional;
};

Column column_of(const TireDescription& tire, const Contour& line, int i, int columns) {
  const double refined = double(columns) / tire.section.meridional;
  const double from = tire.section.station(i / refined);
  const double to = tire.section.station((i + 1) / refined);
  const MeridianPoint a = line.tangent(from), b = line.tangent(to);
  const WallProfile& inside = tire.section.inside;
  Column column;
  column.r = line.point(0.5 * (from + to)).r;
  column.thickness = 0.5 * (inside.at(std::abs(from)) + inside.at(std::abs(to)));
  column.meridional = Eigen::Vector3d(a.r + b.r, 0.0, -a.y - b.y).normalized();
  return column;
}

/// Returns the cords of a ply at radius r. If the ply was built on a drum and lifted, cos(angle) /
/// r stays constant along a cord, and the spacing is proportional to r sin(angle).
CordLayer cords_at(const CordPly& ply, double r, double r_crown) {
  CordLayer cords = ply.cords;
  if (!ply.lifted) return cords;
  const double cosine = std::min(1.0, std::cos(cords.angle) * r / r_crown);
  const double sine = std::sqrt(1.0 - cosine * cosine);
  if (sine > 0.0) cords.thickness *= std::abs(std::sin(cords.angle)) * r_crown / (r * sine);
  cords.angle = std::copysign(std::acos(cosine), cords.angle);
  return cords;
}

/// Returns the stiffness that smeared cords add to a column, Pa.
Matrix6 smeared_stiffness(const Column& column, const CordLayer& cords) {
  const Eigen::Vector3d d =
      std::cos(cords.angle) * Eigen::Vector3d::UnitY() + std::sin(cords.angle) * column.meridional;
  return cords.E_tension * cords.thickness / column.thickness * dyad(d) * dyad(d).transpose();
}

double shear_modulus(const Hyperelastic& rubber) { return 2.0 * (rubber.C10 + rubber.C01); }

StVenantKirchhoff smear(const Hyperelastic& rubber,
                        const Column& column,
                        const std::vector<CordLayer>& cords) {
  const double G = shear_modulus(rubber);
  StVenantKirchhoff law = StVenantKirchhoff::isotropic(G, rubber.K - 2.0 * G / 3.0);
  for (const CordLayer& c : cords) law.D += smeared_stiffness(column, c);
  return law;
}

}  // namespace

Materials build_materials(const TireDescription& tire, MeshRefinement refinement) {
  const SectionPlan plan(tire);
  const Contour line(tire.section.contour);
  const double r_crown = line.point(0.0).r;
  const auto cords_of = [&](int column, double r) {
    std::vector<CordLayer> cords;
    for (const auto& here : plan.plies(column)) {
      cords.push_back(cords_at(tire.plies[here.ply], r, r_crown));
    }
    return cords;
  };

  Materials materials;
  for (const RubberRegion& region : tire.regions) {
    const Rubber& rubber = tire.rubbers[region.rubber];
    materials.solids.push_back({rubber.law, rubber.density});
  }
  if (tire.cord_model == CordModel::rebar) {
    for (int i = 0; i < plan.columns(); ++i) {
      const auto cords = cords_of(i, column_of(tire, line, i, plan.columns()).r);
      materials.layers.insert(materials.layers.end(), cords.begin(), cords.end());
    }
    return materials;
  }
  // Smeared cords have the direction of the wall, so each column of the refined mesh has its own
  // material.
  const int split = refinement.along;
  for (int i = 0; i < split * plan.columns(); ++i) {
    const Column column = column_of(tire, line, i, split * plan.columns());
    const auto cords = cords_of(i / split, column.r);
    const Rubber& rubber = tire.rubbers[tire.regions[plan.region(i / split, 0)].rubber];
    double density = rubber.density;
    for (const CordLayer& c : cords) density += c.density * c.thickness / column.thickness;
    materials.solids.push_back({smear(rubber.law, column, cords), density});
  }
  return materials;
}

LossMaterials build_losses(const TireDescription& tire, MeshRefinement refinement) {
  const SectionPlan plan(tire);
  LossMaterials losses;
  for (const Rubber& rubber : tire.rubbers)
    losses.owners.push_back({"rubber." + rubber.name, false});
  for (const CordPly& ply : tire.plies) losses.owners.push_back({"layer." + ply.name, true});
  const int first_ply = static_cast<int>(tire.rubbers.size());
  for (const RubberRegion& region : tire.regions)
    losses.solids.push_back({tire.rubbers[region.rubber].prony, region.rubber});
  if (tire.cord_model == CordModel::rebar) {
    for (int i = 0; i < plan.columns(); ++i) {
      for (const auto& here : plan.plies(i))
        losses.layers.push_back({tire.plies[here.ply].prony, first_ply + here.ply});
    }
    return losses;
  }
  const Contour line(tire.section.contour);
  const double r_crown = line.point(0.0).r;
  const int split = refinement.along;
  for (int i = 0; i < split * plan.columns(); ++i) {
    const Column column = column_of(tire, line, i, split * plan.columns());
    const int rubber = tire.regions[plan.region(i / split, 0)].rubber;
    RelaxingSolid& solid =
        losses.solids.emplace_back(RelaxingSolid{tire.rubbers[rubber].prony, rubber});
    solid.shear = shear_modulus(tire.rubbers[rubber].law);
    for (const auto& here : plan.plies(i / split)) {
      const CordPly& ply = tire.plies[here.ply];
      solid.smeared.push_back({smeared_stiffness(column, cords_at(ply, column.r, r_crown)),
                               ply.prony,
                               first_ply + here.ply});
    }
  }
  return losses;
}

}  // namespace latsch::fe_tire
