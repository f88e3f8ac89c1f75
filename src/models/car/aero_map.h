// SPDX-License-Identifier: Apache-2.0
// Downforce and drag of a car's body as functions of its ride heights, as measured in a wind
// tunnel:
//
//   F_f = q A C_f(h_f, h_r),   F_r = q A C_r(h_f, h_r),   D = q A C_D,      q = ρ v² / 2
//
// h_f and h_r are the heights of the car's floor above the plane z = 0 at the two axles, in the
// middle of the car; a kerb below the floor does not change them. The coefficients are bilinear
// between the heights of the map and constant beyond them. The downforces F_f and F_r act
// vertically at the axles, the drag D backward at a given height. There is no delay. If the chassis
// is divided into halves that twist, all forces act on the front half, at points in the middle of
// the car, where both halves have the same position.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace latsch::car {

struct AeroMap {
  /// One measured row of the map: a ride height at each axle and the coefficients of downforce at
  /// these heights.
  struct Row {
    double front_height, rear_height;  // m
    double front, rear;                // C_f, C_r; downforce positive
  };
  struct Coefficients {
    Eigen::Vector2d downforce;  // front, rear
    // Derivatives by ride height, 1/m; rows: coefficients, columns: front and rear height.
    Eigen::Matrix2d by_height;
  };

  double density = 1.2;      // kg/m^3
  double area = 1.0;         // m^2
  double drag = 0.0;         // C_D
  double drag_height = 0.0;  // m, height at which drag acts, in the car as drawn
  // Heights of the floor at the axles in the car as drawn, m.
  double floor_front = 0.0, floor_rear = 0;

  /// Sets the map from the rows of a complete grid of ride heights, in any order. A single row
  /// means constant coefficients.
  void set_rows(const std::vector<Row>& rows);
  /// Returns a message that says why such rows form no map, or an empty text if they do.
  static std::string fault(const std::vector<Row>& rows);

  Coefficients at(double front_height, double rear_height) const;

  /// Heights of the map at one axle, m; both are infinite if the map has a single height there, on
  /// which the coefficients then do not depend.
  struct Heights {
    double from, to;
  };
  /// Returns the heights of the map at the front and at the rear axle.
  std::array<Heights, 2> heights() const;

 private:
  std::vector<double> front_heights_ = {0.0}, rear_heights_ = {0.0};
  // Rows: front heights, columns: rear heights.
  Eigen::MatrixXd front_ = Eigen::MatrixXd::Zero(1, 1), rear_ = front_;
};

}  // namespace latsch::car
