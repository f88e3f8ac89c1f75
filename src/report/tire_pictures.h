// SPDX-License-Identifier: Apache-2.0
// Flat pictures of the tire as SVG text: its section with regions and cords, and its contact
// pressure.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace latsch::report {

/// Draws one sector's elements in the (y, r) plane as built, colored by region, with cords as lines
/// and the inflated contour over it.
std::string section_picture(const fe_tire::Mesh& mesh,
                            const std::vector<Layer>& layers,
                            const fe_tire::Inflated* inflated);

/// Draws the lowest sector of the loaded tire on the ground, from behind, with the inflated outer
/// contour dashed. The tire must have more than one sector.
std::string loaded_section_picture(const fe_tire::Mesh& mesh,
                                   const fe_tire::Inflated& inflated,
                                   const Eigen::Matrix3Xd& loaded,
                                   double loaded_radius);

/// Draws the pressure at the contact points, each as large as the area it represents, seen from
/// above with forward to the right.
std::string patch_picture(const fe_tire::ContactPatch& patch);

}  // namespace latsch::report
