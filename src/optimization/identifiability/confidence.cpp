// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/confidence.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "numerics/dense/orthogonal_factors.h"
#include "numerics/dense/singular_values.h"
#include "numerics/student_t.h"
#include "optimization/identifiability/robust_rows.h"
#include "optimization/problem/infinity.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

// Distance to a bound, as a share of the range, within which a variable may count as on the bound.
constexpr double kNearBound = 1e-6;
// Spacing of neighboring floating-point numbers, as a share of the range.
constexpr double kResolved = 4e-16;
// A variable counts as on its bound only if moving it onto the bound changes the residuals by less
// than this share of their noise.
constexpr double kNearInNoise = 0.1;
// Share of the largest singular value below which a singular value counts as zero.
constexpr double kRoundingOfValues = 1e-13;
/// Residuals whose spread is below this share of the stated noise contain no noise. An
/// autoregression with kappa = 0.99975, the largest that the estimation considers, still leaves
/// 0.03 beside a constant in 20 values.
constexpr double kNoNoise = 1e-3;
/// Share of the root mean square of psi below which the residuals count as free of noise if some
/// values lie beyond the corner of their loss. A few wrong values pull the fit of a curved model
/// off exact values, which leaves a smooth pattern of this size in the exact ones; this pattern is
/// not noise that neighbors share. A larger share would miss weak noise that they do share.
constexpr double kPulled = 0.05;
/// A bound holds a variable only if the variable would leave the bound by more than this share of
/// its standard deviation. In a fit without noise, rounding errors decide about smaller distances.
constexpr double kHeldBy = 1e-3;

/// If the variables that bounds hold explain more than this share of S, the residuals are the
/// misfit that the bounds cause, and the remainder is mostly the error of the linear approximation.
constexpr double kMisfit = 0.5;

struct Spectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd directions;
};

/// Returns n singular values, with zeros if there are fewer rows than columns.
Spectrum spectrum(const Eigen::MatrixXd& J) {
  const Eigen::Index n = J.cols();
  const auto [values, V] = numerics::singular_values(J);
  Spectrum s{Eigen::VectorXd::Zero(n), V};
  s.values.head(values.size()) = values;
  return s;
}

/// Returns (J' J)^-1. A direction in which J is zero gets the largest variance that rounding
/// allows.
Eigen::MatrixXd inverse_normal_matrix(const Eigen::MatrixXd& J) {
  if (J.cols() == 0) return {};
  const Spectrum s = spectrum(J);
  const double least =
      std::max(kRoundingOfValues * s.values[0], std::numeric_limits<double>::min());
  const Eigen::VectorXd scale = s.values.cwiseMax(least).cwiseInverse();
  const Eigen::MatrixXd W = s.directions * scale.asDiagonal();
  return W * W.transpose();
}

/// Returns N (H'H)^-1 N' for rows H in the motions N of the plane of `count` variables.
Eigen::MatrixXd inverse_in(const EqualPlane& plane, const Eigen::MatrixXd& H, Eigen::Index count) {
  if (plane.is_whole()) return inverse_normal_matrix(H);
  if (H.cols() == 0) return Eigen::MatrixXd::Zero(count, count);
  const Eigen::MatrixXd N = plane.motions();
  return N * inverse_normal_matrix(H) * N.transpose();
}

/// Returns the coefficients of the combination of the columns of A that is nearest to column j.
Eigen::VectorXd represented(const Eigen::MatrixXd& A, const Eigen::VectorXd& j) {
  return inverse_normal_matrix(A) * (A.transpose() * j);
}

/// Returns the part of column j that is orthogonal to the columns of A.
Eigen::VectorXd beside(const Eigen::MatrixXd& A, const Eigen::VectorXd& j) {
  if (A.cols() == 0) return j;
  // Columns may depend on each other, as those of two bushings in a row do.
  const Eigen::MatrixXd Q = numerics::range_basis(A);
  return j - Q * (Q.transpose() * j);
}

/// Returns the bound that a variable is on, if S grows from this bound inward. `way` is the
/// distance, in the unit cube, within which a variable counts as on a bound.
Bound bound_at(double u, double gradient, double way) {
  if (u <= way && gradient > 0.0) return Bound::lower;
  if (u >= 1.0 - way && gradient < 0.0) return Bound::upper;
  return Bound::none;
}

/// Returns for each variable the bound that prevents a better fit by more than rounding errors.
std::vector<Bound> held_variables(const Eigen::VectorXd& u,
                                  const Eigen::MatrixXd& H,
                                  const Eigen::VectorXd& gradient,
                                  const EqualPlane& plane,
                                  double sigma) {
  const double s = std::isfinite(sigma) ? sigma : 0.0;
  std::vector<Bound> bounds;
  std::vector<int> inside;
  for (int i = 0; i < u.size(); ++i) {
    const double felt = H.col(i).norm();
    const double way =
        s > 0.0 && felt > 0.0 ? std::min(kNearBound, kNearInNoise * s / felt) : kNearBound;
    bounds.push_back(bound_at(u[i], gradient[i], way));
    if (bounds.back() == Bound::none) inside.push_back(i);
  }
  const Eigen::MatrixXd all_inside = H(Eigen::all, inside),
                        H_inside = plane.of(inside).within(all_inside);
  for (int i = 0; i < u.size(); ++i) {
    Bound& bound = bounds[static_cast<size_t>(i)];
    if (bound == Bound::none) continue;
    const Eigen::VectorXd moved = H.col(i) + all_inside * plane.kept_by(inside, i);
    const double own = beside(H_inside, moved).norm();
    if (!(std::abs(gradient[i]) > kHeldBy * s * own)) bound = Bound::none;
  }
  return bounds;
}

/// Returns the share of the sum of squares of r that the held variables explain beside the free
/// ones, whose columns are J(all, free).
double share_of_held(const Eigen::VectorXd& r,
                     const Eigen::MatrixXd& J,
                     const std::vector<int>& free,
                     const EqualPlane& plane) {
  if (std::ssize(free) == J.cols()) return 0.0;
  const double without = beside(plane.of(free).within(J(Eigen::all, free)), r).squaredNorm();
  return without > 0.0 ? 1.0 - beside(plane.within(J), r).squaredNorm() / without : 0.0;
}

/// Returns the distance from a bound inward at which the growth of S, 2 g d + h d^2, reaches the
/// threshold.
double reach(double g, double h, double threshold) {
  const double root = std::sqrt(g * g + h * threshold);
  const double d = threshold / (g + root);  // this form of the solution avoids cancellation
  return std::isfinite(d) ? d : kInfinity;
}

}  // namespace

double rare_ratio(double nu) {
  // Value that a standard normal number exceeds with a chance of one in a thousand.
  constexpr double kNormal = 3.090232;
  const double k = 2.0 / (9.0 * nu);
  return std::pow(1.0 - k + kNormal * std::sqrt(k), 3.0);
}

namespace {

void take_spread(const ResidualNoise& noise,
                 const ConfidenceOptions& options,
                 const RobustRows& rows,
                 Confidence& c) {
  const double seen = noise.sigma(), nu = noise.freedom();
  c.sigma = options.sigma ? *options.sigma : std::max(options.least_sigma, seen);
  c.is_colored = !noise.is_white();
  c.samples_for_one = noise.samples_for_one();
  if (nu <= 0.0 && !options.sigma) c.sigma = std::numeric_limits<double>::quiet_NaN();
  c.with_loss = rows.with_loss();
  c.beyond = rows.beyond();
  if (options.sigma) c.expected_beyond = rows.expected_beyond(*options.sigma);
  if (rows.is_limited()) c.felt_changes = rows.felt_changes();
  if (!options.sigma || nu <= 0.0 || rows.is_limited()) return;
  const double ratio = seen * seen / (*options.sigma * *options.sigma);
  if (ratio <= rare_ratio(nu)) return;
  c.excess = std::sqrt(ratio);
  c.sigma = seen;
}

/// Returns the standard deviation along each direction that noise causes, by the projection of the
/// noise onto J v_k.
Eigen::VectorXd along_directions(const Eigen::MatrixXd& J,
                                 const ResidualNoise& noise,
                                 const Confidence& c) {
  Eigen::VectorXd deviations(c.singular_values.size());
  for (Eigen::Index k = 0; k < deviations.size(); ++k) {
    const double length = c.singular_values[k];
    if (!(length > kRoundingOfValues * c.singular_values[0])) {
      deviations[k] = kInfinity;
      continue;
    }
    const Eigen::VectorXd felt = J * c.directions.col(k) / length;
    deviations[k] = c.sigma * std::sqrt(noise.covariance(felt)(0, 0)) / length;
  }
  return deviations;
}

/// The estimated variables as linear functions of psi, by direction:  u = -V scale felt' psi.
struct Estimates {
  Eigen::MatrixXd V;      // n x f: directions
  Eigen::VectorXd scale;  // f: 1 / singular value
  Eigen::MatrixXd W;      // n x f: V scale
  // The product X W, m x f. Columns of flat directions are 0; without a loss, all others are
  // orthonormal.
  Eigen::MatrixXd felt;
  Eigen::MatrixXd bent;  // H W; 0 if flat
  std::vector<Eigen::Index> flat;

  /// Returns, for these psi, the shift of the minimum of S along each direction.
  Eigen::MatrixXd answer(const Eigen::MatrixXd& psi) const {
    return -(scale.asDiagonal() * (felt.transpose() * psi));
  }
  /// Returns the motion along each direction for a unit motion of another variable, whose column of
  /// H is h.
  Eigen::VectorXd following(const Eigen::VectorXd& h) const {
    return -(scale.asDiagonal() * (bent.transpose() * h));
  }
};

/// Returns the estimates for the derivatives X of the residuals before a loss is applied, and for
/// rows H with H'H = A, in the plane.
Estimates estimates_of(const Eigen::MatrixXd& X,
                       const Eigen::MatrixXd& H,
                       const EqualPlane& plane) {
  if (X.cols() == 0) return {};
  const Eigen::MatrixXd within = plane.within(H);
  if (within.cols() == 0) {
    const Eigen::MatrixXd none(X.cols(), 0), no_rows(X.rows(), 0);
    return {none, Eigen::VectorXd(0), none, no_rows, no_rows, {}};
  }
  const Spectrum s = spectrum(within);
  const double least =
      std::max(kRoundingOfValues * s.values[0], std::numeric_limits<double>::min());
  const Eigen::VectorXd scale = s.values.cwiseMax(least).cwiseInverse();
  const Eigen::MatrixXd V = plane.of_variables(s.directions);
  Estimates estimates{V, scale, V * scale.asDiagonal(), {}, {}, {}};
  estimates.felt = X * estimates.W;
  estimates.bent = H * estimates.W;
  for (Eigen::Index k = 0; k < s.values.size(); ++k) {
    if (s.values[k] > least) continue;
    estimates.felt.col(k).setZero();
    estimates.bent.col(k).setZero();
    estimates.flat.push_back(k);
  }
  return estimates;
}

/// The effect of the noise on the variables of a fit with or without robust losses.
class MovingNoise {
 public:
  MovingNoise(const RobustRows& rows,
              const ResidualNoise& noise,
              const ConfidenceOptions& options,
              const Confidence& c)
      : rows_(rows), noise_(noise), sigma_(c.sigma), deviations_(rows.psi().size()) {
    deviations_.setOnes();
    if (!options.traits.deviations.empty()) deviations_ = to_vector(options.traits.deviations);
    if (!rows.is_limited()) return;
    spreads_ = rows.spreads(options.sigma, options.least_sigma);
    if (c.is_colored && !options.sigma) {
      const ResidualNoise white(rows.psi(), rows.X(), {.deviations = options.traits.deviations});
      const double more = noise.sigma() / white.sigma();
      spreads_.common *= more;
      spreads_.own *= more;
    }
    common_ = weighted_rows(rows.X(), rows.common_weights());
  }

  /// Returns the covariance of the coordinates along the directions of the given variables.
  Eigen::MatrixXd covariance(const Estimates& estimates,
                             const std::vector<int>& variables,
                             const EqualPlane& plane) const {
    Eigen::MatrixXd K = gram(estimates.felt, rows_.is_limited() ? &spreads_.own : nullptr);
    if (rows_.is_limited()) {
      const Eigen::MatrixXd X = rows_.X()(Eigen::all, variables);
      const Estimates common = estimates_of(X, common_(Eigen::all, variables), plane);
      const Eigen::MatrixXd to_these =
          estimates.scale.cwiseInverse().asDiagonal() * (estimates.V.transpose() * common.W);
      take_larger(
          to_these * gram(common.felt, &spreads_.common) * to_these.transpose(), estimates.flat, K);
    }
    for (const Eigen::Index k : estimates.flat)
      K(k, k) = rows_.is_limited() ? sigma_ * sigma_ : 1.0;
    const Eigen::MatrixXd scaled = estimates.scale.asDiagonal() * K * estimates.scale.asDiagonal();
    return rows_.is_limited() ? scaled : Eigen::MatrixXd(sigma_ * sigma_ * scaled);
  }

  /// Returns the variance that the noise causes in y' psi divided by the curvature of S that
  /// belongs to y; without a loss, in units of sigma^2. `common` is the curvature computed with the
  /// same psi' for all residuals.
  double share(const Eigen::VectorXd& y, double curvature, const Eigen::VectorXd& common) const {
    if (!rows_.is_limited()) return noise_.covariance(y)(0, 0) / y.squaredNorm();
    const double of_common = common.squaredNorm();
    return std::max(gram(y, &spreads_.own)(0, 0) / curvature,
                    gram(y, &spreads_.common)(0, 0) * curvature / (of_common * of_common));
  }

  /// Returns the standard deviation of every residual as it acts on the variables.
  Eigen::VectorXd effective_deviations() const {
    const Eigen::VectorXd shared = noise_.effective_deviations();
    if (!rows_.is_limited()) return sigma_ * shared;
    return shared.array() / deviations_.array() * spreads_.common.array() * rows_.slopes().array() /
           rows_.common_weights().array().max(0.0);
  }

  /// Returns the rows weighted by the psi' that is common to all residuals; without a loss, the
  /// unweighted rows.
  const Eigen::MatrixXd& common() const { return rows_.is_limited() ? common_ : rows_.X(); }

 private:
  /// Returns Y' D R D Y, where R is the correlation of the residuals. Without D, the result is Y' R
  /// Y in units of sigma^2.
  Eigen::MatrixXd gram(const Eigen::MatrixXd& Y, const Eigen::VectorXd* D) const {
    if (!D) return noise_.covariance(Y);
    return noise_.covariance(D->cwiseQuotient(deviations_).asDiagonal() * Y);
  }
  /// Replaces K by the larger of K and `other`, except in flat directions, on which no residual
  /// depends.
  static void take_larger(const Eigen::MatrixXd& other,
                          const std::vector<Eigen::Index>& flat,
                          Eigen::MatrixXd& K) {
    std::vector<Eigen::Index> known;
    for (Eigen::Index k = 0; k < K.rows(); ++k)
      if (std::find(flat.begin(), flat.end(), k) == flat.end()) known.push_back(k);
    const Eigen::MatrixXd both = larger(other(known, known), K(known, known));
    K(known, known) = both;
  }

  const RobustRows& rows_;
  const ResidualNoise& noise_;
  double sigma_;
  Eigen::VectorXd deviations_;
  RobustRows::Spreads spreads_;
  Eigen::MatrixXd common_;
};

FreeDirections free_directions(const Linearization& at,
                               const Eigen::MatrixXd& H,
                               const std::vector<int>& free,
                               const Estimates& estimates,
                               const MovingNoise& noise,
                               const RobustRows& rows,
                               const Confidence& c) {
  const Eigen::Index n = at.u.size(), f = estimates.V.cols();
  FreeDirections directions{Eigen::MatrixXd::Zero(n, f),
                            Eigen::MatrixXd(f, f),
                            Eigen::VectorXd(f),
                            Eigen::MatrixXd::Zero(f, n),
                            Eigen::MatrixXd(),
                            c.t};
  if (free.empty()) return directions;
  directions.axes(free, Eigen::all) = estimates.V;
  directions.covariance = noise.covariance(estimates, free, c.plane.of(free));
  directions.left = estimates.answer(rows.psi());
  if (!c.plane.is_whole()) directions.kept = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    if (c.held[static_cast<size_t>(i)] == Bound::none) continue;
    const Eigen::VectorXd kept = c.plane.kept_by(free, i);
    directions.following.col(i) = estimates.following(H.col(i) + H(Eigen::all, free) * kept);
    if (!c.plane.is_whole()) directions.kept(free, i) = kept;
  }
  return directions;
}

/// Computes directions and singular values for all variables, and the standard deviation along
/// each.
void take_directions(const Eigen::MatrixXd& H,
                     const RobustRows& rows,
                     const ResidualNoise& noise,
                     const MovingNoise& moving,
                     Confidence& c) {
  const Eigen::MatrixXd within = c.plane.within(H);
  if (within.cols() == 0) {
    c.directions = Eigen::MatrixXd(H.cols(), 0);
    return;
  }
  const Spectrum all = spectrum(within);
  c.singular_values = all.values;
  c.directions = c.plane.of_variables(all.directions);
  if (!rows.is_limited()) {
    c.direction_deviations = along_directions(H, noise, c);
    return;
  }
  std::vector<int> variables;
  for (int i = 0; i < H.cols(); ++i) variables.push_back(i);
  const Estimates estimates = estimates_of(rows.X(), H, c.plane);
  c.direction_deviations = moving.covariance(estimates, variables, c.plane).diagonal().cwiseSqrt();
  for (const Eigen::Index k : estimates.flat) c.direction_deviations[k] = kInfinity;
}

}  // namespace

Confidence confidence(const Linearization& at, const ConfidenceOptions& options) {
  const Eigen::Index n = at.u.size();
  assert(at.r.size() > 0 && at.J.rows() == at.r.size() && at.J.cols() == n);
  Confidence c;
  c.plane = options.plane;
  const Eigen::VectorXd steepest = at.J.transpose() * at.r;
  const RobustRows rows(at.r, at.J, options.traits);
  const Eigen::MatrixXd H = rows.is_limited() ? weighted_rows(rows.X(), rows.own_weights()) : at.J;
  // The noise is estimated with all variables free: the part of the residuals that a held variable
  // could explain is not noise.
  double rounding = options.sigma ? kNoNoise * *options.sigma : options.least_noise;
  if (rows.beyond() > 0)
    rounding = std::max(rounding, kPulled * rows.psi().norm() / std::sqrt(at.r.size()));
  ResidualNoise noise(rows.psi(), c.plane.within(rows.X()), options.traits, rounding);
  take_spread(noise, options, rows, c);
  std::vector<int> inside, free;
  for (int i = 0; i < n; ++i)
    if (at.u[i] > kNearBound && at.u[i] < 1.0 - kNearBound) inside.push_back(i);
  const Eigen::VectorXd gradient = c.plane.reduced(steepest, inside);
  c.held = held_variables(at.u, H, gradient, c.plane, c.sigma);
  for (int i = 0; i < n; ++i)
    if (c.held[static_cast<size_t>(i)] == Bound::none) free.push_back(i);
  c.share_beyond_bounds = share_of_held(rows.psi(), rows.X(), free, c.plane);
  if (c.share_beyond_bounds > kMisfit) {
    noise.take_for_pattern();
    take_spread(noise, options, rows, c);
  }
  c.is_pattern = noise.is_pattern();
  c.group_freedoms = noise.groups().freedoms();
  const bool stated = options.sigma && c.excess == 1.0;
  const double p = 0.5 + 0.5 * options.level, nu = noise.freedom();
  c.t = numerics::student_t_quantile(p, stated || nu <= 0.0 ? kInfinity : nu);
  const MovingNoise moving(rows, noise, options, c);
  c.noise = moving.effective_deviations();
  take_directions(H, rows, noise, moving, c);

  const EqualPlane plane = c.plane.of(free);
  const Eigen::MatrixXd X_all = rows.X()(Eigen::all, free), H_all = H(Eigen::all, free),
                        common_all = moving.common()(Eigen::all, free);
  const Eigen::MatrixXd X_free = plane.within(X_all), H_free = plane.within(H_all),
                        common_free = plane.within(common_all);
  const Eigen::MatrixXd inverse = inverse_in(plane, H_free, std::ssize(free));
  const Estimates estimates = estimates_of(X_all, H_all, plane);
  Eigen::VectorXd left = -inverse * gradient(free);  // distance to the minimum of S
  // The distance along flat directions, on which no residual depends, is set to 0.
  if (!estimates.flat.empty()) left = estimates.V * estimates.answer(rows.psi());
  c.left_to_gain = free.empty() ? 0.0 : std::max(0.0, -gradient(free).dot(left));
  c.free = free_directions(at, H, free, estimates, moving, rows, c);
  const Eigen::MatrixXd C = estimates.V * c.free.covariance * estimates.V.transpose();
  /// Returns Student's quantile t for the interval of a variable whose estimate is y' psi.
  const auto t_of = [&](const Eigen::VectorXd& y) {
    const double freedom = std::min(nu > 0.0 ? nu : kInfinity, noise.freedom_of(y, stated));
    const double t =
        c.is_colored || noise.has_groups()
            ? numerics::student_t_quantile(p, stated ? noise.freedom_of(y, true) : freedom)
            : c.t;
    c.free.t = std::max(c.free.t, t);
    return t;
  };
  /// Returns the growth of S at the ends of an interval: t^2 times `share`, the ratio of a variance
  /// to a curvature.
  const double unit = rows.is_limited() ? 1.0 : c.sigma * c.sigma;
  const auto threshold_of = [&](double t, double share) {
    return std::isfinite(share) ? unit * t * t * share : c.threshold();
  };
  c.covariance = Eigen::MatrixXd::Zero(n, n);
  c.correlation = Eigen::MatrixXd::Zero(n, n);
  c.intervals.resize(n);
  c.thresholds.resize(n);
  for (size_t a = 0; a < free.size(); ++a) {
    for (size_t b = 0; b < free.size(); ++b) {
      c.covariance(free[a], free[b]) = C(a, b);
      c.correlation(free[a], free[b]) = C(a, b) / std::sqrt(C(a, a) * C(b, b));
    }
    const Eigen::VectorXd y = estimates.felt * estimates.W.row(a).transpose();
    c.thresholds[free[a]] =
        threshold_of(t_of(y), rows.is_limited() ? C(a, a) / inverse(a, a) : moving.share(y, 0, y));
    double half = std::sqrt(c.thresholds[free[a]] * inverse(a, a)) + std::abs(left[a]);
    if (!std::isfinite(half)) half = kInfinity;
    half = std::max(half, kResolved);
    c.intervals[free[a]] = {at.u[free[a]] - half, at.u[free[a]] + half};
  }
  for (int i = 0; i < n; ++i) {
    if (c.held[i] == Bound::none) continue;
    // Changes if the variable moves by 1 and the free ones keep linear equations.
    const Eigen::VectorXd kept = c.plane.kept_by(free, i);
    const Eigen::VectorXd h = H.col(i) + H_all * kept, x = rows.X().col(i) + X_all * kept,
                          common = moving.common().col(i) + common_all * kept;
    const Eigen::VectorXd own = beside(H_free, h);
    const Eigen::VectorXd y = rows.is_limited() && H_free.cols() > 0
                                  ? Eigen::VectorXd(x - X_free * represented(H_free, h))
                                  : beside(X_free, x);
    c.thresholds[i] =
        threshold_of(t_of(y), moving.share(y, own.squaredNorm(), beside(common_free, common)));
    const double inward = reach(std::abs(gradient[i]), own.squaredNorm(), c.thresholds[i]);
    c.intervals[i] = c.held[i] == Bound::lower ? Interval{-kInfinity, at.u[i] + inward}
                                               : Interval{at.u[i] - inward, kInfinity};
  }
  return c;
}

namespace {

/// Returns a matrix with n rows: the rows of `part` at the indices `places`, and 0 elsewhere.
Eigen::MatrixXd spread_rows(const Eigen::MatrixXd& part,
                            const std::vector<int>& places,
                            Eigen::Index n) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, part.cols());
  for (std::size_t k = 0; k < places.size(); ++k)
    all.row(places[k]) = part.row(static_cast<Eigen::Index>(k));
  return all;
}

}  // namespace

Confidence of_all_variables(Confidence part,
                            const std::vector<int>& free,
                            const Eigen::VectorXd& u) {
  const Eigen::Index n = u.size();
  Confidence all = part;
  all.held.assign(static_cast<std::size_t>(n), Bound::none);
  all.thresholds.assign(static_cast<std::size_t>(n), part.threshold());
  all.intervals.clear();
  for (Eigen::Index i = 0; i < n; ++i) all.intervals.push_back({u[i], u[i]});
  for (std::size_t k = 0; k < free.size(); ++k) {
    const auto i = static_cast<std::size_t>(free[k]);
    all.held[i] = part.held[k];
    all.thresholds[i] = part.thresholds[k];
    all.intervals[i] = part.intervals[k];
  }
  const auto square = [&](const Eigen::MatrixXd& of_free) -> Eigen::MatrixXd {
    return spread_rows(spread_rows(of_free, free, n).transpose(), free, n);
  };
  all.directions = spread_rows(part.directions, free, n);
  all.covariance = square(part.covariance);
  all.correlation = square(part.correlation);
  all.free.axes = spread_rows(part.free.axes, free, n);
  all.free.following = spread_rows(part.free.following.transpose(), free, n).transpose();
  if (part.free.kept.size() > 0) all.free.kept = square(part.free.kept);
  return all;
}

Eigen::VectorXd shift_of(const Linearization& at,
                         const std::vector<Bound>& held,
                         const Eigen::VectorXd& change,
                         const Eigen::VectorXd& felt_changes,
                         const EqualPlane& plane) {
  std::vector<int> free;
  for (int i = 0; i < at.u.size(); ++i)
    if (held[static_cast<size_t>(i)] == Bound::none) free.push_back(i);
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(at.u.size());
  if (free.empty()) return shift;
  const Eigen::MatrixXd J = at.J(Eigen::all, free);
  const bool all = felt_changes.size() == 0;
  const Estimates estimates =
      estimates_of(J, all ? J : weighted_rows(J, felt_changes), plane.of(free));
  shift(free) = estimates.V *
                estimates.answer(all ? change : Eigen::VectorXd(felt_changes.cwiseProduct(change)));
  return shift;
}

std::vector<DesignPoint> difference_points(const DesignSpace& space,
                                           const DesignPoint& center,
                                           const Eigen::VectorXd& steps) {
  constexpr double kStep = 0.01;
  std::vector<DesignPoint> points{center};
  const std::vector<double> u = space.to_unit(center);
  for (int i = 0; i < space.size(); ++i) {
    const auto stepped = [&](double side) {
      std::vector<double> moved = u;
      moved[i] += side;
      DesignPoint point = center;  // a copy, which keeps the exact bits of the other variables
      point.values[i] = space.from_unit(moved).values[i];
      return point;
    };
    const double step = steps.size() > i && steps[i] > 0.0 ? steps[i] : kStep;
    const double inward = u[i] + step <= 1.0 ? step : -step;
    const DesignPoint first = stepped(inward), other = stepped(-inward);
    const double behind = u[i] - inward;
    const bool has_room_behind = behind >= 0.0 && behind <= 1.0 && space.contains(other);
    points.push_back(space.contains(first) || !has_room_behind ? first : other);
  }
  return points;
}

std::vector<Eigen::Index> known_residuals(const std::vector<Eigen::VectorXd>& residuals) {
  std::vector<Eigen::Index> known;
  for (Eigen::Index row = 0; row < residuals.front().size(); ++row) {
    const auto finite = [row](const Eigen::VectorXd& r) { return std::isfinite(r[row]); };
    if (std::all_of(residuals.begin(), residuals.end(), finite)) known.push_back(row);
  }
  return known;
}

Linearization differences(const DesignSpace& space,
                          const std::vector<DesignPoint>& points,
                          const std::vector<Eigen::VectorXd>& residuals) {
  const int n = space.size();
  assert(static_cast<int>(points.size()) == n + 1 && residuals.size() == points.size());
  const auto unit = [&](const DesignPoint& point) { return to_vector(space.to_unit(point)); };
  Linearization at{unit(points[0]), residuals[0], Eigen::MatrixXd(residuals[0].size(), n)};
  for (int i = 0; i < n; ++i) {
    const double h = unit(points[i + 1])[i] - at.u[i];
    at.J.col(i) = (residuals[i + 1] - at.r) / h;
  }
  return at;
}

}  // namespace latsch
