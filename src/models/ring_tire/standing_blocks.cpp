// SPDX-License-Identifier: Apache-2.0
// Blocks of a tire that stands. Their forces are the gradient of an energy, so that an equilibrium
// is a minimum which a line search cannot miss:
//   normal      1/2 c_n δ^2 where δ > 0
//   tangential  1/2 c_t |e|^2 up to |F_t| = g, from there on g (|e| - g/(2 c_t)): the tip gives way
// g = μ_adhesion F_n is held while an equilibrium is sought and then renewed with the F_n found
// (Tresca's friction as a step towards Coulomb's). A block that was in the air one step of the
// rim before has no e and holds nothing along the road: where its tip touched is not known.
#include <cmath>

#include "models/ring_tire/tread_contact.h"

namespace latsch::ring_tire {

using Eigen::Vector3d;

void TreadContact::hold_friction() {
  for (const Row& row : rows_)
    for (int at = row.offset; at < row.offset + row.end - row.begin; ++at) {
      const double Fn = column(kFn)[at];
      column(kHeld)[at] = column(kMu)[at] * law_.adhesion(Fn / (positive_ * area_)) * Fn;
    }
}

void TreadContact::standing_forces(const Row& row) {
  const double H = line_height_[static_cast<std::size_t>(row.line)];
  const double y = line_y_[static_cast<std::size_t>(row.line)];
  const auto at_station = [&](int c, int j) {
    return Vector3d(at_stations(c)[j], at_stations(c + 1)[j], at_stations(c + 2)[j]);
  };
  const auto vector = [&](Column c, int at) {
    return Vector3d(column(c)[at],
                    column(static_cast<Column>(c + 1))[at],
                    column(static_cast<Column>(c + 2))[at]);
  };
  const auto set_vector = [&](Column c, int at, const Vector3d& value) {
    for (int i = 0; i < 3; ++i) column(static_cast<Column>(c + i))[at] = value[i];
  };
  for (int j = row.begin; j < row.end; ++j) {
    const int at = row.offset + j - row.begin;
    const Vector3d T = at_station(kP, j) + H * at_station(kG, j) + y * at_station(kA, j);  // (10)
    const Vector3d N = vector(kNx, at);
    const double depth = column(kLevel)[at] - N.dot(T);
    column(kFn)[at] = depth > 0.0 ? normal_ * depth : 0.0;  // (11)
    Vector3d e = Vector3d::Zero();
    double gripped = 0.0;
    if (column(kTouches)[at] > 0.5) {
      e = vector(kTipX, at) - T;
      e -= N * N.dot(e);
      const double held = column(kHeld)[at], trial = tangential_ * e.norm();
      gripped = trial > held ? held / trial : 1.0;  // (13)
      e *= gripped;
    }
    column(kGripped)[at] = gripped;
    set_vector(kEx, at, e);
    set_vector(kFx, at, tangential_ * e);  // (12)
    set_vector(kNewX, at, T + depth * N);
  }
}

}  // namespace latsch::ring_tire
