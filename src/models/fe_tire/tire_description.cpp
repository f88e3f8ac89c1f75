// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/tire_description.h"

#include <algorithm>

namespace latsch::fe_tire {

double ThicknessProfile::at(double q) const {
  if (q <= position.front()) return thickness.front();
  if (q >= position.back()) return thickness.back();
  const auto i = std::upper_bound(position.begin(), position.end(), q) - position.begin();
  const double part = (q - position[i - 1]) / (position[i] - position[i - 1]);
  return thickness[i - 1] + part * (thickness[i] - thickness[i - 1]);
}

}  // namespace latsch::fe_tire
