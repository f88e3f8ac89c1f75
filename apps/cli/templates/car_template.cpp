// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/car_template.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "base/document.h"
#include "base/random.h"
#include "base/units.h"
#include "formats/tables/csv_table.h"

namespace latsch::cli {
namespace {

constexpr std::string_view kSweep =
    R"(kind = "four_post"
mode = "heave"                       # or pitch, roll, warp
from = "1 Hz"
to = "20 Hz"
duration = "8 s"
amplitude = "2 mm"
velocity = "0.1 m/s"
step = "0.5 ms"
sample_step = "2.5 ms"
)";

constexpr std::string_view kCarStudyHead =
    R"(# A car on four posts: springs and dampers found from the forces of its push-rods. sweep.csv is an example; of a rig of your own
# put its recording there, and where it has the heights post_FL .. post_RR of the posts, let the test move them as recorded:
# posts = {from = "measurement.sweep"} in place of mode .. velocity.
title = "Springs and dampers from four posts"

[model]
kind = "car"
file = "car.toml"

[measurement.sweep]
file = "sweep.csv"

[test.sweep]
)";

struct SpringNumber {
  const char *name, *path, *unit;
  double lower, upper, initial, example;  // in `unit`
};
constexpr std::array<SpringNumber, 4> kSprings = {
    {{"front_spring", "front.spring.stiffness", "N/mm", 30.0, 90.0, 45.0, 52.5},
     {"rear_spring", "rear.spring.stiffness", "N/mm", 30.0, 90.0, 45.0, 56.0},
     {"front_damper", "front.spring.damping", "kN s/m", 1.0, 10.0, 3.0, 3.8},
     {"rear_damper", "rear.spring.damping", "kN s/m", 1.0, 10.0, 3.0, 4.2}}};

constexpr std::string_view kKerb =
    R"(# latsch test car.toml kerb.toml --html kerb.html: the left wheels over a kerb, its film and the spectra.
kind = "kerb"
speed = "30 m/s"
run_in = "0.1 s"
duration = "0.3 s"
step = "0.2 ms"
sample_step = "1 ms"

[kerb]
kind = "kerb"
shape = "sine"
pitch = "800 mm"
width = "800 mm"
height = "25 mm"
count = 6
start = ["0 m", "0.3 m"]             # its right edge 0.3 m to the left of the car's middle
)";

/// Returns the text without its opening comment.
std::string without_head(std::string_view text) {
  while (text.starts_with('#') || text.starts_with('\n')) text.remove_prefix(text.find('\n') + 1);
  return std::string(text);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  assert(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string car_study() {
  std::string text = std::string(kCarStudyHead) + std::string(kSweep);
  for (const SpringNumber& one : kSprings)
    text += fmt::format(
        "\n[variable.{}]\npath = \"{}\"\nlower = \"{} {}\"\nupper = \"{} {}\"\n"
        "initial = \"{} {}\"\nscale = \"logarithmic\"\n",
        one.name,
        one.path,
        one.lower,
        one.unit,
        one.upper,
        one.unit,
        one.initial,
        one.unit);
  for (const char* corner : {"FL", "RL"})
    text += fmt::format(
        "\n[experiment.pushrod_{0}]\nkind = \"curve\"\nx = \"sweep/time\"\n"
        "y = \"sweep/pushrod_{0}\"\nmeasurement = \"sweep\"\ncompare = \"psd\"\n"
        "band = [\"1 Hz\", \"20 Hz\"]\nsegment = \"2 s\"\nexponent = 2\n",
        corner);
  return text + "\n[run]\nworkers = 2\ntimeout = \"5 min\"\n";
}

/// Returns the text of the car's file, changed to the names that the suspension files have in the
/// study's folder.
std::string four_post_car() {
  std::string text = without_head(published_four_post_car());
  text = replaced(std::move(text), "../kerb/front_rigid.toml", "front.toml");
  text = replaced(std::move(text), "../kerb/rear_rigid.toml", "rear.toml");
  return "# A student race car on four posts: masses, dampers and tires are assumed. Each tire is "
         "a "
         "vertical spring; a file of a tire\n# replaces it as front_tire = "
         "\"tire.tir\".\n" +
         text;
}

/// Adds measurement scatter and the resolution of a load cell to forces, N.
void scatter(std::vector<double>& forces, RandomStream& chance) {
  constexpr double kScatter = 3.0, kDigit = 0.1;  // N
  for (double& force : forces)
    force = kDigit * std::round((force + kScatter * chance.normal()) / kDigit);
}

}  // namespace

std::vector<WrittenFile> suspension_study_files() {
  const std::string head =
      "# Sixteen numbers that a K&C rig measures at a corner, as slopes over its loads, and the "
      "bushing stiffnesses that cause them. The\n# values are an example, not measured: put your "
      "own in "
      "their place, and your hardpoints into corner.toml.\n";
  return {{"corner.toml", std::string(published_corner())},
          {"study.toml", head + without_head(published_compliance_study())}};
}

std::vector<WrittenFile> car_study_files() {
  return {{"car.toml", four_post_car()},
          {"front.toml", std::string(published_front_suspension())},
          {"rear.toml", std::string(published_rear_suspension())},
          {"kerb.toml", std::string(kKerb)},
          {"study.toml", car_study()}};
}

std::string example_sweep(const std::string& car_file, const experiment::Language& language) {
  const experiment::SpecimenKind& kind = language.kind_of_file(car_file);
  Document car = kind.read(car_file);
  std::string made_of;
  for (const SpringNumber& one : kSprings) {
    const auto example = parse_quantity(fmt::format("{} {}", one.example, one.unit));
    car.set(one.path, example->si);
    made_of +=
        fmt::format("{}{} {} {}", made_of.empty() ? "" : ", ", one.name, one.example, one.unit);
  }
  const auto test = language.read_test(Document::parse(kSweep, "the example's sweep").root(), {});
  const auto recorded = language.run(kind, car, *test);
  if (!recorded) throw std::runtime_error(recorded.failure().reason);
  RandomStream chance(1, 0);
  Channels sweep;
  for (Channel channel : recorded->all()) {
    const bool is_force = channel.name.starts_with("pushrod_");
    if (!is_force && channel.name != "time" && !channel.name.starts_with("post_")) continue;
    if (is_force) scatter(channel.values, chance);
    channel.values.pop_back();  // after rounding, this time could exceed the duration of the test
    sweep.add(std::move(channel));
  }
  return "# An example, not measured: this car with " + made_of +
         ", and 3 N of scatter. Replace it by your recording.\n" + formats::csv_text(sweep);
}

}  // namespace latsch::cli
