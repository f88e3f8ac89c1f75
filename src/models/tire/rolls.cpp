// SPDX-License-Identifier: Apache-2.0
#include "models/tire/rolls.h"

#include <fmt/format.h>

namespace latsch {

Status check_depth(const Tire& tire, double deflection) {
  constexpr double kDeepest = 0.6;  // share of the radius
  if (!(deflection > kDeepest * tire.free_radius())) return {};
  return Failure{
      fmt::format("a deflection of {:.4g} mm is more than the section of a tire with a radius of "
                  "{:.4g} mm: its rim would be in the road",
                  1e3 * deflection,
                  1e3 * tire.free_radius())};
}

}  // namespace latsch
