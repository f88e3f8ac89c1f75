// SPDX-License-Identifier: Apache-2.0
// The tread's points (T.1) as lines around in the order of flow, for the friction of rolling.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/contact/tread_surface.h"

namespace latsch::fe_tire {

/// Half angle of the tread that may touch, rad: flat ground below a tire pressed by 8 % of its
/// radius reaches to 0.22 rad.
inline constexpr double kTouchingAngle = 0.4;

/// All points of a smooth tread surface of the whole ring.
struct TreadLines {
  /// Indices of points, line by line, each in the order in which material passes them in forward
  /// rolling: from theta > 0 to theta < 0.
  std::vector<std::vector<int>> lines;
  std::vector<double> theta;  // rad, material angle of every point, -pi to pi

  explicit TreadLines(const TreadSurface& tread, const Mesh& mesh);
};

}  // namespace latsch::fe_tire
