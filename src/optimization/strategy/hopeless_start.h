// SPDX-License-Identifier: Apache-2.0
// Ends a search in which every point fails for a reason that has nothing to do with the point, for
// example a license server that does not answer or a measurement longer than the simulated time.
//
// If the first kSuspicious points all fail with the same message, points spread over the whole
// space are tried before further points of the optimizer. If all of them fail with this message,
// apart from numbers and names of files, the search is hopeless: converged() is true and reason()
// returns the message. If one succeeds, or fails for another reason, the optimizer observes it and
// continues as if nothing had happened.
//
// The decision depends on the outcomes alone, so it is the same for any number of workers and after
// a crash.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

class HopelessStart : public Optimizer {
 public:
  /// Observes the outcomes of the given search in the given space.
  HopelessStart(const DesignSpace& space, std::unique_ptr<Optimizer> optimizer);

  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;
  std::string ending() const override {
    return reason_ ? "without a result: " + *reason_ : optimizer_->ending();
  }
  std::vector<EndingClaim> claims() const override {
    return reason_ ? claims_in(ending()) : optimizer_->claims();
  }
  std::optional<double> promise() const override { return optimizer_->promise(); }
  std::vector<FoundBasin> basins() const override { return optimizer_->basins(); }
  std::string basins_in_words() const override { return optimizer_->basins_in_words(); }

  /// Returns the message with which all points fail if the search is hopeless; nullopt otherwise.
  const std::optional<std::string>& reason() const { return reason_; }

 private:
  DesignSpace space_;
  std::unique_ptr<Optimizer> optimizer_;
  bool is_watching_ = true;
  int alike_ = 0;  // number of points that failed with the first reason
  std::string first_;
  std::vector<DesignPoint> spread_;  // points spread over the space that are still to be tried
  std::optional<std::string> reason_;
};

/// Returns the words of a reason, without numbers and without words that are paths.
std::string words_of(const std::string& reason);

}  // namespace latsch
