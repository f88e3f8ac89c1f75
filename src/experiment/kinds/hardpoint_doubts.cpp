// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/hardpoint_doubts.h"

#include <fmt/format.h>

#include <cmath>

#include "models/suspension/geometry_reader.h"
#include "models/suspension/suspension_reader.h"

namespace latsch::experiment {

namespace {

/// Adds doubts about a size that all hardpoints have in common, so that all of them may be in
/// another unit. The ranges go from a kart to a heavy truck.
void doubt_size(double radius, double half_track, std::vector<std::string>& doubts) {
  constexpr double kLeastRadius = 0.08, kMostRadius = 1.1;  // m
  constexpr double kLeastHalf = 0.2, kMostHalf = 1.7;       // m, half the track
  if (radius < kLeastRadius || radius > kMostRadius)
    doubts.push_back(fmt::format(
        "hardpoint.wheel_center is {:.6g} mm above hardpoint.contact: the radius of a loaded wheel "
        "is usually {:g} to {:g} mm; are all coordinates in another unit?",
        1e3 * radius,
        1e3 * kLeastRadius,
        1e3 * kMostRadius));
  if (half_track < kLeastHalf || half_track > kMostHalf)
    doubts.push_back(fmt::format(
        "hardpoint.wheel_center is {:.6g} mm beside the middle of the car, y = 0, which is half of "
        "the track: usual are {:g} to {:g} mm; are coordinates in another unit, or is y not "
        "counted from the middle of the car?",
        1e3 * half_track,
        1e3 * kLeastHalf,
        1e3 * kMostHalf));
}

/// Adds doubts about the inner end of a link: its place beside the wheel, the ground and the middle
/// of the car.
void doubt_inner_end(const suspension::Link& link,
                     const Eigen::Vector3d& center,
                     double ground,
                     std::vector<std::string>& doubts) {
  constexpr double kFarInside = 5.0;  // distance from the wheel center over its height
  constexpr double kAcross = 0.15;    // distance beyond the middle of the car over that height
  const double height = center.z() - ground;
  const double away = (link.inner - center).norm();
  if (away > kFarInside * height)
    doubts.push_back(
        fmt::format("the inner end of link {} is {:.6g} mm away from the wheel center, which is "
                    "{:.6g} mm above the contact point: is a coordinate in another unit?",
                    link.name,
                    1e3 * away,
                    1e3 * height));
  if (link.inner.z() < ground)
    doubts.push_back(fmt::format(
        "the inner end of link {} is {:.6g} mm below the contact point: is the sign of z right?",
        link.name,
        1e3 * (ground - link.inner.z())));
  const double across = -link.inner.y() * (center.y() < 0.0 ? -1.0 : 1.0);
  if (across > kAcross * height)
    doubts.push_back(
        fmt::format("the inner end of link {} is {:.6g} mm beyond the middle of the "
                    "car, on the side of the other wheel: is the sign of y right?",
                    link.name,
                    1e3 * across));
}

}  // namespace

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
  doubt_size(height, std::abs(center.y()), doubts);
  if (geometry.kingpin && geometry.kingpin->upper.z() <= geometry.kingpin->lower.z())
    doubts.push_back(
        fmt::format("hardpoint.ubj is {:.6g} mm below hardpoint.lbj: the upper ball joint is above "
                    "the lower one on a suspension; are the two exchanged?",
                    1e3 * (geometry.kingpin->lower.z() - geometry.kingpin->upper.z())));
  const double beside = (center - contact).head<2>().norm();
  if (beside > kFarBeside * height)
    doubts.push_back(
        fmt::format("hardpoint.contact is {:.6g} mm beside hardpoint.wheel_center, seen from "
                    "above: the contact point is usually below the wheel center; is a coordinate "
                    "in another unit, or of another point?",
                    1e3 * beside));
  for (const suspension::Link& link : geometry.linkage.links) {
    const double away = (link.outer - center).norm();
    if (away > kFarOutside * height)
      doubts.push_back(
          fmt::format("the outer end of link {} is {:.6g} mm away from the wheel center, which is "
                      "{:.6g} mm above the contact point: it usually lies within the wheel; is a "
                      "coordinate in another unit?",
                      link.name,
                      1e3 * away,
                      1e3 * height));
    doubt_inner_end(link, center, contact.z(), doubts);
    const double further_in = std::abs(link.inner.y()) - std::abs(link.outer.y());
    if (further_in > kInside * (link.outer - link.inner).norm())
      doubts.push_back(fmt::format(
          "the inner end of link {} is {:.6g} mm further from the middle of the car than "
          "its outer end: are the two exchanged, or has a coordinate another unit?",
          link.name,
          1e3 * further_in));
  }
  return doubts;
}

}  // namespace latsch::experiment
