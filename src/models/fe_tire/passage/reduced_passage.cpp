// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/reduced_passage.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <list>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>

#include "models/fe_tire/passage/halved_step.h"
#include "models/fe_tire/passage/transient_history.h"
#include "models/fe_tire/passage/tread_in_time.h"
#include "numerics/sparse/front_algebra.h"

namespace latsch::fe_tire {
namespace {

constexpr int kMostOfReduced = 12;
/// Least residual of the first contact of a step, relative to the load: its places are not yet
/// those to which it moves the points.
constexpr double kEnoughAtFirst = 1e-4;
constexpr std::size_t kMostWorkspaces = 8;  // one takes some 30 MB
/// Change of the spin in an iteration, relative, at which it has settled.
constexpr double kReducedSpinSettled = 2e-5;
/// Change of the ground's forces by one iteration, relative to the load, at which they have
/// settled. It is needed where a point changes between stick and slide in every iteration: the
/// residual at the places of the iteration before then never becomes small, although the forces
/// hardly change.
constexpr double kReducedForcesSettled = 1e-4;

/// Matrices of a reduced tire for steps of one length.
struct StepMatrices {
  BossakStep rule;
  Eigen::PartialPivLU<Eigen::MatrixXd> A;  // a + Omega b G + K
  Eigen::MatrixXd from_tread;              // A^-1 Phi' [shapes x 3 nodes]
  Eigen::MatrixXd F;                       // (V.10)
  Eigen::MatrixXd carry;                   // exp(-h Omega D)
  Eigen::VectorXd by_spin_rate;            // motion of the shapes by Omega'
  double moment_by_spin_rate;              // N m s^2, of the inertia about the spin axis

  StepMatrices(const ReducedTire& tire, double h, double rho) : rule(h, rho) {
    Eigen::MatrixXd K = tire.K;
    for (const RelaxingStiffness& part : tire.parts)
      for (const PronyTerm& term : part.terms) K += fresh_share(term, h) * part.K;
    K += rule.of_damping() * tire.of.spin * tire.G;
    K.diagonal().array() += rule.of_mass();
    A.compute(K);
    from_tread = A.solve(tire.at_tread.transpose());
    F = tire.rest + tire.at_tread * from_tread;
    carry = Eigen::MatrixXd(-h * tire.of.spin * tire.D).exp();
    by_spin_rate = -A.solve(tire.spin_rate.on_shapes.col(0));
    const auto sums = tire.by_q * by_spin_rate + rule.of_damping() * tire.by_rate * by_spin_rate +
                      rule.of_mass() * tire.by_acceleration * by_spin_rate;
    moment_by_spin_rate = tire.spin_rate.sums(4, 0) + Eigen::VectorXd(sums)[4];
  }
};

}  // namespace

struct ReducedPassage::Impl {
  /// Memory of the steps of one length.
  struct Workspace {
    std::shared_ptr<const ReducedTire> tire;
    StepMatrices matrices;
    TreadInTime ground;

    Workspace(std::shared_ptr<const ReducedTire> of, double h, double rho)
        : tire(std::move(of)), matrices(*tire, h, rho), ground(*tire->tread, *tire->lines) {
      ground.set(matrices.F.cast<float>());
    }
  };
  /// The part of a step that does not depend on the ground's forces at its end.
  struct Known {
    Eigen::VectorXd b;                 // forces on the shapes
    Eigen::Vector<double, 6> inertia;  // sums that do not depend on the shapes
  };

  RollingTransient& full;
  RollingTransientSettings settings = {};
  ReductionSettings reduction = {};
  ReducedState now = {};
  std::list<Workspace> workspaces = {};  // the last used first

  explicit Impl(RollingTransient& of) : full(of) {}
  Workspace& workspace(double h);
  Status reduce();
  Eigen::VectorXd remembered(const StepMatrices& matrices) const;
  Known known(const Eigen::VectorXd& remembered,
              const WheelMoment& to,
              double spin,
              double spin_rate) const;
  Eigen::Vector<double, 6> inertia(const StepMatrices& matrices,
                                   const Known& given,
                                   const BossakStep::Motion& q) const;
  Result<TransientForces> step(const WheelMoment& to, double h);
  void accept(const StepMatrices& matrices, const BossakStep::Motion& q);
};

/// Returns the memory of steps of this length, s, of the present tire. Tires may take turns.
ReducedPassage::Impl::Workspace& ReducedPassage::Impl::workspace(double h) {
  const auto known = std::ranges::find_if(workspaces, [&](const Workspace& of) {
    return of.tire == now.tire && of.matrices.rule.h == h;
  });
  if (known != workspaces.end()) {
    workspaces.splice(workspaces.begin(), workspaces, known);
  } else {
    if (workspaces.size() >= kMostWorkspaces) workspaces.pop_back();
    workspaces.emplace_front(now.tire, h, settings.rho);
  }
  return workspaces.front();
}

/// Returns the forces on the shapes that follow from the motion before the step.
Eigen::VectorXd ReducedPassage::Impl::remembered(const StepMatrices& matrices) const {
  const ReducedTire& tire = *now.tire;
  const BossakStep& rule = matrices.rule;
  const BossakStep::Motion& q = now.q;
  // Motion at the end of the step if the shapes do not move: x' = 0 in rule.at().
  const BossakStep::Motion still = rule.at(q, Eigen::VectorXd::Zero(q.x.size()));
  Eigen::VectorXd b = -rule.mean_acceleration(q, still) - tire.of.spin * (tire.G * still.v);
  const Eigen::VectorXd carried = matrices.carry * q.x;
  for (std::size_t p = 0; p < tire.parts.size(); ++p) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(q.x.size());
    for (std::size_t k = 0; k < tire.parts[p].terms.size(); ++k) {
      const PronyTerm& term = tire.parts[p].terms[k];
      y += std::exp(-rule.h / term.tau) * (matrices.carry * now.y[p][k]) -
           fresh_share(term, rule.h) * carried;
    }
    b -= tire.parts[p].K * y;
  }
  return b;
}

/// Adds what a motion of the wheel causes.
ReducedPassage::Impl::Known ReducedPassage::Impl::known(const Eigen::VectorXd& remembered,
                                                        const WheelMoment& to,
                                                        double spin,
                                                        double spin_rate) const {
  const ReducedTire& tire = *now.tire;
  Known given{remembered, tire.steady};
  const double faster = spin * spin - tire.of.spin * tire.of.spin, turns = spin / tire.of.spin;
  const auto add = [&](const ReducedTire::Inertia& by, const Eigen::VectorXd& change) {
    given.b -= by.on_shapes * change;
    given.inertia += by.sums * change;
  };
  add(tire.spin, Eigen::VectorXd::Constant(1, faster));
  add(tire.spin_rate, Eigen::VectorXd::Constant(1, spin_rate));
  add(tire.acceleration, to.acceleration);
  add(tire.turning, turns * to.turning);
  add(tire.turning_rate, to.turning_rate);
  return given;
}

/// Returns the sums of the tire's inertia.
Eigen::Vector<double, 6> ReducedPassage::Impl::inertia(const StepMatrices& matrices,
                                                       const Known& given,
                                                       const BossakStep::Motion& q) const {
  const ReducedTire& tire = *now.tire;
  return given.inertia + tire.by_q * q.x + tire.by_rate * q.v +
         tire.by_acceleration * matrices.rule.mean_acceleration(now.q, q);
}

/// Takes the motion at the end of a step.
void ReducedPassage::Impl::accept(const StepMatrices& matrices, const BossakStep::Motion& q) {
  const Eigen::VectorXd change = q.x - matrices.carry * now.q.x;
  const double h = matrices.rule.h;
  for (std::size_t p = 0; p < now.y.size(); ++p)
    for (std::size_t k = 0; k < now.y[p].size(); ++k) {
      const PronyTerm& term = now.tire->parts[p].terms[k];
      now.y[p][k] =
          std::exp(-h / term.tau) * (matrices.carry * now.y[p][k]) + fresh_share(term, h) * change;
    }
  now.q = q;
}

/// Finds the contact on the tread of (V.10), about one guess of the ground's forces after the
/// other.
Result<TransientForces> ReducedPassage::Impl::step(const WheelMoment& to, double h) {
  const ReducedTire& tire = *now.tire;
  auto& [of_tire, matrices, patch] = workspace(h);
  const BossakStep& rule = matrices.rule;
  RollingCase of = case_of(to);
  double spin_rate = to.wheel ? now.spin_rate : (of.spin - now.spin) / h;
  const auto ground = to.ground ? to.ground->below(to.place) : nullptr;
  const PassingMoment moment{*now.past, h, ground.get(), to.place};
  GripState states = now.grip;
  Eigen::VectorXd c = now.c;
  TransientForces work;
  double spin_error = 0.0, moved = 0.0;
  patch.begin();
  const Eigen::VectorXd past = remembered(matrices);
  const auto nodes = static_cast<int>(tire.at_tread.rows());
  for (work.iterations = 1; work.iterations <= kMostOfReduced; ++work.iterations) {
    if (to.wheel) of.spin = now.spin + 0.5 * h * (now.spin_rate + spin_rate);
    const Known given = known(past, to, of.spin, spin_rate);
    const Eigen::VectorXd free = matrices.A.solve(given.b);
    const Eigen::VectorXd more = c - tire.c;
    Eigen::VectorXd w(nodes);
    numerics::multiply(nodes, 1, nodes, matrices.F.data(), nodes, more.data(), nodes, w.data());
    w += tire.at_tread * free;
    const Eigen::Matrix3Xd u = tire.u + w.reshaped(3, tire.u.cols());
    // Places of points on the ground are those at u, so what is found is a start, and it is settled
    // if it holds at the places to which it moves them.
    const int solved = work.passes;
    const bool is_first = work.iterations == 1;
    const double enough = is_first ? std::max(kEnoughAtFirst, settings.enough) : settings.enough;
    auto found = patch.solve(
        of, u, c, now.load, enough, states, work.passes, moment, is_first ? 0.0 : settings.enough);
    if (!found) return found.failure();
    of.height = found->of.height;
    const BossakStep::Motion q = rule.at(now.q, free + matrices.from_tread * (found->c - tire.c));
    const Eigen::Vector<double, 6> sums = inertia(matrices, given, q);
    moved = (found->c - c).norm() / now.load;
    c = std::move(found->c);
    spin_error = 0.0;
    if (to.wheel) {
      const double asked = to.wheel->sum(of.spin, -found->forces.drive - sums[4]);
      const double change = (asked - to.wheel->inertia * spin_rate) /
                            (to.wheel->inertia + matrices.moment_by_spin_rate);
      spin_rate += change;
      spin_error = std::abs(0.5 * h * change / of.spin);
    }
    const bool is_settled = !is_first && (work.passes == solved || moved < kReducedForcesSettled);
    if (!is_settled || spin_error > kReducedSpinSettled) continue;
    if (const Status within = check_reach(found->patch, tire.reach, full.touching()); !within)
      return within.failure();
    if (const Status rolls = check_spin(of.spin, now.first_spin); !rolls) return rolls.failure();
    TransientForces reached = on_hub(of, found->forces, sums.head<3>(), sums.tail<3>());
    reached.spin = of.spin;
    reached.spin_rate = spin_rate;
    reached.iterations = work.iterations;
    reached.passes = work.passes;
    reached.patch = std::move(found->patch);
    accept(matrices, q);
    now.c = std::move(c);
    now.grip = std::move(states);
    now.past->add(std::move(found->instant), h);
    now.spin = of.spin;
    now.spin_rate = spin_rate;
    now.wheel = to;
    now.wheel.of.height = of.height;
    now.wheel.ground = nullptr;  // it may not outlive this call
    return reached;
  }
  return Failure{
      fmt::format("a step of {:.3g} ms of the reduced tire does not settle in {} iterations; the "
                  "relative change "
                  "of the spin is {:.3g}, accepted {:.3g}, that of the ground's forces {:.3g}, "
                  "accepted {:.3g}",
                  1e3 * h,
                  kMostOfReduced,
                  spin_error,
                  kReducedSpinSettled,
                  moved,
                  kReducedForcesSettled)};
}

ReducedPassage::ReducedPassage(RollingTransient& full) : impl_(std::make_unique<Impl>(full)) {}
ReducedPassage::ReducedPassage(ReducedPassage&&) noexcept = default;
ReducedPassage::~ReducedPassage() = default;

Result<TransientForces> ReducedPassage::begin(const RollingState& steady,
                                              const RollingTransientSettings& settings,
                                              const ReductionSettings& reduction) {
  auto begun = impl_->full.start(steady, settings);
  if (!begun) return begun;
  Impl& of = *impl_;
  of.settings = settings;
  of.reduction = reduction;
  of.now = {};
  const auto from = std::make_shared<const TransientState>(of.full.take());
  of.now.grip = from->grip;
  of.now.past = from->past;
  of.now.spin = from->spin;
  of.now.load = from->load;
  of.now.first_spin = from->first_spin;
  of.now.wheel = from->wheel;
  of.now.unreduced = from;
  return begun;
}

/// Makes the reduced tire of the present state, unless it is made.
Status ReducedPassage::Impl::reduce() {
  if (!now.unreduced) return {};
  full.resume(*now.unreduced);
  auto tire = full.reduced(reduction);
  full.take();
  if (!tire) return tire.failure();
  now.tire = std::make_shared<const ReducedTire>(*std::move(tire));
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(now.tire->shapes());
  now.q = {still, still, still};
  now.y.clear();
  for (const RelaxingStiffness& part : now.tire->parts)
    now.y.emplace_back(part.terms.size(), still);
  now.c = now.tire->c;
  now.unreduced.reset();
  return {};
}

Result<TransientForces> ReducedPassage::start(const RollingState& steady,
                                              const RollingTransientSettings& settings,
                                              const ReductionSettings& reduction) {
  auto begun = begin(steady, settings, reduction);
  if (!begun) return begun;
  if (const Status reduced = impl_->reduce(); !reduced) return reduced.failure();
  return begun;
}

Result<TransientForces> ReducedPassage::advance(const WheelMoment& to) {
  return advance(to, impl_->settings.step);
}

Result<TransientForces> ReducedPassage::advance(const WheelMoment& to, double step) {
  if (const Status reduced = impl_->reduce(); !reduced) return reduced.failure();
  auto whole = impl_->step(to, step);
  if (whole) return whole;
  const ReducedState before = impl_->now;
  const auto part = [&](const WheelMoment& wheel, double h) { return impl_->step(wheel, h); };
  auto end = in_halves(part, impl_->now.wheel, to, step);
  if (!end) impl_->now = before;
  return end;
}

const ReducedState& ReducedPassage::state() const { return impl_->now; }
ReducedState ReducedPassage::take() { return std::exchange(impl_->now, {}); }
void ReducedPassage::resume(ReducedState state) { impl_->now = std::move(state); }

}  // namespace latsch::fe_tire
