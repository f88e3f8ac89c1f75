// SPDX-License-Identifier: Apache-2.0
// The Magic Formula of one state and of many, eight at a time.
#include "models/magic_formula/aligning.h"
#include "models/magic_formula/geometry.h"
#include "models/magic_formula/lateral.h"
#include "models/magic_formula/longitudinal.h"
#include "models/magic_formula/moments.h"

namespace latsch::magic_formula::LATSCH_KERNELS {

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
LATSCH_INLINE void find_everything(const TireConstants& tire,
                                   const Conventions& conventions,
                                   const StateOf<R>& state,
                                   Everything<R>& e) {
  find_operating_point(tire, conventions, on_measured_side(state, conventions), e.o);
  Shapes<R> shapes;
  e.x = longitudinal_terms(tire, conventions, e.o, shapes);
  e.pure = pure_lateral_terms(tire, conventions, e.o, false, shapes);
  PureLateral<R> upright = pure_lateral_terms(tire, conventions, e.o, true, shapes);
  e.y = combined_lateral_terms(tire, conventions, e.o, e.pure, shapes);
  e.z = aligning_terms(tire, conventions, e.o, e.pure, e.x.Kxk, shapes);
  shapes.end(Shapes<R>::kLateral);
  shapes.begin(Shapes<R>::kOthers);
  shapes.end(Shapes<R>::kOthers);
  finish(e.o, shapes, e.x);
  finish(conventions, e.o, shapes.sine[Shapes<R>::kFy], e.pure);
  finish(conventions, e.o, shapes.sine[Shapes<R>::kFyUpright], upright);
  finish(shapes, e.pure, e.y);
  finish(tire, conventions, e.o, e.pure, upright.Fy0, e.y, e.x.Fx, shapes, e.z);
}

template <class R>
LATSCH_INLINE Forces<R> forces_of(const TireConstants& tire,
                                  const Conventions& conventions,
                                  const StateOf<R>& state) {
  Everything<R> e;
  find_everything(tire, conventions, state, e);
  const Forces<R> f{e.x.Fx,
                    e.y.Fy,
                    overturning(tire, e.o, e.y.Fy),
                    rolling_resistance(tire, e.o, e.x.Fx),
                    e.z.Mz};
  return conventions.mirrored ? mirrored(f) : f;
}

/// Everything but the deflection of MF 6.2, which hangs on `wheel`.
template <class R>
LATSCH_INLINE void steady_state(const TireConstants& tire,
                                const Conventions& conventions,
                                const StateOf<R>& state,
                                SteadyStateOf<R>& s,
                                WheelUnderLoadOf<R>& wheel) {
  Everything<R> e;
  find_everything(tire, conventions, state, e);
  const auto& [o, x, pure, y, z] = e;
  wheel = {o.Fz, o.Fz_given, o.omega, o.gamma, o.dpi, o.R_omega};
  const double side = conventions.mirrored ? -1.0 : 1.0;
  s.Mx = side * overturning(tire, o, y.Fy);  // first: the longest chain that hangs on the forces
  const Deflection<R> d = deflection(tire, o, x.Fx, y.Fy);
  const Patch<R> patch = contact_patch(tire, o);
  const Relaxation<R> r = relaxation(tire, o, x.Kxk, pure.Kya);
  s.Fx = x.Fx;
  s.Fy = side * y.Fy;
  s.Fz = o.Fz;
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
  s.Cz = select(d.rho > 0.0, o.Fz / d.rho, R(tire.p.VERTICAL_STIFFNESS));
  s.sigma_x = r.sigma_x;
  s.sigma_y = r.sigma_y;
}

// States and results lie in memory as structs of doubles; side by side, field by field.

template <class Fields>
constexpr int kFieldsOf = sizeof(Fields) / sizeof(double);

/// Eight structs of doubles as one of Lanes.
template <class Wide, class Narrow>
LATSCH_INLINE Wide side_by_side(const Narrow* eight) {
  static_assert(sizeof(Wide) == 8 * sizeof(Narrow));
  const auto field = [&](int state, int i) {
    double x;
    std::memcpy(&x, reinterpret_cast<const char*>(eight + state) + sizeof x * i, sizeof x);
    return x;
  };
  Wide wide;
  for (int i = 0; i < kFieldsOf<Narrow>; ++i)
    reinterpret_cast<Lanes*>(&wide)[i] = lanes(field(0, i),
                                               field(1, i),
                                               field(2, i),
                                               field(3, i),
                                               field(4, i),
                                               field(5, i),
                                               field(6, i),
                                               field(7, i));
  return wide;
}
template <class Wide, class Narrow>
LATSCH_INLINE void one_by_one(const Wide& wide, Narrow* eight) {
  static_assert(sizeof(Wide) == 8 * sizeof(Narrow));
  double fields[kFieldsOf<Narrow>][8];
  for (int i = 0; i < kFieldsOf<Narrow>; ++i)
    store(reinterpret_cast<const Lanes*>(&wide)[i], fields[i]);
  for (int state = 0; state < 8; ++state) {
    double of_one[kFieldsOf<Narrow>];
    for (int i = 0; i < kFieldsOf<Narrow>; ++i) of_one[i] = fields[i][state];
    std::memcpy(eight + state, of_one, sizeof of_one);
  }
}

/// `wheel`: what the deflection of MF 6.2 hangs on.
void evaluate_one(const TireConstants& tire,
                  const Conventions& conventions,
                  const State& state,
                  SteadyState& result,
                  WheelUnderLoad& wheel) {
  // Written where they stay: copies of what was just written would wait for it to arrive.
  static_assert(sizeof(Lane) == sizeof(double));
  steady_state(tire,
               conventions,
               std::bit_cast<StateOf<Lane>>(state),
               reinterpret_cast<SteadyStateOf<Lane>&>(result),
               reinterpret_cast<WheelUnderLoadOf<Lane>&>(wheel));
}

void evaluate_eight(const TireConstants& tire,
                    const Conventions& conventions,
                    const State* states,
                    SteadyState* results,
                    WheelUnderLoad* wheels) {
  WheelUnderLoadOf<Lanes> at;
  SteadyStateOf<Lanes> s;
  steady_state(tire, conventions, side_by_side<StateOf<Lanes>>(states), s, at);
  one_by_one(s, results);
  if (wheels != nullptr) one_by_one(at, wheels);
}

/// `count` a multiple of eight; columns in the order of StateOf and Forces.
void forces_of_columns(const TireConstants& tire,
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

}  // namespace latsch::magic_formula::LATSCH_KERNELS
