// SPDX-License-Identifier: Apache-2.0
// What a page shows of a car's run over a kerb: the car from its left side as it moves, with the
// belts of its tires as they are; areas of contact; pressure below the front left tire; which
// waves of its belt the kerb excites.
//
// Of the radius r(φ) of the belt about the wheel's center, φ in the wheel plane and not turning
// with the wheel, amplitudes of waves are c_n = 1/(2π) ∮ r e^(-inφ) dφ by the trapezoidal rule,
// and 2 |c_n - c_n0| is drawn (|c_0 - c_00| of n = 0), c_n0 the mean before the kerb. n = 1 is the
// belt as a rigid ring against the rim.
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

  /// A sample of the run.
  void see(const car::Car& car, const car::CarState& state, double time);
  Test::Details details() const;

  static constexpr int kWaves = 6;  // n = 0 .. 5
  /// c_n of points about a center in the plane x, z.
  static std::array<std::complex<double>, kWaves> waves(const std::vector<Eigen::Vector2d>& points);

 private:
  static constexpr int kBins = 24;        // of pressure along x,
  static constexpr double kReach = 0.15;  // m, to either side
  struct Frame {
    double time = 0.0;
    std::vector<Eigen::Vector2d> chassis;                  // m, x and z of its corners
    std::array<Eigen::Vector2d, 2> centers;                // front and rear left wheel
    std::array<std::vector<Eigen::Vector2d>, 2> outlines;  // from the center
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
