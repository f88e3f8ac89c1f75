// SPDX-License-Identifier: Apache-2.0
// Averages of a tread surface, weighted by hat functions around the circumference and across: (T.1)
// and (T.3) of tread_surface.h. All section planes of a mesh have equal sections, so the weights of
// (T.1) are products of those around and those across.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "models/fe_tire/contact/hat_means.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::fe_tire {

/// A row of adjacent tread faces in a section, given by the nodes between them.
struct TreadStrip {
  std::vector<int> nodes;    // indices of nodes in the section
  std::vector<double> span;  // m, distance from each node to the next

  std::optional<double> span_at(int face) const {
    if (face < 0 || face >= static_cast<int>(span.size())) return std::nullopt;
    return span[face];
  }
};

/// An average around the circumference at one position.
struct MeanAround {
  int place;  // position, counted in kPlaces per face
  HatMean mean;
  double theta;   // rad, angle of the averaged point
  double moment;  // rad^3, second moment of the hat function
  double share;   // (T.3)
};

/// An average across the tread, in the section.
struct MeanAcross {
  HatMean mean;
  double share;
  Eigen::Vector3d X, slope;  // m, position and tangent along the section, without load
};

/// Returns the rows of adjacent tread faces. Returns none if the faces of successive section planes
/// are not adjacent.
std::vector<TreadStrip> tread_strips(const Mesh& mesh);

/// Returns the angle of a section plane, rad. Planes may be counted beyond one turn of the ring.
double angle_of_plane(const Mesh& mesh, int plane);

/// Returns the average around a position; positions are counted around the ring, kPlaces per face.
MeanAround mean_around(const Mesh& mesh, int place);

/// Returns the averages at all positions across a row of faces, from its first node to its last.
std::vector<MeanAcross> means_across(const Mesh& mesh, const TreadStrip& strip);

}  // namespace latsch::fe_tire
