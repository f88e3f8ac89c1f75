// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/rolling_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "experiment/rigs/fe_rolling/patch_limits.h"
#include "experiment/rigs/fe_tire/deflection_for_load.h"
#include "models/fe_tire/motion/spinning_tire.h"
#include "models/fe_tire/rolling/rolling_forces.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::experiment {
namespace {

using fe_tire::RollingCase;
using fe_tire::RollingRates;
using fe_tire::RollingState;

/// First guess of the deflection, relative to the radius.
constexpr double kFirstGuess = 0.05;
/// Effective radius of a tire without friction: its share of the deflection below the inflated
/// radius. Tires with a stiff belt have about a third.
constexpr double kEffective = 1.0 / 3.0;

/// Distances between states that are a similar effort: of slip and slip angle, camber, and load,
/// speed, relative.
constexpr double kSlipScale = 0.03, kCamberScale = 0.1, kRelative = 0.3, kTurnScale = 0.05;

/// Share at which distances from the state found last count: its tangent is still kept.
constexpr double kFromLast = 0.5;

double distance(const RollingCase& a, const RollingCase& b) {
  const auto slip = [](const RollingCase& c) {
    return c.spin / (c.speed * std::cos(c.slip_angle)) * c.height;
  };
  return std::abs(std::tan(a.slip_angle) - std::tan(b.slip_angle)) / kSlipScale +
         std::abs(slip(a) - slip(b)) / kSlipScale + std::abs(a.camber - b.camber) / kCamberScale +
         std::abs(a.turn_slip - b.turn_slip) / kTurnScale +
         std::abs(a.speed / b.speed - 1.0) / kRelative +
         std::abs(*a.load / *b.load - 1.0) / kRelative;
}

std::string in_words(const RollingRow& row, std::size_t number, std::size_t of) {
  return fmt::format(
      "state {} of {} ({:.5g} N, {:.4g} km/h, alpha {:.4g} deg, kappa {}, camber "
      "{:.4g} deg)",
      number + 1,
      of,
      row.load,
      3.6 * row.speed,
      row.alpha * 180.0 / M_PI,
      row.kappa ? fmt::format("{:g}", *row.kappa) : std::string("free"),
      row.camber * 180.0 / M_PI);
}

/// The states found at one pressure, from which others start.
class FlatTrack {
 public:
  FlatTrack(TireRig& rig,
            const fe_tire::Inflated& inflated,
            const RollingTest& test,
            fe_tire::TireSlopes* slopes)
      : rig_(rig),
        pressure_(inflated.pressure),
        states_friction_(test.friction.has_value()),
        states_pressure_(test.pressure.has_value()),
        friction_(friction_of(rig, test.friction)),
        slopes_(slopes),
        curvature_(test.drum_radius > 0.0 ? 1.0 / test.drum_radius : 0.0),
        rolling_(rig.tire()) {
    rolling_.set_history(rig.losses(), inflated);
  }

  /// Finds the rates of a row's state, which find() has found.
  Status differentiate(const RollingRow& row, RolledState& rolled) {
    const auto free = rates_of_free_wheel(row);
    if (!free) return free.failure();
    const double R_e = rolled.effective_radius, spin = row.speed / R_e;
    std::vector<double> shares;  // relative changes of the free wheel's spin
    for (const RollingRates& rates : *free) {
      shares.push_back(rates.spin / spin);
      rolled.effective_radius_rates.push_back(-R_e * shares.back());
    }
    auto rates = !row.kappa && is_straight(row) ? free : rates_of(row, rolled.state, shares);
    if (!rates) return rates.failure();
    rolled.rates = *std::move(rates);
    return {};
  }

  /// Finds the state of a row. `slip` receives kappa against the free wheel, and `R_e` that
  /// wheel's effective radius, m.
  Result<RollingState> find(const RollingRow& row, double& slip, double& R_e) {
    RollingCase of = case_of(row);
    if (friction_.at_rest == 0.0) {
      slip = 0.0;
      of.drive.reset();
      auto found = from_nearest(of);
      if (found) R_e = row.speed / found->of.spin;
      return found;
    }
    const auto free = free_wheel(row);
    if (!free) return free.failure();
    const double V_x = row.speed;
    R_e = V_x / free->of.spin;
    of.height = free->of.height;
    of.spin = free->of.spin;
    if (row.kappa) {
      of.spin = (1.0 + *row.kappa) * V_x / R_e;
      of.drive.reset();
    } else if (is_straight(row)) {
      slip = 0.0;
      return free;
    }
    const auto found = from_nearest(of);
    if (found) slip = found->of.spin * R_e / V_x - 1.0;
    return found;
  }

  /// Distance of a row's state from the nearest one that is known, or less from that found last.
  double distance_to(const RollingRow& row) const {
    RollingCase of = case_of(row);
    double least = std::numeric_limits<double>::infinity();
    for (const RollingState& state : found_) {
      of.height = state.of.height;
      of.spin = (1.0 + row.kappa.value_or(0.0)) * row.speed / of.height;
      RollingCase there = state.of;
      there.load = state.forces.force.z();
      const double share = &state == &found_.back() ? kFromLast : 1.0;
      least = std::min(least, share * distance(of, there));
    }
    return found_.empty() ? 0.0 : least;
  }

 private:
  static bool is_straight(const RollingRow& row) {
    return row.alpha == 0.0 && row.turn_slip == 0.0;
  }

  RollingCase case_of(const RollingRow& row) const {
    RollingCase of;
    of.speed = row.speed / std::cos(row.alpha);
    of.slip_angle = row.alpha;
    of.camber = row.camber;
    of.turn_slip = row.turn_slip;
    of.curvature = curvature_;
    of.load = row.load;
    of.drive = 0.0;
    of.friction = stable_friction(rig_, friction_, pressure_, of.speed);
    return of;
  }

  /// Returns the free wheel, straight ahead, at the row's load, speed and camber.
  Result<RollingState> free_wheel(const RollingRow& row) {
    RollingRow straight = row;
    straight.kappa.reset();
    straight.alpha = straight.turn_slip = 0.0;
    for (const auto& [known, at] : free_)
      if (known.load == row.load && known.speed == row.speed && known.camber == row.camber)
        return found_[at];
    auto found = from_nearest(case_of(straight));
    if (found) free_.emplace_back(straight, found_.size() - 1);
    return found;
  }

  Result<RollingState> from_nearest(RollingCase of) {
    if (!start_) {
      const auto pressed = press(*of.load, of.camber);
      if (!pressed) return pressed.failure();
      start_ = rolling_.start(*pressed);
      radius_ = pressed->inflated->radius;
    }
    const RollingState* from = &*start_;
    double least = std::numeric_limits<double>::infinity();
    for (const RollingState& state : found_) {
      // A wheel with a slip may be locked, and a tire that slides as a whole does not tell how its
      // drive depends on the spin: a free wheel is found from free wheels alone.
      if (of.drive && !state.of.drive) continue;
      RollingCase there = state.of, here = of;
      there.load = state.forces.force.z();
      if (!(here.height > 0.0)) here.height = there.height;
      if (!(here.spin > 0.0)) here.spin = there.spin * here.speed / there.speed;
      const double d = distance(here, there);
      if (d < least) {
        least = d;
        from = &state;
      }
    }
    if (!(of.height > 0.0)) of.height = from->of.height;
    const double V_x = of.speed * std::cos(of.slip_angle);
    if (of.spin == 0.0 && of.drive) of.spin = V_x / effective(of.height);
    if (!of.drive && friction_.at_rest == 0.0) of.spin = V_x / effective(of.height);
    auto found = rolling_.roll(*from, of);
    if (found) found_.push_back(*found);
    return found;
  }

  /// Returns the rates of a state whose spin, if it is stated, changes by these shares.
  Result<std::vector<RollingRates>> rates_of(const RollingRow& row,
                                             const RollingState& state,
                                             const std::vector<double>& shares) {
    std::vector<fe_tire::TireSlopes::RollsWith> with(slopes_->variables());
    for (int k = 0; k < slopes_->variables(); ++k) {
      if (!shares.empty()) with[k].spin = shares[k];
      if (states_friction_) continue;
      if (const auto laws = slopes_->friction(k)) {
        const auto stable = [&](const fe_tire::RollingFriction& law) {
          return stable_friction(rig_, law, pressure_, state.of.speed);
        };
        with[k].friction.emplace(stable(laws->first), stable(laws->second));
      }
    }
    return slopes_->of_rolling(rolling_, state, with, !states_pressure_ && !row.pressure);
  }

  /// Returns the rates of the row's free wheel.
  Result<std::vector<RollingRates>> rates_of_free_wheel(const RollingRow& row) {
    const auto free = free_wheel(row);
    if (!free) return free.failure();
    for (const auto& [known, rates] : free_rates_)
      if (known.load == row.load && known.speed == row.speed && known.camber == row.camber)
        return rates;
    auto rates = rates_of(row, *free, {});
    if (rates) free_rates_.emplace_back(row, *rates);
    return rates;
  }

  double effective(double height) const { return radius_ - kEffective * (radius_ - height); }

  Result<fe_tire::TireState> press(double load, double camber) {
    const auto& inflated = rig_.inflated(pressure_);
    if (!inflated) return inflated.failure();
    return load_to_force(rig_.tire(),
                         *inflated,
                         load,
                         kFirstGuess * inflated->radius,
                         {},
                         {camber, fe_tire::FeTire::Poses::any});
  }

  TireRig& rig_;
  double pressure_;
  // True if the test states them: those of the tire's file then have no effect.
  bool states_friction_, states_pressure_;
  fe_tire::RollingFriction friction_;
  fe_tire::TireSlopes* slopes_;  // null: none are asked for
  std::vector<std::pair<RollingRow, std::vector<RollingRates>>> free_rates_;
  double curvature_, radius_ = 0.0;
  fe_tire::RollingTire rolling_;
  std::optional<RollingState> start_;
  std::vector<RollingState> found_;
  std::vector<std::pair<RollingRow, std::size_t>> free_;  // row, index in found_
};

/// Returns why no tire rolls so fast; nothing if it does.
Status check_speed(TireRig& rig, double pressure, double speed) {
  const auto spinning = rig.spinning(pressure, {speed, true});
  return spinning ? Status{} : Status{spinning.failure()};
}

/// Finds all states at one pressure, always going on to the row nearest to a state that is known.
/// Sweeps are thereby followed from their middle to one end, then to the other.
Status roll_at(TireRig& rig,
               const RollingTest& test,
               double pressure,
               std::vector<std::size_t> open,
               std::vector<RolledState>& states,
               const RollingProgress& progress,
               fe_tire::TireSlopes* slopes) {
  double fastest = 0.0;
  for (const std::size_t k : open) fastest = std::max(fastest, test.rows[k].speed);
  if (const Status done = check_speed(rig, pressure, fastest); !done) return done;
  const auto& inflated = rig.inflated(pressure);
  if (!inflated) return inflated.failure();
  FlatTrack track(rig, *inflated, test, slopes);
  const fe_tire::LossMeter meter(rig.tire(), rig.losses(), *inflated);
  while (!open.empty()) {
    const auto next = std::ranges::min_element(
        open, {}, [&](std::size_t k) { return track.distance_to(test.rows[k]); });
    const std::size_t k = *next;
    open.erase(next);
    auto found = track.find(test.rows[k], states[k].kappa, states[k].effective_radius);
    if (!found)
      return Failure{in_words(test.rows[k], k, test.rows.size()) + ": " + found.failure().reason};
    if (const Status fits = check_drum(*found, test.drum_radius); !fits)
      return Failure{in_words(test.rows[k], k, test.rows.size()) + ": " + fits.failure().reason};
    states[k].losses = meter.measure(found->u, found->alpha, found->of.spin);
    states[k].state = *std::move(found);
    if (slopes)
      if (const Status done = track.differentiate(test.rows[k], states[k]); !done)
        return Failure{in_words(test.rows[k], k, test.rows.size()) + ": " + done.failure().reason};
    if (progress) progress(states, k);
  }
  return {};
}

}  // namespace

double fastest(const std::vector<RollingRow>& rows) {
  double speed = 0.0;
  for (const RollingRow& row : rows) speed = std::max(speed, row.speed);
  return speed;
}

double highest_pressure(const RollingTest& test, double own) {
  const double usual = test.pressure.value_or(own);
  double pressure = test.rows.empty() ? usual : 0.0;
  for (const RollingRow& row : test.rows)
    pressure = std::max(pressure, row.pressure.value_or(usual));
  return pressure;
}

RollingPatch patch_of(const RollingState& state) { return patch_of(state.patch); }

RollingPatch patch_of(const std::vector<fe_tire::RollingPatchPoint>& points) {
  Eigen::Vector2d least = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d most = -least;
  double load = 0.0, sticking = 0.0;
  for (const fe_tire::RollingPatchPoint& point : points) {
    least = least.cwiseMin(Eigen::Vector2d(point.x, point.y));
    most = most.cwiseMax(Eigen::Vector2d(point.x, point.y));
    load += point.pressure * point.area;
    if (point.sticks) sticking += point.pressure * point.area;
  }
  if (!(load > 0.0)) return {};
  return {most.x() - least.x(), most.y() - least.y(), sticking / load};
}

Channels channels_of(const std::vector<RolledState>& states,
                     const std::vector<fe_tire::LossMaterials::Owner>& owners) {
  Channels channels;
  const auto add_rolled = [&](const std::string& name, const char* unit, const auto& value) {
    std::vector<double> values;
    for (const RolledState& rolled : states) values.push_back(value(rolled));
    channels.add({name, unit, std::move(values)});
  };
  const auto add = [&](const char* name, const char* unit, const auto& value) {
    add_rolled(name, unit, [&](const RolledState& rolled) { return value(rolled.state); });
  };
  using State = const RollingState&;
  add("alpha", "rad", [](State s) { return s.of.slip_angle; });
  add_rolled("kappa", "1", [](const RolledState& s) { return s.kappa; });
  add("gamma", "rad", [](State s) { return s.of.camber; });
  add("phit", "1/m", [](State s) { return s.of.turn_slip; });
  add("Vx", "m/s", [](State s) { return s.of.speed * std::cos(s.of.slip_angle); });
  add("p", "Pa", [](State s) { return s.pressure; });
  add("Fx", "N", [](State s) { return s.forces.force.x(); });
  add("Fy", "N", [](State s) { return s.forces.force.y(); });
  add("Fz", "N", [](State s) { return s.forces.force.z(); });
  add("Mx", "N m", [](State s) { return s.forces.moment.x(); });
  add("My", "N m", [](State s) { return s.forces.moment.y(); });
  add("Mz", "N m", [](State s) { return s.forces.moment.z(); });
  add("omega", "rad/s", [](State s) { return s.of.spin; });
  add("R_e", "m", [](State s) { return s.of.speed * std::cos(s.of.slip_angle) / s.of.spin; });
  add("R_l", "m", [](State s) { return s.loaded_radius(); });
  add("drive", "N m", [](State s) { return s.forces.drive; });
  add_rolled("loss_rubber", "W", [](const RolledState& s) { return s.losses.rubber; });
  add_rolled("loss_cords", "W", [](const RolledState& s) { return s.losses.cords; });
  add("loss_friction", "W", [](State s) { return s.forces.friction_power; });
  add_rolled("rolling_resistance", "N", [](const RolledState& s) {
    return (s.losses.rubber + s.losses.cords + s.state.forces.friction_power) / s.state.of.speed;
  });
  add("sticking", "1", [](State s) { return patch_of(s).sticking; });
  add("length", "m", [](State s) { return patch_of(s).length; });
  add("width", "m", [](State s) { return patch_of(s).width; });
  add_rolled("balance", "W", [](const RolledState& s) {
    return fe_tire::power_balance(s.state) - s.losses.rubber - s.losses.cords;
  });
  for (std::size_t k = 0; k < owners.size(); ++k)
    add_rolled(
        "loss." + owners[k].name, "W", [k](const RolledState& s) { return s.losses.parts[k]; });
  return channels;
}

Result<std::vector<RolledState>> roll_states(TireRig& rig,
                                             const RollingTest& test,
                                             const RollingProgress& found,
                                             fe_tire::TireSlopes* slopes) {
  slopes = known_rates(rig, test, slopes);
  std::vector<RolledState> states(test.rows.size());
  std::vector<std::pair<double, std::vector<std::size_t>>> groups;  // rows of each pressure
  const double own = test.pressure.value_or(rig.own_pressure());
  for (std::size_t k = 0; k < test.rows.size(); ++k) {
    const double pressure = test.rows[k].pressure.value_or(own);
    const auto group = std::ranges::find(groups, pressure, [](const auto& g) { return g.first; });
    if (group == groups.end())
      groups.push_back({pressure, {k}});
    else
      group->second.push_back(k);
  }
  for (const auto& [pressure, rows] : groups) {
    const Status done = roll_at(rig, test, pressure, rows, states, found, slopes);
    if (!done) return done.failure();
  }
  return states;
}

fe_tire::TireSlopes* known_rates(const TireRig& rig,
                                 const RollingTest& test,
                                 fe_tire::TireSlopes* slopes) {
  const bool is_known = slopes != nullptr && rig.losses().is_elastic() &&
                        friction_of(rig, test.friction).at_rest > 0.0 && !slopes->move_shape();
  return is_known ? slopes : nullptr;
}

Eigen::MatrixXd slopes_by(const std::vector<RolledState>& states,
                          const std::function<double(const RolledState&, std::size_t)>& slope) {
  const std::size_t parameters = states.empty() ? 0 : states.front().rates.size();
  Eigen::MatrixXd slopes(std::ssize(states), static_cast<Eigen::Index>(parameters));
  for (std::size_t state = 0; state < states.size(); ++state)
    for (std::size_t k = 0; k < parameters; ++k)
      slopes(static_cast<Eigen::Index>(state), static_cast<Eigen::Index>(k)) =
          slope(states[state], k);
  return slopes;
}

bool has_rolling_slopes(const std::string& channel) {
  static constexpr std::string_view kKnown[] = {
      "Fx", "Fy", "Fz", "Mx", "My", "Mz", "omega", "R_l", "R_e"};
  return std::ranges::find(kKnown, channel) != std::end(kKnown);
}

ChannelSlopes slopes_of(const std::vector<RolledState>& states, double side) {
  if (states.empty() || states.front().rates.empty()) return {};
  const auto by = [&](double factor, const auto& of) {
    return slopes_by(states, [&](const RolledState& rolled, std::size_t k) {
      return factor * of(rolled.rates[k]);
    });
  };
  using Rates = const RollingRates&;
  return {{"Fx", by(1.0, [](Rates r) { return r.forces.force.x(); })},
          {"Fy", by(side, [](Rates r) { return r.forces.force.y(); })},
          {"Fz", by(1.0, [](Rates r) { return r.forces.force.z(); })},
          {"Mx", by(side, [](Rates r) { return r.forces.moment.x(); })},
          {"My", by(1.0, [](Rates r) { return r.forces.moment.y(); })},
          {"Mz", by(side, [](Rates r) { return r.forces.moment.z(); })},
          {"omega", by(1.0, [](Rates r) { return r.spin; })},
          {"R_l", slopes_by(states, [](const RolledState& rolled, std::size_t k) {
             return rolled.rates[k].height / std::cos(rolled.state.of.camber);
           })}};
}

Result<Channels> roll(TireRig& rig, const RollingTest& test, fe_tire::TireSlopes* slopes) {
  const auto states = roll_states(rig, test, {}, slopes);
  if (!states) return states.failure();
  const auto& losses = rig.losses();
  const Channels channels =
      channels_of(*states, losses.is_elastic() ? decltype(losses.owners){} : losses.owners);
  ChannelSlopes known = slopes_of(*states);
  if (known.empty()) return channels;
  known.emplace_back("drive", slopes_by(*states, [](const RolledState& rolled, std::size_t k) {
                       return rolled.rates[k].forces.drive;
                     }));
  known.emplace_back("loss_friction",
                     slopes_by(*states, [](const RolledState& rolled, std::size_t k) {
                       return rolled.rates[k].forces.friction_power;
                     }));
  known.emplace_back("R_e", slopes_by(*states, [](const RolledState& rolled, std::size_t k) {
                       const RollingCase& of = rolled.state.of;
                       return -of.speed * std::cos(of.slip_angle) / (of.spin * of.spin) *
                              rolled.rates[k].spin;
                     }));
  return with_slopes(channels, known);
}

}  // namespace latsch::experiment
