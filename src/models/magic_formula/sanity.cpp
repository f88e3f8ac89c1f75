// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/sanity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "models/magic_formula/coefficient_conditions.h"
#include "models/magic_formula/magic_formula.h"

namespace latsch::magic_formula {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kWider = 1.5;  // width of the checked range relative to that of the data
constexpr double kLeastFriction = 0.2, kMostFriction = 3.0;
// Rise of the friction with the load, as a share, below which it is ignored.
constexpr double kRise = 0.01;
// Smallest force in a direction, as a share of the convex hull of the forces.
constexpr double kConvex = 0.8;
// Share of FNOMIN; the aligning moment at smaller loads is not checked.
constexpr double kLightest = 0.1;
// Largest aligning moment of opposite sign, as a share of the peak.
constexpr double kReturned = 0.5;
// Slip angle up to which the aligning moment is checked at least, whatever the range of the data.
// The trail has fallen to zero there.
constexpr double kLeastSweep = 30.0 * kDegree;
// Largest checked slips of a tire that rolls forward.
constexpr double kMostAlpha = 45.0 * kDegree, kMostKappa = 1.0;
// Smallest force at large slip, as a share of its peak. A smaller one turns around.
constexpr double kLeastLeft = 0.1;
// Largest lever of the overturning moment, as a share of the radius.
constexpr double kMostLever = 0.5;
// Largest camber stiffness over the load, 1/rad.
constexpr double kMostCamber = 6.0;
constexpr std::size_t kNamed = 3;
constexpr double kBar = 1e5;

/// An interval of 1.5 times the width of the data, with the same middle.
struct Widened {
  double from, to;

  std::vector<double> points(int count) const {
    if (!(to > from)) return {from};
    std::vector<double> all;
    for (int i = 0; i < count; ++i) all.push_back(from + (to - from) * i / (count - 1));
    return all;
  }
};

Widened widened(double from, double to) {
  const double more = 0.5 * (kWider - 1.0) * (to - from);
  return {from - more, to + more};
}

/// Widens the range of a quantity that has to stay positive. The lower end does not go below half
/// of its value.
Widened widened_above_zero(double from, double to) {
  Widened range = widened(from, to);
  range.from = std::max(range.from, 0.5 * from);
  return range;
}

struct Lattice {
  std::vector<double> loads, cambers, pressures;
  double alpha, kappa, nominal_pressure, speed;
};

Lattice lattice_over(const DataRange& range, const Parameters& p) {
  const Widened gamma = widened(range.gamma_from, range.gamma_to);
  Lattice lattice{widened_above_zero(range.Fz_from, range.Fz_to).points(9),
                  gamma.points(7),
                  widened_above_zero(range.p_from, range.p_to).points(7),
                  std::min(kMostAlpha, kWider * range.alpha),
                  std::min(kMostKappa, kWider * range.kappa),
                  std::clamp(p.NOMPRES, range.p_from, std::max(range.p_from, range.p_to)),
                  p.LONGVL};
  if (gamma.from < 0.0 && gamma.to > 0.0) lattice.cambers.push_back(0.0);
  return lattice;
}

/// Removes the limits of the file, because clamped inputs would hide the behavior outside of the
/// data.
Parameters without_ranges(Parameters p) {
  p.PRESMIN = p.FZMIN = 0.0;
  p.PRESMAX = p.FZMAX = p.KPUMAX = p.ALPMAX = p.CAMMAX = kUnlimited;
  p.KPUMIN = p.ALPMIN = p.CAMMIN = -kUnlimited;
  return p;
}

/// Result of a check: the severity of a violation (0: none) and its description.
struct Finding {
  double severity = 0.0;
  std::string words;

  void worsen(double by, const std::function<std::string()>& in_words) {
    if (!(by > severity)) return;
    severity = by;
    words = in_words();
  }
};

std::string place(double Fz, double gamma, double p) {
  return fmt::format(
      "{:.0f} N, camber {:.1f} deg, {:.2f} bar", Fz, gamma / kDegree + 0.0, p / kBar);
}

using Answer = double SteadyState::*;

Finding keeps_sign(const Parameters& p, const Lattice& at, Answer stiffness, const char* name) {
  const MagicFormula tire(p);
  // Kya is negative, since alpha > 0 gives Fy < 0
  const double expected = stiffness == &SteadyState::Kya ? -1.0 : 1.0;
  const State nominal{p.FNOMIN, 0.0, 0.0, 0.0, 0.0, at.speed, at.nominal_pressure};
  const double size = std::max(std::abs(tire.evaluate(nominal).*stiffness), 1e-3 * p.FNOMIN);
  Finding found;
  for (const double Fz : at.loads)
    for (const double gamma : at.cambers)
      for (const double pressure : at.pressures) {
        const double K =
            expected * (tire.evaluate({Fz, 0.0, 0.0, gamma, 0.0, at.speed, pressure}).*stiffness);
        if (K > 0.0) continue;
        found.worsen(1e-9 - K / size, [&] {
          return fmt::format("{} has the wrong sign at {}", name, place(Fz, gamma, pressure));
        });
      }
  return found;
}

Finding friction_in_bounds(const Parameters& p, const Lattice& at, Answer mu, const char* name) {
  const MagicFormula tire(p);
  Finding found;
  for (const double Fz : at.loads)
    for (const double gamma : at.cambers)
      for (const double pressure : at.pressures) {
        const double x = tire.evaluate({Fz, 0.0, 0.0, gamma, 0.0, at.speed, pressure}).*mu;
        found.worsen(std::max(kLeastFriction - x, x - kMostFriction), [&] {
          return fmt::format("{} is {:.3g} at {}, outside of {} to {}",
                             name,
                             x,
                             place(Fz, gamma, pressure),
                             kLeastFriction,
                             kMostFriction);
        });
      }
  return found;
}

Finding friction_falls(const Parameters& p, const Lattice& at, Answer mu, const char* name) {
  const MagicFormula tire(p);
  Finding found;
  for (const double gamma : at.cambers)
    for (const double pressure : at.pressures) {
      double least = 0.0, least_at = 0.0;
      for (const double Fz : at.loads) {
        const double x = tire.evaluate({Fz, 0.0, 0.0, gamma, 0.0, at.speed, pressure}).*mu;
        if (least_at == 0.0 || x < least) {
          least = x;
          least_at = Fz;
        }
        found.worsen((x - least) / std::max(std::abs(least), kLeastFriction) - kRise, [&] {
          return fmt::format("{} rises with load: {:.3g} at {:.0f} N, {:.3g} at {}",
                             name,
                             least,
                             least_at,
                             x,
                             place(Fz, gamma, pressure));
        });
      }
    }
  return found;
}

/// Checks the forces of one slip alone up to a locked wheel or kMostAlpha, whatever the data: they
/// keep the direction that they have at small slip.
Finding force_keeps_direction(const Parameters& p, const Lattice& at, bool lateral) {
  constexpr int kSteps = 60;
  const MagicFormula tire(p);
  Finding found;
  for (const double Fz : at.loads)
    for (const double side : {-1.0, 1.0}) {
      double peak = 0.0;
      for (int i = 1; i <= kSteps; ++i) {
        const double slip = side * (lateral ? kMostAlpha : kMostKappa) * i / kSteps;
        const SteadyState s = tire.evaluate({Fz,
                                             lateral ? 0.0 : slip,
                                             lateral ? slip : 0.0,
                                             0.0,
                                             0.0,
                                             at.speed,
                                             at.nominal_pressure});
        const double force = side * (lateral ? -s.Fy : s.Fx);
        peak = std::max(peak, force);
        if (!(peak > 0.0)) continue;
        found.worsen(kLeastLeft - force / peak, [&] {
          return fmt::format("the {} force turns around: {:.0f} % of its peak at {} and {:.0f} N",
                             lateral ? "side" : "longitudinal",
                             100.0 * force / peak,
                             lateral ? fmt::format("{:.0f} deg", slip / kDegree)
                                     : fmt::format("kappa {:.2f}", slip),
                             Fz);
        });
      }
    }
  return found;
}

/// Checks that the trail at zero slip angle is positive, so that the side force steers back.
Finding trail_is_positive(const Parameters& p, const Lattice& at) {
  const MagicFormula tire(p);
  Finding found;
  for (const double Fz : at.loads) {
    if (Fz < kLightest * p.FNOMIN) continue;
    const double t = tire.evaluate({Fz, 0.0, 0.0, 0.0, 0.0, at.speed, at.nominal_pressure}).t;
    found.worsen(-t / p.UNLOADED_RADIUS, [&] {
      return fmt::format(
          "the pneumatic trail is {:.3g} mm at {:.0f} N: the aligning moment has the "
          "wrong sign",
          1e3 * t,
          Fz);
    });
  }
  return found;
}

/// Checks the overturning moment against half of the radius as the lever of the load.
Finding overturning_in_bounds(const Parameters& p, const Lattice& at) {
  const MagicFormula tire(p);
  Finding found;
  for (const double Fz : at.loads)
    for (const double alpha : {-at.alpha, 0.0, at.alpha}) {
      const double lever =
          tire.evaluate({Fz, 0.0, alpha, 0.0, 0.0, at.speed, at.nominal_pressure}).Mx / Fz;
      found.worsen(std::abs(lever) / p.UNLOADED_RADIUS - kMostLever, [&] {
        return fmt::format(
            "the overturning moment is that of {:.0f} N at a lever of {:.0f} mm at "
            "{:.1f} deg, more than half of the radius",
            Fz,
            1e3 * lever,
            alpha / kDegree);
      });
    }
  return found;
}

/// Checks the side force by camber at zero slip angle over load and angle.
Finding camber_force_in_bounds(const Parameters& p, const Lattice& at) {
  constexpr double kAngle = 1.0 * kDegree;
  const MagicFormula tire(p);
  const auto Fy = [&](double Fz, double gamma) {
    return tire.evaluate({Fz, 0.0, 0.0, gamma, 0.0, at.speed, at.nominal_pressure}).Fy;
  };
  Finding found;
  for (const double Fz : at.loads) {
    const double share = std::abs(Fy(Fz, kAngle) - Fy(Fz, -kAngle)) / (2.0 * kAngle * Fz);
    found.worsen(share - kMostCamber, [&] {
      return fmt::format(
          "the camber stiffness is {:.3g} of the load a radian at {:.0f} N, that of a "
          "tire is at most some {:g}",
          share,
          Fz,
          kMostCamber);
    });
  }
  return found;
}

struct Point {
  double x, y;
};

/// The convex hull of points, counterclockwise [Andrew, Inf. Process. Lett. 9 (1979) 216].
std::vector<Point> hull_of(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  });
  const auto turn = [](const Point& o, const Point& a, const Point& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  };
  std::vector<Point> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Point& point : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0.0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Returns the distance from the origin to the boundary of a polygon in a direction (rad).
double reach(const std::vector<Point>& hull, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  double most = 0.0;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Point &a = hull[k], &b = hull[(k + 1) % hull.size()];
    const double across_a = c * a.y - s * a.x, across_b = c * b.y - s * b.x;
    if ((across_a > 0.0) == (across_b > 0.0)) continue;
    const double t = across_a / (across_a - across_b);
    most = std::max(most, c * (a.x + t * (b.x - a.x)) + s * (a.y + t * (b.y - a.y)));
  }
  return most;
}

/// Checks that the forces over all slips at a load form a nearly convex set. It compares the
/// largest force with the convex hull in kDirections directions.
Finding ellipse_is_convex(const Parameters& p, const Lattice& at) {
  constexpr int kAlphas = 61, kKappas = 61, kDirections = 64;
  const MagicFormula tire(p);
  Finding found;
  for (const double Fz : {at.loads.front(), at.loads[at.loads.size() / 2], at.loads.back()}) {
    std::vector<Point> forces;
    std::vector<double> farthest(kDirections, 0.0);
    std::vector<State> states;
    for (int i = 0; i < kAlphas; ++i)
      for (int k = 0; k < kKappas; ++k)  // points are denser where the forces are steep
        states.push_back({Fz,
                          at.kappa * std::pow(2.0 * k / (kKappas - 1) - 1.0, 3),
                          at.alpha * std::pow(2.0 * i / (kAlphas - 1) - 1.0, 3),
                          0.0,
                          0.0,
                          at.speed,
                          at.nominal_pressure});
    std::vector<SteadyState> answers(states.size());
    tire.evaluate(states, answers);
    for (const SteadyState& s : answers) {
      forces.push_back({s.Fx, s.Fy});
      const double turns = std::atan2(s.Fy, s.Fx) / (2.0 * std::numbers::pi) + 1.0;
      double& far = farthest[static_cast<std::size_t>(turns * kDirections) % kDirections];
      far = std::max(far, std::hypot(s.Fx, s.Fy));
    }
    const std::vector<Point> hull = hull_of(std::move(forces));
    for (int d = 0; d < kDirections; ++d) {
      const double angle = 2.0 * std::numbers::pi * (d + 0.5) / kDirections;
      const double whole = reach(hull, angle);
      if (!(whole > 0.0)) continue;
      const double share = farthest[static_cast<std::size_t>(d)] / whole;
      found.worsen(kConvex - share, [&] {
        return fmt::format(
            "the friction ellipse is dented: {:.0f} % of its convex hull {:.0f} deg "
            "from Fx, at {:.0f} N",
            100.0 * share,
            angle / kDegree,
            Fz);
      });
    }
  }
  return found;
}

Finding moment_returns(const Parameters& p, const Lattice& at) {
  constexpr int kSteps = 60;
  const MagicFormula tire(p);
  const double end = std::max(at.alpha, kLeastSweep);
  Finding found;
  for (const double Fz : at.loads)
    for (const double side : {-1.0, 1.0}) {
      if (Fz < kLightest * p.FNOMIN) continue;
      const auto Mz = [&](double alpha) {
        return tire.evaluate({Fz, 0.0, side * alpha, 0.0, 0.0, at.speed, at.nominal_pressure}).Mz;
      };
      double peak = 0.0, last = 0.0;
      for (int i = 0; i <= kSteps; ++i) {
        last = Mz(end * i / kSteps) - Mz(0.0);
        if (std::abs(last) > std::abs(peak)) peak = last;
      }
      if (!(std::abs(peak) > 1e-6 * p.FNOMIN * p.UNLOADED_RADIUS)) continue;
      found.worsen(std::abs(last / peak) - kReturned, [&] {
        return fmt::format(
            "the aligning moment does not return to zero: {:.3g} N m of {:.3g} at "
            "{:.0f} deg and {:.0f} N",
            last,
            peak,
            side * end / kDegree,
            Fz);
      });
    }
  return found;
}

/// A polynomial factor that has to stay positive. It is a function of x = (p - NOMPRES) / NOMPRES,
/// or of gamma.
struct Factor {
  const char* words;
  Condition condition;
  std::vector<const char*> coefficients;
  double (*value)(const Parameters&, double);
};

const std::vector<Factor>& factors() {
  using P = Parameters;
  using enum Condition;
  static const std::vector<Factor> all = {
      {"of vertical stiffness",
       pressure,
       {"PFZ1"},
       [](const P& p, double x) { return 1.0 + p.PFZ1 * x; }},
      {"of slip stiffness",
       pressure,
       {"PPX1", "PPX2"},
       [](const P& p, double x) { return 1.0 + p.PPX1 * x + p.PPX2 * x * x; }},
      {"of longitudinal friction",
       pressure,
       {"PPX3", "PPX4"},
       [](const P& p, double x) { return 1.0 + p.PPX3 * x + p.PPX4 * x * x; }},
      {"of cornering stiffness",
       pressure,
       {"PPY1"},
       [](const P& p, double x) { return 1.0 + p.PPY1 * x; }},
      {"of the load of the largest cornering stiffness",
       pressure,
       {"PPY2"},
       [](const P& p, double x) { return 1.0 + p.PPY2 * x; }},
      {"of lateral friction",
       pressure,
       {"PPY3", "PPY4"},
       [](const P& p, double x) { return 1.0 + p.PPY3 * x + p.PPY4 * x * x; }},
      {"of camber stiffness",
       pressure,
       {"PPY5"},
       [](const P& p, double x) { return 1.0 + p.PPY5 * x; }},
      {"of the trail", pressure, {"PPZ1"}, [](const P& p, double x) { return 1.0 - p.PPZ1 * x; }},
      {"of the residual torque",
       pressure,
       {"PPZ2"},
       [](const P& p, double x) { return 1.0 + p.PPZ2 * x; }},
      {"of longitudinal friction",
       camber,
       {"PDX3"},
       [](const P& p, double x) { return 1.0 - p.PDX3 * x * x; }},
      {"of lateral friction",
       camber,
       {"PDY3"},
       [](const P& p, double x) { return 1.0 - p.PDY3 * x * x; }},
      {"of cornering stiffness",
       camber,
       {"PKY3"},
       [](const P& p, double x) { return 1.0 - p.PKY3 * std::abs(x); }},
      {"of the load of the largest cornering stiffness",
       camber,
       {"PKY5"},
       [](const P& p, double x) { return 1.0 + (p.PKY2 != 0.0 ? p.PKY5 / p.PKY2 : 0.0) * x * x; }},
      {"of the trail's stiffness factor",
       camber,
       {"QBZ4", "QBZ5"},
       [](const P& p, double x) { return 1.0 + p.QBZ4 * x + p.QBZ5 * std::abs(x); }},
      {"of the trail",
       camber,
       {"QDZ3", "QDZ4"},
       [](const P& p, double x) { return 1.0 + p.QDZ3 * x + p.QDZ4 * x * x; }},
  };
  return all;
}

Finding stays_positive(const Parameters& p, const Lattice& at, const Factor& factor) {
  const bool of_pressure = factor.condition == Condition::pressure;
  Finding found;
  for (const double x : of_pressure ? at.pressures : at.cambers) {
    const double value = factor.value(p, of_pressure ? x / p.NOMPRES - 1.0 : x);
    if (value > 0.0) continue;
    found.worsen(1e-9 - value, [&] {
      return fmt::format("the {} factor {} is {:.3g} at {}",
                         name_of(factor.condition),
                         factor.words,
                         value,
                         of_pressure ? fmt::format("{:.2f} bar", x / kBar)
                                     : fmt::format("{:.1f} deg", x / kDegree));
    });
  }
  return found;
}

struct Row {
  std::string name;
  std::function<Finding(const Parameters&)> look;
  // Prefixes of the coefficients that may cause a violation.
  std::vector<std::string_view> suspects;
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

/// Finds the coefficients that cause a violation. It sets one coefficient after the other to its
/// neutral value and keeps the change that reduces the severity most.
std::vector<std::string> causes(const Row& row, Parameters p, double severity) {
  std::vector<std::string> named;
  while (severity > 0.0 && named.size() < kNamed) {
    const ParameterField* best = nullptr;
    double least = severity;
    for (const ParameterField& field : parameter_fields()) {
      const double neutral = neutral_value(field.name);
      const bool is_suspect =
          std::any_of(row.suspects.begin(), row.suspects.end(), [&](auto prefix) {
            return field.name.starts_with(prefix);
          });
      if (!is_suspect || p.*field.member == neutral) continue;
      Parameters without = p;
      without.*field.member = neutral;
      const double left = row.look(without).severity;
      if (left < least) {
        least = left;
        best = &field;
      }
    }
    // No coefficient reduces the severity by more than 10 %.
    if (!best || !(least < 0.9 * severity)) break;
    named.emplace_back(best->name);
    p.*best->member = neutral_value(best->name);
    severity = least;
  }
  return named;
}

std::vector<Row> rows(const Parameters& p, const Lattice& at) {
  using S = SteadyState;
  std::vector<Row> all;
  const auto add = [&](std::string name, auto look, std::vector<std::string_view> suspects) {
    all.push_back({std::move(name), look, std::move(suspects)});
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
    const Answer mu = lateral ? &S::muy : &S::mux;
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

std::vector<SanityFault> sanity_faults(const Parameters& parameters, const DataRange& range) {
  const Parameters p = without_ranges(parameters);
  const Lattice at = lattice_over(range, p);
  std::vector<SanityFault> faults;
  for (const Row& row : rows(p, at)) {
    const Finding found = row.look(p);
    if (found.severity > 0.0)
      faults.push_back({row.name, found.words, causes(row, p, found.severity)});
  }
  return faults;
}

}  // namespace latsch::magic_formula
