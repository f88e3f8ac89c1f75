// SPDX-License-Identifier: Apache-2.0
// Pictures of the tire as SVG text: its cross section with regions and cords, and its contact
// pressure.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace latsch::report {

/// Draws the elements of one sector in the (y, r) plane as built, colored by region, with cords as
/// lines and the inflated contour over them.
std::string section_picture(const fe_tire::Mesh& mesh,
                            const std::vector<Layer>& layers,
                            const fe_tire::Inflated* inflated);

/// Draws the lowest sector of the loaded tire on the ground, seen from behind, with the inflated
/// outer contour as a dashed line. The tire must have more than one sector.
std::string loaded_section_picture(const fe_tire::Mesh& mesh,
                                   const fe_tire::Inflated& inflated,
                                   const Eigen::Matrix3Xd& loaded,
                                   double loaded_radius);

/// Draws the pressure at the contact points, seen from above with the forward direction to the
/// right. Each point is as large as the area that it represents.
std::string patch_picture(const fe_tire::ContactPatch& patch);

}  // namespace latsch::report
