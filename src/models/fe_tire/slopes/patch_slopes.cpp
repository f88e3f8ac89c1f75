// SPDX-License-Identifier: Apache-2.0
// Derivatives of the contact patch. For each parameter the state is moved by (S.1) of
// tire_slopes.h, and the patch is measured again.
#include "models/fe_tire/slopes/tire_slopes.h"
#include "models/fe_tire/slopes/tire_slopes_impl.h"

namespace latsch::fe_tire {
namespace {

constexpr double kExactly = 1e-10;  // relative tolerance of linear solves

}  // namespace

Result<Eigen::MatrixXd> TireSlopes::Impl::moved_state(Systems& all,
                                                      const TireState& state,
                                                      const Eigen::VectorXd& height) {
  const auto of_state = factor(all, state);
  if (!of_state) return of_state.failure();
  const auto numbers = moved_numbers(OfRing::pressed, state.inflated->pressure);
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  Eigen::MatrixXd moved(x.size(), count());
  for (int k = 0; k < count(); ++k) {
    const MovedNumber& number = numbers[static_cast<std::size_t>(k)];
    const auto forces = [&](const RingElements& elements, double pressure, Eigen::VectorXd& f) {
      AssembledState at{x, state.alpha};
      return all.solver.assembly().assemble(elements, at, pressure, f, nullptr, nullptr);
    };
    Eigen::VectorXd below, above;
    if (!forces(*number.below, number.pressure_below, below) ||
        !forces(*number.above, number.pressure_above, above))
      return beside_state();
    moved.col(k) = (below - above) / number.way;
  }
  const auto keep_forces = [](const TreadSurface&,
                              const std::vector<TreadContact::Touch>&,
                              const Eigen::VectorXd& f) { return Eigen::VectorXd(-f); };
  add_tread(all, state, keep_forces, moved);
  moved -= by_height(all, state).first * height.transpose();
  (*of_state)->solve_columns(moved, kExactly);
  return moved;
}

ContactPatch TireSlopes::Impl::patch_beside(Systems& all,
                                            const TireState& state,
                                            const Eigen::VectorXd& x,
                                            double height,
                                            int k,
                                            double side) {
  const Varied& tire = side < 0.0 ? varied[k]->below : varied[k]->above;
  const TreadSurface& tread = tire.same_shape ? all.tread : tread_of(tire, all, state.is_halved);
  TreadContact contact(tread, state.ground);
  GroundPose pose = state.pose;
  pose.height += height;
  contact.start(pose, x, {});
  return contact.patch(x);
}

Result<TireSlopes::OfPatch> TireSlopes::of_patch(const TireState& state,
                                                 const Eigen::VectorXd& height) {
  Impl& impl = *impl_;
  Systems& all = impl.base.systems(state.is_halved, state.window);
  const auto moved = impl.moved_state(all, state, height);
  if (!moved) return moved.failure();
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  OfPatch slopes{
      Eigen::VectorXd(impl.count()), Eigen::VectorXd(impl.count()), Eigen::VectorXd(impl.count())};
  for (int k = 0; k < impl.count(); ++k) {
    const double step = impl.variations[k].step;
    const auto beside = [&](double side) {
      const double by = side * step;
      return impl.patch_beside(all, state, x + by * moved->col(k), by * height[k], k, side);
    };
    const ContactPatch below = beside(-1.0), above = beside(1.0);
    slopes.length[k] = (above.length - below.length) / (2.0 * step);
    slopes.width[k] = (above.width - below.width) / (2.0 * step);
    slopes.area[k] = (above.area - below.area) / (2.0 * step);
  }
  return slopes;
}

}  // namespace latsch::fe_tire
