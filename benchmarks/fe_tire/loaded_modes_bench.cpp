// SPDX-License-Identifier: Apache-2.0
// Why loaded modes of two programs differ on the same mesh, and which is right
//
// A 205/55R16 at 3 bar on 72 sectors of 5 degrees, 24, 27 and 30 mm deep, comparison element, cords
// smeared, 24 x 2 elements across: here and in CalculiX 2.20. A mode of the loaded tire sees the
// ground as springs where it touches, with the full penalty however small the pressure there. Which
// points those are changes point by point as the tire is pressed, on faces as long as half the
// patch; both programs have points of their own (12 x 12 a face here). The judge is the
// same tire on four times as many sectors, whose steps are four times as small.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>

#include "calculix.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr double kPressure = 3e5;  // Pa
constexpr int kModes = 10;
constexpr double kWeak = 0.05;  // of the mean pressure: a point that just touches

TireDescription passenger_tire(int sectors) {
  TireDescription tire = shipped_tire("passenger_205_55R16");
  tire.section.columns.clear();
  tire.section.meridional = 24;
  tire.section.sectors = sectors;
  tire.section.sector_zones.clear();
  tire.cord_model = CordModel::smeared;
  tire.element = ElementKind::full_integration;
  return tire;
}

struct Answer {
  double Fz = 0.0;
  int points = 0, weak = 0;
  std::vector<double> frequencies;
};

Answer answer_of(FeTire& tire, double deflection) {
  const Inflated inflated = value_of(tire.inflate(kPressure));
  std::vector<double> way;
  for (int i = 1; i <= 5; ++i) way.push_back(deflection * i / 5);
  const TireState loaded = value_of(tire.press(inflated, Ground{}, way)).back();
  Answer answer;
  const Standing last = tire.stand(loaded);
  answer.Fz = last.force.z();
  answer.points = static_cast<int>(last.patch.points.size());
  double mean = 0.0;
  for (const ContactPatch::Point& point : last.patch.points) mean += point.pressure / answer.points;
  for (const ContactPatch::Point& point : last.patch.points)
    answer.weak += point.pressure < kWeak * mean;
  for (const Mode& mode : value_of(tire.modes(loaded, kModes)))
    answer.frequencies.push_back(mode.frequency);
  return answer;
}

Answer answer_of_calculix(const TireDescription& tire, double radius, double deflection) {
  formats::CcxRun run;
  run.pressure = kPressure;
  run.modes = kModes;
  run.ground = formats::CcxGround{radius, deflection};
  const auto calculix = run_calculix(build_mesh(tire), build_materials(tire), run);
  if (!calculix) throw std::runtime_error("CalculiX did not finish");
  return {calculix->results.total_force.at("GROUND").y(), 0, 0, calculix->results.frequencies};
}

double largest_difference(const Answer& a, const Answer& b) {
  double largest = a.frequencies.size() == b.frequencies.size() ? 0.0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.frequencies.size(), b.frequencies.size()); ++i)
    largest = std::max(largest, std::abs(a.frequencies[i] / b.frequencies[i] - 1.0));
  return largest;
}

void within(Table& table, const std::string& what, double error, double reach) {
  table.row(what,
            fmt::format("{:.3f} %", 100.0 * error),
            fmt::format("<= {:.1f} %", 100.0 * reach),
            error <= reach);
}

std::string listed(const Answer& answer) {
  return fmt::format("Fz {:.1f} N, {:.2f} Hz", answer.Fz, fmt::join(answer.frequencies, " "));
}

}  // namespace

int run() {
  Table table("loaded_modes");
  if (std::system("command -v ccx > /dev/null 2>&1") != 0) {
    table.note("loaded modes", "skipped: no ccx on the path");
    return table.exit_code();
  }
  const TireDescription coarse = passenger_tire(72);
  FeTire tire(coarse), fine(passenger_tire(288));
  const double radius = value_of(tire.inflate(kPressure)).radius;
  for (const double deflection : {0.024, 0.027, 0.030}) {
    const Answer ours = answer_of(tire, deflection), judge = answer_of(fine, deflection),
                 theirs = answer_of_calculix(coarse, radius, deflection);
    const std::string at = fmt::format("{:.0f} mm: ", deflection * 1e3);
    table.note(at + "ours", listed(ours));
    table.note(at + "CalculiX", listed(theirs));
    table.note(at + "288 sectors", listed(judge));
    table.note(at + "points that touch, that just touch",
               fmt::format("{}, {}", ours.points, ours.weak));
    within(table, at + "Fz, ours and CalculiX", std::abs(ours.Fz / theirs.Fz - 1.0), 5e-3);
    within(table, at + "modes, ours and CalculiX", largest_difference(ours, theirs), 1.2e-2);
    within(table, at + "modes, ours and judge", largest_difference(ours, judge), 2e-2);
    within(table, at + "modes, CalculiX and judge", largest_difference(theirs, judge), 2e-2);
  }
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main() { return latsch::benchmarks::guarded(latsch::benchmarks::run); }
