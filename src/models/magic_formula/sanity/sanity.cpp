// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/sanity/sanity.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string_view>

#include "models/magic_formula/sanity/sanity_checks.h"

namespace latsch::magic_formula {
namespace {

constexpr std::size_t kNamed = 3;  // most coefficients that a fault names

/// Removes the limits of the file, because clamped inputs would hide the behavior outside of the
/// data.
Parameters without_ranges(Parameters p) {
  p.PRESMIN = p.FZMIN = 0.0;
  p.PRESMAX = p.FZMAX = p.KPUMAX = p.ALPMAX = p.CAMMAX = kUnlimited;
  p.KPUMIN = p.ALPMIN = p.CAMMIN = -kUnlimited;
  return p;
}

struct Row {
  std::string name;
  std::function<WorstViolation(const Parameters&)> look;
  // Prefixes of the coefficients that may cause a violation.
  std::vector<std::string_view> suspects;
  // True if every other coefficient may be the single cause. The friction ellipse takes too long.
  bool others_may_cause = true;
};

/// Returns a value for a coefficient with which it does no harm: the one at which it has no effect
/// or, if there is none, a usual value.
double neutral_value(std::string_view name) {
  struct Usual {
    std::string_view name;
    double value;
  };
  constexpr Usual kUsual[] = {{"PCX1", 1.5},
                              {"PDX1", 1.0},
                              {"PKX1", 20.0},
                              {"PCY1", 1.4},
                              {"PDY1", 1.0},
                              {"PKY1", -20.0},
                              {"PKY2", 1.6},
                              {"PKY4", 2.0},
                              {"QBZ1", 8.0},
                              {"QCZ1", 1.1},
                              {"RCX1", 1.0},
                              {"RCY1", 1.0}};
  for (const Usual& one : kUsual)
    if (one.name == name) return one.value;
  return name.starts_with("L") && name.size() > 2 ? 1.0 : 0.0;
}

/// Sets a coefficient to its neutral value.
void neutralize(Parameters& p, const ParameterField& field) {
  p.*field.member = neutral_value(field.name);
}

bool is_suspect(const Row& row, std::string_view name) {
  return std::ranges::any_of(row.suspects, [&](auto prefix) { return name.starts_with(prefix); });
}

/// Returns how far a value lies from the middle of its usual range, as a share of half its width,
/// on a logarithmic scale if the range has one sign; 0 if no range is known.
double oddity(double value, const std::optional<UsualSpan>& usual) {
  if (!usual) return 0.0;
  double from = usual->lower, to = usual->upper;
  if (from * to > 0.0) {
    if (!(value * from > 0.0)) return kUnlimited;  // has the other sign
    value = std::log(value / from);
    to = std::log(to / from);
    from = 0.0;
  }
  return std::abs(2.0 * value - from - to) / std::abs(to - from);
}

/// Returns the coefficients each of which alone removes a violation if it is set to its neutral
/// value, those of the most unusual values first; at most kNamed.
std::vector<std::string> single_causes(const Row& row, const Parameters& p, const UsualOf& usual) {
  struct Cause {
    std::string name;
    double oddity;
  };
  std::vector<Cause> all;
  for (const ParameterField& field : parameter_fields()) {
    const auto span = usual ? usual(field.name) : std::nullopt;
    if (!is_suspect(row, field.name) && !(row.others_may_cause && span)) continue;
    if (p.*field.member == neutral_value(field.name)) continue;
    Parameters without = p;
    neutralize(without, field);
    if (row.look(without).severity > 0.0) continue;
    all.push_back({std::string(field.name), oddity(p.*field.member, span)});
  }
  std::ranges::stable_sort(all, std::greater<>(), &Cause::oddity);
  std::vector<std::string> named;
  for (const Cause& cause : all)
    if (named.size() < kNamed) named.push_back(cause.name);
  return named;
}

/// Finds the coefficients that cause a violation together, if no single one does. It sets one after
/// the other to its neutral value and keeps the change that reduces the severity most.
std::vector<std::string> joint_causes(const Row& row, Parameters p, double severity) {
  std::vector<std::string> named;
  while (severity > 0.0 && named.size() < kNamed) {
    const ParameterField* best = nullptr;
    double least = severity;
    for (const ParameterField& field : parameter_fields()) {
      if (!is_suspect(row, field.name) || p.*field.member == neutral_value(field.name)) continue;
      Parameters without = p;
      neutralize(without, field);
      const double left = row.look(without).severity;
      if (left < least) {
        least = left;
        best = &field;
      }
    }
    // No coefficient reduces the severity by more than 10 %.
    if (!best || !(least < 0.9 * severity)) break;
    named.emplace_back(best->name);
    neutralize(p, *best);
    severity = least;
  }
  return named;
}

std::vector<Row> rows(const Parameters& p, const Lattice& at) {
  using S = SteadyState;
  std::vector<Row> all;
  const auto add = [&](std::string name, auto look, std::vector<std::string_view> suspects) {
    const bool is_long = name == "friction ellipse";
    all.push_back({std::move(name), look, std::move(suspects), !is_long});
  };
  const bool has_x = p.PDX1 != 0.0 && p.PKX1 != 0.0, has_y = p.PDY1 != 0.0 && p.PKY1 != 0.0;
  if (has_y)
    add("cornering stiffness",
        [at](const Parameters& q) { return keeps_sign(q, at, &S::Kya, "the cornering stiffness"); },
        {"PKY", "PPY", "LKY"});
  if (has_x)
    add("slip stiffness",
        [at](const Parameters& q) { return keeps_sign(q, at, &S::Kxk, "the slip stiffness"); },
        {"PKX", "PPX", "LKX"});
  for (const bool lateral : {false, true}) {
    if (lateral ? !has_y : !has_x) continue;
    const NumberOfState mu = lateral ? &S::muy : &S::mux;
    const char* name = lateral ? "lateral friction" : "longitudinal friction";
    const auto suspects = lateral ? std::vector<std::string_view>{"PDY", "PPY", "LMUY"}
                                  : std::vector<std::string_view>{"PDX", "PPX", "LMUX"};
    add(
        "friction",
        [=](const Parameters& q) { return friction_in_bounds(q, at, mu, name); },
        suspects);
    add(
        "friction over load",
        [=](const Parameters& q) { return friction_falls(q, at, mu, name); },
        suspects);
  }
  if (has_x && has_y && at.kappa > 0.0 && at.alpha > 0.0)
    add("friction ellipse",
        [at](const Parameters& q) { return ellipse_is_convex(q, at); },
        {"RB", "RC", "RE", "RH", "RV", "PE", "PC"});
  for (const bool lateral : {false, true})
    if (lateral ? has_y : has_x)
      add(
          "force at large slip",
          [=](const Parameters& q) { return force_keeps_direction(q, at, lateral); },
          lateral ? std::vector<std::string_view>{"PCY", "PEY", "LEY", "LCY"}
                  : std::vector<std::string_view>{"PCX", "PEX", "LEX", "LCX"});
  if (has_y) {
    add("trail", [at](const Parameters& q) { return trail_is_positive(q, at); }, {"QD", "LTR"});
    add("overturning moment",
        [at](const Parameters& q) { return overturning_in_bounds(q, at); },
        {"QSX", "LMX", "LVMX"});
    add("camber stiffness",
        [at](const Parameters& q) { return camber_force_in_bounds(q, at); },
        {"PKY", "PHY3", "PVY3", "PVY4", "LKYC"});
  }
  if (has_y && at.alpha > 0.0)
    add("aligning moment",
        [at](const Parameters& q) { return moment_returns(q, at); },
        {"QB", "QC", "QD", "QE", "QH", "PE"});
  for (const Factor& factor : factors())
    add("factors",
        [at, &factor](const Parameters& q) { return stays_positive(q, at, factor); },
        {factor.coefficients.begin(), factor.coefficients.end()});
  return all;
}

}  // namespace

DataRange range_of(const Parameters& p) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const auto limited = [](double x, double otherwise) { return std::isfinite(x) ? x : otherwise; };
  DataRange range;
  range.Fz_from = p.FZMIN > 0.0 ? p.FZMIN : 0.5 * p.FNOMIN;
  range.Fz_to = std::max(range.Fz_from, limited(p.FZMAX, 1.5 * p.FNOMIN));
  range.alpha = std::max(std::abs(limited(p.ALPMIN, 12.0 * kDegree)),
                         std::abs(limited(p.ALPMAX, 12.0 * kDegree)));
  range.kappa = std::max(std::abs(limited(p.KPUMIN, 0.2)), std::abs(limited(p.KPUMAX, 0.2)));
  range.gamma_from = limited(p.CAMMIN, -4.0 * kDegree);
  range.gamma_to = limited(p.CAMMAX, 4.0 * kDegree);
  range.p_from = p.PRESMIN > 0.0 ? p.PRESMIN : 0.85 * p.NOMPRES;
  range.p_to = std::max(range.p_from, limited(p.PRESMAX, 1.15 * p.NOMPRES));
  return range;
}

std::vector<SanityFault> sanity_faults(const Parameters& parameters,
                                       const DataRange& range,
                                       const UsualOf& usual) {
  const Parameters p = without_ranges(parameters);
  const Lattice at = lattice_over(range, p);
  std::vector<SanityFault> faults;
  for (const Row& row : rows(p, at)) {
    const WorstViolation found = row.look(p);
    if (!(found.severity > 0.0)) continue;
    auto named = single_causes(row, p, usual);
    if (named.empty()) named = joint_causes(row, p, found.severity);
    faults.push_back({row.name, found.words, std::move(named)});
  }
  return faults;
}

}  // namespace latsch::magic_formula
