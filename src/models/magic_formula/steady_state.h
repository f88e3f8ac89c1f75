// SPDX-License-Identifier: Apache-2.0
// Evaluates all equations of the Magic Formula, in the order in which they depend on each other.
#if defined(LATSCH_MAGIC_FORMULA_STEADY_STATE) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_MAGIC_FORMULA_STEADY_STATE
#undef LATSCH_MAGIC_FORMULA_STEADY_STATE
#else
#define LATSCH_MAGIC_FORMULA_STEADY_STATE
#endif

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

/// All forces of a state together with the intermediate results.
template <class R>
struct Everything {
  OperatingPoint<R> o;
  Longitudinal<R> x;
  PureLateral<R> pure;
  CombinedLateral<R> y;
  Aligning<R> z;
};

template <class R>
LATSCH_INLINE void find_everything(const TireOf<R>& tire,
                                   const Conventions& conventions,
                                   const StateOf<R>& state,
                                   Everything<R>& e,
                                   const AskedOutputs& asked = {}) {
  find_operating_point(tire, conventions, on_measured_side(state, conventions), e.o);
  Shapes<R> shapes;
  e.x = longitudinal_terms(tire, conventions, e.o, shapes);
  e.pure = pure_lateral_terms(tire, conventions, e.o, false, shapes);
  PureLateral<R> upright;
  if (asked.Mz) {
    upright = pure_lateral_terms(tire, conventions, e.o, true, shapes);
  } else {
    shapes.set(Shapes<R>::kFyUpright, R(0.0), R(0.0), R(0.0));
    shapes.set(Shapes<R>::kTrail, R(0.0), R(0.0), R(0.0));
  }
  e.y = combined_lateral_terms(tire, conventions, e.o, e.pure, shapes);
  if (asked.Mz) e.z = aligning_terms(tire, conventions, e.o, e.pure, e.x.Kxk, shapes);
  shapes.end(Shapes<R>::kLateral);
  shapes.begin(Shapes<R>::kOthers);
  shapes.end(Shapes<R>::kOthers);
  finish(e.o, shapes, e.x);
  finish(conventions, e.o, shapes.sine[Shapes<R>::kFy], e.pure);
  if (asked.Mz) finish(conventions, e.o, shapes.sine[Shapes<R>::kFyUpright], upright);
  finish(shapes, e.pure, e.y);
  if (asked.Mz) finish(tire, conventions, e.o, e.pure, upright.Fy0, e.y, e.x.Fx, shapes, e.z);
}

template <class R>
LATSCH_INLINE Forces<R> forces_of(const TireOf<R>& tire,
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

/// Computes all results except the deflection of MF 6.2. For that deflection, `wheel` receives its
/// inputs.
template <class R>
LATSCH_INLINE void steady_state(const TireOf<R>& tire,
                                const Conventions& conventions,
                                const StateOf<R>& state,
                                SteadyStateOf<R>& s,
                                WheelUnderLoadOf<R>& wheel,
                                const AskedOutputs& asked = {}) {
  Everything<R> e;
  find_everything(tire, conventions, state, e, asked);
  const auto& [o, x, pure, y, z] = e;
  wheel = {o.Fz, o.Fz_given, o.omega, o.gamma, o.dpi, o.R_omega};
  const double side = conventions.mirrored ? -1.0 : 1.0;
  // Mx is computed first, because it has the longest chain of dependent operations.
  if (asked.Mx) s.Mx = side * overturning(tire, o, y.Fy);
  Deflection<R> d;
  if (asked.deflection) d = deflection(tire, o, x.Fx, y.Fy);
  Patch<R> patch;
  if (asked.patch) patch = contact_patch(tire, o);
  Relaxation<R> r;
  if (asked.relaxation) r = relaxation(tire, o, x.Kxk, pure.Kya);
  s.Fx = x.Fx;
  s.Fy = side * y.Fy;
  s.Fz = o.Fz;
  if (asked.My) s.My = rolling_resistance(tire, o, x.Fx);
  if (asked.Mz) s.Mz = side * z.Mz;
  s.R_e = o.Re;
  if (asked.deflection) {
    s.R_l = d.R_l;
    s.rho = d.rho;
    s.Cz = select(d.rho > 0.0, o.Fz / d.rho, R(tire.p.VERTICAL_STIFFNESS));
  }
  if (asked.patch) {
    s.a = patch.a;
    s.b = patch.b;
  }
  if (asked.Mz) s.t = z.t;
  if (asked.Mz) s.Mzr = side * z.Mzr;
  s.mux = x.mux;
  s.muy = pure.muy;
  s.omega = o.omega;
  s.Kxk = x.Kxk;
  s.Kya = pure.Kya;
  if (asked.relaxation) {
    s.Cx = r.Cx;
    s.Cy = r.Cy;
    s.sigma_x = r.sigma_x;
    s.sigma_y = r.sigma_y;
  }
}

}  // namespace latsch::magic_formula::LATSCH_KERNELS
#endif
