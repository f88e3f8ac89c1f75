// SPDX-License-Identifier: Apache-2.0
// Example 5. Rolls a flexible-ring tire over a cleat at a constant axle height and prints the hub
// force. Any other rolling tire (Magic Formula, rigid ring) has the same interface,
// models/tire/tire.h.
//
//   target_link_libraries(roll PRIVATE latsch::ring_tire)
//
//   $ 5_roll_a_ring_tire studies/ring_tires/passenger_205_55R16.toml
//
// It prints time (s), Fx and Fz (N) in the axes of the wheel carrier, every 2 ms.
#include <latsch/base/document.h>
#include <latsch/models/ring_tire/description/ring_reader.h>
#include <latsch/models/ring_tire/ring/ring_tire.h>
#include <latsch/models/road/profile_road.h>

#include <cstdio>
#include <exception>

using namespace latsch;

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: 5_roll_a_ring_tire RING.toml\n");
    return 2;
  }
  ring_tire::RingTire tire(ring_tire::read_ring_tire(Document::read(argv[1]).root()));

  constexpr double kSpeed = 10.0;       // m/s
  constexpr double kDeflection = 0.02;  // m, vertical deflection of the tire at rest
  constexpr double kStep = 0.5e-3;      // s, time step of the simulation
  // A cleat 15 mm high and 30 mm long lies across the road, half a meter ahead of the wheel's start.
  const road::ProfileRoad road(
      {.along = road::cleat_profile(0.015, 0.03, 0.0), .origin = {0.5, 0.0}});

  WheelMotion motion;
  motion.center.z() = tire.free_radius() - kDeflection;
  const auto rest = tire.settle(motion, road, 0.0);
  if (!rest) {
    std::fprintf(stderr, "%s\n", rest.failure().reason.c_str());
    return 1;
  }
  std::printf("at rest: Fz = %.0f N\n", rest->force.z());

  motion.velocity.x() = kSpeed;
  // rad/s, close to the angular velocity of free rolling
  motion.spin_rate = kSpeed / (tire.free_radius() - kDeflection / 3.0);
  for (int i = 1; i <= 200; ++i) {
    const double time = i * kStep;
    motion.center.x() = kSpeed * time;
    motion.spin = motion.spin_rate * time;
    const auto hub = tire.advance(motion, road, time, kStep);
    if (!hub) {
      std::fprintf(stderr, "at %.4f s: %s\n", time, hub.failure().reason.c_str());
      return 1;
    }
    if (i % 4 == 0) std::printf("%.3f %8.0f %8.0f\n", time, hub->force.x(), hub->force.z());
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
