// SPDX-License-Identifier: Apache-2.0
#include "measurement/order_tracking.h"

#include <algorithm>
#include <cassert>

#include "numerics/signals/time_delay.h"

namespace latsch {

std::vector<double> over_revolutions(std::span<const double> x,
                                     std::span<const double> speed,
                                     double rate,
                                     double circumference,
                                     int per_revolution) {
  assert(x.size() == speed.size() && !x.empty());
  const double step = 1.0 / per_revolution;
  std::vector<double> places;
  double turned = 0.0, next = 0.0;  // revolutions
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    assert(speed[i] > 0.0);
    // trapezoidal rule
    const double more = 0.5 * (speed[i] + speed[i + 1]) / (rate * circumference);
    for (; next < turned + more; next = static_cast<double>(places.size()) * step) {
      places.push_back(static_cast<double>(i) + (next - turned) / more);
    }
    turned += more;
  }
  return numerics::values_at(x, places);
}

}  // namespace latsch
