// SPDX-License-Identifier: Apache-2.0
// Passenger tires of sizes drawn at random, as `latsch new --size` writes them. Programs that
// include this header link latsch_cli.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "cli/templates/sized_tire.h"
#include "shipped_tires.h"

namespace latsch::benchmarks {

/// A tire of a size such as "235/70R15".
struct SizedTire {
  std::string size;
  fe_tire::TireDescription tire;
  double width = 0.0;  // m, width of the section
};

inline SizedTire tire_of_size(const std::string& size) {
  const std::string text = cli::sized_tire(read_text_file(tire_file(cli::template_of(size))), size);
  return {size, fe_tire::read_tire(Document::parse(text, size).root()), 1e-3 * std::stod(size)};
}

/// Draws sizes until `count` of them exist as tires.
inline std::vector<SizedTire> draw_sizes(std::uint64_t seed, std::size_t count) {
  RandomStream random(seed, 0);
  const auto drawn = [&](int from, int to, int step) {
    return from + step * static_cast<int>(random.below((to - from) / step + 1));
  };
  std::vector<SizedTire> tires;
  while (tires.size() < count) {
    const int width = drawn(165, 315, 10), aspect = drawn(30, 70, 5), rim = drawn(14, 21, 1);
    try {
      tires.push_back(tire_of_size(fmt::format("{}/{}R{}", width, aspect, rim)));
    } catch (const InputError&) {  // no such tire exists
    }
  }
  return tires;
}

}  // namespace latsch::benchmarks
