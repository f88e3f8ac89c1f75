// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/magic_formula.h"

#include <algorithm>
#include <cassert>

#include "models/magic_formula/aligning.h"
#include "models/magic_formula/geometry.h"
#include "models/magic_formula/lateral.h"
#include "models/magic_formula/longitudinal.h"
#include "models/magic_formula/moments.h"

namespace latsch::magic_formula {
namespace kernel {

TireConstants::TireConstants(const Parameters& parameters)
    : p(parameters), mf52(p.version == Version::mf52), Fz0_prime(p.LFZO * p.FNOMIN) {
  const double stiffness = p.VERTICAL_STIFFNESS * p.UNLOADED_RADIUS / p.FNOMIN;
  Q_FZ1 = std::sqrt(std::max(stiffness * stiffness - 4.0 * p.Q_FZ2, 0.0));  // (4)
  per_FNOMIN = 1.0 / p.FNOMIN;
  per_Fz0_prime = 1.0 / Fz0_prime;
  per_NOMPRES = 1.0 / p.NOMPRES;
  per_LONGVL = 1.0 / p.LONGVL;
  per_VXLOW = 1.0 / p.VXLOW;
  per_FZMIN = 1.0 / p.FZMIN;
  R0_per_V0 = p.UNLOADED_RADIUS / p.LONGVL;
  Q_A1 = p.Q_A1;
  Q_A2 = p.Q_A2;
  if (Q_A1 == 0.0 && Q_A2 == 0.0) {
    // What MF-Tyre takes for a file that is silent: a fit over tires by their stiffness.
    const double y = std::log10(stiffness);
    Q_A1 = ((-0.0388 * y + 0.2509) * y - 0.6283) * y + 0.6279;
    Q_A2 = 1.693 * Q_A1 * Q_A1;
  }
}

namespace {

template <class R>
struct Forces {
  R Fx, Fy, Mx, My, Mz;
};

template <class R>
LATSCH_INLINE Forces<R> mirrored(const Forces<R>& f) {
  return {f.Fx, -f.Fy, -f.Mx, f.My, -f.Mz};
}

template <class R>
LATSCH_INLINE StateOf<R> on_measured_side(const StateOf<R>& s, const Conventions& conventions) {
  if (!conventions.mirrored) return s;
  return {s.Fz, s.kappa, -s.alpha, -s.gamma, -s.phit, s.Vx, s.p};
}

/// All forces of a state and what else comes with them.
template <class R>
struct Everything {
  OperatingPoint<R> o;
  Longitudinal<R> x;
  PureLateral<R> pure;
  CombinedLateral<R> y;
  Aligning<R> z;
};

template <class R>
LATSCH_INLINE Everything<R> everything(const TireConstants& tire,
                                       const Conventions& conventions,
                                       const StateOf<R>& state) {
  Everything<R> e;
  e.o = operating_point(tire, conventions, on_measured_side(state, conventions));
  Shapes<R> shapes;
  e.x = longitudinal_terms(tire, conventions, e.o, shapes);
  e.pure = pure_lateral_terms(tire, conventions, e.o, false, shapes);
  PureLateral<R> upright = pure_lateral_terms(tire, conventions, e.o, true, shapes);
  e.y = combined_lateral_terms(tire, conventions, e.o, e.pure, shapes);
  e.z = aligning_terms(tire, conventions, e.o, e.pure, e.x.Kxk, shapes);
  shapes.evaluate();
  finish(e.o, shapes, e.x);
  finish(conventions, e.o, shapes.sine[Shapes<R>::kFy], e.pure);
  finish(conventions, e.o, shapes.sine[Shapes<R>::kFyUpright], upright);
  finish(shapes, e.pure, e.y);
  finish(tire, conventions, e.o, e.pure, upright.Fy0, e.y, e.x.Fx, shapes, e.z);
  return e;
}

template <class R>
LATSCH_INLINE Forces<R> forces_of(const TireConstants& tire,
                                  const Conventions& conventions,
                                  const StateOf<R>& state) {
  const Everything<R> e = everything(tire, conventions, state);
  const Forces<R> f{e.x.Fx,
                    e.y.Fy,
                    overturning(tire, e.o, e.y.Fy),
                    rolling_resistance(tire, e.o, e.x.Fx),
                    e.z.Mz};
  return conventions.mirrored ? mirrored(f) : f;
}

/// Everything but the deflection of MF 6.2, which `add_deflection_62` adds.
template <class R>
LATSCH_INLINE SteadyStateOf<R> steady_state(const TireConstants& tire,
                                            const Conventions& conventions,
                                            const StateOf<R>& state) {
  const auto [o, x, pure, y, z] = everything(tire, conventions, state);
  const Deflection<R> d = deflection(tire, o, x.Fx, y.Fy);
  const Patch<R> patch = contact_patch(tire, o);
  const Relaxation<R> r = relaxation(tire, o, x.Kxk, pure.Kya);
  const double side = conventions.mirrored ? -1.0 : 1.0;
  SteadyStateOf<R> s;
  s.Fx = x.Fx;
  s.Fy = side * y.Fy;
  s.Fz = o.Fz;
  s.Mx = side * overturning(tire, o, y.Fy);
  s.My = rolling_resistance(tire, o, x.Fx);
  s.Mz = side * z.Mz;
  s.R_e = o.Re;
  s.R_l = d.R_l;
  s.rho = d.rho;
  s.a = patch.a;
  s.b = patch.b;
  s.t = z.t;
  s.Mzr = side * z.Mzr;
  s.mux = x.mux;
  s.muy = pure.muy;
  s.omega = o.omega;
  s.Kxk = x.Kxk;
  s.Kya = pure.Kya;
  s.Cx = r.Cx;
  s.Cy = r.Cy;
  s.Cz = select(d.rho > 0.0, o.Fz / d.rho, constant<R>(tire.p.VERTICAL_STIFFNESS));
  s.sigma_x = r.sigma_x;
  s.sigma_y = r.sigma_y;
  return s;
}

LATSCH_CLONES void evaluate_one(const TireConstants& tire,
                                const Conventions& conventions,
                                const State& state,
                                SteadyState& result) {
  result = steady_state<double>(tire, conventions, state);
}

constexpr int kStateFields = sizeof(State) / sizeof(double);
constexpr int kResultFields = sizeof(SteadyState) / sizeof(double);

LATSCH_CLONES void evaluate_eight(const TireConstants& tire,
                                  const Conventions& conventions,
                                  const State* states,
                                  SteadyState* results) {
  StateOf<Lanes> side_by_side;
  for (int field = 0; field < kStateFields; ++field)
    for (int i = 0; i < 8; ++i)
      reinterpret_cast<Lanes*>(&side_by_side)[field][i] =
          reinterpret_cast<const double*>(states + i)[field];
  const SteadyStateOf<Lanes> all_eight = steady_state<Lanes>(tire, conventions, side_by_side);
  for (int field = 0; field < kResultFields; ++field)
    for (int i = 0; i < 8; ++i)
      reinterpret_cast<double*>(results + i)[field] =
          reinterpret_cast<const Lanes*>(&all_eight)[field][i];
}

/// `count` a multiple of eight; columns in the order of StateOf and Forces.
LATSCH_CLONES void forces_of_columns(const TireConstants& tire,
                                     const Conventions& conventions,
                                     const double* const* in,
                                     double* const* out,
                                     std::size_t count) {
  for (std::size_t i = 0; i < count; i += 8) {
    const StateOf<Lanes> state{lanes(in[0] + i),
                               lanes(in[1] + i),
                               lanes(in[2] + i),
                               lanes(in[3] + i),
                               lanes(in[4] + i),
                               lanes(in[5] + i),
                               lanes(in[6] + i)};
    const Forces<Lanes> f = forces_of<Lanes>(tire, conventions, state);
    store(f.Fx, out[0] + i);
    store(f.Fy, out[1] + i);
    store(f.Mx, out[2] + i);
    store(f.My, out[3] + i);
    store(f.Mz, out[4] + i);
  }
}

void add_deflection_62(const TireConstants& tire,
                       const Conventions& conventions,
                       const State& state,
                       SteadyState& s) {
  if (tire.p.version != Version::mf62) return;
  const OperatingPoint<double> o =
      operating_point(tire, conventions, on_measured_side(state, conventions));
  const Deflection<double> d = deflection_62(tire, o, s.Fx, conventions.mirrored ? -s.Fy : s.Fy);
  s.rho = d.rho;
  s.R_l = d.R_l;
  s.Cz = d.rho > 0.0 ? o.Fz / d.rho : tire.p.VERTICAL_STIFFNESS;
}

}  // namespace
}  // namespace kernel

namespace {

Conventions usable(Conventions conventions, const Parameters& parameters) {
  conventions.turn_slip = conventions.turn_slip && parameters.turn_slip_known();
  return conventions;
}

}  // namespace

MagicFormula::MagicFormula(const Parameters& parameters, const Conventions& conventions)
    : tire_(parameters), conventions_(usable(conventions, parameters)) {}

SteadyState MagicFormula::evaluate(const State& state) const {
  SteadyState result;
  kernel::evaluate_one(tire_, conventions_, state, result);
  kernel::add_deflection_62(tire_, conventions_, state, result);
  return result;
}

void MagicFormula::evaluate(std::span<const State> states, std::span<SteadyState> results) const {
  assert(states.size() == results.size());
  const std::size_t whole = states.size() / 8 * 8;
  for (std::size_t i = 0; i < whole; i += 8)
    kernel::evaluate_eight(tire_, conventions_, &states[i], &results[i]);
  for (std::size_t i = 0; i < whole; ++i)
    kernel::add_deflection_62(tire_, conventions_, states[i], results[i]);
  for (std::size_t i = whole; i < states.size(); ++i) results[i] = evaluate(states[i]);
}

void MagicFormula::forces(const StateColumns& states, const ForceColumns& results) const {
  const double* in[] = {states.Fz.data(),
                        states.kappa.data(),
                        states.alpha.data(),
                        states.gamma.data(),
                        states.phit.data(),
                        states.Vx.data(),
                        states.p.data()};
  double* out[] = {results.Fx.data(),
                   results.Fy.data(),
                   results.Mx.data(),
                   results.My.data(),
                   results.Mz.data()};
  const std::size_t count = states.Fz.size(), whole = count / 8 * 8;
  kernel::forces_of_columns(tire_, conventions_, in, out, whole);
  for (std::size_t i = whole; i < count; ++i) {
    const SteadyState s =
        evaluate({in[0][i], in[1][i], in[2][i], in[3][i], in[4][i], in[5][i], in[6][i]});
    out[0][i] = s.Fx;
    out[1][i] = s.Fy;
    out[2][i] = s.Mx;
    out[3][i] = s.My;
    out[4][i] = s.Mz;
  }
}

}  // namespace latsch::magic_formula
