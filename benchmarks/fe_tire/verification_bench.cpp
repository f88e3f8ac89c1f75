// SPDX-License-Identifier: Apache-2.0
// Compares the default finite element with extrapolated meshes, and modes found by circumferential
// harmonics with those of the full eigenvalue problem.
//
// The tires have the default element: all shipped ones, with cords as rebars, inflated and pressed
// on the ground; three sizes drawn at random, inflated; tires A and B with smeared cords, inflated
// and, for B, pressed. Every mesh is refined in all three directions with nodes on the true contour
// and the same physical boundary. Inflation and unloaded modes use one sector, refined 2, 3 and 4
// times and extrapolated. The loaded ring is judged by the default method that users get, and for
// three tires by a thorough one (loaded_limits.h), which shows the accuracy of the default.
// `--sizes` judges other sizes, also on the ground. As many tires are judged at a time as the
// machine has cores.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <exception>
#include <functional>
#include <future>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/templates/sized_tire.h"
#include "cpu_time.h"
#include "drawn_sizes.h"
#include "experiment/rigs/fe_tire/column_placement.h"
#include "experiment/rigs/fe_tire/discretization.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/description/section_columns.h"
#include "models/fe_tire/description/tire_description.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

// largest relative error of the default element on a mesh with 1.5 times the unknowns of the paper
constexpr double kReach = 0.01;
constexpr double kTravel = 0.025;         // m, deflection of the shipped tires
constexpr double kRaceTravel = 0.015;     // m
constexpr double kSmearedTravel = 0.010;  // m
constexpr double kSizesTravel = 0.022;    // m
constexpr double kLimitsAgree = 0.003;
constexpr int kUnknownsOfB = 15480 * 3 / 2, kUnknownsOfA = 27000 * 3 / 2;
// least ratio of the CPU time of the full eigenvalue problem to that of harmonics
constexpr double kFullRatio = 50.0;
constexpr int kModes = 20;
constexpr int kRuns = 5;  // number of timed runs of modes

/// Returns the median CPU seconds of two kinds of work that are run in turn: the long one `runs`
/// times and the short one `runs` squared times.
std::pair<double, double> times_of(int runs,
                                   const std::function<void()>& short_one,
                                   const std::function<void()>& long_one) {
  std::vector<double> of_short, of_long;
  const auto time = [](const std::function<void()>& work, std::vector<double>& seconds) {
    const double start = cpu_seconds();
    work();
    seconds.push_back(cpu_seconds() - start);
  };
  for (int i = 0; i < runs; ++i) {
    for (int k = 0; k < runs; ++k) time(short_one, of_short);
    time(long_one, of_long);
  }
  const auto median = [](std::vector<double>& seconds) {
    const auto middle = seconds.begin() + std::ssize(seconds) / 2;
    std::ranges::nth_element(seconds, middle);
    return *middle;
  };
  return {median(of_short), median(of_long)};
}

void compare_modes(const std::string& name,
                   const TireDescription& description,
                   Table& table,
                   int runs) {
  FeTire tire(description);
  const Inflated inflated = value_of(tire.inflate(description.pressure));
  std::vector<Mode> by_harmonics, by_ring;
  const auto [fast, full] = times_of(
      runs,
      [&] { by_harmonics = value_of(tire.modes(inflated, kModes)); },
      [&] { by_ring = value_of(tire.modes_full(inflated, kModes)); });
  double difference = 0.0;
  for (int k = 0; k < kModes; ++k) {
    difference =
        std::max(difference, std::abs(by_harmonics[k].frequency / by_ring[k].frequency - 1.0));
  }
  table.full_row(
      fmt::format("{}: {} modes by harmonics against the full eigen-solve", name, kModes),
      fmt::format(
          "{:.0f} x faster ({:.1f} ms, {:.0f} ms CPU)", full / fast, 1e3 * fast, 1e3 * full),
      fmt::format(">= {:.0f} x", kFullRatio),
      full >= kFullRatio * fast);
  table.row(fmt::format("{}: their frequencies against the full eigen-solve", name),
            fmt::format("{:.1e}", difference),
            "<= 1e-6",
            difference <= 1e-6);
}

std::string of(const DiscretizationRow& row) {
  const double error = 100 * row.error(), uncertainty = 100 * row.error_uncertainty();
  return row.unit == "N"
             ? fmt::format("{:+.2f} +- {:.2f} % of {:.0f} N", error, uncertainty, row.converged)
             : fmt::format(
                   "{:+.2f} +- {:.2f} % of {:.3f} mm", error, uncertainty, 1e3 * row.converged);
}

void add_rows(const std::string& name,
              const std::string& state,
              const std::vector<DiscretizationRow>& rows,
              Table& table) {
  const DiscretizationRow* worst = nullptr;
  double sum = 0.0;
  int modes = 0;
  for (const DiscretizationRow& row : rows) {
    if (row.unit != "Hz") {
      table.row(fmt::format("{}: {}", name, row.name),
                of(row),
                "<= 1 %",
                std::abs(row.error()) <= kReach);
      continue;
    }
    if (!row.paired) continue;
    ++modes;
    sum += std::abs(row.error());
    if (!worst || std::abs(row.error()) > std::abs(worst->error())) worst = &row;
  }
  table.row(fmt::format("{}: {} modes found on every mesh", name, state),
            fmt::format("{}", modes),
            fmt::format("{}", kModes),
            modes == kModes);
  if (!worst) return;
  table.row(fmt::format("{}: worst of them", name),
            fmt::format("{:+.2f} +- {:.2f} % ({}), mean {:.2f} %",
                        100 * worst->error(),
                        100 * worst->error_uncertainty(),
                        worst->name,
                        100 * sum / modes),
            "<= 1 %",
            std::abs(worst->error()) <= kReach);
}

struct Case {
  std::string name;
  std::function<TireDescription()> tire;
  double travel = 0.0;          // m, deflection on the ground; 0: the tire is only inflated
  int unknowns = kUnknownsOfB;  // at most
  bool thoroughly = false;      // judges the loaded ring thoroughly, which takes one or two minutes
  bool is_judged = true;        // false: only the two references are compared with each other
};

/// Compares the default limits of a few loaded meshes with the thorough ones: the largest relative
/// difference, and the number of differences that exceed both error estimates.
void compare_limits(const std::string& name, const DiscretizationStudy& found, Table& table) {
  double farthest = 0.0;
  int outside = 0;
  std::string worst;
  for (const DiscretizationRow& few : found.loaded_by_few) {
    const auto same = std::ranges::find(found.loaded, few.name, &DiscretizationRow::name);
    if (!few.paired || same == found.loaded.end() || !same->paired) continue;
    const double apart = std::abs(few.converged / same->converged - 1.0);
    if (apart > farthest) worst = few.name;
    farthest = std::max(farthest, apart);
    outside += std::abs(few.converged - same->converged) > few.uncertainty + same->uncertainty;
  }
  table.row(name + ": limits of the default judge farther off than the +- say",
            fmt::format("{}", outside),
            "0",
            outside == 0);
  table.row(name + ": limits of the default judge from those found thoroughly",
            fmt::format("up to {:.2f} % ({})", 100 * farthest, worst),
            fmt::format("<= {:g} %", 100 * kLimitsAgree),
            farthest <= kLimitsAgree);
}

struct Judged {
  int unknowns;
  Result<DiscretizationStudy> study;
};

Judged judge(const Case& of) {
  const TireDescription tire = of.tire();
  DiscretizationSettings settings;
  settings.element = tire.element;
  settings.pressure = tire.pressure;
  settings.deflection = of.travel;
  settings.modes = kModes;
  settings.loaded_thoroughly = of.thoroughly;
  return {build_mesh(tire).free_dofs(),
          study_discretization(tire, settings, [&](const std::string& text) {
            fmt::print(stderr, "  {}, {}, {:.0f} s of CPU\n", of.name, text, cpu_seconds());
          })};
}

void add_rows(const Case& of, const Judged& judged, Table& table) {
  if (of.is_judged)
    table.row(of.name + ": unknowns",
              fmt::format("{}", judged.unknowns),
              fmt::format("<= {}", of.unknowns),
              judged.unknowns <= of.unknowns);
  if (!judged.study) {
    table.row(of.name + ": finer meshes", judged.study.failure().reason, "a result", false);
    return;
  }
  const DiscretizationStudy& study = *judged.study;
  if (of.is_judged) add_rows(of.name, "unloaded", study.unloaded, table);
  if (of.is_judged && of.travel > 0.0) add_rows(of.name, "loaded", study.loaded, table);
  if (of.thoroughly) compare_limits(of.name, study, table);
}

/// Judges as many cases at a time as the machine has cores; rows are in the order of the cases.
void study(const std::vector<Case>& cases, Table& table) {
  std::vector<std::promise<Judged>> judged(cases.size());
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> threads(std::max(1U, std::thread::hardware_concurrency()));
  for (std::jthread& thread : threads) {
    thread = std::jthread([&] {
      for (std::size_t k; (k = next++) < cases.size();) {
        try {
          judged[k].set_value(judge(cases[k]));
        } catch (...) {
          judged[k].set_exception(std::current_exception());
        }
      }
    });
  }
  for (std::size_t k = 0; k < cases.size(); ++k)
    add_rows(cases[k], judged[k].get_future().get(), table);
}

/// Returns the case of a passenger tire of any size, as written by `latsch new --size`.
Case of_size(const SizedTire& of, double travel) {
  const TireDescription tire = of.tire;
  return {
      .name = of.size,
      .tire = [tire] { return tire; },
      .travel = travel,
      .unknowns = cli::template_of(of.size) == "passenger_235_45R20" ? kUnknownsOfA : kUnknownsOfB};
}

/// Judges tires of the given sizes, separated by commas, also on the ground.
int run_sizes(const std::string& sizes, const Options& options) {
  Table table("verification", options);
  std::istringstream each(sizes);
  std::vector<Case> cases;
  for (std::string size; std::getline(each, size, ',');)
    cases.push_back(of_size(tire_of_size(size), kSizesTravel));
  study(cases, table);
  return table.exit_code();
}

/// Returns the tire with smeared cords, with columns and sectors placed so that it has `unknowns`
/// unknowns. The ends and the zones of its sectors are those of the shipped tire `as`; the equal
/// sectors of `tire` itself are those of the CalculiX deck.
TireDescription smeared(TireDescription tire, const TireDescription& as, int unknowns) {
  // The deck of tire B clamps the outer half of the bead. Its stiff inner half then bends about an
  // edge, and this singularity spoils the convergence of any element. Clamped at the inner half,
  // the tire has as many unknowns and no such edge.
  if (tire.section.clamp == BeadClamp::outside) tire.section.clamp = BeadClamp::inside;
  tire.section.ends = as.section.ends;
  tire.section.sector_zones = as.section.sector_zones;
  const auto placed = value_of(place_columns(tire, {.unknowns = unknowns, .choose_sectors = true}));
  tire.section.sectors = placed.sectors;
  return with_columns(std::move(tire), placed.columns);
}

/// Compares modes found by harmonics with those of the full eigenvalue problem on a coarse tire,
/// and studies its meshes.
int smoke(const Options& options) {
  Table table("verification", options);
  const TireDescription tire =
      coarse_tire("passenger_225_50R16", {.meridional = 13, .sectors = 12});
  compare_modes("coarse tire B", tire, table, 1);
  const Judged judged = judge({.name = "coarse tire B", .tire = [tire] { return tire; }});
  table.row("coarse tire B: finer meshes",
            judged.study ? fmt::format("{} rows", judged.study->unloaded.size())
                         : judged.study.failure().reason,
            "a result",
            judged.study && !judged.study->unloaded.empty());
  return table.exit_code();
}

int run(const Options& options) {
  if (options.has("--sizes")) return run_sizes(options.text("--sizes"), options);
  if (options.is_smoke()) return smoke(options);
  const auto seed = static_cast<std::uint64_t>(options.integer("SEED", 2016));
  Table table("verification", options);
  const TireDescription a = shipped_tire("passenger_235_45R20"),
                        b = shipped_tire("passenger_225_50R16");
  compare_modes("tire B", b, table, kRuns);
  compare_modes("tire A", a, table, kRuns);
  const auto shipped = [](TireDescription tire) { return [tire] { return tire; }; };
  std::vector<Case> cases = {{.name = "205/55R16",
                              .tire = shipped(shipped_tire("passenger_205_55R16")),
                              .travel = kTravel,
                              .thoroughly = true},
                             {.name = "race tire",
                              .tire = shipped(shipped_tire("race_16x7.5-10")),
                              .travel = kRaceTravel,
                              .thoroughly = true}};
  for (const SizedTire& drawn : draw_sizes(seed, 3)) cases.push_back(of_size(drawn, 0.0));
  cases.push_back({.name = "tire B, rebars", .tire = shipped(b), .travel = kTravel});
  cases.push_back(
      {.name = "tire A, rebars", .tire = shipped(a), .travel = kTravel, .unknowns = kUnknownsOfA});
  cases.push_back({.name = "tire A, smeared",
                   .tire = [&] { return smeared(reference_tire_a(), a, kUnknownsOfA); },
                   .unknowns = kUnknownsOfA});
  cases.push_back({.name = "tire B, smeared",
                   .tire = [&] { return smeared(reference_tire_b(), b, kUnknownsOfB); },
                   .travel = kSmearedTravel});
  // The default reference is tested on the case with the largest error, which has the fewest
  // unknowns: those of the paper.
  cases.push_back({.name = "tire B, smeared, as many unknowns as the paper's",
                   .tire = [&] { return smeared(reference_tire_b(), b, kUnknownsOfB * 2 / 3); },
                   .travel = kSmearedTravel,
                   .thoroughly = true,
                   .is_judged = false});
  study(cases, table);
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc,
      argv,
      {{"SEED", "", "of the sizes drawn at random"},
       {"--sizes", "LIST", "these in their place, 235/70R15,225/55R20"}},
      latsch::benchmarks::run);
}
