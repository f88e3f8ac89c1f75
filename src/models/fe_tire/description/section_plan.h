// SPDX-License-Identifier: Apache-2.0
// Assigns materials to elements. build_mesh and build_materials share this numbering.
#pragma once

#include <vector>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// The section before refinement as a grid: columns from the +y to the -y bead, rows from inside to
/// outside.
class SectionPlan {
 public:
  explicit SectionPlan(const TireDescription& tire);

  int columns() const { return tire_.section.meridional; }
  int rows() const { return tire_.section.rows(); }
  bool inside(int row) const { return row < tire_.section.rows_inside; }
  /// Returns s in [-1, 1] of the middle of a column; |s| is its position along the wall.
  double middle(int column) const { return middles_[column]; }

  /// Returns the index into TireDescription::regions of an element. Throws InputError if no region
  /// or more than one contains the element.
  int region(int column, int row) const;
  /// Returns the index into Materials::solids of an element. Indices of regions come first, then
  /// those of columns with smeared cords, numbered by `refined_column`.
  int solid(int column, int row, int refined_column) const;
  bool smeared(int row) const { return tire_.cord_model == CordModel::smeared && inside(row); }

  /// A ply that crosses a column, and its index into Materials::layers.
  struct PlyHere {
    int ply, layer;
  };
  /// Returns the plies that cross a column, in the order of the description.
  const std::vector<PlyHere>& plies(int column) const { return plies_[column]; }
  int layers() const { return layers_; }

 private:
  const TireDescription& tire_;
  // Positions s of the columns' middles. They are stored, because each is computed by Newton's
  // method.
  std::vector<double> middles_;
  std::vector<std::vector<PlyHere>> plies_;
  int layers_ = 0;
};

}  // namespace latsch::fe_tire
