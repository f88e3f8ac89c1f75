// SPDX-License-Identifier: Apache-2.0
// Exported units: size of packages and libraries, what they need of a machine, bits and speed.
// Packages are made by `latsch export`, checked by tools/check_fmu.py, and stepped through their C
// functions beside the same model in this process.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "cpu_time.h"
#include "exchange/package/unit_folder.h"
#include "fmu_testing.h"
#include "table.h"

namespace {

using namespace latsch;
using namespace latsch::exchange;
using benchmarks::Options;
using benchmarks::Table;
namespace fs = std::filesystem;

constexpr double kMega = 1e6, kCommunication = 1e-3;  // bytes; s

struct ExportedKind {
  const char* name;
  const char* short_name;
  const char* file;  // below studies
  bool is_car;
};
constexpr ExportedKind kExported[] = {
    {"ring", "ring", "ring_tires/passenger_205_55R16.toml", false},
    {"rigid ring", "rigid", "tire_model_comparison/rigid_ring.tir", false},
    {"Magic Formula", "formula", "tire_model_comparison/magic_formula.tir", false},
    {"car", "car", "kerb/baseline.toml", true}};

/// Returns the inputs of a step, by name: a wheel that rolls under its load, steered to and fro, or
/// a car that is driven.
std::map<std::string, double> inputs_at(const ExportedKind& kind, int step) {
  constexpr double kSpeed = 15.0, kSpin = 48.0;  // m/s, rad/s
  const double t = kCommunication * step;
  if (kind.is_car)
    return {{"rack.travel", 0.02 * t},
            {"rack.velocity", 0.02},
            {"drive.RL", 100.0},
            {"drive.RR", 100.0},
            {"load.Fz", -200.0}};
  return {{"wheel.x", kSpeed * t},
          {"wheel.z", 0.3},
          {"wheel.yaw", 0.04 * std::sin(30.0 * t)},
          {"wheel.wz", 1.2 * std::cos(30.0 * t)},
          {"wheel.vx", kSpeed},
          {"wheel.spin", kSpin * t},
          {"wheel.spin_rate", kSpin}};
}

/// Runs the unit of a package. Returns the bits of all its outputs after every step; empty if a
/// call did not end well.
std::vector<std::uint64_t> run_package(const Package& package,
                                       const ExportedKind& kind,
                                       int steps) {
  const auto slave = instantiate(package);
  if (!slave->there()) return {};
  const auto set = [&](const std::string& name, double value) {
    return slave->set(package.reference(name), value) == CallStatus::ok;
  };
  if (kind.is_car && !set("speed", 15.0)) return {};
  std::vector<std::uint64_t> bits;
  for (int i = 0; i <= steps; ++i) {
    for (const auto& [name, value] : inputs_at(kind, std::max(i - 1, 0)))
      if (!set(name, value)) return {};
    const CallStatus status =
        i == 0 ? slave->initialize(0.0) : slave->step(kCommunication * (i - 1), kCommunication);
    if (status != CallStatus::ok && status != CallStatus::warning) return {};
    for (const ExchangedVariable& variable : package.variables) {
      if (variable.causality != Causality::output) continue;
      double value = 0.0;
      slave->get(package.reference(variable.name), value);
      bits.push_back(std::bit_cast<std::uint64_t>(value));
    }
  }
  return bits;
}

/// Runs the same model in this process.
std::vector<std::uint64_t> run_here(const ExportedKind& kind, int steps) {
  const fs::path file = fs::path(LATSCH_SOURCE_DIR) / "studies" / kind.file;
  const auto& specimen = experiment::language().kind_of_file(file);
  const auto unit = unit_of(specimen, specimen.read(file));
  const auto set = [&](const std::string& name, double value) {
    for (std::size_t i = 0; i < unit->variables().size(); ++i)
      if (unit->variables()[i].name == name) unit->set(i, value);
  };
  if (kind.is_car) set("speed", 15.0);
  std::vector<std::uint64_t> bits;
  for (int i = 0; i <= steps; ++i) {
    for (const auto& [name, value] : inputs_at(kind, std::max(i - 1, 0))) set(name, value);
    const Status done =
        i == 0 ? unit->start(0.0) : unit->step(kCommunication * (i - 1), kCommunication);
    if (!done) return {};
    for (std::size_t v = 0; v < unit->variables().size(); ++v)
      if (unit->variables()[v].causality == Causality::output)
        bits.push_back(std::bit_cast<std::uint64_t>(unit->value(v)));
  }
  return bits;
}

void judge_bits(Table& table, const ExportedKind& kind, int steps) {
  const auto expected = run_here(kind, steps);
  for (const FmiVersion version : {FmiVersion::fmi2, FmiVersion::fmi3}) {
    const auto found = run_package(Package(version, kind.file, ""), kind, steps);
    std::size_t equal = 0;
    for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i)
      equal += found[i] == expected[i];
    table.row(fmt::format("{}, FMI {}: outputs with the bits of the program, {} steps",
                          kind.name,
                          version == FmiVersion::fmi2 ? "2" : "3",
                          steps),
              fmt::format("{} of {}", equal, expected.size()),
              "all",
              equal == expected.size() && !expected.empty());
  }
}

/// Exports packages of all kinds and lets the check of packages read them.
void judge_packages(Table& table) {
  const ScratchFolder folder;
  std::string files;
  double largest = 0.0;
  for (const ExportedKind& kind : kExported)
    for (const char* version : {"2.0", "3.0"}) {
      const std::string file = folder / fmt::format("{}_{}.fmu", kind.short_name, version[0]);
      benchmarks::run_command(fmt::format("'{}' export '{}/studies/{}' --fmu {} -o '{}'",
                                          LATSCH_PROGRAM,
                                          LATSCH_SOURCE_DIR,
                                          kind.file,
                                          version,
                                          file));
      if (!fs::exists(file)) continue;
      files += " '" + file + "'";
      largest = std::max(largest, static_cast<double>(fs::file_size(file)));
    }
  const std::string checked =
      benchmarks::run_command(
          fmt::format("python3 '{}/tools/check_fmu.py'{}", LATSCH_SOURCE_DIR, files))
          .output;
  const auto count = [&](const std::string& part) {
    int found = 0;
    for (std::size_t at = checked.find(part); at != checked.npos; at = checked.find(part, at + 1))
      ++found;
    return found;
  };
  const int good = count("no fault");
  if (good < 8) fmt::print("{}", checked);
  table.row(
      "packages (4 kinds, FMI 2 and 3) without a fault by tools/check_fmu.py: needs, symbols, "
      "newest glibc 2.36, sizes, description",
      fmt::format("{} of 8", good),
      "8 of 8",
      good == 8);
  table.row("largest package",
            fmt::format("{:.2f} MB", largest / kMega),
            "<= 5.5 MB",
            largest > 0.0 && largest <= 5.5 * kMega);
}

void judge_sizes(Table& table) {
  for (const char* file : {LATSCH_FMI2, LATSCH_FMI3}) {
    const double size = static_cast<double>(fs::file_size(file));
    table.row(fmt::format("library {}", fs::path(file).filename().string()),
              fmt::format("{:.2f} MB", size / kMega),
              "<= 6 MB",
              size <= 6.0 * kMega);
  }
}

/// Returns the least processor time, s, of some tries.
template <class Work>
double least_seconds(int tries, const Work& work) {
  double least = HUGE_VAL;
  for (int i = 0; i < tries; ++i) {
    const double begin = benchmarks::cpu_seconds();
    work();
    least = std::min(least, benchmarks::cpu_seconds() - begin);
  }
  return least;
}

void judge_speed(Table& table, const Options& options) {
  const int tries = options.size(5, 1), steps = options.size(500, 5);
  for (const ExportedKind& kind : {kExported[0], kExported[3]}) {
    const Package slim(FmiVersion::fmi3, kind.file, "");
    const double start = least_seconds(tries, [&] { run_package(slim, kind, 0); });
    table.full_row(fmt::format("{}: processor time of an instance and its start", kind.name),
                   fmt::format("{:.1f} ms", 1e3 * start),
                   kind.is_car ? "<= 100 ms" : "<= 20 ms",
                   start <= (kind.is_car ? 0.1 : 0.02));
    const Package all(FmiVersion::fmi3, kind.file, "", LATSCH_FMI3_ALL);
    double slim_time = HUGE_VAL, all_time = HUGE_VAL;
    for (int i = 0; i < tries; ++i) {  // in turns, because other programs load the machine
      slim_time = std::min(slim_time, least_seconds(1, [&] { run_package(slim, kind, steps); }));
      all_time = std::min(all_time, least_seconds(1, [&] { run_package(all, kind, steps); }));
    }
    table.full_row(
        fmt::format("{}: speed of the slim library over that with all models", kind.name),
        fmt::format("{:.3f}", all_time / slim_time),
        ">= 0.97",
        all_time / slim_time >= 0.97);
  }
}

int run(const Options& options) {
  Table table("units", options);
  judge_sizes(table);
  judge_packages(table);
  for (const ExportedKind& kind : kExported)
    judge_bits(table, kind, options.size(500, kind.is_car ? 5 : 20));
  judge_speed(table, options);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return latsch::benchmarks::run_benchmark(argc, argv, {}, run); }
