// SPDX-License-Identifier: Apache-2.0
// Magic Formula 6.1 fitted to the measured cornering of a race tire, side force and aligning moment
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <numbers>

#include "base/text.h"
#include "correlation/basic_data/slip_fit.h"
#include "formats/tables/csv_table.h"
#include "table.h"

namespace {

using namespace latsch;
using namespace latsch::correlation;

constexpr double kDegree = std::numbers::pi / 180.0;

/// The full file where it lies beside the source tree, else the thinned table of the study.
std::filesystem::path measured_file() {
  const std::filesystem::path full =
      LATSCH_SOURCE_DIR "/../shared/data/measured/ttc_hoosier_43075_cornering_10Hz.csv";
  return std::filesystem::exists(full) ? full : "";
}

SlipRecord read(const std::filesystem::path& file) {
  const auto table = formats::CsvTable::read(file);
  const auto column = [&](const char* name) { return table.numbers(name, "1"); };
  SlipRecord record;
  record.Fy = column("FY_N");
  record.Mz = column("MZ_Nm");
  const auto Fz = column("FZ_N_positive"), alpha = column("SA_deg"), gamma = column("IA_deg"),
             p = column("P_kPa"), V = column("V_kph");
  for (int i = 0; i < table.rows(); ++i)
    record.states.push_back(
        {Fz[i], 0.0, alpha[i] * kDegree, gamma[i] * kDegree, 0.0, V[i] / 3.6, p[i] * 1e3});
  return record;
}

magic_formula::Parameters start() {
  magic_formula::Parameters p;
  p.UNLOADED_RADIUS = 0.2032;  // 16 inch diameter
  p.FNOMIN = 1600.0;
  p.NOMPRES = p.INFLPRES = 83e3;
  p.LONGVL = 11.17;
  p.VERTICAL_STIFFNESS = 218e3;
  p.PCY1 = 1.4;
  p.PDY1 = 2.4;
  p.PEY1 = -0.5;
  p.PKY1 = -50.0;
  p.PKY2 = 1.6;
  p.QBZ1 = 8.0;
  p.QCZ1 = 1.2;
  p.QDZ1 = 0.12;
  p.QEZ1 = -1.0;
  return p;
}

int bench() {
  benchmarks::Table table("race_tire_mf");
  const std::filesystem::path file = measured_file();
  if (file.empty()) {
    table.note("the full run", "is not beside the source tree");
    return 1;
  }
  const SlipRecord record = read(file);
  magic_formula::Parameters tire = start();
  const std::clock_t begin = std::clock();
  for (const SlipFitStage& stage : cornering_stages()) {
    const SlipFit found = fit(tire, record, stage);
    tire = found.parameters;
    table.note(stage.name,
               fmt::format("{:.2f} %, {} coefficients, {} evaluations",
                           100 * found.error,
                           found.variables.size(),
                           found.evaluations));
    for (std::size_t i = 0; stage.name.ends_with("all") && i < found.variables.size(); ++i)
      table.note(fmt::format("  {}", found.variables[i].name),
                 fmt::format("{} +- {:.2g}",
                             format_known(found.variables[i].initial,
                                          found.half_width(static_cast<int>(i))),
                             found.half_width(static_cast<int>(i))));
  }
  const double Fy = relative_error(tire, record, SlipChannel::Fy),
               Mz = relative_error(tire, record, SlipChannel::Mz);
  table.row(fmt::format("Fy over the whole run, {} samples, RMS error", record.Fy.size()),
            fmt::format("{:.3f} %", 100 * Fy),
            "<= 4.0 %",
            Fy <= 0.04);
  table.row(fmt::format("Mz over the whole run, {} samples, RMS error", record.Mz.size()),
            fmt::format("{:.2f} %", 100 * Mz),
            "<= 19 % (published set)",
            Mz <= 0.19);
  table.note("CPU time of all stages",
             fmt::format("{:.1f} s", double(std::clock() - begin) / CLOCKS_PER_SEC));
  return table.exit_code();
}

}  // namespace

int main() { return latsch::benchmarks::guarded(bench); }
