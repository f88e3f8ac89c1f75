// SPDX-License-Identifier: Apache-2.0
// Roundness of inflated tires whose sectors are not equally wide, and their load just after they
// touch the ground. Off the ground such a tire should have the shape of the same section on equal
// sectors, because deflections are measured from that shape. The reference is 240 equal sectors
// around the tire. Two errors are judged: the largest distance of a node from the reference shape,
// relative to the growth by inflation, and the error of the growth at the contact. On the ground
// the reference has 240 equal sectors around the whole ring too, not only in the zone of the
// contact.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr int kJudge = 240;      // equal sectors
constexpr double kClear = 0.02;  // m, between the tire and the ground
constexpr double kRound = 5e-4;  // tolerance of the shape, relative to the growth by inflation
// tolerance of the load at small deflection, relative to Fz at the deflection kTouch
constexpr double kEarlyLoad = 0.01;
constexpr double kTouch = 5e-4;  // m of deflection

TireDescription on_equal_sectors(TireDescription description, int sectors) {
  description.section.sector_zones.clear();
  description.section.sectors = sectors;
  return description;
}

/// Distances from the shape of the reference mesh, relative to its growth by inflation.
struct Roundness {
  double bottom = 0.0;  // at the lowest point
  double worst = 0.0;   // largest over all nodes of all cross sections
};

Roundness roundness(FeTire& tire, double pressure, const Inflated& judge) {
  const Inflated inflated = value_of(tire.inflate(pressure));
  const std::vector<GroundPose> clear = {{.height = inflated.radius + kClear}};
  const TireState state = value_of(tire.advance(tire.over(inflated, Ground{}), clear)).back();
  const int n = tire.mesh().nodes_per_sector();
  int lowest = 0;
  for (int k = 1; k < n; ++k)
    if (tire.mesh().X(2, k) < tire.mesh().X(2, lowest)) lowest = k;
  Roundness result;
  result.bottom = (judge.u(2, lowest) - state.u(2, lowest)) / judge.growth;
  for (int plane = 0; plane < tire.mesh().sectors; ++plane) {
    const double apart = (state.u.middleCols(plane * n, n) - judge.u).colwise().norm().maxCoeff();
    result.worst = std::max(result.worst, apart / judge.growth);
  }
  return result;
}

double early_load(FeTire& tire, double pressure) {
  const Inflated inflated = value_of(tire.inflate(pressure));
  return tire.stand(value_of(tire.press(inflated, Ground{}, {kTouch})).back()).force.z();
}

void judge_tire(const std::string& name, const TireDescription& zoned, Table& table) {
  FeTire fine(on_equal_sectors(zoned, kJudge));
  const Inflated judge = value_of(fine.inflate(zoned.pressure));
  const double load = early_load(fine, zoned.pressure);
  FeTire tire(zoned);
  const Roundness found = roundness(tire, zoned.pressure, judge);
  const double error = early_load(tire, zoned.pressure) / load - 1.0;
  table.full_row(
      name + ": growth",
      fmt::format(
          "{:+.3f} % at the contact, {:.3f} % anywhere", 1e2 * found.bottom, 1e2 * found.worst),
      "<= 0.05 %",
      found.worst <= kRound);
  table.full_row(name + ": Fz at 0.5 mm",
                 fmt::format("{:+.2f} %", 1e2 * error),
                 "<= 1 %",
                 std::abs(error) <= kEarlyLoad);
}

}  // namespace

int run(const Options& options) {
  Table table("round_ring", options);
  if (const std::string file = options.text("--tire"); !file.empty()) {
    judge_tire(file, read_tire(Document::read(file).root()), table);
    return table.exit_code();
  }
  if (options.is_smoke()) {
    TireDescription equal = coarse_tire("passenger_225_50R16"), zoned = equal;
    zoned.section.sector_zones = {{4, 0.1}, {4, 0.2}};
    FeTire even(equal), uneven(zoned);
    const Inflated judge = value_of(even.inflate(equal.pressure));
    const Roundness of_equal = roundness(even, equal.pressure, judge);
    const Roundness of_zoned = roundness(uneven, equal.pressure, judge);
    table.row("zoned ring",
              fmt::format("{:.3f} %", 1e2 * of_zoned.worst),
              "<= 0.05 %",
              of_zoned.worst <= kRound);
    table.row("equal sectors stay where one sector was inflated",
              fmt::format("{:.1e}", of_equal.worst),
              "<= 1e-4 of the growth",
              of_equal.worst <= 1e-4);
    return table.exit_code();
  }
  for (const char* name :
       {"passenger_205_55R16", "race_16x7.5-10", "passenger_225_50R16", "passenger_235_45R20"})
    judge_tire(name, shipped_tire(name), table);
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc,
      argv,
      {{"--tire", "FILE", "judges this tire file in place of the shipped ones"}},
      latsch::benchmarks::run);
}
