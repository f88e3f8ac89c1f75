// SPDX-License-Identifier: Apache-2.0
// Sums of (M.3) and (M.4) of hex8_motions.h over one sector, for harmonic motions about a state
// that is the same in all sectors.
//
// A mode of circumferential number n moves sector s by Re(phi exp(i n theta_s)). Its energy over
// the ring is the energy of the real and of the imaginary part of phi in one sector, times the
// number of sectors. Its effect on the state is again the same in all sectors. Each element is
// therefore evaluated with these parts as motions, several modes at once in the lanes of a
// register.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <span>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/slopes/moved_numbers.h"

namespace latsch::fe_tire {

/// A mode as a vector of the unknowns of a sector, with unit mass in this sector.
struct HarmonicShape {
  int n = 0;
  double frequency = 0.0;  // Hz
  Eigen::VectorXcd phi;
};

class SectorMotions {
 public:
  /// Largest number of modes at a time. Each mode has two parts, and there are as many parts as
  /// lanes.
  static constexpr std::size_t kMost = ElementMotion::kMost * ElementBatch::kLanes / 2;

  /// The object keeps references to the elements, whose sectors must be equally wide, to the state
  /// and to the modes.
  SectorMotions(const RingElements& elements,
                const Inflated& at,
                std::span<const HarmonicShape> modes);

  /// Computes the third derivative D3W[phi, phi, .] of the energy W for every mode phi [sector
  /// unknowns x modes]. Returns false if an element is inverted.
  bool curvatures(Eigen::MatrixXd& g);

  /// Computes the derivative of D2W[phi~, phi~] - omega^2 phi^T M phi + DW[along~] with respect to
  /// every parameter, for every mode, with constant motions [modes x parameters]. `along` is
  /// [sector unknowns x modes]. curvatures() must have been called before. Returns false if an
  /// element is inverted.
  bool slopes(const Eigen::MatrixXd& along,
              const std::vector<MovedNumber>& numbers,
              Eigen::MatrixXd& sums);

 private:
  static constexpr std::size_t kLanes = ElementBatch::kLanes;
  /// Motion in a lane: the real or the imaginary part of a mode.
  struct Part {
    std::size_t mode;
    bool is_imaginary;
    double share;  // weight of the part in the sum over the mode's parts
  };
  std::size_t lanes_of(std::size_t motion) const;
  void set_batch(int element, ElementBatch& batch) const;
  void set_modes(int element);
  void set_along(int element, const Eigen::MatrixXd& along);
  void keep_alphas();
  void recall_alphas(int element);

  const RingElements& elements_;
  const Ring& ring_;
  const Inflated& at_;
  std::span<const HarmonicShape> modes_;
  Eigen::VectorXd x_;
  std::vector<Part> parts_;
  std::vector<ElementMotion> motions_;
  struct Alphas {
    double mode[8][kLanes], second[8][kLanes];
  };
  std::vector<Alphas> alphas_;  // enhanced strains for every element and motion
};

}  // namespace latsch::fe_tire
