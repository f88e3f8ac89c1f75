// SPDX-License-Identifier: Apache-2.0
// The inflated tire that spins off the ground: growth by rotation, standing-wave speed, modes with
// and against the spin (spinning_modes.cpp).
//
//   SpinningTire spinning(tire);
//   auto grown = spinning.inflate(*tire.inflate(2.6e5), 90.0);       // rad/s
//   auto modes = spinning.modes(*grown, {}, 20);
//   auto wave  = spinning.standing_wave(*tire.inflate(2.6e5));
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/motion/rim_motion.h"

namespace latsch::fe_tire {

/// Direction in which a wave travels around the tire, seen from axes that do not spin. A mode of n
/// = 0, and one of a tire that does not spin, travels in none.
enum class Sense { none, with, against };
std::string name(Sense sense);  // "with", "against", "-"

/// A mode about the spinning tire: u = Re(shape exp(i omega t)), axes that stand.
struct SpinningMode {
  double frequency = 0.0;          // Hz, seen from axes that do not spin (hub)
  double frequency_on_tire = 0.0;  // Hz, of a sensor that spins with the tire
  Sense sense = Sense::none;
  int n = 0;  // waves around the circumference
  ModeType type = ModeType::other;
  int order = 1;              // among modes of the same n, type and sense
  Eigen::Matrix3Xcd shape;    // [3 x nodes], sector frames; real and imaginary part, a quarter of a
                              // period apart, have unit mass together with the rim
  std::string label() const;  // "radial n=2 with"
};

/// Lowest speed at which a wave stands still beside the wheel, so that nothing holds it: K(n) -
/// Omega^2 W(n) of the inflated tire that grows with the speed is singular.
struct StandingWave {
  double speed = 0.0;   // rad/s
  double radius = 0.0;  // m, of the tire that spins at this speed
  int n = 0;            // waves around the circumference
  /// Greatest n for which a sector is at most one radian of the wave. A standing wave with a
  /// greater n depends on the number of sectors.
  int resolved = 0;
};

class SpinningTire {
 public:
  /// Keeps a reference to the tire, and to its materials as they are now.
  explicit SpinningTire(FeTire& tire);

  /// Returns the inflated tire as it spins, grown by its rotation. `at_rest`: inflated without
  /// spin; speed: rad/s about +y. A Failure names the speed and the standing-wave speed if the
  /// speed is above it, or says that the tire has no equilibrium or grows by more than a tenth of
  /// its section height.
  Result<Inflated> inflate(const Inflated& at_rest, double speed);

  /// Computes the `count` lowest modes by their frequencies seen from axes that do not spin.
  /// Motions of a whole wheel with free rim below 0.5 Hz are left out. A Failure says if no wave is
  /// held at this speed.
  Result<std::vector<SpinningMode>> modes(const Inflated& spinning, const Rim& rim, int count);

  /// Finds the standing-wave speed of the tire inflated without spin. A Failure says why there is
  /// none.
  Result<StandingWave> standing_wave(const Inflated& at_rest);

  /// Returns the failure that a speed (rad/s) above a standing wave gives.
  static Failure above(const StandingWave& wave, double speed);

 private:
  FeTire& tire_;
};

}  // namespace latsch::fe_tire
