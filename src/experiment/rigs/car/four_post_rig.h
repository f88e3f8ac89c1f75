// SPDX-License-Identifier: Apache-2.0
// A car on four posts: its tires stand on plates that actuators move up and down; the wheels do not
// turn. The car is driven by the heights recorded in the laboratory, or by a sweep:
//   h = A(t) sin φ(t),  φ' = 2π f(t), f rising by the same factor every second;
//   A = v/(2π f), at most the amplitude: above the frequency at which both are equal the plates
//   move at constant peak velocity.
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
  double still = 0.0;  // s, during which the posts rest at their final heights until the car is at
                       // rest again
};

/// Directions in which a sweep moves the four posts.
enum class PostMode { heave, pitch, roll, warp };
/// Signs of FL, FR, RL, RR; FL goes up first.
std::array<double, 4> signs_of(PostMode mode);

struct PostSweep {
  PostMode mode = PostMode::heave;
  double from = 0.5, to = 30.0;  // Hz
  double duration = 20.0;        // s
  double amplitude = 3e-3;       // m
  double velocity = 0.1;         // m/s
};
FourPostTest sweep_test(const PostSweep& sweep, double sample_step);

/// Records the channels of car_record.h and the heights of the posts, "post_FL" ...
Result<Channels> run(car::Car& car, const FourPostTest& test, const CarWatcher& watch = {});

}  // namespace latsch::experiment
