// SPDX-License-Identifier: Apache-2.0
// Stiffnesses and dampings of the rigid ring from the values of a .tir: frequencies of the free
// belt, overall stiffnesses of the tire.
//
//   k_bx = k_bz = m_b (2 pi f_long)^2     k_by = m_b (2 pi f_lat)^2
//   k_bgamma = k_bpsi = I_xx (2 pi f_yaw)^2     k_btheta = I_yy (2 pi f_windup)^2
//   c = 2 zeta sqrt(k m)
//
// The overall compliance beyond that of the ring is that of the residual springs between ring and
// contact patch, in series:
//   1/C_z = 1/k_bz + 1/c_rz
//   1/C_x = 1/k_bx + R_l^2/k_btheta + 1/c_rx
//   1/C_y = 1/k_by + R_l^2/k_bgamma + 1/c_ry
//   1/C_psi = 1/k_bpsi + 1/c_rpsi
// [Zegelaar 1998; Maurice 2000; Pacejka 2012, ch. 9]
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "models/magic_formula/parameters.h"

namespace latsch::rigid_ring {

/// An overall stiffness of the file beside the belt that the file's frequencies give.
struct StiffnessBesideBelt {
  const char *stiffness, *frequencies;  // keys of the file: "LATERAL_STIFFNESS", "FREQ_LAT and ..."
  bool turns = false;                   // true: stiffnesses are in N m/rad, else in N/m
  double stated = 0.0;                  // stiffness of the whole tire in the file
  double of_belt = 0.0;                 // stiffness of the belt alone; above `stated` if both fit
  double made = 0.0;                    // stiffness of the ring that results
};

struct RingConstants {
  double m_b = 0.0, I_xx = 0.0, I_yy = 0.0;                       // kg, kg m^2
  double k_bx = 0.0, k_by = 0.0, k_bgamma = 0.0, k_btheta = 0.0;  // N/m, N m/rad; k_bz = k_bx
  double c_bx = 0.0, c_by = 0.0, c_bgamma = 0.0, c_btheta = 0.0;
  double c_rx = 0.0, c_ry = 0.0, c_rz = 0.0;  // N/m, residual
  double c_rpsi = 0.0;                        // N m/rad, residual; 0: no YAW_STIFFNESS in the file
  /// Directions in which the belt alone is (nearly) as soft as the file's whole tire. The residual
  /// spring is then twenty times as stiff as the whole tire, so the tire is softer than the file
  /// states.
  std::vector<StiffnessBesideBelt> too_soft;
  /// Directions in which the belt is so much stiffer than the file's whole tire that frequencies
  /// and stiffness hardly belong to one tire.
  std::vector<StiffnessBesideBelt> too_stiff;
};

/// Returns a Failure if masses, frequencies or overall stiffnesses are missing, or if the belt is
/// so soft that the standing tire has no state of rest. `R_l`: loaded radius at the nominal load.
/// Stiffnesses are at nominal load and pressure.
Result<RingConstants> ring_constants(const magic_formula::Parameters& parameters, double R_l);

/// Returns a sentence for each contradiction between frequencies and stiffnesses of the file.
std::vector<std::string> contradictions(const RingConstants& ring);

}  // namespace latsch::rigid_ring
