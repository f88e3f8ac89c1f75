// SPDX-License-Identifier: Apache-2.0
// The load cases of studies/cleat_fit, the specimen that is measured in them, and the noise of its
// measurement. bench_cleat_fit uses them for its fits and for counting correct intervals.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "base/document.h"
#include "base/random.h"
#include "experiment/rigs/drum_rig.h"
#include "models/ring_tire/description/ring_parameters.h"
#include "optimization/problem/design_space.h"

namespace latsch::benchmarks::cleat {

constexpr double kHighest = 200.0;  // Hz, highest frequency that is compared
/// N, standard deviation of the noise of Fx and Fz in every sample of one passage
constexpr double kNoise[2] = {50.0, 100.0};
constexpr double kRecord = 24.5;  // s, duration of one load case
constexpr const char* kChannels[2] = {"Fx", "Fz"};

/// Settings of the discretization of a simulated tire.
struct Numerics {
  int nodes, blocks, lines;
};
constexpr Numerics kModel{100, 16, 4}, kSpecimen{140, 15, 6};
/// number of passages simulated for the specimen, at half the model's step
constexpr int kPassages = 8;

/// Radial dry friction of the specimen's sidewall: none, or friction that adds a fifth to the
/// stiffness before it slips. Its five elements slip at deflections between 1.4 and 6.8 mm.
struct Friction {
  double stiffening = 0.0, force = 0.0;  // N/m
};
constexpr Friction kFriction{0.2, 500.0};

/// Calls `work` with 0 .. count - 1 in parallel on all cores.
template <class Work>
void at_once(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto go = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) others.emplace_back(go);
  go();
}

/// A parameter of the tire: its path in the file, the specimen's value relative to the one in the
/// file, and the range of its possible error.
struct Number {
  const char* path;
  double truth, range;
};
constexpr Number kNumbers[12] = {{"sidewall.radial.stiffness", 1.12, 1.5},
                                 {"sidewall.radial.damping", 1.30, 2.0},
                                 {"sidewall.radial.dynamic_stiffening", 0.80, 2.0},
                                 {"sidewall.time_constant", 1.25, 2.0},
                                 {"sidewall.tangential.stiffness", 0.88, 1.5},
                                 {"sidewall.tangential.damping", 0.75, 2.0},
                                 {"sidewall.progressivity", 0.85, 1.5},
                                 {"belt.pressure_width", 1.15, 1.5},
                                 {"belt.bending_in_plane", 1.30, 2.0},
                                 {"belt.extension", 0.85, 1.5},
                                 {"tread.shore_a", 0.95, 1.15},
                                 {"tread.damping_time", 1.30, 2.0}};

/// A load case of studies/cleat_fit, with the time step and the number of simulated passages over
/// the cleat.
struct Case {
  std::string name;
  bool fitted;
  experiment::DrumTest test;
  std::string words = {};
  std::vector<double> measured[2] = {};  // densities
  /// N, the averaged force over time, from which the densities are computed
  std::vector<double> force[2] = {};
  std::vector<double> noiseless[2] = {};
};

std::filesystem::path study_folder();
std::vector<Case> cases();

/// Returns the tire's file with the parameters as known before the fit.
Document file();
ring_tire::RingParameters tire_at(const Document& known, const DesignPoint& point);
ring_tire::RingParameters with(ring_tire::RingParameters ring, const Numerics& numerics);
ring_tire::RingParameters with(ring_tire::RingParameters ring, const Friction& friction);
/// Reduces the lines of tread blocks: on a straight cleat an upright wheel loads all lines across
/// its width equally, so one suffices.
Numerics enough(Numerics numerics, const Case& of);

/// Returns the standard deviation, N, of the noise that remains after averaging the passages that a
/// record contains.
double noise(const experiment::DrumTest& test, int channel);
std::vector<double> with_noise(std::vector<double> force, double deviation, RandomStream random);
std::vector<double> density(const std::vector<double>& force);
double rms(const std::vector<double>& values);

/// Simulates the measurement of the specimen with draw number `draw` of the noise; 0 is that of the
/// study's own measurements. Throws InputError if a simulation of the specimen has no solution.
void measure(std::vector<Case>& all,
             const ring_tire::RingParameters& specimen,
             int draw = 0,
             int passages = kPassages);
/// Writes the simulated measurements as files into the folder `measured` of the study.
void write(const std::vector<Case>& all, const std::filesystem::path& study);

}  // namespace latsch::benchmarks::cleat
