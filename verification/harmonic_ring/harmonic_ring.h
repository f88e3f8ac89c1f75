// SPDX-License-Identifier: Apache-2.0
// The ring of the CalculiX deck harmonic_ring.inp: the band on a disc of gyro_ring.inp in 24
// sectors at rest, with a force of 2 N along z, half a newton on each of the four outer nodes at
// theta = 0, and Rayleigh's damping a = 20 1/s, b = 1e-4 s. Used by the test of this folder and by
// the benchmark `response`.
#pragma once

#include <complex>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/motion/reduced_motion.h"
#include "models/fe_tire/motion/response_port.h"

namespace latsch::verification {

inline constexpr int kHarmonicSectors = 24;
inline constexpr fe_tire::Rayleigh kHarmonicDamping{20.0, 1e-4};

/// Displacements along z, m, of the outer node at theta = 0, y = 0.01 m ("drive") and of the same
/// place at the top, for e^(+i omega t).
struct HarmonicRow {
  double frequency;                             // Hz
  std::complex<double> drive, top;              // all unknowns
  std::complex<double> modal_drive, modal_top;  // CalculiX 2.20 in 200 modes, without residuals
};
/// Results of harmonic_ring.inp: "all unknowns" by an independent program of some 200 lines (HEX8,
/// whole ring) that solves (K (1 + i omega b) + M (i omega a - omega^2)) u = f.
const std::vector<HarmonicRow>& harmonic_rows();

/// Returns the response of Latsch's ring in modes and static displacements, or in modes alone.
std::vector<HarmonicRow> harmonic_response(bool has_static_shapes);

/// Largest distance of a displacement from the listed one, relative to the largest listed one of
/// the same place. The small displacement at the top is also compared with itself.
struct HarmonicErrors {
  double drive = 0.0, top = 0.0;
};
HarmonicErrors harmonic_errors(const std::vector<HarmonicRow>& found);

/// Returns the response at points and at the wheel of the same ring by all unknowns: K and M of all
/// nodes, those of the rim included, are assembled, and the force on the rim is the reaction of its
/// nodes. The rows and columns are those of TireResponse::at().
Eigen::MatrixXcd by_all_unknowns(double frequency,
                                 const std::vector<fe_tire::ResponsePort>& ports,
                                 const fe_tire::Rayleigh& damping);

/// Returns the largest error of TireResponse with forces on two points and all motions of the wheel
/// compared with by_all_unknowns() at four frequencies up to 190 Hz: relative to the entry, or to a
/// twentieth of the geometric mean of the two ports' own entries for one that symmetry makes small.
double reaction_error();

/// Returns the ring in the air, without pressure.
fe_tire::TireState harmonic_state(fe_tire::FeTire& ring);

}  // namespace latsch::verification
