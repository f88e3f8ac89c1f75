// SPDX-License-Identifier: Apache-2.0
#include "models/car/rolling_car.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <set>

#include "base/document_parts.h"
#include "base/error.h"
#include "base/text.h"
#include "models/car/spring_tire.h"

namespace latsch::car {
namespace {

/// Endings of the keys for a car's tires.
constexpr std::array<const char*, 2> kOfSides = {"_tire", "_tire_right"};

/// Throws InputError for a table that no reader reads: its name is probably misspelled, and the
/// table would be ignored.
void refuse_unknown(const Node& car) {
  std::set<std::string> known = {"kind", "title", "gravity", "chassis", "aero", "driver"};
  for (const char* axle : kAxles)
    for (const char* of : {"", "_suspension", "_tire", "_tire_right", "_tire_kind"})
      known.insert(std::string(axle) + of);
  for (const std::string& key : car.keys())
    if (!known.contains(key))
      car.reject(key,
                 fmt::format("is no key of a car, expected one of: {}", fmt::join(known, ", ")));
}

/// Throws InputError if the car's table has keys of a tire without the tire of the left side.
void refuse_keys_without_tire(const Node& car, std::size_t axle) {
  const std::string part = tire_key(axle, 0);
  for (const std::string& key : {tire_key(axle, 1), part + "_kind"})
    if (car.has(key)) car.reject(key, "is given without " + part + ", the tire of the left side");
}

}  // namespace

std::string tire_key(std::size_t axle, std::size_t side) {
  return std::string(kAxles[axle]) + kOfSides[side];
}

bool is_elements(const Document& tire) { return tire.root().has("section"); }

std::string tire_kind_name(const Node& car, const Document& tire, const std::string& part) {
  const std::string key = part.substr(0, part.find('_')) + "_tire_kind";
  if (!tire.root().has("kind") && is_elements(tire)) {
    if (car.has(key)) car.reject(key, "is for a .tir, but " + part + " is a finite-element tire");
    return "fe_tire";
  }
  if (!tire.root().has("kind"))
    return car.choice(key, {"magic_formula", "rigid_ring"}, "magic_formula");
  const std::string name = tire.root().text("kind");
  if (car.has(key) && name != car.text(key))
    car.reject(key, "is for a .tir, but " + part + " states that it is a " + name);
  for (const char* kind : {"ring_tire", "rigid_ring", "magic_formula", "fe_tire"})
    if (name == kind) return name;
  throw InputError({tire.file(), 0},
                   part + " is of kind " + in_quotes(name) +
                       ", which does not roll: expected a flexible ring, a rigid ring, a "
                       "finite-element tire or a .tir");
}

TireSide side_of(const Document& tire) {
  const Node root = tire.root();
  return root.has("side") && root.text("side") == "right" ? TireSide::right : TireSide::left;
}

RollingCar::RollingCar(const Document& numbers, const TireMaker& make)
    : numbers_(numbers), file_(read_car(numbers.root())) {
  const std::array<const std::optional<SpringTireParameters>*, 2> springs = {
      &file_.front_spring_tire, &file_.rear_spring_tire};
  for (std::size_t axle = 0; axle < 2; ++axle) {
    const std::string part = tire_key(axle, 0), right = tire_key(axle, 1);
    if (!numbers.root().has(part)) {
      refuse_keys_without_tire(numbers.root(), axle);
      if (!*springs[axle])
        throw InputError({numbers.file(), 0},
                         part + " is missing, expected the file of a tire, or a table [" +
                             kAxles[axle] + ".spring_tire]");
      for (std::size_t side = 0; side < 2; ++side)
        tires_[2 * axle + side] = std::make_unique<SpringTire>(**springs[axle]);
      continue;
    }
    for (std::size_t side = 0; side < 2; ++side) {
      const std::string key = side == 1 && numbers.root().has(right) ? right : part;
      const Document tire = part_of(numbers, key);
      RollingModel model =
          make(tire_kind_name(numbers.root(), tire, key), tire, key, side == 0 || key == right);
      tires_[2 * axle + side] =
          mounted(model.rolls->tire(), side_of(tire), side == 0 ? TireSide::left : TireSide::right);
      models_.emplace_back(fmt::format("{}, {}", key, side == 0 ? "left" : "right"),
                           std::move(model));
    }
  }
  refuse_unknown(numbers.root());
}

Result<std::unique_ptr<Car>> RollingCar::car(const CarInputs& at_rest) const {
  auto car = Car::make(file_.parameters, tires_, at_rest);
  if (!car) return car;
  (*car)->guide.y = file_.driver_line;
  (*car)->guide.drives = file_.drives;
  return car;
}

std::vector<std::string> RollingCar::limits_met() const {
  std::vector<std::string> all;
  for (const auto& [name, model] : models_) {
    for (const std::string& limit : model.limits_met()) all.push_back(name + ": " + limit);
    for (const std::string& assumed : model.rolls->assumed_in_time())
      all.push_back(name + ": " + assumed);
  }
  return all;
}

void RollingCar::check_tires() const {
  const auto wrong = Car::misfit(build(file_.parameters).parts, tires_);
  if (!wrong) return;
  const std::size_t axle = is_front(wrong->corner) ? 0 : 1, side = is_left(wrong->corner) ? 0 : 1;
  std::string key = tire_key(axle, side);
  if (!numbers_.root().has(key)) key = tire_key(axle, 0);
  if (!numbers_.root().has(key)) key = kAxles[axle];
  throw InputError({numbers_.file(), 0},
                   key + ": " + wrong->why +
                       ": expected another tire, or wheel_center and contact "
                       "of its suspension as this tire stands");
}

}  // namespace latsch::car
