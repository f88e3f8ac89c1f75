// SPDX-License-Identifier: Apache-2.0
// Derivatives of the loads and modes of states on the ground, by (S.2) and (S.3) of tire_slopes.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "models/fe_tire/slopes/tire_slopes.h"
#include "models/fe_tire/slopes/tire_slopes_impl.h"
#include "numerics/sparse/davidson.h"

namespace latsch::fe_tire {
namespace {

/// Relative tolerance of the linear solves: residual norm over norm of the right-hand side.
constexpr double kExactly = 1e-10;

using Touches = std::vector<TreadContact::Touch>;

/// Returns the forces on the tread of a tire with a changed parameter, on flat ground below the
/// wheel. Exactly those points are in contact that touch in the state of the unchanged tire.
/// Otherwise a point that barely touches would lift off within the finite difference.
Touches forces_where(const Touches& touching,
                     const TreadSurface& tread,
                     const TireState& state,
                     const Eigen::VectorXd& x) {
  const Eigen::Matrix3Xd positions = tread.positions(tread.displacements(x));
  Touches touches = touching;
  for (TreadContact::Touch& touch : touches) {
    const TreadSurface::Point& point = tread.points()[touch.point];
    const double stiffness = state.ground.stiffness * point.dA;
    const double distance = tread.at(point, positions).z() + state.pose.height;
    touch.stiffness = stiffness * Eigen::Vector3d::UnitZ() * Eigen::RowVector3d::UnitZ();
    touch.force = -stiffness * distance * Eigen::Vector3d::UnitZ();
  }
  return touches;
}

double vertical(const Touches& touches) {
  double force = 0.0;
  for (const TreadContact::Touch& touch : touches) force += touch.force.z();
  return force;
}

/// Returns phi^T K phi for the ground's stiffness K.
double ground_stiffness(const TreadSurface& tread,
                        const Touches& touches,
                        const Eigen::Matrix3Xd& shape) {
  const Eigen::Matrix3Xd motions = tread.motions(shape);
  double sum = 0.0;
  for (const TreadContact::Touch& touch : touches) {
    const Eigen::Vector3d motion = motions.col(touch.point);
    sum += motion.dot(touch.stiffness * motion);
  }
  return sum;
}

Failure on_friction(double mu) {
  return Failure{fmt::format(
      "slopes: the tire stands with friction of {:.3g}, so the result depends on the load path:  "
      "expected a state on ground without friction, or differences of trials",
      mu)};
}

}  // namespace

std::vector<MovedNumber> TireSlopes::Impl::moved_numbers(OfRing of, double pressure) const {
  const auto elements = [&](const Varied& tire) {
    return of == OfRing::even ? &tire.even() : &*tire.elements;
  };
  std::vector<MovedNumber> numbers;
  for (int k = 0; k < count(); ++k) {
    const Varied &below = varied[k]->below, &above = varied[k]->above;
    numbers.push_back({elements(below),
                       elements(above),
                       pressure_of(k, below.tire, pressure),
                       pressure_of(k, above.tire, pressure),
                       2.0 * variations[k].step,
                       &varied[k]->parts});
  }
  return numbers;
}

std::pair<Eigen::VectorXd, double> TireSlopes::Impl::by_height(Systems& all,
                                                               const TireState& state) const {
  TreadContact contact(all.tread, state.ground);
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  contact.start(state.pose, x, state.anchors);
  // If the wheel is raised, the distance of every touching point from the ground grows by the same
  // amount.
  std::vector<TreadContact::Touch> touches = contact.stuck(x);
  double stiffness = 0.0;
  for (TreadContact::Touch& touch : touches) {
    touch.force = -touch.stiffness.col(2);
    stiffness += touch.stiffness(2, 2);
  }
  Eigen::VectorXd f_h = Eigen::VectorXd::Zero(x.size());
  add_forces(all.tread, touches, f_h);
  return {std::move(f_h), stiffness};
}

namespace {

bool is_same(const TireState& a, const TireState& b) { return a.pose == b.pose && a.u == b.u; }

}  // namespace

TireSlopes::Impl::Tangent& TireSlopes::Impl::tangent_for(Systems& all) {
  const auto found = own_tangents.find(&all);
  if (found != own_tangents.end()) return found->second;
  const auto& pattern = *all.solver.assembly().pattern();
  Tangent made{
      numerics::SymmetricMatrix(pattern),
      numerics::Factorization(pattern, numerics::Precision::refined, all.factor.elimination()),
      std::nullopt};
  return own_tangents.emplace(&all, std::move(made)).first->second;
}

Result<const numerics::Factorization*> TireSlopes::Impl::factor(Systems& all,
                                                                const TireState& state) {
  if (state.ground.mu > 0.0) return on_friction(state.ground.mu);
  if (all.factored && is_same(*all.factored, state)) return &all.factor;
  Tangent& tangent = tangent_for(all);
  if (tangent.of && is_same(*tangent.of, state)) return &tangent.factor;
  tangent.of.reset();
  if (const Status done = base.assemble(all, state, tangent.K); !done) return done.failure();
  if (const Status done = base.factorize(state, tangent.K, tangent.factor); !done)
    return done.failure();
  tangent.of = state;
  return &tangent.factor;
}

/// Computes w of (S.2) while the solver's factorization is near the state, so that no new one is
/// needed.
void TireSlopes::Impl::pass(Systems& all, const TireState& state) {
  if (state.ground.mu > 0.0) return;
  Tangent& tangent = tangent_for(all);
  tangent.of.reset();
  if (!base.assemble(all, state, tangent.K)) return;
  Eigen::VectorXd w = by_height(all, state).first;
  if (all.solver.solve_nearby(tangent.K, kExactly, w)) passed.push_back({state, std::move(w)});
}

Result<Eigen::VectorXd> TireSlopes::Impl::motion_by_height(Systems& all,
                                                           const TireState& state,
                                                           const Eigen::VectorXd& f_h) {
  for (const Passed& before : passed)
    if (is_same(before.state, state)) return before.w;
  const auto factor_of_state = factor(all, state);
  if (!factor_of_state) return factor_of_state.failure();
  Eigen::MatrixXd w = f_h;
  (*factor_of_state)->solve_columns(w, kExactly);
  return Eigen::VectorXd(w.col(0));
}

/// Returns the tread of a tire with a changed parameter. It is built once for all states.
const TreadSurface& TireSlopes::Impl::tread_of(const Varied& tire,
                                               const Systems& all,
                                               bool is_halved) {
  std::unique_ptr<VariedTread>& tread = varied_treads[{&tire, &all}];
  if (!tread) tread = std::make_unique<VariedTread>(tire, all, base, is_halved);
  return tread->surface;
}

void TireSlopes::Impl::add_tread(Systems& all,
                                 const TireState& state,
                                 const TouchChange& change,
                                 Eigen::MatrixXd& sums) {
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  TreadContact contact(all.tread, state.ground);
  contact.start(state.pose, x, state.anchors);
  const auto touching = contact.stuck(x);
  for (int k = 0; k < count(); ++k) {
    for (const double side : {-1.0, 1.0}) {
      const Varied& tire = side < 0.0 ? varied[k]->below : varied[k]->above;
      if (tire.same_shape) continue;
      const TreadSurface& tread = tread_of(tire, all, state.is_halved);
      const auto touches = forces_where(touching, tread, state, x);
      Eigen::VectorXd forces = Eigen::VectorXd::Zero(x.size());
      add_forces(tread, touches, forces);
      sums.col(k) += side / (2.0 * variations[k].step) * change(tread, touches, forces);
    }
  }
}

/// Computes (S.2). The vertical force Fz is the work of -df/dh along w.
Result<TireSlopes::OfState> TireSlopes::of_state(const TireState& state) {
  Impl& impl = *impl_;
  Systems& all = impl.base.systems(state.is_halved, state.window);
  if (state.ground.mu > 0.0) return on_friction(state.ground.mu);
  const auto [f_h, stiffness] = impl.by_height(all, state);
  const auto w = impl.motion_by_height(all, state, f_h);
  if (!w) return w.failure();
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  const double pressure = state.inflated->pressure, multiplicity = all.tread.multiplicity();
  const std::vector<Mode> no_modes;
  RingMotions motions(all.unknowns, impl.base.elements(), x, state.alpha, pressure, no_modes);
  Eigen::MatrixXd sums;
  if (!motions.slopes(*w, impl.moved_numbers(Impl::OfRing::pressed, pressure), sums))
    return beside_state();
  const auto along_w = [&](const TreadSurface&, const Touches& touches, const Eigen::VectorXd& f) {
    return Eigen::VectorXd::Constant(1, w->dot(f) + vertical(touches));
  };
  impl.add_tread(all, state, along_w, sums);
  OfState slopes;
  slopes.force = multiplicity * sums.row(0).transpose();
  slopes.by_height = multiplicity * (w->dot(f_h) - stiffness);
  return slopes;
}

/// Computes (S.3). For all parameters, g dx/dp is -z (df/dp + df/dh dh/dp).
Result<Eigen::MatrixXd> TireSlopes::of_modes(const TireState& state,
                                             const std::vector<Mode>& modes,
                                             const Eigen::VectorXd& height) {
  if (state.ground.mu > 0.0) return on_friction(state.ground.mu);
  const auto sharp = impl_->sharpened_modes(state, modes);
  if (!sharp) return sharp.failure();
  Eigen::MatrixXd slopes(std::ssize(modes), impl_->count());
  for (std::size_t first = 0; first < modes.size(); first += ElementMotion::kMost) {
    const auto last = std::min<std::size_t>(modes.size(), first + ElementMotion::kMost);
    const std::vector<Mode> some(sharp->begin() + static_cast<std::ptrdiff_t>(first),
                                 sharp->begin() + static_cast<std::ptrdiff_t>(last));
    const auto found = impl_->of_some_modes(state, some, height);
    if (!found) return found;
    slopes.middleRows(static_cast<Eigen::Index>(first), found->rows()) = *found;
  }
  return slopes;
}

namespace {

/// Computes more accurate shapes of those modes that the unknowns of this assembly (even or odd)
/// represent. If the iteration finds another mode, the given one is kept.
Status sharpen(const RingAssembly& assembly,
               const numerics::SymmetricMatrix& tangent,
               const numerics::SymmetricMatrix& M,
               const numerics::Factorization& factor,
               std::optional<numerics::Davidson> search,
               std::vector<Mode>& modes) {
  constexpr double kHalf = 0.5, kSame = 0.99;
  const RingUnknowns& unknowns = assembly.unknowns();
  const double scale = std::sqrt(unknowns.multiplicity());
  std::vector<Mode*> own;
  Eigen::MatrixXd vectors(unknowns.size(), std::ssize(modes));
  for (Mode& mode : modes) {
    const Eigen::VectorXd phi = unknowns.compress(mode.shape);
    if ((unknowns.expand(phi) - mode.shape).norm() > kHalf * mode.shape.norm()) continue;
    vectors.col(std::ssize(own)) = scale * phi;
    own.push_back(&mode);
  }
  if (own.empty()) return {};
  vectors.conservativeResize(Eigen::NoChange, std::ssize(own));
  const bool goes_on = search && search->count() >= vectors.cols();
  if (!goes_on) {
    const auto solve = [&](Eigen::Ref<Eigen::MatrixXd> X) { factor.solve_roughly(X); };
    search.emplace(tangent, M, solve, vectors);
  }
  const auto pairs =
      goes_on ? search->sharpen(vectors.cols(), kSharp) : search->find(vectors.cols(), kSharp);
  if (!pairs.converged) return Failure{"slopes: shapes of modes do not converge"};
  const Eigen::MatrixXd& sharp = pairs.vectors;
  Eigen::MatrixXd M_sharp(sharp.rows(), sharp.cols());
  M.multiply(sharp, M_sharp);
  const Eigen::MatrixXd overlaps = (vectors.transpose() * M_sharp).cwiseAbs();
  for (std::size_t i = 0; i < own.size(); ++i) {
    Eigen::Index same = 0;
    if (overlaps.row(static_cast<Eigen::Index>(i)).maxCoeff(&same) < kSame) continue;
    own[i]->shape = unknowns.expand(sharp.col(same)) / scale;
  }
  return {};
}

}  // namespace

Result<std::vector<Mode>> TireSlopes::Impl::sharpened_modes(const TireState& state,
                                                            std::vector<Mode> modes) {
  if (base.settings.mode_tolerance <= kSharp) return modes;
  Systems& all = base.systems(state.is_halved, state.window);
  if (const Status done = base.factorize(all, state); !done) return done.failure();
  all.find_masses(base.elements());
  if (const Status done = sharpen(all.solver.assembly(),
                                  all.tangent,
                                  *all.mass,
                                  all.factor,
                                  std::exchange(all.search, std::nullopt),
                                  modes);
      !done)
    return done.failure();
  if (!all.odd) return modes;
  if (const Status done = sharpen(*all.odd,
                                  *all.odd_tangent,
                                  *all.odd_mass,
                                  *all.odd_factor,
                                  std::exchange(all.odd_search, std::nullopt),
                                  modes);
      !done)
    return done.failure();
  return modes;
}

Result<Eigen::MatrixXd> TireSlopes::Impl::of_some_modes(const TireState& state,
                                                        const std::vector<Mode>& modes,
                                                        const Eigen::VectorXd& height) {
  Systems& all = base.systems(state.is_halved, state.window);
  const auto factor_of_state = factor(all, state);
  if (!factor_of_state) return factor_of_state.failure();
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  const double pressure = state.inflated->pressure, multiplicity = all.tread.multiplicity();
  RingMotions motions(all.unknowns, base.elements(), x, state.alpha, pressure, modes);
  Eigen::MatrixXd z, changes;
  if (!motions.curvatures(z)) return beside_state();
  (*factor_of_state)->solve_columns(z, kExactly);
  z = -z;
  if (!motions.slopes(z, moved_numbers(Impl::OfRing::pressed, pressure), changes))
    return beside_state();
  const Eigen::VectorXd f_h = by_height(all, state).first;
  changes += (z.transpose() * f_h) * height.transpose();
  const auto of_tread =
      [&](const TreadSurface& tread, const Touches& touches, const Eigen::VectorXd& f) {
        Eigen::VectorXd sums = z.transpose() * f;
        for (std::size_t i = 0; i < modes.size(); ++i)
          sums[static_cast<Eigen::Index>(i)] += ground_stiffness(tread, touches, modes[i].shape);
        return sums;
      };
  add_tread(all, state, of_tread, changes);
  for (std::size_t i = 0; i < modes.size(); ++i)
    changes.row(static_cast<Eigen::Index>(i)) *= to_hertz_slope(multiplicity, modes[i].frequency);
  return changes;
}

}  // namespace latsch::fe_tire
