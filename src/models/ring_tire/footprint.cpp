// SPDX-License-Identifier: Apache-2.0
// What the tread blocks tell about the contact: resultants, footprint, energy, depth of a tire
// pushed into the road.
#include <algorithm>
#include <limits>

#include "models/ring_tire/tread_contact.h"

namespace latsch::ring_tire {

using Eigen::Vector3d;

double TreadContact::deepest(const NodeValues& q,
                             const RimFrame& rim,
                             const road::Road& road,
                             double time) {
  a_ = rim.a;
  double deepest = -std::numeric_limits<double>::infinity();
  for (int segment = 0; segment < nodes_; ++segment) {
    set_frames(q, segment);
    set_stations(q, q, segment, 0, blocks_);
    for (int line = 0; line < lines_; ++line) {
      const double H = line_height_[static_cast<std::size_t>(line)];
      const double y = line_y_[static_cast<std::size_t>(line)];
      for (int j = 0; j < blocks_; ++j) {
        const auto tip = [&](int i) {
          return at_stations(kP + i)[j] + H * at_stations(kG + i)[j] + y * at_stations(kA + i)[j];
        };
        if (tip(2) > rim.center.z()) continue;
        deepest = std::max(deepest, road.height(tip(0), tip(1), time) - tip(2));
      }
    }
  }
  return deepest;
}

std::vector<BlockContact> TreadContact::footprint() const {
  std::vector<BlockContact> contacts;
  for (const Row& row : rows_)
    for (int j = row.begin; j < row.end; ++j) {
      const int at = row.offset + j - row.begin;
      const double Fn = column(kFn)[at];
      if (!(Fn > 0.0)) continue;
      BlockContact contact;
      contact.tip = {column(kNewX)[at] + column(kEx)[at],
                     column(kNewY)[at] + column(kEy)[at],
                     column(kNewZ)[at] + column(kEz)[at]};
      const Vector3d N(column(kNx)[at], column(kNy)[at], column(kNz)[at]);
      const Vector3d along(column(kFx)[at], column(kFy)[at], column(kFz)[at]);
      contact.force = Fn * N + along;
      contact.root = {column(kNewX)[at], column(kNewY)[at], column(kNewZ)[at]};
      contact.area = area_;
      contact.pressure = Fn / (positive_ * area_);
      contact.sticks = column(kGripped)[at] == 1.0 || along.isZero(0.0);
      contacts.push_back(contact);
    }
  return contacts;
}

double TreadContact::energy() const {
  double sum = 0.0;
  for (const Row& row : rows_)
    for (int at = row.offset; at < row.offset + row.end - row.begin; ++at) {
      const double Fn = column(kFn)[at];
      if (!(Fn > 0.0)) continue;
      const Vector3d e(column(kEx)[at], column(kEy)[at], column(kEz)[at]);
      sum += 0.5 * (Fn * Fn / normal_ + tangential_ * e.squaredNorm());
    }
  return sum;
}

}  // namespace latsch::ring_tire
