// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/magic_formula.h"

#include <algorithm>
#include <cassert>

#include "models/magic_formula/deflection_62.h"
#include "models/magic_formula/vertical/load_curve.h"

#define LATSCH_KERNELS_IN "models/magic_formula/magic_formula_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::magic_formula {
namespace {

Conventions usable(Conventions conventions, const Parameters& parameters) {
  conventions.turn_slip = conventions.turn_slip && parameters.turn_slip_known();
  return conventions;
}

/// Returns the parameters without the least load of the file if limits are off: the inputs are then
/// used as they are. The other ranges act in the kernels, which know the conventions.
Parameters limited(Parameters parameters, const Conventions& conventions) {
  if (!conventions.limits) parameters.FZMIN = 0.0;
  return parameters;
}

/// Returns true if the deflection is computed outside of the vectorized kernels.
bool deflects_otherwise(const Parameters& p) {
  return p.version == Version::mf62 || has_load_curve(p);
}

void add_deflection(const Parameters& parameters,
                    const TireConstants& tire,
                    const Conventions& conventions,
                    const WheelUnderLoad& wheel,
                    SteadyState& s) {
  if (has_load_curve(parameters)) {
    s.rho = deflection_on_curve(parameters, std::max(wheel.Fz, parameters.FZMIN));
    s.R_l = std::max(wheel.R_omega - s.rho, 0.0);
    s.Cz = s.rho > 0.0 ? wheel.Fz / s.rho : initial_stiffness(parameters);
    return;
  }
  const Deflection62 d = deflection_62(tire, wheel, s.Fx, conventions.mirrored ? -s.Fy : s.Fy);
  s.rho = d.rho;
  s.R_l = d.R_l;
  s.Cz = d.rho > 0.0 ? wheel.Fz / d.rho : tire.p.VERTICAL_STIFFNESS;
}

}  // namespace

MagicFormula::MagicFormula(const Parameters& parameters, const Conventions& conventions)
    : parameters_(limited(parameters, conventions)),
      tire_(parameters_, parameters.version),
      conventions_(usable(conventions, parameters)) {}

SteadyState MagicFormula::evaluate(const State& state) const {
  SteadyState result;
  WheelUnderLoad wheel;
  LATSCH_KERNEL(evaluate_one)(tire_, conventions_, state, result, wheel);
  if (deflects_otherwise(parameters_))
    add_deflection(parameters_, tire_, conventions_, wheel, result);
  return result;
}

void MagicFormula::evaluate(std::span<const State> states, std::span<SteadyState> results) const {
  assert(states.size() == results.size());
  const bool alone = deflects_otherwise(parameters_);
  const auto eight = LATSCH_KERNEL(evaluate_eight);
  const std::size_t whole = states.size() / 8 * 8;
  for (std::size_t i = 0; i < whole; i += 8) {
    WheelUnderLoad wheels[8];
    eight(tire_, conventions_, &states[i], &results[i], alone ? wheels : nullptr);
    for (std::size_t k = 0; alone && k < 8; ++k)
      add_deflection(parameters_, tire_, conventions_, wheels[k], results[i + k]);
  }
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
  LATSCH_KERNEL(forces_of_columns)(tire_, conventions_, in, out, whole);
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
