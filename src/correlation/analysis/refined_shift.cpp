// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/refined_shift.h"

#include <cmath>
#include <filesystem>

#include "correlation/study/refinement.h"
#include "correlation/target/predictions.h"
#include "correlation/target/residuals.h"
#include "evaluation/journal/journal.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {

bool evaluate_refined(const Study& study,
                      const DesignPoint& point,
                      Executor& executor,
                      const RunOptions& options) {
  const Study finer = refined(study);
  const auto& journal = finer.run.journal;
  if (std::filesystem::exists(journal) && Journal::read(journal).identity() != identity(finer))
    std::filesystem::remove(journal);
  return evaluate_points(finer, {point}, executor, options);
}

std::optional<Eigen::VectorXd> refined_shift(const Study& study,
                                             const Identification& identification) {
  if (!study.refinement || !identification.is_linearized()) return std::nullopt;
  const DesignPoint& center = identification.center();
  const auto channels = recorded_channels(refined(study), {center});
  if (!channels) return std::nullopt;
  const auto score = residual_objective(study)(center, channels->front());
  if (!score) return std::nullopt;
  const Linearization& at = identification.linearization();
  const Eigen::VectorXd residuals = to_vector(score->residuals);
  Eigen::VectorXd change = residuals(identification.residuals_used()) - at.r;
  for (double& one : change)
    if (!std::isfinite(one)) one = 0.0;
  const Confidence& c = identification.confidence();
  return shift_of(at, c.held, change, c.felt_changes, c.plane);
}

}  // namespace latsch::correlation
