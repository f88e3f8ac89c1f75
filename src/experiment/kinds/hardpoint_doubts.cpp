// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/hardpoint_doubts.h"

#include <fmt/format.h>

#include <cmath>

#include "models/suspension/geometry_reader.h"
#include "models/suspension/suspension_reader.h"

namespace latsch::experiment {

std::vector<std::string> doubts_about_hardpoints(const Node& root) {
  // horizontal distance of the contact point from the wheel center over the center's height above
  // the ground
  constexpr double kFarBeside = 0.5;
  // distance of a link's outer end from the wheel center over that height
  constexpr double kFarOutside = 1.5;
  // share of a link's length by which its inner end may be farther from the middle of the car than
  // its outer end; trailing arms lead outward a little
  constexpr double kInside = 0.25;
  const suspension::CornerGeometry geometry = suspension::read_corner(root).geometry;
  const Eigen::Vector3d center = geometry.linkage.wheel.center;
  const Eigen::Vector3d contact = suspension::read_point(root.table("hardpoint"), "contact");
  const double height = center.z() - contact.z();
  std::vector<std::string> doubts;
  if (geometry.kingpin && geometry.kingpin->upper.z() <= geometry.kingpin->lower.z())
    doubts.push_back(
        fmt::format("hardpoint.ubj is {:.4g} mm below hardpoint.lbj: the upper ball joint is above "
                    "the lower one on a suspension; are the two exchanged?",
                    1e3 * (geometry.kingpin->lower.z() - geometry.kingpin->upper.z())));
  const double beside = (center - contact).head<2>().norm();
  if (beside > kFarBeside * height)
    doubts.push_back(
        fmt::format("hardpoint.contact is {:.4g} mm beside hardpoint.wheel_center, seen from "
                    "above: the contact point is usually below the wheel center; is a coordinate "
                    "in another unit, or of another point?",
                    1e3 * beside));
  for (const suspension::Link& link : geometry.linkage.links) {
    const double away = (link.outer - center).norm();
    if (away > kFarOutside * height)
      doubts.push_back(
          fmt::format("the outer end of link {} is {:.4g} mm away from the wheel center, which is "
                      "{:.4g} mm above the contact point: it usually lies within the wheel; is a "
                      "coordinate in another unit?",
                      link.name,
                      1e3 * away,
                      1e3 * height));
    const double further_in = std::abs(link.inner.y()) - std::abs(link.outer.y());
    if (further_in > kInside * (link.outer - link.inner).norm())
      doubts.push_back(fmt::format(
          "the inner end of link {} is {:.4g} mm further from the middle of the car than "
          "its outer end: are the two exchanged, or has a coordinate another unit?",
          link.name,
          1e3 * further_in));
  }
  return doubts;
}

}  // namespace latsch::experiment
