// SPDX-License-Identifier: Apache-2.0
// A car's run over a kerb on a page: the moving car from its left side with the deformed belts of
// its tires; areas of contact; pressure below the front left tire; the waves of its belt that the
// kerb excites.
//
// The radius r(φ) of the belt about the wheel's center, φ in the wheel plane and not turning with
// the wheel, has the wave amplitudes c_n = 1/(2π) ∮ r e^(-inφ) dφ, by the trapezoidal rule; 2 |c_n
// - c_n0| is drawn (|c_0 - c_00| for n = 0), where c_n0 is the mean before the kerb. n = 1 is the
// motion of the belt as a rigid ring against the rim.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <vector>

#include "experiment/language/test.h"
#include "models/car/car.h"

namespace latsch::experiment {

class KerbFilm {
 public:
  KerbFilm(const road::Road& road, double line) : road_(road), line_(line) {}

  /// Records a sample of the run.
  void see(const car::Car& car, const car::CarState& state, double time);
  Test::Details details() const;

  static constexpr int kWaves = 6;  // n = 0 .. 5
  /// Returns c_n for points about a center in the plane x, z.
  static std::array<std::complex<double>, kWaves> waves(const std::vector<Eigen::Vector2d>& points);

 private:
  static constexpr int kBins = 24;        // bins of the pressure along x
  static constexpr double kReach = 0.15;  // m, range of the bins to either side
  struct Frame {
    double time = 0.0;
    std::vector<Eigen::Vector2d> chassis;                  // m, x and z of its corners
    std::array<Eigen::Vector2d, 2> centers;                // front and rear left wheel
    std::array<std::vector<Eigen::Vector2d>, 2> outlines;  // relative to the center
    std::array<double, car::kCorners> areas{};             // m^2
    std::array<double, kBins> pressure{};                  // Pa, front left, mean over the width
  };
  std::string animation() const;
  std::string area_plot() const;
  std::string pressure_map() const;
  std::string wave_plot() const;
  std::vector<double> times() const;

  const road::Road& road_;
  double line_, radius_ = 0.0;
  std::vector<Frame> frames_;
};

}  // namespace latsch::experiment
