// SPDX-License-Identifier: Apache-2.0
// The box of a residual trust region: what is known in it, and the points worth an evaluation.
//
// Around the best point c with half widths h = radius w; its part inside bounds and linear
// constraints is where points are taken from. Three kinds of them:
//   probe    along a direction which the samples leave unknown
//   step     to the least value to be expected (box_least_squares.h)
//   explore  anywhere near the point predicted to be the best
// Directions are those along the equations among the constraints. Samples from outside of the
// region help the models and are never the center.
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

/// A point whose outcome the method waits for.
struct Wanted {
  enum class Kind { start, probe, step };

  Eigen::VectorXd u;
  DesignPoint point;
  Kind kind;
  int center = -1;         // from which it was chosen
  double f_center = 0.0;   // its value
  double length = 0.0;     // |u - center|, largest component in widths of the variables
  double predicted = 0.0;  // value to be expected, of steps
};

class TrustBox {
 public:
  /// Around the initial values of the space.
  TrustBox(const DesignSpace& space, double radius, std::uint64_t seed);

  DesignSpace space;
  FeasibleRegion region;
  ResidualMemory memory;
  double radius;
  double noise = 0.0;  // of the model, in its units

  int n() const { return space.size(); }
  /// The equations leave nothing to vary.
  bool is_point() const { return region.E().rows() > 0 && along().cols() == 0; }
  const Eigen::VectorXd& c() const { return center_ >= 0 ? memory[center_].u : start_; }
  double f() const;
  /// The best sample inside the region since the last `move_to`; -1: none.
  int center() const { return center_; }
  bool has_center() const { return center_ >= 0; }
  /// The best sample of all inside the region; -1: none.
  int best() const { return best_; }
  /// Whether its value is no more than that; false for 0.
  bool is_down_to(double value) const {
    return value > 0.0 && best_ >= 0 && memory[best_].f <= value;
  }

  /// Begins anew around u.
  void move_to(const Eigen::VectorXd& u);
  /// Whether residuals leapt: it is worse than the center, with more stand-ins among them.
  bool leaps(const ResidualSample& sample) const;
  /// True where the sample is the new center.
  bool take(ResidualSample sample);
  /// From here on a value counts as exploded, beside those around the center or, where a run has
  /// none yet, around the best point of all.
  double explosion() const;

  /// What the samples and `wanted` leave open of the slopes.
  SlopeVariance geometry(const PendingPoints<Wanted>& wanted) const;
  /// Of the samples around c; `is_noisy`: it looks for noise.
  ResidualKriging model(bool is_noisy);
  /// dr/du at c, as the model knows it.
  Eigen::MatrixXd slopes();
  /// The outcome as the model expects it.
  ResidualSample expected(const DesignPoint& point) const;

  Wanted at(const Eigen::VectorXd& u, Wanted::Kind kind) const;
  /// Along a direction, to the side with more room, as long as it can be; nullopt where bounds and
  /// constraints leave it none.
  std::optional<Wanted> probe(Eigen::VectorXd direction, const PendingPoints<Wanted>& wanted) const;
  /// The step in a box of half width `box` radii; with a length of 0 where it is not worth an
  /// evaluation.
  Wanted step(const ResidualKriging& m, double box, const PendingPoints<Wanted>& wanted) const;
  /// Whether the value to be expected of it is less.
  bool promises(const Wanted& step) const;
  /// Where fresh slopes at c are to be taken; `J`: dr/du there; `change` of the residuals along an
  /// axis, of what they are.
  NaturalFrame natural_frame(const Eigen::MatrixXd& J, double change, double shortest) const;
  /// By `move` from c or back, as far as the region and failures leave room; nullopt: no room.
  std::optional<Wanted> probe_by(const Eigen::VectorXd& move,
                                 const PendingPoints<Wanted>& wanted) const;
  /// Of the samples which the frame brings near.
  ResidualKriging natural_model(const NaturalFrame& frame, double& noise) const;
  /// By the same samples: how far the residuals change over a move of 1 along each axis, of their
  /// norm, by the move mainly along it that changes them least; 0 where there is none.
  Eigen::VectorXd changes_along(const NaturalFrame& frame) const;
  /// Whether one of them tells anything of that axis.
  bool has_moved_along(int axis, const NaturalFrame& frame) const;
  /// The step of that model as far as `reach` along the axes.
  Wanted natural_step(const ResidualKriging& m,
                      const NaturalFrame& frame,
                      double reach,
                      const PendingPoints<Wanted>& wanted) const;
  /// Near the point predicted to be the best, at a distance of any magnitude.
  std::optional<Wanted> explore(const PendingPoints<Wanted>& wanted);
  /// u with every variable moved at random by up to `reach` widths, inside the region.
  Eigen::VectorXd moved(const Eigen::VectorXd& u, double reach);
  /// A point of the region, up to `reach` from u in every variable, equally likely anywhere there
  /// inside the bounds.
  Eigen::VectorXd drawn_near(const Eigen::VectorXd& u, double reach);
  /// Numbers in -1 ... 1, one a variable.
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
  /// Least value expected at c + T z with |z_i| <= box, outside of failed regions.
  Eigen::VectorXd least_expected(const ResidualKriging& m,
                                 const Eigen::MatrixXd& T,
                                 double box) const;
  Eigen::VectorXd moved(const Eigen::VectorXd& u, double reach, RandomStream& numbers) const;

  Eigen::VectorXd start_;
  int center_ = -1;
  int best_ = -1;
  VariableScale scale_;
  mutable std::vector<Edge> edges_;                // around the center, in widths
  mutable std::array<int, 3> edges_of_{-1, 0, 0};  // center, samples and failures they were made of
  int scaled_for_ = -1;  // the center whose Jacobian the scale learned last
  std::uint64_t seed_;
  std::uint64_t drawn_ = 0;  // random points so far
};

}  // namespace latsch
