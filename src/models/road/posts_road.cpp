// SPDX-License-Identifier: Apache-2.0
#include "models/road/posts_road.h"

#include <algorithm>
#include <cassert>

namespace latsch::road {

PostsRoad::PostsRoad(Settings settings) : settings_(std::move(settings)) {
  assert(settings_.times.size() >= 2);
  step_ = (settings_.times.back() - settings_.times.front()) /
          static_cast<double>(settings_.times.size() - 1);
}

PostsRoad::Moved PostsRoad::moved(int post, double time) const {
  const std::vector<double>& h = settings_.heights[static_cast<std::size_t>(post)];
  const double place = (time - settings_.times.front()) / step_;
  const long last = static_cast<long>(h.size()) - 1;
  if (!(place > 0.0)) return {h.front(), 0.0};
  if (place >= static_cast<double>(last)) return {h.back(), 0.0};
  const long i = static_cast<long>(place);
  const auto at = [&](long k) { return h[static_cast<std::size_t>(std::clamp(k, 0L, last))]; };
  const double s = place - static_cast<double>(i), r = 1.0 - s;
  const double m0 = 0.5 * (at(i + 1) - at(i - 1)), m1 = 0.5 * (at(i + 2) - at(i));
  const double value =
      r * r * ((1.0 + 2.0 * s) * at(i) + s * m0) + s * s * ((1.0 + 2.0 * r) * at(i + 1) - r * m1);
  const double slope =
      6.0 * s * r * (at(i + 1) - at(i)) + r * (r - 2.0 * s) * m0 + s * (s - 2.0 * r) * m1;
  return {value, slope / step_};
}

GroundPoint PostsRoad::at(double x, double y, double time) const {
  const Moved m = moved(post(x, y), time);
  GroundPoint ground;
  ground.height = m.height;
  ground.velocity.z() = m.velocity;
  return ground;
}

double PostsRoad::height(double x, double y, double time) const {
  return moved(post(x, y), time).height;
}

GroundBounds PostsRoad::bounds(const GroundBox& box, double time) const {
  const bool one = post(box.x0, box.y0) == post(box.x1, box.y1);
  double highest = moved(post(box.x0, box.y0), time).height;
  for (const auto& [x, y] : {std::pair{box.x0, box.y1}, {box.x1, box.y0}, {box.x1, box.y1}})
    highest = std::max(highest, moved(post(x, y), time).height);
  return {.highest = highest, .plane = one};
}

}  // namespace latsch::road
