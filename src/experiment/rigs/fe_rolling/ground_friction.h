// SPDX-License-Identifier: Apache-2.0
// Friction of a finite-element tire with the ground on which it rolls or stands.
//
// A test's own friction is a coefficient; else that of the tire's file is taken, which may depend
// on pressure and sliding speed (description/rolling_friction.h). If friction falls with the speed
// faster than the tread's shear stiffness G holds it, a point slides in jerks and several steady
// states exist: a tread that passes with the speed V does not keep still below d(mu p)/dw =
// -kStable G/V, because a traction t moves it over the ground at some V t/G. The law is limited to
// that slope, and the notes of the test say so. A tire that stands has the coefficient of its test
// alone.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "experiment/rigs/fe_tire/tire_rig.h"
#include "models/fe_tire/description/rolling_friction.h"

namespace latsch::experiment {

/// Friction of a tire if neither the test nor the tire's file states one.
constexpr double kAssumedFriction = 1.0;

/// Returns the law of friction of a test in which the tire rolls.
fe_tire::RollingFriction friction_of(const TireRig& rig, std::optional<double> of_test);
/// Returns the law with which the tire rolls at a pressure, Pa, and a speed, m/s: nowhere does it
/// fall faster than is stable.
fe_tire::RollingFriction stable_friction(const TireRig& rig,
                                         const fe_tire::RollingFriction& law,
                                         double pressure,
                                         double speed);
/// Returns stable_friction() at a pressure, Pa, as a function of the speed that needs no rig.
std::function<fe_tire::RollingFriction(double speed)> friction_by_speed(
    const TireRig& rig, const fe_tire::RollingFriction& law, double pressure);
/// Says which friction a tire has in a test that states none, and where it is limited at the test's
/// pressure, Pa, and highest speed, m/s.
std::string friction_in_words(const TireRig& rig, double pressure, double speed);
/// Says which friction a standing tire has although its file states another one for rolling; empty
/// if the file states no friction, or one that depends on neither pressure nor sliding speed.
std::string friction_at_rest_in_words(const TireRig& rig, double of_test);

}  // namespace latsch::experiment
