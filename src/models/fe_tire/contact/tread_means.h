// SPDX-License-Identifier: Apache-2.0
// Means of a tread surface over hat functions around and across: (T.1) and (T.3) of
// tread_surface.h. All planes of a mesh are alike, so weights of (T.1) are products of those around
// and across.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "models/fe_tire/contact/hat_means.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::fe_tire {

/// A row of adjacent tread faces of a section, given by the nodes between them.
struct TreadStrip {
  std::vector<int> nodes;    // section nodes
  std::vector<double> span;  // m, from one node to the next

  std::optional<double> span_at(int face) const {
    if (face < 0 || face >= static_cast<int>(span.size())) return std::nullopt;
    return span[face];
  }
};

/// A mean around the circumference.
struct MeanAround {
  int place;  // counted in kPlaces a face
  HatMean mean;
  double theta;   // rad, angle of the point
  double moment;  // second moment of the hat function, rad^3
  double share;   // (T.3)
};

/// A mean across, in the section.
struct MeanAcross {
  HatMean mean;
  double share;
  Eigen::Vector3d X, slope;  // m, position and tangent along the section
};

/// Returns runs of tread faces; none if faces are not adjacent from plane to plane.
std::vector<TreadStrip> tread_strips(const Mesh& mesh);

/// Returns the angle of any plane, rad, counted on around the ring.
double angle_of_plane(const Mesh& mesh, int plane);

/// Returns the mean around a place; kPlaces places are counted in each face around.
MeanAround mean_around(const Mesh& mesh, int place);

/// Returns the means around all places of a strip, from its first node to its last.
std::vector<MeanAcross> means_across(const Mesh& mesh, const TreadStrip& strip);

}  // namespace latsch::fe_tire
