// SPDX-License-Identifier: Apache-2.0
// Flat pictures of the tire as SVG text: its section with regions and cords, the pressure in its
// contact patch.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace latsch::report {

/// One sector's elements in the (y, r) plane as built, colored by region; cords as lines; the
/// inflated contour over it.
std::string section_picture(const fe_tire::Mesh& mesh,
                            const std::vector<Layer>& layers,
                            const fe_tire::Inflated* inflated);

/// The lowest sector of the loaded tire on the ground, from behind, the inflated outer contour
/// dashed. More than one sector.
std::string loaded_section_picture(const fe_tire::Mesh& mesh,
                                   const fe_tire::Inflated& inflated,
                                   const Eigen::Matrix3Xd& loaded,
                                   double loaded_radius);

/// Pressure at the contact points, each as large as the area it stands for, seen from above,
/// forward to the right.
std::string patch_picture(const fe_tire::ContactPatch& patch);

}  // namespace latsch::report
