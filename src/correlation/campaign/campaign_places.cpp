// SPDX-License-Identifier: Apache-2.0
#include "correlation/campaign/campaign_places.h"

#include <algorithm>
#include <cmath>

#include "optimization/design/continuous_design.h"

namespace latsch::correlation {

CampaignPlaces::CampaignPlaces(const CampaignSettings& campaign,
                               const CampaignStart& start,
                               const TestSlopes& slopes,
                               int points)
    : campaign_(campaign), slopes_(slopes) {
  const auto n = static_cast<int>(start.point.values.size());
  for (int p = 0; p < points; ++p)
    for (const int i : start.free) columns_.push_back(p * n + i);
  largest_.assign(campaign.measures.size(), 0.0);
  const DesignProblem all{static_cast<int>(campaign.settings.size()),
                          {},
                          [&](const Eigen::VectorXd& s) { return admitted(s); },
                          {},
                          {}};
  const bool has_shares =
      std::any_of(start.noise.begin(), start.noise.end(), [](const ChannelNoise& one) {
        return one.noise.relative > 0.0;
      });
  for (const Eigen::VectorXd& place : first_places(all)) {
    ++first_admitted_;
    if (!has_shares) continue;
    const TestValues* values = known(place);
    for (Eigen::Index k = 0; values && k < values->y.size(); ++k) {
      double& largest =
          largest_[static_cast<std::size_t>(values->channel[static_cast<std::size_t>(k)])];
      largest = std::max(largest, std::abs(values->y[k]));
    }
  }
  for (std::size_t c = 0; c < largest_.size(); ++c)
    deviations_.push_back(
        std::hypot(start.noise[c].noise.absolute, start.noise[c].noise.relative * largest_[c]));
}

bool CampaignPlaces::admitted(const Eigen::VectorXd& place) const {
  return campaign_.admits(campaign_.values_at(std::vector<double>(place.begin(), place.end())));
}

const TestValues* CampaignPlaces::known(const Eigen::VectorXd& place) const {
  const std::vector<double> key(place.begin(), place.end());
  auto found = computed_.find(key);
  if (found == computed_.end()) {
    // A search seldom returns to a place, and with many draws the slopes of a place need much
    // memory. Therefore all places are dropped if there are this many.
    constexpr std::size_t kMostKept = 4000;
    if (computed_.size() >= kMostKept) computed_.clear();
    auto values = slopes_.at(campaign_.values_at(key));
    if (!values) {
      if (failed_++ == 0) first_failure_ = values.failure().reason;
      found = computed_.emplace(key, std::nullopt).first;
    } else {
      found = computed_.emplace(key, *std::move(values)).first;
    }
  }
  return found->second ? &*found->second : nullptr;
}

Eigen::MatrixXd CampaignPlaces::rows(const Eigen::VectorXd& place) const {
  const TestValues& values = *known(place);
  Eigen::MatrixXd J = values.J(Eigen::all, columns_);
  for (Eigen::Index k = 0; k < J.rows(); ++k)
    J.row(k) /= deviations_[static_cast<std::size_t>(values.channel[static_cast<std::size_t>(k)])];
  return J;
}

Eigen::VectorXd CampaignPlaces::values(const Eigen::VectorXd& place) const {
  const TestValues& known_values = *known(place);
  Eigen::VectorXd y = known_values.y;
  for (Eigen::Index k = 0; k < y.size(); ++k)
    y[k] /=
        deviations_[static_cast<std::size_t>(known_values.channel[static_cast<std::size_t>(k)])];
  return y;
}

const std::vector<int>& CampaignPlaces::channels(const Eigen::VectorXd& place) const {
  return known(place)->channel;
}

}  // namespace latsch::correlation
