// SPDX-License-Identifier: Apache-2.0
// The values and slopes of a test at places of the unit cube of its settings, in units of the
// noise. Each place is computed once.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "correlation/campaign/campaign.h"

namespace latsch::correlation {

class CampaignPlaces {
 public:
  /// Computes the first places if a noise is a share: it counts from the largest value there.
  CampaignPlaces(const CampaignSettings& campaign,
                 const CampaignStart& start,
                 const TestSlopes& slopes,
                 int points);

  /// True if the limits admit the place and the model succeeds there.
  bool admits(const Eigen::VectorXd& place) const { return admitted(place) && known(place); }
  /// Returns the slopes of the free variables, in units of the noise: columns of the first point,
  /// then of the others. The place has to be admitted.
  Eigen::MatrixXd rows(const Eigen::VectorXd& place) const;
  /// Returns the values in units of the noise.
  Eigen::VectorXd values(const Eigen::VectorXd& place) const;
  /// Returns the channel of each value.
  const std::vector<int>& channels(const Eigen::VectorXd& place) const;
  /// Returns the largest value of each channel, SI; 0 if no noise is a share.
  const std::vector<double>& largest() const { return largest_; }
  const std::vector<double>& deviations() const { return deviations_; }
  int failed() const { return failed_; }
  const std::string& first_failure() const { return first_failure_; }
  /// True if the limits admit the place.
  bool admitted(const Eigen::VectorXd& place) const;
  /// Number of first places that were admitted.
  int first_admitted() const { return first_admitted_; }

 private:
  const TestValues* known(const Eigen::VectorXd& place) const;

  const CampaignSettings& campaign_;
  const TestSlopes& slopes_;
  std::vector<int> columns_;  // columns of the free variables at all points
  std::vector<double> largest_, deviations_;
  int first_admitted_ = 0;
  mutable std::map<std::vector<double>, std::optional<TestValues>> computed_;
  mutable int failed_ = 0;
  mutable std::string first_failure_;
};

}  // namespace latsch::correlation
