// SPDX-License-Identifier: Apache-2.0
// Builds the mesh of one sector, of hexahedra with eight nodes, from the description of a section.

#include <algorithm>
#include <cassert>
#include <cmath>

#include "models/fe_tire/description/section_grid.h"
#include "models/fe_tire/description/section_plan.h"

namespace latsch::fe_tire {
namespace {

class MeshBuilder {
 public:
  MeshBuilder(const TireDescription& tire, MeshRefinement refinement)
      : tire_(tire), section_(tire.section), r_(refinement), plan_(tire), line_(section_.contour) {
    const auto crown = section_.crown_columns();
    crown_ = crown ? *crown * r_.along : columns();
    for (int i = 0; i <= columns(); ++i) first_node_.push_back(first_node_.back() + rows_at(i) + 1);
  }

  Mesh build() const {
    Mesh mesh;
    mesh.sectors = r_.around * section_.sectors;
    mesh.theta = section_.sector_planes(r_.around);
    for (const RubberRegion& region : tire_.regions) mesh.region_names.push_back(region.name);
    place_nodes(mesh);
    for (int i = 0; i < columns(); ++i) {
      const int rows = std::max(rows_at(i), rows_at(i + 1));
      for (int k = 0; k < rows; ++k) mesh.elements.push_back(element(i, k, rows));
    }
    clamp(mesh);
    choose_sensors(mesh);
    return mesh;
  }

  SectionGrid grid() const {
    SectionGrid grid;
    for (int i = 0; i <= columns(); ++i) {
      grid.stations.push_back(s(i));
      grid.rows.emplace_back();
      for (int k = 0; k <= rows_at(i); ++k) grid.rows.back().push_back(parent_row(k, rows_at(i)));
    }
    return grid;
  }

 private:
  int columns() const { return r_.along * plan_.columns(); }
  double s(double i) const { return section_.station(i / r_.along); }
  /// Returns the number of rows of elements at the station (border between columns) i. A sidewall
  /// has one row outside the reference line.
  int rows_at(int i) const {
    const bool sidewall = std::abs(i - 0.5 * columns()) > crown_ - 0.5;
    return r_.through * (sidewall ? section_.rows_inside + 1 : plan_.rows());
  }
  int node(int i, int k) const { return first_node_[i] + k; }
  int top(int i) const { return node(i, rows_at(i)); }

  /// Converts the row k of `rows` (fractions allowed) to a row of the unrefined crown.
  double parent_row(double k, int rows) const {
    const double row = k / r_.through, inside = section_.rows_inside;
    const int outside = rows / r_.through - section_.rows_inside;
    if (row <= inside) return row;
    return inside + (row - inside) * (plan_.rows() - section_.rows_inside) / outside;
  }
  /// Returns the distance from the reference line, at s, of the lower face of row k of `rows`;
  /// positive outward.
  double face(double s, int k, int rows) const {
    return section_.face(std::abs(s), parent_row(k, rows));
  }

  void place_nodes(Mesh& mesh) const {
    mesh.X.resize(3, first_node_.back());
    for (int i = 0; i <= columns(); ++i)
      for (int k = 0; k <= rows_at(i); ++k) {
        const MeridianPoint p = line_.offset(s(i), face(s(i), k, rows_at(i)));
        mesh.X.col(node(i, k)) << 0.0, p.y, -p.r;
      }
  }

  /// Nodes of station i at the lower and upper face of row k of `rows`. If the station has fewer
  /// rows, these are the two nodes between which the row ends, and `from` and `to` are the relative
  /// positions of its faces between them.
  struct RowEnd {
    int lower, upper;
    double from = 0.0, to = 1.0;
  };
  RowEnd row_end(int i, int k, int rows) const {
    const int inside = r_.through * section_.rows_inside;
    if (rows_at(i) == rows || k < inside) return {node(i, k), node(i, k + 1)};
    const int part = (rows - inside) / (rows_at(i) - inside);
    const int row = inside + (k - inside) / part, place = (k - inside) % part;
    return {node(i, row), node(i, row + 1), double(place) / part, double(place + 1) / part};
  }

  Element element(int i, int k, int rows) const {
    const int n = first_node_.back();
    Element e;
    const RowEnd ends[2] = {row_end(i, k, rows), row_end(i + 1, k, rows)};
    e.node = {ends[0].lower,
              ends[0].lower + n,
              ends[1].lower + n,
              ends[1].lower,
              ends[0].upper,
              ends[0].upper + n,
              ends[1].upper + n,
              ends[1].upper};
    for (int side : {0, 1}) {
      if (ends[side].to - ends[side].from < 1.0) {
        e.tie = {side == 0 ? -1 : 1, ends[side].from, ends[side].to};
      }
    }
    const int column = i / r_.along, row = static_cast<int>(parent_row(k + 0.5, rows));
    e.solid = plan_.solid(column, row, i);
    e.region = plan_.region(column, row);
    e.inner = k == 0;
    e.layer_rows = r_.through * (plan_.inside(row) ? section_.rows_inside
                                                   : rows / r_.through - section_.rows_inside);
    e.tread = k == rows - 1 && std::abs(plan_.middle(column)) < section_.tread_to;
    if (is_wall(column, rows)) e.wall = thickness(i);
    if (tire_.cord_model == CordModel::rebar) e.rebars = rebars(i, k, rows);
    return e;
  }

  /// Returns true if the whole thickness of a column bends as one wall. This holds for a sidewall,
  /// but not for a crown with belts under a thick tread.
  bool is_wall(int column, int rows) const {
    if (!section_.faces.empty()) return rows < r_.through * plan_.rows();
    return tire_.cord_model == CordModel::rebar &&
           std::ranges::all_of(plan_.plies(column), [&](const SectionPlan::PlyHere& here) {
             return tire_.plies[here.ply].extent.to == 1.0;
           });
  }

  /// Returns the thickness of the wall at the middle of column i, m.
  double thickness(int i) const {
    const double q = std::abs(s(i + 0.5));
    return section_.inside.at(q) + section_.outside.at(q);
  }

  std::vector<RebarPlacement> rebars(int i, int k, int rows) const {
    const double middle = s(i + 0.5);
    const double lower = face(middle, k, rows), upper = face(middle, k + 1, rows);
    std::vector<RebarPlacement> found;
    for (const auto& [ply, layer] : plan_.plies(i / r_.along)) {
      const double d = tire_.plies[ply].offset.at(std::abs(middle));
      // A ply exactly on a face between rows belongs to the element inside it.
      const bool lowest = k == 0 && d == lower;
      if (lowest || (lower < d && d <= upper))
        found.push_back({layer, 2.0 * (d - lower) / (upper - lower) - 1.0});
    }
    return found;
  }

  void clamp(Mesh& mesh) const {
    const int reference_line = r_.through * section_.rows_inside;
    const int first = section_.clamp == BeadClamp::outside ? reference_line : 0;
    for (int i : {0, columns()}) {
      const int last = section_.clamp == BeadClamp::inside ? reference_line : rows_at(i);
      for (int k = first; k <= last; ++k) mesh.clamped.push_back(node(i, k));
    }
  }

  /// Selects the outer nodes whose displacements are reported: at the crown, at both edges of the
  /// tread and at both widest points.
  void choose_sensors(Mesh& mesh) const {
    const auto nearest = [&](double target) {
      int found = 0;
      for (int i = 1; i <= columns(); ++i) {
        if (std::abs(s(i) - target) < std::abs(s(found) - target)) found = i;
      }
      return top(found);
    };
    int left = top(0), right = left;
    for (int i = 0; i <= columns(); ++i) {
      if (mesh.X(1, top(i)) > mesh.X(1, left)) left = top(i);
      if (mesh.X(1, top(i)) < mesh.X(1, right)) right = top(i);
    }
    mesh.sensors = {
        left, nearest(-section_.tread_to), nearest(0.0), nearest(section_.tread_to), right};
  }

  const TireDescription& tire_;
  const Section& section_;
  MeshRefinement r_;
  SectionPlan plan_;
  Contour line_;
  double crown_ = 0.0;  // number of columns from the crown to the first row of the sidewall
  std::vector<int> first_node_ = {0};
};

}  // namespace

Mesh build_mesh(const TireDescription& tire, MeshRefinement refinement) {
  assert(refinement.around >= 1 && refinement.along >= 1 && refinement.through >= 1);
  Mesh mesh = MeshBuilder(tire, refinement).build();
  try {
    check(mesh);
  } catch (const InputError& error) {
    throw InputError(tire.place, error.what());
  }
  return mesh;
}

SectionGrid section_grid(const TireDescription& tire, MeshRefinement refinement) {
  return MeshBuilder(tire, refinement).grid();
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
