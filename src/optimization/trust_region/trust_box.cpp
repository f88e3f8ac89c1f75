// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/trust_box.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optimization/least_squares/box_least_squares.h"
#include "optimization/least_squares/polytope_least_squares.h"
#include "optimization/problem/infinity.h"
#include "optimization/problem/point_vector.h"
#include "optimization/region/tangent_cone.h"

namespace latsch {
namespace {

// Length of a probe as a share of the radius. Shorter probes give more exact slopes, longer ones
// exceed the noise; a third of this length or three times this length make little difference.
constexpr double kProbe = 0.03;
// Length of the probes of the first model, likewise a share of the radius. Nothing is known of
// noise and ripple then, and the next model mends what curvature makes of long probes.
constexpr double kFirstProbe = 1.0;
// Change of the residuals over a first probe, as a multiple of their size, above which the slope is
// mostly curvature: the next first probes are shorter in proportion, and longer again if they
// change the residuals by less.
constexpr double kFirstChange = 1.0;
// Length of a probe beside an awaited step, as a share of the step.
constexpr double kBeside = 0.25;
// Smallest share of a probe's length that bounds and failed regions must leave.
constexpr double kRoom = 0.5;
// Length of a step, as a share of the radius, below which it is not worth an evaluation.
constexpr double kShort = 0.01;
// Factor by which a step is shortened if no cutting plane keeps it out of a failed region.
constexpr double kBackOff = 0.5;
// Distance of a cutting plane from the center of a failure's ball, as a multiple of its radius, so
// that a step onto the plane is outside of the ball.
constexpr double kBeyondBall = 1.001;
constexpr int kMostCuts = 20;  // largest number of cutting planes for one step
// Longest probe as a share of a range when slopes are recomputed along directions with little
// effect.
constexpr double kLongestProbe = 0.2;
constexpr int kProbeShortenings = 3;  // number of times a probe without room is halved
// Distance to a known point, as a share of the step, below which a new point gives no information.
constexpr double kSame = 0.1;
/// Returns the widths of the variables around a point, as shares of their ranges: so narrow that a
/// move by `radius` changes no linear variable by more than its value. A bound may be a wall far
/// away, and then its distance is no scale for a step or a tolerance. A value of 0 says nothing of
/// its own size, so the width is then the whole range.
Eigen::VectorXd ordinary_widths(const DesignSpace& space, const DesignPoint& point, double radius) {
  Eigen::VectorXd widths = Eigen::VectorXd::Ones(space.size());
  for (int i = 0; i < space.size(); ++i) {
    const DesignVariable& variable = space[i];
    const double size = std::abs(point.values[i]);
    if (variable.scale == Scale::logarithmic || size == 0.0) continue;
    widths[i] = std::min(1.0, size / (radius * (variable.upper - variable.lower)));
  }
  return widths;
}

}  // namespace

TrustBox::TrustBox(const DesignSpace& s, double first_radius, std::uint64_t seed)
    : space(s),
      region(s),
      radius(first_radius),
      start_(to_vector(s.to_unit(s.initial()))),
      scale_(ordinary_widths(s, s.initial(), first_radius)),
      first_radius_(first_radius),
      first_probe_(kFirstProbe),
      seed_(seed) {}

double TrustBox::f() const { return has_center() ? memory[center_].f : kInfinity; }

void TrustBox::move_to(const Eigen::VectorXd& u) {
  start_ = u;
  center_ = -1;
}

bool TrustBox::take(ResidualSample sample) {
  const bool is_inside = region.contains(sample.u);
  const bool is_better = is_inside && sample.f < f();
  const bool is_best = is_inside && (best_ < 0 || sample.f < memory[best_].f);
  memory.add(std::move(sample));
  if (is_better) center_ = memory.size() - 1;
  if (is_best) best_ = memory.size() - 1;
  return is_better;
}

void TrustBox::learn_from_first_probe(double change) {
  const bool is_known = change >= 0.0;
  if (!is_known || (change <= kFirstChange && first_probe_ == kFirstProbe)) return;
  first_probe_ = std::clamp(first_probe_ * kFirstChange / change, kProbe, kFirstProbe);
}

bool TrustBox::leaps(const ResidualSample& sample) const {
  return has_center() && sample.stand_ins > memory[center_].stand_ins && !(sample.f < f());
}

double TrustBox::explosion() const {
  const int around = has_center() ? center_ : best_;
  return around >= 0 ? memory.explosion(around, h()) : kInfinity;
}

Eigen::MatrixXd TrustBox::along() const {
  const Eigen::MatrixXd E = region.E() * scale_.widths().asDiagonal();
  return tangent_cone(Eigen::MatrixXd(n(), 0), E.transpose()).lines;
}

SlopeVariance TrustBox::geometry(const PendingPoints<Wanted>& wanted) const {
  std::vector<Eigen::VectorXd> places;
  if (has_center()) {
    for (const int i : memory.near(center_, h())) places.push_back(memory[i].u - c());
  }
  for (const Wanted& w : wanted) {
    if (w.u != c()) places.push_back(w.u - c());
  }
  return variance_left(places, h());
}

SlopeVariance TrustBox::variance_left(const std::vector<Eigen::VectorXd>& places,
                                      const Eigen::VectorXd& h) const {
  Eigen::MatrixXd Z(std::ssize(places), n());
  for (Eigen::Index i = 0; i < Z.rows(); ++i) Z.row(i) = places[i].cwiseQuotient(h);
  if (region.E().rows() == 0) return slope_variance(Z);
  const Eigen::MatrixXd N = along();
  if (N.cols() == 0) return {};  // the region is a single point
  SlopeVariance found = slope_variance(Z * N);
  found.directions = N * found.directions;
  return found;
}

ResidualKriging TrustBox::model(bool is_noisy) {
  if (std::exchange(scaled_for_, center_) != center_) {
    const DesignPoint here = space.from_unit({c().begin(), c().end()});
    scale_.widen(ordinary_widths(space, here, first_radius_));
    const ResidualKriging first(samples(), noise);
    const Eigen::MatrixXd J = first.jacobian(Eigen::VectorXd::Zero(n()));  // dr/dz
    scale_.learn(J * h().cwiseInverse().asDiagonal());
    // The edges are in units of the widths, which have changed, so they are computed again.
    edges_of_[0] = -1;
  }
  const ResidualSamples around = samples();
  if (is_noisy || noise > 0.0) noise = likeliest_noise(around);
  return ResidualKriging(around, noise);
}

Eigen::MatrixXd TrustBox::slopes() {
  return model(false).jacobian(Eigen::VectorXd::Zero(n())) * h().cwiseInverse().asDiagonal();
}

ResidualSample TrustBox::expected(const DesignPoint& point) const {
  const Eigen::VectorXd u = to_vector(space.to_unit(point));
  const Eigen::VectorXd r =
      ResidualKriging(samples(), noise).residuals((u - c()).cwiseQuotient(h()));
  return {u, r, {}, r.squaredNorm(), memory[center_].stand_ins};
}

Wanted TrustBox::at(const Eigen::VectorXd& u, Wanted::Kind kind) const {
  const Eigen::VectorXd inside = region.nearest(u);
  return {inside,
          space.from_unit({inside.begin(), inside.end()}),
          kind,
          center_,
          f(),
          scale_.length(inside - c())};
}

bool TrustBox::is_beyond_edge(const Eigen::VectorXd& u) const {
  if (!has_center()) return false;
  const Eigen::VectorXd x = (u - c()).cwiseQuotient(scale_.widths());
  return std::any_of(
      edges().begin(), edges().end(), [&](const Edge& edge) { return edge.a.dot(x) > edge.b; });
}

/// True if the point is close to a known or wanted point, or lies in a failed region.
bool TrustBox::is_pointless(const Eigen::VectorXd& u,
                            double distance,
                            const PendingPoints<Wanted>& wanted) const {
  const auto is_near = [&](const Wanted& w) { return scale_.length(w.u - u) < distance; };
  return memory.knows(u, distance * scale_.widths()) || memory.has_failed_near(u) ||
         std::any_of(wanted.begin(), wanted.end(), is_near);
}

std::optional<Wanted> TrustBox::probe(Eigen::VectorXd direction,
                                      const PendingPoints<Wanted>& wanted) const {
  Eigen::Index largest;
  direction.cwiseAbs().maxCoeff(&largest);
  if (direction[largest] < 0.0) direction = -direction;
  const auto end = [&](double length) {
    return region.nearest(c() + length * scale_.widths().cwiseProduct(direction));
  };
  double length = (knows_slopes() ? kProbe : first_probe_) * radius;
  if (scale_.norm(end(-length) - c()) > 1.01 * scale_.norm(end(length) - c())) {
    direction = -direction;
  }
  constexpr int kShortenings = 20;
  for (int k = 0; k < kShortenings; ++k, length *= 0.2) {
    for (const double signed_length : {length, -length}) {
      const Eigen::VectorXd u = end(signed_length);
      const bool has_room = scale_.norm(u - c()) > kRoom * length;
      if (has_room && !is_pointless(u, 1e-3 * length, wanted)) return at(u, Wanted::Kind::probe);
    }
  }
  return std::nullopt;
}

std::optional<Wanted> TrustBox::probe_beside(const Wanted& step,
                                             double least_share,
                                             const PendingPoints<Wanted>& wanted) const {
  const Eigen::VectorXd reach = step.length * scale_.widths();
  std::vector<Eigen::VectorXd> places{c() - step.u};
  for (const int i : memory.near(center_, h())) places.push_back(memory[i].u - step.u);
  for (const Wanted& w : wanted) {
    if (w.u != step.u) places.push_back(w.u - step.u);
  }
  const SlopeVariance left = variance_left(places, reach);
  const Eigen::Index last = left.share.size() - 1;
  if (last < 0 || left.share[last] <= least_share) return std::nullopt;
  const Eigen::VectorXd move = kBeside * reach.cwiseProduct(left.directions.col(last));
  for (const double side : {1.0, -1.0}) {
    const Eigen::VectorXd u = region.nearest(step.u + side * move);
    const bool has_room = scale_.norm(u - step.u) > kRoom * scale_.norm(move);
    if (has_room && !is_beyond_edge(u) && !is_pointless(u, kSame * kBeside * step.length, wanted)) {
      return at(u, Wanted::Kind::probe);
    }
  }
  return std::nullopt;
}

// If the minimum lies in a failed region, the space is cut by a plane in front of the ball around
// that failure, as seen from c, and the minimum is sought again on the near side. Steps thus follow
// the edge of the region.
Eigen::VectorXd TrustBox::least_expected(const ResidualKriging& m,
                                         const Eigen::MatrixXd& T,
                                         double box) const {
  const bool is_aligned =
      region.is_cube() && T.isDiagonal() && T.diagonal().minCoeff() > 0.0 && edges().empty();
  const Eigen::VectorXd reach = Eigen::VectorXd::Constant(T.cols(), box);
  Eigen::MatrixXd A = region.A();
  Eigen::VectorXd room = (region.b() - A * c()).cwiseMax(0.0);
  const auto close_off = [&](const Eigen::VectorXd& a, double distance) {
    A.conservativeResize(A.rows() + 1, Eigen::NoChange);
    A.row(A.rows() - 1) = a.transpose();
    room.conservativeResize(A.rows());
    room[A.rows() - 1] = std::max(0.0, distance);
  };
  for (const Edge& edge : edges()) close_off(edge.a.cwiseQuotient(scale_.widths()), edge.b);
  const auto least = [&](bool is_cut) {
    if (is_aligned && !is_cut) {
      const Eigen::ArrayXd h = T.diagonal();
      return minimize_in_box(
          m, (-c().array() / h).max(-box).matrix(), ((1.0 - c().array()) / h).min(box).matrix());
    }
    return minimize_in_polytope(m, -reach, reach, region.E() * T, A * T, room);
  };
  Eigen::VectorXd z = least(false);
  int last = -1;
  for (int cuts = 0; cuts < kMostCuts; ++cuts) {
    const int failed = memory.failure_near(c() + T * z);
    if (failed < 0) return z;
    if (failed == last) break;
    last = failed;
    const Eigen::VectorXd away = memory.failure(failed) - c();
    const double distance = away.norm();
    close_off(away / distance, distance - kBeyondBall * memory.avoided(failed));
    z = least(true);
  }
  while (memory.has_failed_near(c() + T * z)) z *= kBackOff;
  return z;
}

const std::vector<Edge>& TrustBox::edges() const {
  const std::array now{center_, memory.size(), memory.failures()};
  if (std::exchange(edges_of_, now) != now) edges_ = memory.edges(center_, scale_.widths());
  return edges_;
}

Wanted TrustBox::step(const ResidualKriging& m,
                      double box,
                      const PendingPoints<Wanted>& wanted) const {
  const Eigen::VectorXd z = least_expected(m, h().asDiagonal(), box);
  Wanted step = at(c() + h().cwiseProduct(z), Wanted::Kind::step);
  step.predicted = m.expected(z);
  step.deviation = m.target_deviation();
  step.radius = radius;
  step.box = box;
  if (step.length < kShort * radius || is_pointless(step.u, kSame * step.length, wanted) ||
      !promises(step)) {
    step.length = 0.0;
  }
  return step;
}

NaturalFrame TrustBox::natural_frame(const Eigen::MatrixXd& J,
                                     double change,
                                     double shortest) const {
  return latsch::natural_frame(J,
                               change * memory[center_].r.norm(),
                               c(),
                               scale_.widths(),
                               along(),
                               {shortest, kLongestProbe});
}

std::optional<Wanted> TrustBox::probe_by(const Eigen::VectorXd& move,
                                         const PendingPoints<Wanted>& wanted) const {
  double share = 1.0;
  for (int k = 0; k < kProbeShortenings; ++k, share *= 0.5) {
    for (const double side : {share, -share}) {
      const Eigen::VectorXd u = region.nearest(c() + side * move);
      const bool has_room = scale_.norm(u - c()) > 0.5 * share * scale_.norm(move);
      const double distance = kSame * share * scale_.norm(move);
      if (!has_room || is_beyond_edge(u)) continue;
      if (!is_pointless(u, distance, wanted)) return at(u, Wanted::Kind::probe);
    }
  }
  return std::nullopt;
}

ResidualKriging TrustBox::natural_model(const NaturalFrame& frame, double& noise) const {
  const ResidualSamples around = memory.around(center_, frame);
  noise = likeliest_noise(around);
  return ResidualKriging(around, noise);
}

Eigen::VectorXd TrustBox::changes_along(const NaturalFrame& frame) const {
  const ResidualSamples around = memory.around(center_, frame);
  const double r = memory[center_].r.norm();
  Eigen::VectorXd changes = Eigen::VectorXd::Zero(frame.axes());
  if (!(r > 0.0)) return changes;
  Eigen::VectorXd least = Eigen::VectorXd::Constant(frame.axes(), kInfinity);
  for (Eigen::Index row = 0; row < around.Z.rows(); ++row) {
    Eigen::Index axis;
    const double y = around.Z.row(row).cwiseAbs().maxCoeff(&axis);
    if (y > 0.0) least[axis] = std::min(least[axis], around.D.row(row).norm() / (r * y));
  }
  for (Eigen::Index k = 0; k < least.size(); ++k)
    if (least[k] < kInfinity) changes[k] = least[k];
  return changes;
}

bool TrustBox::has_moved_along(int axis, const NaturalFrame& frame) const {
  // Smallest coordinate along an axis with which a sample gives information about it.
  constexpr double kTells = 0.05;
  const ResidualSamples around = memory.around(center_, frame);
  return around.Z.rows() > 0 && around.Z.col(axis).cwiseAbs().maxCoeff() > kTells;
}

Wanted TrustBox::natural_step(const ResidualKriging& m,
                              const NaturalFrame& frame,
                              double reach,
                              const PendingPoints<Wanted>& wanted) const {
  const Eigen::VectorXd z = least_expected(m, frame.T, reach);
  Wanted step = at(c() + frame.T * z, Wanted::Kind::step);
  step.predicted = m.expected(z);
  // The lowest of many noisy values is too low by chance, so a step is compared with the model's
  // value at the center.
  const double here = std::max(f(), m.expected(Eigen::VectorXd::Zero(z.size())));
  const bool is_promising = step.predicted < (1.0 - kFlat) * here;
  if (is_pointless(step.u, kSame * step.length, wanted) || !is_promising) step.length = 0.0;
  return step;
}

bool TrustBox::promises(const Wanted& step) const { return step.predicted < (1.0 - kFlat) * f(); }

std::optional<Wanted> TrustBox::explore(const PendingPoints<Wanted>& wanted) {
  Eigen::VectorXd around = c();
  double best = f(), reach = radius;
  for (const Wanted& w : wanted) {
    if (w.kind != Wanted::Kind::step || w.predicted >= best) continue;
    best = w.predicted;
    around = w.u;
    reach = std::max(w.length, kShort * radius);
  }
  constexpr int kTries = 100;
  for (int k = 0; k < kTries; ++k) {
    RandomStream numbers(seed_, drawn_++);
    const double size = reach * std::pow(10.0, -numbers.uniform());
    const Eigen::VectorXd u = moved(around, size, numbers);
    if (!is_pointless(u, 1e-3 * size, wanted)) return at(u, Wanted::Kind::probe);
  }
  return std::nullopt;
}

std::optional<Wanted> TrustBox::scatter(const PendingPoints<Wanted>& wanted) {
  constexpr std::array kRadii{2.0, 4.0, 6.0};
  constexpr int kTries = 20;
  for (int k = 0; k < kTries; ++k) {
    const double length = kRadii[drawn_ % kRadii.size()] * radius;
    const Eigen::VectorXd move = length * draw().normalized();
    const Eigen::VectorXd u = region.nearest(c() + scale_.widths().cwiseProduct(move));
    if (!is_pointless(u, kSame * length, wanted)) return at(u, Wanted::Kind::probe);
  }
  return std::nullopt;
}

Eigen::VectorXd TrustBox::moved(const Eigen::VectorXd& u,
                                double reach,
                                RandomStream& numbers) const {
  Eigen::VectorXd next = u;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    next[i] += reach * scale_.widths()[i] * (2.0 * numbers.uniform() - 1.0);
  }
  return region.nearest(next);
}

Eigen::VectorXd TrustBox::moved(const Eigen::VectorXd& u, double reach) {
  RandomStream numbers(seed_, drawn_++);
  return moved(u, reach, numbers);
}

Eigen::VectorXd TrustBox::drawn_near(const Eigen::VectorXd& u, double reach) {
  RandomStream numbers(seed_, drawn_++);
  Eigen::VectorXd next = u;
  for (double& value : next) {
    const double lower = std::max(0.0, value - reach), upper = std::min(1.0, value + reach);
    value = lower + numbers.uniform() * (upper - lower);
  }
  return region.nearest(next);
}

Eigen::VectorXd TrustBox::draw() {
  RandomStream numbers(seed_, drawn_++);
  Eigen::VectorXd drawn(n());
  for (double& number : drawn) number = 2.0 * numbers.uniform() - 1.0;
  return drawn;
}

}  // namespace latsch
