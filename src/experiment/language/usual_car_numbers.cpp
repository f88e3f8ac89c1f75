// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/usual_car_numbers.h"

namespace latsch::experiment {
namespace {

using CarUnits = std::vector<const char*>;

const CarUnits kCarMasses{"kg", "g", "t", "lb"};
const CarUnits kCarLengths{"mm", "cm", "m", "in"};
const CarUnits kCarForces{"N", "kN", "lbf"};
const CarUnits kCarMoments{"N m", "kN m", "N mm"};
const CarUnits kSpeeds{"m/s", "mm/s", "km/h"};
const CarUnits kSprings{"N/mm", "N/m", "kN/mm", "lbf/in"};
const CarUnits kDampers{"N s/m", "N s/mm", "kN s/m"};
const CarUnits kInertias{"kg m^2", "kg mm^2", "kg cm^2", "t m^2"};
const CarUnits kTorsions{"N m/rad", "N m/deg", "kN m/deg"};

/// Names of an axle's tables. They are string literals, because the table of magnitudes stores
/// pointers.
struct AxleTables {
  const char *mass, *inertia, *spring, *third, *bar, *tire;
};

/// Adds the numbers of a spring unit with its damper.
void add_unit(const char* below, std::vector<UsualMagnitude>& all) {
  all.insert(
      all.end(),
      {{below, "stiffness", "a spring's stiffness", "N/mm", 0.05, 1, 3e3, 1e5, kSprings, true},
       {below, "damping", "a damper's constant", "N s/m", 0.5, 20, 1e5, 1e7, kDampers, true},
       {below, "inertance", "an inertance", "kg", 1e-3, 0.1, 3e3, 1e5, kCarMasses, true},
       {below, "damper", "a damper's rate", "m/s", 0, 0, 8, 50, kSpeeds, true, true},
       {below, "damper", "a damper's force", "kN", 0, 0, 60, 600, kCarForces, true, true},
       {below, "curve", "a spring's travel", "mm", 0, 0, 600, 3e3, kCarLengths, true, true},
       {below, "curve", "a spring's force", "kN", 0, 0, 300, 1e4, kCarForces, true, true}});
}

/// Adds the masses, springs and dampers of one axle.
void add_axle(const AxleTables& of, std::vector<UsualMagnitude>& all) {
  for (const char* key : {"upper_wishbone", "lower_wishbone", "pushrod", "trackrod", "rocker"})
    all.push_back({of.mass, key, "a link's mass", "kg", 1e-3, 0.02, 100, 1e3, kCarMasses});
  all.insert(
      all.end(),
      {{of.mass, "upright", "an upright's mass", "kg", 0.02, 0.2, 300, 3e3, kCarMasses},
       {of.mass, "wheel", "a wheel's mass", "kg", 0.02, 0.3, 300, 3e3, kCarMasses, true},
       {of.inertia, "upright", "an upright's inertia", "kg m^2", 1e-5, 3e-4, 50, 1e3, kInertias},
       {of.inertia, "wheel_spin", "a wheel's inertia", "kg m^2", 1e-4, 3e-3, 50, 1e3, kInertias},
       {of.inertia,
        "wheel_across",
        "a wheel's inertia",
        "kg m^2",
        1e-4,
        2e-3,
        50,
        1e3,
        kInertias,
        true},
       {of.bar, "stiffness", "an anti-roll bar's stiffness", "N/mm", 1e-3, 0.5, 1e4, 1e6, kSprings},
       {of.tire, "radius", "a tire's radius", "mm", 50, 100, 1500, 3e3, kCarLengths},
       {of.tire, "stiffness", "a tire's stiffness", "N/mm", 2, 20, 5e3, 1e5, kSprings},
       {of.tire, "damping", "a tire's damping", "N s/m", 0.1, 1, 2e4, 1e6, kDampers, true}});
  add_unit(of.spring, all);
  add_unit(of.third, all);
}

void add_bushings(std::vector<UsualMagnitude>& all) {
  for (const char* key : {"x", "y", "z"})
    all.push_back(
        {"bushing", key, "a joint's stiffness", "N/mm", 0.1, 10, 2e6, 1e9, kSprings, true});
  for (const char* key : {"about_x", "about_y", "about_z"})
    all.push_back(
        {"bushing", key, "a joint's stiffness", "N m/rad", 1e-6, 1e-3, 1e7, 1e10, kTorsions, true});
  all.push_back({"bushing",
                 "damping",
                 "a joint's damping over stiffness",
                 "ms",
                 1e-6,
                 1e-4,
                 50,
                 1e4,
                 {"ms", "s", "us"},
                 true});
}

}  // namespace

const std::vector<UsualMagnitude>& usual_of_cars() {
  static const std::vector<UsualMagnitude> all = [] {
    std::vector<UsualMagnitude> of{
        {"chassis", "mass", "a chassis' mass", "kg", 3, 20, 4e4, 3e5, kCarMasses},
        {"chassis", "inertia", "a chassis' inertia", "kg m^2", 0.05, 0.5, 1e6, 1e8, kInertias},
        {"chassis", "torsion", "a chassis' torsion", "N m/rad", 100, 2e3, 1e8, 1e10, kTorsions},
        {"aero", "area", "an area of air forces", "m^2", 0.01, 0.1, 15, 200, {"m^2", "cm^2"}},
        {"aero", "density", "the density of air", "kg/m^3", 0.05, 0.5, 1.6, 10, {}},
        {"aero", "drag", "a drag coefficient", "1", 0, 0, 3, 50, {}, true},
        {"aero", "floor", "a height of the floor", "mm", 0, 0, 1000, 1e4, kCarLengths, true, true},
        {"aero",
         "drag_height",
         "the height of the drag",
         "m",
         0,
         0,
         3,
         15,
         kCarLengths,
         true,
         true},
        {"aero", "map", "a coefficient of downforce", "1", 0, 0, 12, 200, {}, true, true},
        {"aero", "map", "a height of the floor", "mm", 0, 0, 1500, 1e4, kCarLengths, true, true},
    };
    add_axle({"front.mass",
              "front.inertia",
              "front.spring",
              "front.third",
              "front.anti_roll_bar",
              "front.spring_tire"},
             of);
    add_axle({"rear.mass",
              "rear.inertia",
              "rear.spring",
              "rear.third",
              "rear.anti_roll_bar",
              "rear.spring_tire"},
             of);
    add_bushings(of);
    of.insert(
        of.end(),
        {{"spring", "stiffness", "a spring's stiffness", "N/mm", 0.05, 1, 3e3, 1e5, kSprings},
         {"spring", "sprung_mass", "a sprung mass", "kg", 1, 10, 1e4, 1e5, kCarMasses},
         {"spring", "tire_stiffness", "a tire's stiffness", "N/mm", 2, 20, 5e3, 1e5, kSprings}});
    return of;
  }();
  return all;
}

const std::vector<UsualMagnitude>& usual_of_car_tests() {
  static const std::vector<UsualMagnitude> all = [] {
    std::vector<UsualMagnitude> of;
    for (const char* key : {"Fx", "Fy", "Fz", "Fx_L", "Fy_L", "Fz_L", "Fx_R", "Fy_R", "Fz_R"})
      of.push_back({"test", key, "a load on a wheel", "kN", 0, 0, 60, 250, kCarForces, true, true});
    for (const char* key : {"Mx", "My", "Mz", "Mx_L", "My_L", "Mz_L", "Mx_R", "My_R", "Mz_R"})
      of.push_back(
          {"test", key, "a moment on a wheel", "kN m", 0, 0, 20, 200, kCarMoments, true, true});
    for (const char* key : {"travel", "travel_L", "travel_R"})
      of.push_back(
          {"test", key, "a wheel's travel", "mm", 0, 0, 250, 1e3, kCarLengths, true, true});
    of.insert(
        of.end(),
        {{"test", "from", "a wheel's travel", "mm", 0, 0, 250, 1e3, kCarLengths, true, true},
         {"test", "to", "a wheel's travel", "mm", 0, 0, 250, 1e3, kCarLengths, true, true},
         {"test", "rack", "a rack's travel", "mm", 0, 0, 150, 1e3, kCarLengths, true, true},
         {"test", "wheelbase", "a wheelbase", "m", 0.3, 0.8, 8, 30, kCarLengths},
         {"test", "cg_height", "a center of mass", "m", 0.02, 0.1, 2.5, 6, kCarLengths},
         {"test", "rack_per_turn", "a rack's travel per turn", "mm", 2, 10, 250, 2e3, kCarLengths},
         {"test", "amplitude", "the amplitude of a post", "mm", 1e-4, 0.01, 100, 500, kCarLengths},
         {"test", "velocity", "the velocity of a post", "m/s", 1e-5, 1e-3, 2, 20, kSpeeds},
         {"test", "pitch", "the pitch of a kerb", "m", 0.002, 0.03, 20, 1e3, kCarLengths},
         {"test", "width", "a width of the road", "m", 0.002, 0.02, 10, 1e3, kCarLengths}});
    return of;
  }();
  return all;
}

}  // namespace latsch::experiment
