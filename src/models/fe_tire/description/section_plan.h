// SPDX-License-Identifier: Apache-2.0
// Assignment of materials to elements: the numbering that build_mesh and build_materials share.
#pragma once

#include <vector>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// The unrefined section as a grid: columns from the +y to the -y bead, rows from inside to
/// outside.
class SectionPlan {
 public:
  explicit SectionPlan(const TireDescription& tire);

  int columns() const { return tire_.section.meridional; }
  int rows() const { return tire_.section.rows(); }
  bool inside(int row) const { return row < tire_.section.rows_inside; }
  /// Returns s in [-1, 1] of the column's middle. |s| is its position along the wall.
  double middle(int column) const { return middles_[column]; }

  /// Returns the index into TireDescription::regions. Throws InputError if an element has no region
  /// or two.
  int region(int column, int row) const;
  /// Returns the index into Materials::solids. Regions come first, then the smeared columns,
  /// numbered by `refined_column`.
  int solid(int column, int row, int refined_column) const;
  bool smeared(int row) const { return tire_.cord_model == CordModel::smeared && inside(row); }

  /// A ply crossing a column, with its index into Materials::layers.
  struct PlyHere {
    int ply, layer;
  };
  /// Plies of a column in the order of the description.
  const std::vector<PlyHere>& plies(int column) const { return plies_[column]; }
  int layers() const { return layers_; }

 private:
  const TireDescription& tire_;
  std::vector<double> middles_;  // s of the columns' middles, stored because each takes Newton's
                                 // method
  std::vector<std::vector<PlyHere>> plies_;
  int layers_ = 0;
};

}  // namespace latsch::fe_tire
