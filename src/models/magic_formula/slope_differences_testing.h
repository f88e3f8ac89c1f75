// SPDX-License-Identifier: Apache-2.0
// For tests: compares derivatives with finite differences of the plain formula, for every variable
// and output.
//
// Central differences over h, h/2, h/4, h = 1e-3 of the variable's size, are extrapolated
// [Richardson 1911]. The error is of order h^6, 1e-18 for a smooth curve, plus rounding, about ten
// units in the last place of the output over h/4: 1e-11 of output over size. If the last two
// extrapolations differ by more than the tolerance, a kink lies within h, and nothing is compared.
// Slips and angles of exactly 0 are not compared either, because |x| has a kink there and
// differences from both sides cancel.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "models/magic_formula/magic_formula_slopes.h"

namespace latsch::magic_formula {

inline const std::vector<Output>& all_outputs() {
  using S = SteadyState;
  static const std::vector<Output> outputs = {
      &S::Fx,  &S::Fy,  &S::Fz, &S::Mx, &S::My,  &S::Mz,      &S::R_e,    &S::R_l,
      &S::rho, &S::a,   &S::b,  &S::t,  &S::Mzr, &S::mux,     &S::muy,    &S::omega,
      &S::Kxk, &S::Kya, &S::Cx, &S::Cy, &S::Cz,  &S::sigma_x, &S::sigma_y};
  return outputs;
}

struct SlopeComparison {
  int count = 0, kinks = 0, not_the_bits = 0;
  double worst = 0.0;  // largest difference over its tolerance; at most 1 if all agree
  std::string where;
};

class SlopeDifferences {
 public:
  SlopeDifferences(const MagicFormula& tire, const std::vector<State>& states)
      : tire_(tire), states_(states), sizes_(all_outputs().size(), 0.0) {
    for (const SteadyState& s : evaluated(tire, states))
      for (std::size_t o = 0; o < sizes_.size(); ++o)
        sizes_[o] = std::max(sizes_[o], std::abs(s.*all_outputs()[o]));
  }

  void compare(const std::vector<std::string>& names, SlopeComparison& result) const {
    const SteadyStateSlopes found = steady_state_slopes(tire_, states_, names, all_outputs());
    const auto plain = evaluated(tire_, states_);
    for (std::size_t o = 0; o < sizes_.size(); ++o)
      for (std::size_t i = 0; i < states_.size(); ++i)
        result.not_the_bits +=
            std::memcmp(&found.values(i, o), &(plain[i].*all_outputs()[o]), sizeof(double)) != 0;
    for (std::size_t j = 0; j < names.size(); ++j) compare(names[j], found, j, result);
  }

 private:
  using Results = std::vector<SteadyState>;

  static Results evaluated(const MagicFormula& tire, const std::vector<State>& states) {
    Results results(states.size());
    tire.evaluate(states, results);
    return results;
  }

  /// Returns the typical size of a variable, to which the step of the differences is proportional;
  /// 0 if the variable cannot be changed.
  double size_of(const std::string& name) const {
    static const std::vector<std::pair<std::string, double>> states = {{"Fz", 4000.0},
                                                                       {"kappa", 0.1},
                                                                       {"alpha", 0.1},
                                                                       {"gamma", 0.1},
                                                                       {"phit", 0.1},
                                                                       {"Vx", 10.0},
                                                                       {"p", 2e5}};
    for (const auto& [state, size] : states)
      if (state == name) return size;
    const ParameterField& field = *find_parameter(name);
    const double x = tire_.parameters().*field.member;
    // The value 0 of these parameters switches equations, and limits may be infinite, so they are
    // not changed.
    for (const char* switching : {"Q_A1", "Q_A2", "PTY2", "Q_CAM1", "Q_CAM2"})
      if (name == switching && x == 0.0) return 0.0;
    if (!std::isfinite(x)) return 0.0;
    return field.unit == ParameterUnit::one ? std::max(std::abs(x), 0.1) : std::abs(x);
  }

  Results changed(const std::string& name, double by) const {
    if (const ParameterField* field = find_parameter(name)) {
      Parameters p = tire_.parameters();
      p.*field->member += by;
      return evaluated(MagicFormula(p, tire_.conventions()), states_);
    }
    std::vector<State> states = states_;
    for (State& s : states) *field_of(name, s) += by;
    return evaluated(tire_, states);
  }

  static double* field_of(const std::string& name, State& s) {
    return name == "Fz"      ? &s.Fz
           : name == "kappa" ? &s.kappa
           : name == "alpha" ? &s.alpha
           : name == "gamma" ? &s.gamma
           : name == "phit"  ? &s.phit
           : name == "Vx"    ? &s.Vx
           : name == "p"     ? &s.p
                             : nullptr;
  }
  /// Returns the value of a state's variable; for a coefficient returns 1.
  static double value_of(const std::string& name, State s) {
    const double* x = field_of(name, s);
    return x == nullptr ? 1.0 : *x;
  }

  void compare(const std::string& name,
               const SteadyStateSlopes& found,
               std::size_t j,
               SlopeComparison& result) const {
    const double size = size_of(name), h = 1e-3 * size;
    if (size == 0.0) return;
    Results up[3], down[3];
    for (int k = 0; k < 3; ++k) {
      up[k] = changed(name, h / (1 << k));
      down[k] = changed(name, -h / (1 << k));
    }
    for (std::size_t o = 0; o < sizes_.size(); ++o)
      for (std::size_t i = 0; i < states_.size(); ++i) {
        double d[3];
        for (int k = 0; k < 3; ++k)
          d[k] = (up[k][i].*all_outputs()[o] - down[k][i].*all_outputs()[o]) / (2 * h / (1 << k));
        const double coarse = d[1] + (d[1] - d[0]) / 3.0, fine = d[2] + (d[2] - d[1]) / 3.0;
        const double best = fine + (fine - coarse) / 15.0;
        const double here = found.slopes[o](i, j);
        double reach = 1e-7 * std::abs(best) + 1e-9 * sizes_[o] / size;
        // The deflection of MF 6.2 is solved to 1e-15 m. If the deflection is small, this error
        // matters in Cz.
        if (all_outputs()[o] == &SteadyState::Cz && up[2][i].rho > 0.0)
          reach += 1e-15 * up[2][i].Cz / up[2][i].rho / (h / 4.0);
        if (value_of(name, states_[i]) == 0.0) continue;
        ++result.count;
        if (!(std::abs(fine - coarse) <= reach) && std::isfinite(here)) {
          ++result.kinks;
          continue;
        }
        const double excess = here == best ? 0.0 : std::abs(here - best) / reach;
        if (excess <= result.worst) continue;
        result.worst = std::isfinite(excess) ? excess : INFINITY;
        result.where = "output " + std::to_string(o) + " state " + std::to_string(i) + " " + name +
                       ": " + std::to_string(here) + ", differences " + std::to_string(best);
      }
  }

  const MagicFormula& tire_;
  const std::vector<State>& states_;
  std::vector<double> sizes_;
};

inline SlopeComparison compare_with_differences(const MagicFormula& tire,
                                                const std::vector<State>& states) {
  std::vector<std::string> names = {"Fz", "kappa", "alpha", "gamma", "phit", "Vx", "p"};
  for (const ParameterField& field : parameter_fields()) names.emplace_back(field.name);
  SlopeComparison result;
  SlopeDifferences(tire, states).compare(names, result);
  return result;
}

}  // namespace latsch::magic_formula
