// SPDX-License-Identifier: Apache-2.0
#include "optimization/residual_trust_region.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "base/random.h"
#include "optimization/box_least_squares.h"
#include "optimization/option_check.h"
#include "optimization/residual_memory.h"
#include "optimization/variable_scale.h"

namespace latsch {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Of the variance of slopes before anything was known:
constexpr double kUnknown = 0.5;  // a direction to be probed before any step
constexpr double kPoor =
    0.02;  // one to be probed when a step disappoints: no sample within 7 radii

// Of the radius: a probe's length. Shorter ones are nearer to the slope, longer ones rise above
// noise; a third of this or three times it change little.
constexpr double kProbe = 0.03;

constexpr double kGoodGain = 0.5;
constexpr double kBadGain = 0.1;
constexpr double kGrowth = 2.0;      // of the radius over the step, at least, after a good gain
constexpr double kMostGrowth = 4.0;  // at most
constexpr double kShrinkage = 0.7;   // of the radius after a bad gain
constexpr double kMostShrinkage = 0.1;
constexpr double kWidest = 0.5;  // a box as wide as the cube

constexpr double kShort = 0.01;   // of the radius: a step not worth an evaluation in this box
constexpr double kFlat = 1e-6;    // of f: a predicted decrease that is none
constexpr double kSettled = 0.1;  // of the initial radius: below it a flat model is believed
constexpr double kBackOff = 0.5;  // of a step that would end in a failed region
constexpr double kSame = 0.1;     // of a step: nearer to a known point nothing is learned

constexpr int kFailuresToShrink = 2;
constexpr int kFailuresToGiveUp = 4;  // in a row: no more probes beside this center
constexpr int kDisappointments = 3;   // in a row, before noise is looked for
constexpr double kDrowned = 1e4;      // noise as large as the slopes

/// Boxes for further steps while the outcome of the first one is awaited.
constexpr std::array kBoxes{1.0, 0.25, 2.0, 0.5, 0.1, 4.0, 0.03, 0.01};
/// Of the initial radius: how far from the best point restarts begin, one after the other.
constexpr std::array kJumps{0.1, 1.0, 0.03, 0.3};

enum class Kind { start, probe, step };

/// A point whose outcome the method waits for.
struct Wanted {
  Eigen::VectorXd u;
  DesignPoint point;
  Kind kind;
  int center = -1;         // from which it was chosen
  double f_center = 0.0;   // its value
  double length = 0.0;     // |u - center|, largest component in widths of the variables
  double predicted = 0.0;  // value to be expected, of steps
};

Eigen::VectorXd to_vector(const std::vector<double>& u) {
  return Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size()));
}

Eigen::VectorXd in_cube(const Eigen::VectorXd& u) { return u.cwiseMax(0.0).cwiseMin(1.0); }

/// u with every variable moved by up to its `size`.
Eigen::VectorXd moved(const Eigen::VectorXd& u, const Eigen::VectorXd& size, RandomStream& random) {
  Eigen::VectorXd next = u;
  for (Eigen::Index i = 0; i < u.size(); ++i) next[i] += size[i] * (2.0 * random.uniform() - 1.0);
  return in_cube(next);
}

void check(const ResidualTrustRegionOptions& options) {
  const OptionCheck check("residual trust region");
  check.lengths(options.initial_radius, options.step_tolerance, 0.5, "initial radius");
  check.require(options.restarts >= 0, "restarts", options.restarts, "0 or more");
  check.require(options.outstanding >= 1, "outstanding", options.outstanding, "1 or more");
}

}  // namespace

struct ResidualTrustRegion::State {
  DesignSpace space;
  ResidualTrustRegionOptions options;
  ResidualMemory memory;

  Eigen::VectorXd start;  // where the present run begins
  int center = -1;        // the best sample of the run; -1: none succeeded yet
  double radius;
  VariableScale scale;
  int scaled_for = -1;               // the center whose Jacobian the scale learned last
  double noise = 0.0;                // of the model, in its units
  bool is_geometry_doubted = false;  // a step disappointed
  bool has_widened = false;          // the radius, for noise, since the last outcome
  int disappointments = 0;           // in a row
  int failures = 0;                  // in a row
  int restarts = 0;
  std::uint64_t drawn = 0;     // random points so far
  std::vector<Wanted> wanted;  // in the order proposed; empty: converged

  State(const DesignSpace& s, const ResidualTrustRegionOptions& o)
      : space(s),
        options(o),
        start(to_vector(s.to_unit(s.initial()))),
        radius(o.initial_radius),
        scale(s.size()) {
    wanted.push_back(at(start, Kind::start));
    fill();
  }

  int n() const { return space.size(); }
  const Eigen::VectorXd& c() const { return center >= 0 ? memory[center].u : start; }
  double f() const { return center >= 0 ? memory[center].f : kInfinity; }

  /// Half widths of the box.
  Eigen::VectorXd h() const { return radius * scale.widths(); }

  RandomStream random() { return RandomStream(options.seed, drawn++); }

  Wanted at(const Eigen::VectorXd& u, Kind kind) const {
    const Eigen::VectorXd inside = in_cube(u);
    return {inside,
            space.from_unit({inside.begin(), inside.end()}),
            kind,
            center,
            f(),
            scale.length(inside - c())};
  }

  /// Whether to ask there would be to ask again, or for a failure.
  bool is_pointless(const Eigen::VectorXd& u, double distance) const {
    const auto is_near = [&](const Wanted& w) { return scale.length(w.u - u) < distance; };
    return memory.knows(u, distance * scale.widths()) || memory.has_failed_near(u) ||
           std::any_of(wanted.begin(), wanted.end(), is_near);
  }

  /// Of what is known and of what is under way.
  SlopeVariance geometry() const {
    std::vector<Eigen::VectorXd> places;
    if (center >= 0) {
      for (const int i : memory.near(center, h())) places.push_back(memory[i].u - c());
    }
    for (const Wanted& w : wanted) {
      if (w.u != c()) places.push_back(w.u - c());
    }
    Eigen::MatrixXd Z(std::ssize(places), n());
    for (Eigen::Index i = 0; i < Z.rows(); ++i) Z.row(i) = places[i].cwiseQuotient(h());
    return slope_variance(Z);
  }

  ResidualModel model() {
    if (std::exchange(scaled_for, center) != center) {
      const ResidualModel here(memory.around(center, h()), noise);
      const Eigen::MatrixXd J = here.jacobian(Eigen::VectorXd::Zero(n()));  // dr/dz
      scale.learn(J * h().cwiseInverse().asDiagonal());
    }
    const ResidualSamples samples = memory.around(center, h());
    if (disappointments >= kDisappointments || noise > 0.0) noise = likeliest_noise(samples);
    return ResidualModel(samples, noise);
  }

  /// Along a direction, to the side with more room, as long as it can be.
  Wanted probe(Eigen::VectorXd direction) const {
    Eigen::Index largest;
    direction.cwiseAbs().maxCoeff(&largest);
    if (direction[largest] < 0.0) direction = -direction;
    const auto end = [&](double length) {
      return in_cube(c() + length * scale.widths().cwiseProduct(direction));
    };
    double length = kProbe * radius;
    if (scale.norm(end(-length) - c()) > 1.01 * scale.norm(end(length) - c())) {
      direction = -direction;
    }
    constexpr int kShortenings = 20;
    for (int k = 0; k < kShortenings; ++k, length *= 0.2) {
      for (const double signed_length : {length, -length}) {
        const Eigen::VectorXd u = end(signed_length);
        const bool has_room = scale.norm(u - c()) > 0.5 * length;
        if (has_room && !is_pointless(u, 1e-3 * length)) return at(u, Kind::probe);
      }
    }
    return at(end(kProbe * radius), Kind::probe);
  }

  /// The step in a box of half width `box` radii; with a length of 0 where it is not worth an
  /// evaluation.
  Wanted step(const ResidualModel& m, double box) const {
    const Eigen::VectorXd lower = (-c()).cwiseQuotient(h()).cwiseMax(-box);
    const Eigen::VectorXd upper = (1.0 - c().array()).matrix().cwiseQuotient(h()).cwiseMin(box);
    Eigen::VectorXd z = minimize_in_box(m, lower, upper);
    while (memory.has_failed_near(c() + h().cwiseProduct(z))) z *= kBackOff;
    Wanted step = at(c() + h().cwiseProduct(z), Kind::step);
    step.predicted = m.expected(z);
    if (step.length < kShort * radius || is_pointless(step.u, kSame * step.length) ||
        !promises(step)) {
      step.length = 0.0;
    }
    return step;
  }

  bool promises(const Wanted& step) const { return step.predicted < (1.0 - kFlat) * f(); }

  /// Near the point predicted to be the best, at a distance of any magnitude.
  std::optional<Wanted> explore() {
    Eigen::VectorXd around = c();
    double best = f(), reach = radius;
    for (const Wanted& w : wanted) {
      if (w.kind != Kind::step || w.predicted >= best) continue;
      best = w.predicted;
      around = w.u;
      reach = std::max(w.length, kShort * radius);
    }
    constexpr int kTries = 100;
    for (int k = 0; k < kTries; ++k) {
      RandomStream numbers = random();
      const double size = reach * std::pow(10.0, -numbers.uniform());
      const Eigen::VectorXd u = moved(around, size * scale.widths(), numbers);
      if (!is_pointless(u, 1e-3 * size)) return at(u, Kind::probe);
    }
    return std::nullopt;
  }

  bool is_step_awaited() const {
    return std::any_of(wanted.begin(), wanted.end(), [&](const Wanted& w) {
      return w.kind == Kind::step && w.center == center;
    });
  }

  /// The next point, after those already wanted; nullopt at the end.
  std::optional<Wanted> next() {
    while (radius >= options.step_tolerance && !is_hopeless()) {
      const bool has_slopes = center >= 0 && memory[center].J.size() > 0;
      const SlopeVariance g = geometry();
      const double worst = has_slopes ? 0.0 : g.share[n() - 1];
      if (worst > kUnknown && (center < 0 || failures < kFailuresToGiveUp)) {
        return probe(g.directions.col(n() - 1));
      }
      if (center < 0) return explore();
      if (std::exchange(is_geometry_doubted, false) && worst > kPoor) {
        return probe(g.directions.col(n() - 1));
      }
      const ResidualModel m = model();
      if (noise >= kDrowned && !has_widened && radius < options.initial_radius) {
        has_widened = true;
        radius *= 2.0;
        continue;
      }
      if (is_step_awaited()) return another_step(m);
      const Wanted first = step(m, kBoxes.front());
      if (first.length > 0.0) return first;
      if (worst > kPoor && failures < kFailuresToGiveUp) return probe(g.directions.col(n() - 1));
      if (!promises(first) && radius < kSettled * options.initial_radius) break;
      radius *= 0.1;
    }
    if (is_hopeless()) return std::nullopt;
    return wanted.empty() ? restart() : explore();
  }

  std::optional<Wanted> another_step(const ResidualModel& m) {
    for (std::size_t k = 1; k < kBoxes.size(); ++k) {
      Wanted other = step(m, kBoxes[k]);
      if (other.length > 0.0) return other;
    }
    return explore();
  }

  std::optional<Wanted> restart() {
    if (restarts >= options.restarts || memory.best() < 0) return std::nullopt;
    const double jump = kJumps[restarts++ % kJumps.size()] * options.initial_radius;
    RandomStream numbers = random();
    start = moved(memory[memory.best()].u, jump * scale.widths(), numbers);
    center = -1;
    radius = std::max(jump, options.step_tolerance);
    return at(start, Kind::start);
  }

  void fill() {
    while (std::ssize(wanted) < options.outstanding) {
      auto next_point = next();
      if (!next_point) return;
      wanted.push_back(std::move(*next_point));
    }
  }

  /// Nothing succeeded in many places.
  bool is_hopeless() const { return center < 0 && failures > 20 * (n() + 1); }

  /// Elsewhere, farther and farther away.
  void start_again(const Eigen::VectorXd& failed) {
    if (is_hopeless()) return;
    RandomStream numbers = random();
    const double reach = options.initial_radius * (1.0 + failures / n());
    start = moved(failed, reach * scale.widths(), numbers);
    wanted.push_back(at(start, Kind::start));
  }

  void take_failure(const Wanted& tried) {
    memory.add_failure(tried.u);
    ++failures;
    if (tried.kind == Kind::start && center < 0) start_again(tried.u);
    if (failures >= kFailuresToGiveUp) {
      radius *= 0.1;
    } else if (tried.kind == Kind::step && failures >= kFailuresToShrink) {
      radius *= 0.5;
    }
  }

  void take(const Wanted& tried, ResidualSample sample) {
    failures = 0;
    const double gain = (tried.f_center - sample.f) / (tried.f_center - tried.predicted);
    const bool is_best = sample.f < f();
    const bool is_of_center = tried.center == center;
    memory.add(std::move(sample));
    if (is_best) center = memory.size() - 1;
    if (tried.kind != Kind::step) return;
    if (gain > kGoodGain) disappointments = 0;
    if (is_best && gain > kGoodGain) {
      radius = std::clamp(radius, kGrowth * tried.length, kMostGrowth * tried.length);
      radius = std::min(radius, kWidest);
    } else if (gain < kBadGain && is_of_center && tried.length <= 1.01 * radius) {
      radius *= std::clamp(tried.length / radius, kMostShrinkage, kShrinkage);
      is_geometry_doubted = true;
      ++disappointments;
    }
  }

  void observe(const DesignPoint& point, const std::optional<ResidualSample>& sample) {
    const auto found = std::find_if(
        wanted.begin(), wanted.end(), [&](const Wanted& w) { return w.point == point; });
    const Wanted tried =
        found != wanted.end() ? *found : at(to_vector(space.to_unit(point)), Kind::probe);
    if (found != wanted.end()) wanted.erase(found);
    has_widened = false;
    const double limit = center >= 0 ? memory.explosion(center, h()) : kInfinity;
    if (sample && sample->f < limit) {
      take(tried, {tried.u, sample->r, sample->J, sample->f});
    } else {
      take_failure(tried);
    }
    fill();
  }

  /// dr/du = dr/dx dx/du
  Eigen::MatrixXd slopes(const DesignPoint& point, const Score& score) const {
    if (score.jacobian.empty()) return {};
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto m = static_cast<Eigen::Index>(score.residuals.size());
    if (std::ssize(score.jacobian) != m * n()) return {};
    const Eigen::MatrixXd J = Eigen::Map<const Rows>(score.jacobian.data(), m, n());
    if (!J.allFinite()) return {};
    return J * to_vector(space.unit_slopes(point)).asDiagonal();
  }

  std::optional<ResidualSample> sample(const DesignPoint& point,
                                       const Result<Score>& outcome) const {
    if (!outcome) return std::nullopt;
    if (outcome->residuals.empty()) {
      throw InputError(
          "residual trust region: the target function gives no residuals; use another method, "
          "such as gss");
    }
    const Eigen::VectorXd r = to_vector(outcome->residuals);
    const bool is_odd = memory.size() > 0 && r.size() != memory[0].r.size();
    if (is_odd || !std::isfinite(r.squaredNorm())) return std::nullopt;
    return ResidualSample{
        to_vector(space.to_unit(point)), r, slopes(point, *outcome), r.squaredNorm()};
  }

  /// The outcome as the model expects it.
  std::optional<ResidualSample> expected(const DesignPoint& point) const {
    if (center < 0) return std::nullopt;
    const Eigen::VectorXd u = to_vector(space.to_unit(point));
    const ResidualModel m(memory.around(center, h()), noise);
    const Eigen::VectorXd r = m.residuals((u - c()).cwiseQuotient(h()));
    return ResidualSample{u, r, {}, r.squaredNorm()};
  }
};

ResidualTrustRegion::ResidualTrustRegion(const DesignSpace& space,
                                         const ResidualTrustRegionOptions& options) {
  check(options);
  state_ = std::make_unique<State>(space, options);
}

ResidualTrustRegion::~ResidualTrustRegion() = default;

std::vector<DesignPoint> ResidualTrustRegion::propose(int count) const {
  assert(count >= 1);
  std::vector<DesignPoint> plan;
  const auto take = [&](const std::vector<Wanted>& wanted) {
    for (const Wanted& w : wanted) {
      const bool is_named = std::find(plan.begin(), plan.end(), w.point) != plan.end();
      if (std::ssize(plan) < count && !is_named) plan.push_back(w.point);
    }
  };
  take(state_->wanted);
  if (plan.empty() || std::ssize(plan) == count) return plan;
  State future = *state_;
  if (future.center < 0) {  // nothing to expect yet: the geometry will be wanted anyway
    future.options.outstanding = count;
    future.fill();
    take(future.wanted);
  }
  while (std::ssize(plan) < count && future.center >= 0 && !future.wanted.empty()) {
    const DesignPoint first = future.wanted.front().point;
    future.observe(first, future.expected(first));
    take(future.wanted);
  }
  return plan;
}

void ResidualTrustRegion::observe(const DesignPoint& point, const Result<Score>& outcome) {
  state_->observe(point, state_->sample(point, outcome));
}

bool ResidualTrustRegion::converged() const { return state_->wanted.empty(); }

}  // namespace latsch
