// SPDX-License-Identifier: Apache-2.0
// A car driven over kerbs: computing time of a grid of runs, aerodynamic forces estimated from
// noisy push-rod forces, and a measured track.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include "base/random.h"
#include "correlation/comparison/comparison_effects.h"
#include "cpu_time.h"
#include "experiment/language/capabilities.h"
#include "experiment/rigs/car/kerb_rig.h"
#include "models/road/plane_road.h"
#include "numerics/signals/butterworth.h"
#include "table.h"

namespace {

using namespace latsch;
using benchmarks::cpu_seconds;
using benchmarks::Table;
using car::Car;

const std::filesystem::path kStudy = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/kerb";

std::unique_ptr<Car> car_of(const std::string& name) {
  const auto* kind = experiment::language().find_kind("car");
  const auto specimen = kind->build(kind->read(kStudy / name));
  auto car = specimen->find<Drives>()->car({});
  if (!car) throw std::runtime_error(car.failure().reason);
  return std::move(*car);
}

/// Returns a test on the exit kerb of 100 m or more below the left wheels, recorded for 2 s from
/// the moment the front axle meets it.
experiment::KerbTest long_kerb(double speed, double line) {
  experiment::KerbTest test;
  test.kerb = road::Kerb{.shape = road::Kerb::Shape::sine,
                         .pitch = 0.8,
                         .width = 0.8,
                         .height = -0.025,
                         .count = 200,
                         .start = {0.0, 0.5}};
  test.speed = {{0.0}, {speed}};
  test.line = {{0.0}, {line}};
  test.run_in = 0.1;
  test.duration = 2.0;
  test.with_area = true;
  test.loaders = car::AeroLoaders{};
  test.loaders->points << 1.55, 1.55, 0.0, 0.4, -0.4, 0.0, 0.3, 0.3, 0.3;
  test.downforce = {2.8e3, 2.8e3, 5.6e3};
  return test;
}

/// True if the contact area of every tire that carries load is known at every sample. A tire that
/// leaves the road may touch it without load, and then needs no area.
bool areas_are_known(const Channels& channels) {
  for (const char* corner : {"FL", "FR", "RL", "RR"}) {
    const auto& area = channels[std::string("area_") + corner];
    const auto& Fz = channels[std::string("Fz_") + corner];
    for (std::size_t i = 0; i < area.size(); ++i)
      if (!std::isfinite(area[i]) || (Fz[i] > 0.0 && !(area[i] > 0.0))) return false;
  }
  return true;
}

void time_of_a_grid(Table& table, const benchmarks::Options& options) {
  std::vector<experiment::KerbTest> tests;
  for (const double speed : {50.0, 60.0, 70.0})
    for (const double line : {-0.08, 0.0, 0.08}) tests.push_back(long_kerb(speed, line));
  tests.resize(options.size(tests.size(), std::size_t{1}));
  for (auto& test : tests) test.duration = options.size(test.duration, 0.06);
  std::atomic<std::size_t> next{0};
  std::atomic<int> failed{0}, known{0};
  const auto begin = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds();
  const auto work = [&] {
    for (std::size_t i = next++; i < tests.size(); i = next++) {
      const auto car = car_of("proposed.toml");
      const auto channels = experiment::run(*car, tests[i]);
      if (!channels) ++failed;
      if (channels && areas_are_known(*channels)) ++known;
    }
  };
  std::thread other(work);
  work();
  other.join();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  table.full_row("ring tires, compliant: 3 speeds x 3 lines of 2 s, two threads",
                 fmt::format("{:.1f} s", wall.count()),
                 "< 30 s",
                 failed == 0 && wall.count() < 30.0);
  table.note("processor time of it, as on one core", fmt::format("{:.1f} s", cpu_seconds() - cpu));
  table.row("runs in which every tire on the road has a contact area at every sample",
            fmt::format("{} of {}", known.load(), tests.size()),
            "all",
            known == static_cast<int>(tests.size()));
}

/// The car drives on a level road under known downforce. The push-rod forces have noise and are
/// low-pass filtered; the row shows the error of the downforce computed from them.
/// `model`: file of the car in studies/kerb. Ring tires take most of the time: before every
/// equilibrium they roll until they are steady.
void aero_forces(Table& table, const std::string& model, int draws) {
  constexpr double kEdge = 10.0;                     // Hz
  constexpr double kStretch = 0.5, kSettling = 0.1;  // s
  experiment::KerbTest test = long_kerb(60.0, 0.0);
  test.kerb.reset();
  test.run_in = 0.0;
  test.duration = kStretch + kSettling;
  const auto car = car_of(model);
  const auto run = experiment::run(*car, test);
  if (!run) throw std::runtime_error(run.failure().reason);
  Eigen::Vector4d level;
  for (int c = 0; c < 4; ++c)
    level[c] = (*run)[std::string("pushrod_") + car::kCornerNames[static_cast<std::size_t>(c)]][0];
  const road::PlaneRoad road;
  auto solved = car::solve_loaders(*car, *test.loaders, level, road, 60.0);
  if (!solved) throw std::runtime_error(solved.failure().reason);
  const double rate = 1.0 / test.sample_step;
  const auto filter = numerics::polynomials_of(
      numerics::butterworth(2, numerics::FilterBand::low_pass, {kEdge}, rate));
  for (const double noise : {0.01, 0.02}) {
    double square = 0.0, left = 0.0;
    for (int draw = 0; draw < draws; ++draw) {
      RandomStream random(15, static_cast<std::uint64_t>(draw));
      Eigen::Vector4d forces;
      for (int c = 0; c < 4; ++c) {
        auto values =
            (*run)[std::string("pushrod_") + car::kCornerNames[static_cast<std::size_t>(c)]];
        const double carried = values[0];
        for (double& value : values) value += noise * carried * random.normal();
        auto state = numerics::steady_state(filter);
        for (double& value : state) value *= values[0];
        const auto passed = numerics::filter(filter, values, state);
        const auto first = static_cast<std::ptrdiff_t>(kSettling * rate);
        forces[c] = 0.0;
        for (auto at = passed.begin() + first; at != passed.end(); ++at)
          forces[c] += *at / static_cast<double>(passed.end() - passed.begin() - first);
      }
      const auto [downforce, rest] = solved->near(forces);
      for (int k = 0; k < 3; ++k)
        square += std::pow(downforce[k] / test.downforce[k] - 1.0, 2) / (3.0 * draws);
      left += rest.norm() / draws;
    }
    table.full_row(
        fmt::format("aero forces, push-rods with {:.0f} % noise a sample at 1 kHz, {:g} Hz, "
                    "{:g} s without kerb: rms error",
                    100.0 * noise,
                    kEdge,
                    kStretch),
        fmt::format("{:.2f} %", 100.0 * std::sqrt(square)),
        "<= 1 %",
        square <= 1e-4);
    table.note("  of the four push-rods no loaders reach", fmt::format("{:.1f} N", left));
  }
}

void beside_the_track(Table& table) {
  using namespace correlation;
  ModelComparisonFile file =
      read_model_comparison(kStudy / "comparison.toml", experiment::language());
  file.uncertainties.clear();
  file.fits.clear();  // the models' files contain their numbers
  for (ComparedModel& model : file.models) model.fits.clear();
  file.pictures.reset();
  const ModelComparison comparison = compare_models(file, experiment::language(), 2);
  const auto cases = all_cases(file);
  const std::size_t baseline = file.factorial_models[0][0], proposed = file.factorial_models[1][1];
  for (std::size_t b = 0; b < file.bands.size(); ++b) {
    const double ratio = mean_distance(comparison, cases, proposed, b) /
                         mean_distance(comparison, cases, baseline, b);
    table.row(fmt::format("PSD distance to the track, proposed over baseline, {:g} to {:g} Hz",
                          file.bands[b].band.lower,
                          file.bands[b].band.upper),
              fmt::format("{:.2f}", ratio),
              "< 1",
              ratio < 1.0);
  }
  std::size_t nearer = 0;
  for (const std::size_t i : cases)
    nearer += comparison.cases[i].models[proposed].mean_distance(0) <
              comparison.cases[i].models[baseline].mean_distance(0);
  table.note("cases in which the proposed is nearer",
             fmt::format("{} of {}", nearer, cases.size()));
  for (std::size_t b = 0; b < file.bands.size(); ++b) {
    const FactorialEffects e = mean_effects(file, comparison, cases, b, false);
    table.note(fmt::format("effects on the distance in band {}: tire, compliance, interaction",
                           file.bands[b].name),
               fmt::format("{:+.1f} %, {:+.1f} %, {:+.1f} %",
                           100.0 * e.first,
                           100.0 * e.second,
                           100.0 * e.interaction));
  }
}

int kerb(const benchmarks::Options& options) {
  Table table("kerb", options);
  time_of_a_grid(table, options);
  aero_forces(
      table, options.is_smoke() ? "mf_compliant.toml" : "proposed.toml", options.size(200, 10));
  if (!options.is_smoke()) beside_the_track(table);  // takes minutes
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return latsch::benchmarks::run_benchmark(argc, argv, {}, kerb); }
