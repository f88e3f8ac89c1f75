// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/sanity/sanity_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace latsch::magic_formula {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kWider = 1.5;  // width of the checked range relative to that of the data
constexpr double kLeastFriction = 0.2, kMostFriction = 3.0;
// Rise of the friction with the load, as a share, below which it is ignored.
constexpr double kRise = 0.01;
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
// Largest camber stiffness over the load in the wrong direction, 1/rad. Conicity and ply steer of
// a tire tested at few cambers may look like a little of it.
constexpr double kMostAside = 0.2;
constexpr double kBar = 1e5;

/// An interval of 1.5 times the width of the data, with the same middle.
struct Widened {
  double from, to;

  std::vector<double> points(int count) const {
    if (!(to > from)) return {from};
    std::vector<double> all;
    all.reserve(count);
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

std::string place(double Fz, double gamma, double p) {
  return fmt::format(
      "{:.0f} N, camber {:.1f} deg, {:.2f} bar", Fz, gamma / kDegree + 0.0, p / kBar);
}

}  // namespace

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

WorstViolation keeps_sign(const Parameters& p,
                          const Lattice& at,
                          NumberOfState stiffness,
                          const char* name) {
  const MagicFormula tire(p);
  // Kya is negative, since alpha > 0 gives Fy < 0
  const double expected = stiffness == &SteadyState::Kya ? -1.0 : 1.0;
  const State nominal{p.FNOMIN, 0.0, 0.0, 0.0, 0.0, at.speed, at.nominal_pressure};
  const double size = std::max(std::abs(tire.evaluate(nominal).*stiffness), 1e-3 * p.FNOMIN);
  WorstViolation found;
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

WorstViolation friction_in_bounds(const Parameters& p,
                                  const Lattice& at,
                                  NumberOfState mu,
                                  const char* name) {
  const MagicFormula tire(p);
  WorstViolation found;
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

WorstViolation friction_falls(const Parameters& p,
                              const Lattice& at,
                              NumberOfState mu,
                              const char* name) {
  const MagicFormula tire(p);
  WorstViolation found;
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

WorstViolation force_keeps_direction(const Parameters& p, const Lattice& at, bool lateral) {
  constexpr int kSteps = 60;
  const MagicFormula tire(p);
  WorstViolation found;
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

WorstViolation trail_is_positive(const Parameters& p, const Lattice& at) {
  const MagicFormula tire(p);
  WorstViolation found;
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

WorstViolation overturning_in_bounds(const Parameters& p, const Lattice& at) {
  const MagicFormula tire(p);
  WorstViolation found;
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

WorstViolation camber_force_in_bounds(const Parameters& p, const Lattice& at) {
  constexpr double kAngle = 1.0 * kDegree;
  const MagicFormula tire(p);
  const auto Fy = [&](double Fz, double gamma) {
    return tire.evaluate({Fz, 0.0, 0.0, gamma, 0.0, at.speed, at.nominal_pressure}).Fy;
  };
  WorstViolation found;
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
  const double aside = (Fy(p.FNOMIN, kAngle) - Fy(p.FNOMIN, -kAngle)) / (2.0 * kAngle * p.FNOMIN);
  found.worsen(aside - kMostAside, [&] {
    return fmt::format(
        "a leaning tire is pushed away from its lean: dFy/dgamma is {:+.3g} of the load a radian "
        "at {:.0f} N and negative in the axes of a .tir (ISO), as dFy/dalpha is; if it was fitted, "
        "look at the axes and signs of the recording, above all those of gamma, alpha and Fy",
        aside,
        p.FNOMIN);
  });
  return found;
}

WorstViolation moment_returns(const Parameters& p, const Lattice& at) {
  constexpr int kSteps = 60;
  const MagicFormula tire(p);
  const double end = std::max(at.alpha, kLeastSweep);
  WorstViolation found;
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

}  // namespace latsch::magic_formula
