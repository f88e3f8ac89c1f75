// SPDX-License-Identifier: Apache-2.0
// The predictions of a rival model for the test of a campaign, in units of the noise.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "correlation/campaign/campaign.h"
#include "optimization/design/model_discrimination.h"

namespace latsch::correlation {

class CampaignPlaces;

class RivalPredictions {
 public:
  RivalPredictions(const CampaignPlan& plan, const CampaignPlaces& places);
  RivalPredictions(const RivalPredictions&) = delete;
  RivalPredictions& operator=(const RivalPredictions&) = delete;

  const RivalProblem& problem() const { return problem_; }

 private:
  Eigen::VectorXd predict(const Eigen::VectorXd& place, const Eigen::VectorXd& v) const;

  const CampaignPlan& plan_;
  const CampaignPlaces& places_;
  RivalProblem problem_;
  /// Specimens at the last variables, which are asked at many settings.
  struct Recent {
    Eigen::VectorXd v;
    std::unique_ptr<experiment::Specimen> specimen;
  };
  experiment::Specimen& specimen_at(const Eigen::VectorXd& v) const;
  mutable std::vector<Recent> recent_;
  mutable std::size_t next_ = 0;  // place of the next specimen
};

}  // namespace latsch::correlation
