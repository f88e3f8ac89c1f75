// SPDX-License-Identifier: Apache-2.0
// From the description of a section to the HEX8 mesh of one sector.

#include <algorithm>
#include <cassert>
#include <cmath>

#include "models/fe_tire/description/section_plan.h"

namespace latsch::fe_tire {
namespace {

class MeshBuilder {
 public:
  MeshBuilder(const TireDescription& tire, Refinement refinement)
      : tire_(tire), section_(tire.section), r_(refinement), plan_(tire), line_(section_.contour) {}

  Mesh build() const {
    Mesh mesh;
    mesh.sectors = r_.around * section_.sectors;
    mesh.theta = section_.sector_planes(r_.around);
    for (const RubberRegion& region : tire_.regions) mesh.region_names.push_back(region.name);
    place_nodes(mesh);
    for (int i = 0; i < columns(); ++i)
      for (int k = 0; k < rows(); ++k) mesh.elements.push_back(element(i, k));
    clamp(mesh);
    choose_sensors(mesh);
    return mesh;
  }

 private:
  int columns() const { return r_.along * plan_.columns(); }
  int rows() const { return r_.through * plan_.rows(); }
  double s(double i) const { return section_.station(i / r_.along); }
  int node(int i, int k) const { return i * (rows() + 1) + k; }

  /// Distance of the face below row k from the reference line at s, positive outward.
  double face(double s, int k) const {
    return section_.face(std::abs(s), static_cast<double>(k) / r_.through);
  }

  void place_nodes(Mesh& mesh) const {
    mesh.X.resize(3, (columns() + 1) * (rows() + 1));
    for (int i = 0; i <= columns(); ++i)
      for (int k = 0; k <= rows(); ++k) {
        const MeridianPoint p = line_.offset(s(i), face(s(i), k));
        mesh.X.col(node(i, k)) << 0.0, p.y, -p.r;
      }
  }

  Element element(int i, int k) const {
    const int n = (columns() + 1) * (rows() + 1);
    Element e;
    for (int top = 0; top < 2; ++top) {
      e.node[4 * top + 0] = node(i, k + top);
      e.node[4 * top + 1] = node(i, k + top) + n;
      e.node[4 * top + 2] = node(i + 1, k + top) + n;
      e.node[4 * top + 3] = node(i + 1, k + top);
    }
    const int column = i / r_.along, row = k / r_.through;
    e.solid = plan_.solid(column, row, i);
    e.region = plan_.region(column, row);
    e.inner = k == 0;
    e.layer_rows = r_.through * (plan_.inside(row) ? section_.rows_inside
                                                   : plan_.rows() - section_.rows_inside);
    e.tread = k == rows() - 1 && std::abs(plan_.middle(column)) < section_.tread_to;
    if (tire_.cord_model == CordModel::rebar) e.rebars = rebars(i, k);
    return e;
  }

  std::vector<RebarPlacement> rebars(int i, int k) const {
    const double middle = s(i + 0.5);
    const double lower = face(middle, k), upper = face(middle, k + 1);
    std::vector<RebarPlacement> found;
    for (const auto& [ply, layer] : plan_.plies(i / r_.along)) {
      const double d = tire_.plies[ply].offset.at(std::abs(middle));
      const bool lowest = k == 0 && d == lower;  // a ply on a face belongs to the element inside it
      if (lowest || (lower < d && d <= upper))
        found.push_back({layer, 2.0 * (d - lower) / (upper - lower) - 1.0});
    }
    return found;
  }

  void clamp(Mesh& mesh) const {
    const int reference_line = r_.through * section_.rows_inside;
    const int first = section_.clamp == BeadClamp::outside ? reference_line : 0;
    const int last = section_.clamp == BeadClamp::inside ? reference_line : rows();
    for (int i : {0, columns()})
      for (int k = first; k <= last; ++k) mesh.clamped.push_back(node(i, k));
  }

  /// Outer nodes at the crown, at both edges of the tread and at both widest places.
  void choose_sensors(Mesh& mesh) const {
    const auto nearest = [&](double target) {
      int found = 0;
      for (int i = 1; i <= columns(); ++i) {
        if (std::abs(s(i) - target) < std::abs(s(found) - target)) found = i;
      }
      return node(found, rows());
    };
    int left = node(0, rows()), right = left;
    for (int i = 0; i <= columns(); ++i) {
      if (mesh.X(1, node(i, rows())) > mesh.X(1, left)) left = node(i, rows());
      if (mesh.X(1, node(i, rows())) < mesh.X(1, right)) right = node(i, rows());
    }
    mesh.sensors = {
        left, nearest(-section_.tread_to), nearest(0.0), nearest(section_.tread_to), right};
  }

  const TireDescription& tire_;
  const Section& section_;
  Refinement r_;
  SectionPlan plan_;
  Contour line_;
};

}  // namespace

Mesh build_mesh(const TireDescription& tire, Refinement refinement) {
  assert(refinement.around >= 1 && refinement.along >= 1 && refinement.through >= 1);
  Mesh mesh = MeshBuilder(tire, refinement).build();
  try {
    check(mesh);
  } catch (const InputError& error) {
    throw InputError(tire.place, error.what());
  }
  return mesh;
}

bool same_mesh(const TireDescription& a, const TireDescription& b) {
  const auto same_region = [](const RubberRegion& x, const RubberRegion& y) {
    return x.name == y.name && x.extent == y.extent && x.side == y.side;
  };
  const auto same_place = [](const CordPly& x, const CordPly& y) {
    return x.extent == y.extent && x.offset == y.offset;
  };
  return a.section == b.section && a.cord_model == b.cord_model &&
         std::ranges::equal(a.regions, b.regions, same_region) &&
         std::ranges::equal(a.plies, b.plies, same_place);
}

}  // namespace latsch::fe_tire
