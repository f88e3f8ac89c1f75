// SPDX-License-Identifier: Apache-2.0
// The box of a residual trust region: the samples in it, and the points worth an evaluation.
//
// The box surrounds the best point c with half widths h = radius w. Points are chosen from its part
// inside bounds and linear constraints. There are three kinds:
//   probe    along a direction that the samples leave unknown
//   step     to the minimum of the expected value (box_least_squares.h)
//   explore  anywhere near the point predicted to be the best
// If constraints include equations, all directions lie along these. Samples from outside of the
// region improve the models but never become the center.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/random.h"
#include "optimization/problem/design_space.h"
#include "optimization/problem/feasible_region.h"
#include "optimization/problem/pending_points.h"
#include "optimization/trust_region/natural_frame.h"
#include "optimization/trust_region/residual_memory.h"
#include "optimization/trust_region/variable_scale.h"

namespace latsch {

/// A point that the search has proposed and whose outcome it does not know yet.
struct Wanted {
  enum class Kind { start, probe, step };

  Eigen::VectorXd u;
  DesignPoint point;
  Kind kind;
  int center = -1;         // index of the sample from which the point was chosen
  double f_center = 0.0;   // value of the sample `center`
  double length = 0.0;     // largest component of u - center, in units of the widths
  double predicted = 0.0;  // expected value; only for steps
  /// Radius of the search when the step was proposed, and the half width of its box in radii.
  double radius = 0.0, box = 1.0;
  /// Standard deviation of the target due to noise, as the model of the step knows it.
  double deviation = 0.0;
};

class TrustBox {
 public:
  /// Predicted decrease of f, as a share of f, below which it counts as none.
  static constexpr double kFlat = 1e-6;

  /// Starts around the initial values of the space.
  TrustBox(const DesignSpace& space, double radius, std::uint64_t seed);

  DesignSpace space;
  FeasibleRegion region;
  ResidualMemory memory;
  double radius;
  double noise = 0.0;  // variance of the noise, in units of the model

  int n() const { return space.size(); }
  /// Returns the widths of the variables (variable_scale.h), as shares of their ranges.
  const Eigen::VectorXd& widths() const { return scale_.widths(); }
  /// True if the equations leave only a single point.
  bool is_point() const { return region.E().rows() > 0 && along().cols() == 0; }
  const Eigen::VectorXd& c() const { return center_ >= 0 ? memory[center_].u : start_; }
  double f() const;
  /// Returns the index of the best sample inside the region since the last call of move_to(); -1:
  /// none.
  int center() const { return center_; }
  bool has_center() const { return center_ >= 0; }
  /// Returns the index of the best of all samples inside the region; -1: none.
  int best() const { return best_; }
  /// True if the best value is at most `value`; false if `value` is 0.
  bool is_down_to(double value) const {
    return value > 0.0 && best_ >= 0 && memory[best_].f <= value;
  }

  /// True unless the first samples are still too few for the slopes of all variables.
  bool knows_slopes() const { return memory.size() > n(); }
  /// Adapts the length of the next probes of the first model to the change of the residuals,
  /// relative to their size, over one of them.
  void learn_from_first_probe(double change);
  /// Moves the box to the best of all samples. Requires that there is one.
  void return_to_best() { center_ = best_; }
  /// Moves the box to u, which is not evaluated yet, and starts again.
  void move_to(const Eigen::VectorXd& u);
  /// True if residuals jump: the sample is worse than the center and has more stand-ins for missing
  /// values.
  bool leaps(const ResidualSample& sample) const;
  /// Adds the sample. Returns true if it becomes the center.
  bool take(ResidualSample sample);
  /// Returns the limit above which the value of a sample counts as exploded, compared with the
  /// samples around the center or, if a run has no center yet, around the best of all points.
  double explosion() const;

  /// Returns the variance of the slopes that remains when the outcomes of `wanted` are known.
  SlopeVariance geometry(const PendingPoints<Wanted>& wanted) const;
  /// Builds a model of the samples around c. If `is_noisy` is true, it estimates the noise.
  ResidualKriging model(bool is_noisy);
  /// Returns dr/du at c according to the model.
  Eigen::MatrixXd slopes();
  /// Returns the outcome that the model expects.
  ResidualSample expected(const DesignPoint& point) const;

  Wanted at(const Eigen::VectorXd& u, Wanted::Kind kind) const;
  /// Returns a probe along a direction, toward the side with more room, of the length of a probe or
  /// as long as the room allows; nullopt if bounds and constraints leave no room.
  std::optional<Wanted> probe(Eigen::VectorXd direction, const PendingPoints<Wanted>& wanted) const;
  /// Returns a probe beside a step whose outcome is awaited, in the direction whose slope at the
  /// end of the step will be known least; nullopt if no direction leaves more than `least_share` of
  /// the variance, or if there is no room.
  std::optional<Wanted> probe_beside(const Wanted& step,
                                     double least_share,
                                     const PendingPoints<Wanted>& wanted) const;
  /// Returns the step in a box whose half width is `box` times the radius. Its length is 0 if it is
  /// not worth an evaluation.
  Wanted step(const ResidualKriging& m, double box, const PendingPoints<Wanted>& wanted) const;
  /// True if the expected value of the step is less than that of the center.
  bool promises(const Wanted& step) const;
  /// Returns the frame for recomputing slopes at c. `J` is dr/du there; `change` is the intended
  /// change of the residuals along an axis, relative to their size.
  NaturalFrame natural_frame(const Eigen::MatrixXd& J, double change, double shortest) const;
  /// Returns a probe at the distance `move` from c, or in the opposite direction, shortened as far
  /// as the region and failures require; nullopt if there is no room.
  std::optional<Wanted> probe_by(const Eigen::VectorXd& move,
                                 const PendingPoints<Wanted>& wanted) const;
  /// Builds a model of the samples that are near in the frame.
  ResidualKriging natural_model(const NaturalFrame& frame, double& noise) const;
  /// Returns for each axis the change of the residuals over a move of 1, relative to their norm:
  /// the smallest one that samples in the frame show, among those that lie mainly along this axis;
  /// 0 if there is none.
  Eigen::VectorXd changes_along(const NaturalFrame& frame) const;
  /// True if a sample gives information about that axis.
  bool has_moved_along(int axis, const NaturalFrame& frame) const;
  /// Returns the step to the minimum of the model in the frame, by at most `reach` along the axes.
  Wanted natural_step(const ResidualKriging& m,
                      const NaturalFrame& frame,
                      double reach,
                      const PendingPoints<Wanted>& wanted) const;
  /// Returns a point near the one predicted to be the best, at a random distance of any order of
  /// magnitude.
  std::optional<Wanted> explore(const PendingPoints<Wanted>& wanted);
  /// Returns a point around the start of the box at two to six radii in a random direction, so that
  /// a first model with more samples than variables has curvature.
  std::optional<Wanted> scatter(const PendingPoints<Wanted>& wanted);
  /// Returns u with every variable changed by a random amount of up to `reach` widths, inside the
  /// region.
  Eigen::VectorXd moved(const Eigen::VectorXd& u, double reach);
  /// Returns a random point of the region that differs from u by up to `reach` in every variable,
  /// uniformly distributed inside the bounds.
  Eigen::VectorXd drawn_near(const Eigen::VectorXd& u, double reach);
  /// Returns random numbers between -1 and 1, one for each variable.
  Eigen::VectorXd draw();

 private:
  /// Half widths of the box.
  Eigen::VectorXd h() const { return radius * scale_.widths(); }
  /// Orthonormal columns: directions along the equations, in units of h.
  Eigen::MatrixXd along() const;
  ResidualSamples samples() const { return memory.around(center_, h()); }
  bool is_pointless(const Eigen::VectorXd& u,
                    double distance,
                    const PendingPoints<Wanted>& wanted) const;
  const std::vector<Edge>& edges() const;
  bool is_beyond_edge(const Eigen::VectorXd& u) const;
  /// Returns the point c + T z, |z_i| <= box, with the least expected value outside of failed
  /// regions.
  Eigen::VectorXd least_expected(const ResidualKriging& m,
                                 const Eigen::MatrixXd& T,
                                 double box) const;
  Eigen::VectorXd moved(const Eigen::VectorXd& u, double reach, RandomStream& numbers) const;

  Eigen::VectorXd start_;
  int center_ = -1;
  int best_ = -1;
  /// Returns the variance of the slopes that samples at the places, in units of h, leave.
  SlopeVariance variance_left(const std::vector<Eigen::VectorXd>& places,
                              const Eigen::VectorXd& h) const;

  VariableScale scale_;
  double first_radius_;
  double first_probe_;  // length of the next probe of the first model, as a share of the radius
  /// Edges of failed regions around the center, in units of the widths.
  mutable std::vector<Edge> edges_;
  /// Center and numbers of samples and failures that edges_ was computed for.
  mutable std::array<int, 3> edges_of_{-1, 0, 0};
  int scaled_for_ = -1;  // index of the center whose Jacobian was last used for the scale
  std::uint64_t seed_;
  std::uint64_t drawn_ = 0;  // number of random points drawn so far
};

}  // namespace latsch
