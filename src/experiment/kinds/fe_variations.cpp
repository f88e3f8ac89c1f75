// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/fe_variations.h"

#include <cmath>
#include <optional>
#include <utility>

#include "base/text.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::experiment {
namespace {

constexpr double kStep = 1e-5;  // share of the number: tire_slopes.h

/// Returns the reference for a step: the number itself, or a usual value of its unit if the number
/// is zero.
double size_of(double value, const std::string& unit) {
  if (value != 0.0) return std::abs(value);
  if (unit == "m") return 1e-3;
  if (unit == "Pa") return 1e6;
  return 1.0;
}

}  // namespace

std::function<fe_tire::VariedTire(const Document&)> described_tires(
    const fe_tire::TreadSplit& split) {
  using fe_tire::TireDescription;
  return [split, built = std::optional<std::pair<TireDescription, fe_tire::Mesh>>()](
             const Document& numbers) mutable -> fe_tire::VariedTire {
    TireDescription tire = fe_tire::read_tire(numbers.root());
    if (split != fe_tire::TreadSplit{}) tire = with_split_tread(std::move(tire), split);
    if (!built) built.emplace(tire, fe_tire::build_mesh(tire));
    return {fe_tire::same_mesh(tire, built->first) ? built->second : fe_tire::build_mesh(tire),
            fe_tire::build_materials(tire),
            tire.pressure,
            tire.friction};
  };
}

Result<std::vector<fe_tire::Variation>> fe_variations(
    const Document& numbers,
    const std::vector<std::string>& paths,
    const std::function<fe_tire::VariedTire(const Document&)>& tire) {
  const fe_tire::VariedTire base = tire(numbers);
  std::vector<fe_tire::Variation> variations;
  for (const std::string& path : paths) {
    const double value = numbers.get(path), size = size_of(value, numbers.unit(path));
    const auto moved = [&](double by) {
      Document other = numbers;
      other.set(path, value + by);
      return tire(other);
    };
    fe_tire::Variation variation{
        moved(-kStep * size), moved(kStep * size), kStep * size, path == "pressure"};
    for (const auto* other : {&variation.below, &variation.above}) {
      if (!fe_tire::same_topology(other->mesh, base.mesh) ||
          other->materials.layers.size() != base.materials.layers.size())
        return Failure{"slopes: a small change of " + in_quotes(path) +
                       " makes another mesh; a search without derivatives can vary it"};
    }
    variations.push_back(std::move(variation));
  }
  return variations;
}

}  // namespace latsch::experiment
