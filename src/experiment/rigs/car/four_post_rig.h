// SPDX-License-Identifier: Apache-2.0
// A car on four posts: its tires stand on plates that actuators move up and down; wheels do not
// turn. The plates follow heights recorded in a laboratory, or a sweep:
//   h = A(t) sin φ(t),  φ' = 2π f(t), where f grows by the same factor every second; A = v/(2π f),
// but at most the amplitude: above the frequency at which both are equal the plates move at one
// peak velocity v. The sweep begins below its lowest frequency and ends above its highest one: the
// plates take a tenth of the duration to start and a twentieth to stop, and move fully from `from`
// to `to`. With the default velocity the tires of a light race car stay on their plates; at 0.1 m/s
// they leave them.
#pragma once

#include <array>
#include <vector>

#include "base/result.h"
#include "experiment/rigs/car/car_record.h"
#include "measurement/channels.h"
#include "models/car/car.h"

namespace latsch::experiment {

struct FourPostTest {
  std::vector<double> times;                   // s, equally spaced
  std::array<std::vector<double>, 4> heights;  // m, FL, FR, RL, RR
  double step = 2e-4, sample_step = 1e-3;      // s
  /// Time, s, for which the posts rest at their final heights until the car is at rest again.
  double still = 0.0;
};

/// Directions in which a sweep moves the four posts.
enum class PostMode { heave, pitch, roll, warp };
/// Returns the signs of FL, FR, RL, RR; FL goes up first.
std::array<double, 4> signs_of(PostMode mode);

struct PostSweep {
  PostMode mode = PostMode::heave;
  double from = 0.5, to = 30.0;  // Hz
  double duration = 20.0;        // s
  double amplitude = 3e-3;       // m
  double velocity = 0.03;        // m/s
};
FourPostTest sweep_test(const PostSweep& sweep, double sample_step);
/// Returns the sweep's frequency at a time, Hz.
double frequency_at(const PostSweep& sweep, double time);

/// Results of two runs: in the second one the displacement of the plates is reversed. Half the
/// difference of both contains only odd powers of the displacement.
struct BothWays {
  Channels up, down;
};

/// Records the channels of car_record.h and the heights of the posts, "post_FL" ...
Result<Channels> run(car::Car& car, const FourPostTest& test, const CarWatcher& watch = {});
/// Runs the test with the heights and with reversed displacements. Both runs end with the posts at
/// rest for kStill, so that the car comes to rest.
Result<BothWays> run_both_ways(car::Car& car, const FourPostTest& test);
/// s; a shorter time would cut off the decaying vibration, a longer one takes more computing time
constexpr double kStill = 3.0;

}  // namespace latsch::experiment
