// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/posterior_density.h"

#include <cmath>

namespace latsch {

double PosteriorDensity::at(double S, const Eigen::VectorXd& u) const {
  const double prior = log_prior ? log_prior(u) : 0.0;
  if (!std::isfinite(prior) || !std::isfinite(S)) return kNoDensity;
  const double likelihood =
      s ? -0.5 * S / (*s * *s) : -0.5 * static_cast<double>(values) * std::log(S);  // (1), (2)
  return likelihood + prior;
}

}  // namespace latsch
