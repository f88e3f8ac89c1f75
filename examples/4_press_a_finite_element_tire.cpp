// SPDX-License-Identifier: Apache-2.0
// Example 4. Inflates a finite-element tire, presses it on flat ground and computes its lowest vibration modes on the ground.
//
//   target_link_libraries(press PRIVATE latsch::fe_tire)
//
//   $ 4_press_a_finite_element_tire studies/tires/passenger_205_55R16.toml
//
// It prints force and footprint at three deflections, then the frequencies.
#include <latsch/base/document.h>
#include <latsch/models/fe_tire/analysis/fe_tire.h>
#include <latsch/models/fe_tire/description/tire_description.h>

#include <cstdio>
#include <exception>

using namespace latsch;

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: 4_press_a_finite_element_tire TIRE.toml\n");
    return 2;
  }
  const fe_tire::TireDescription description = fe_tire::read_tire(Document::read(argv[1]).root());
  fe_tire::FeTire tire(description);
  const auto inflated = tire.inflate(description.pressure);
  if (!inflated) {  // a failed simulation is a value, not an exception
    std::fprintf(stderr, "%s\n", inflated.failure().reason.c_str());
    return 1;
  }
  std::printf("inflated at %.2f bar: radius %.1f mm, section width %.1f mm\n",
              description.pressure / 1e5,
              inflated->radius * 1e3,
              inflated->width * 1e3);
  const auto states = tire.press(*inflated, fe_tire::Ground{}, {0.005, 0.010, 0.020});
  if (!states) {
    std::fprintf(stderr, "%s\n", states.failure().reason.c_str());
    return 1;
  }
  for (const fe_tire::TireState& state : *states) {
    const fe_tire::Standing standing = tire.stand(state);
    std::printf("%4.0f mm: %6.0f N, footprint %.0f x %.0f mm\n",
                standing.deflection * 1e3,
                standing.force.z(),
                standing.patch.length * 1e3,
                standing.patch.width * 1e3);
  }
  const auto modes = tire.modes(states->back(), 6);
  if (!modes) {
    std::fprintf(stderr, "%s\n", modes.failure().reason.c_str());
    return 1;
  }
  for (const fe_tire::Mode& mode : *modes)
    std::printf("%6.1f Hz  %s\n", mode.frequency, mode.label().c_str());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
