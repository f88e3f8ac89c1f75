// SPDX-License-Identifier: Apache-2.0
// One run of the residual trust region from one start, with its restarts: the method as
// residual_trust_region.h describes it, but for lost variables, which are looked for between runs.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "optimization/residual_trust_region.h"
#include "optimization/trust_box.h"

namespace latsch {

class TrustRegionRun {
 public:
  /// From the initial values of the space.
  TrustRegionRun(const DesignSpace& space, const ResidualTrustRegionOptions& options);

  /// In the order proposed; empty: ended, or it has settled.
  const std::vector<Wanted>& wanted() const { return wanted_; }
  /// `sample`: none for a failure.
  void observe(const DesignPoint& point, const std::optional<ResidualSample>& sample);

  /// Before a restart from a value clearly better than at the last time: it waits for `go_on`.
  bool has_settled() const { return has_settled_; }
  int restarts_left() const { return options_.restarts - restarts_; }
  void go_on(int restarts_left);
  /// Wants `count` points at a time from here on.
  void widen(int count);

  const ResidualTrustRegionOptions& options() const { return options_; }
  TrustBox& box() { return box_; }
  const TrustBox& box() const { return box_; }
  /// Requires that a point succeeded.
  const ResidualSample& best() const { return box_.memory[box_.best()]; }

 private:
  struct OpenDirection {
    double share = 0.0;  // of the variance of its slope
    Eigen::VectorXd direction;
  };

  int n() const { return box_.n(); }
  bool is_step_awaited() const;
  bool is_hopeless() const;
  std::optional<Wanted> next();
  OpenDirection open_direction() const;
  std::optional<Wanted> another_step(const ResidualModel& m);
  std::optional<Wanted> restart();
  Wanted start();
  void fill();
  void start_again(const Eigen::VectorXd& failed);
  void take_failure(const Wanted& tried);
  void take(const Wanted& tried, ResidualSample sample);

  ResidualTrustRegionOptions options_;
  TrustBox box_;
  bool is_geometry_doubted_ = false;  // a step disappointed
  bool has_widened_ = false;          // the radius, for noise, since the last outcome
  int disappointments_ = 0;           // in a row
  int failures_ = 0;                  // in a row
  int explored_ = 0;                  // points at the end of a run, since its last better one
  int restarts_ = 0;
  Eigen::MatrixXd flat_;      // directions without effect at the best point of all
  int scouts_ = 0;            // along them, left of this restart
  bool is_scouting_ = false;  // the start under way is one
  bool is_over_ = false;      // the last restart failed
  bool has_settled_ = false;
  double f_settled_ = std::numeric_limits<double>::infinity();  // the best value when it last had
  std::vector<Wanted> wanted_;
};

}  // namespace latsch
