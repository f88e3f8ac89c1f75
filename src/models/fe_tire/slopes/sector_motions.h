// SPDX-License-Identifier: Apache-2.0
// Harmonic motions about a state that is the same in all sectors: sums of (M.3) and (M.4) of
// hex8_motions.h over one of them.
//
// A mode of circumferential number n moves sector s by Re(phi exp(i n theta_s)). Over the ring its
// energy is that of the real and of the imaginary part of phi in one sector, times the sectors, and
// what it does to the state is again the same in all of them. So an element is evaluated with these
// parts side by side, the modes in its lanes.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <span>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/slopes/moved_numbers.h"

namespace latsch::fe_tire {

/// A mode over the unknowns of a sector, of unit mass there.
struct HarmonicShape {
  int n = 0;
  double frequency = 0.0;  // Hz
  Eigen::VectorXcd phi;
};

class SectorMotions {
 public:
  /// Modes at most, at a time: two parts each, as many as there are lanes.
  static constexpr std::size_t kMost = ElementMotion::kMost * ElementBatch::kLanes / 2;

  /// Refers to the elements, whose sectors are equally wide, to the state and the modes.
  SectorMotions(const RingElements& elements,
                const Inflated& at,
                std::span<const HarmonicShape> modes);

  /// D3W[phi, phi, .] of every mode [sector unknowns x modes]. False where an element has no state.
  bool curvatures(Eigen::MatrixXd& g);

  /// d/dp of D2W[phi~, phi~] - omega^2 phi.M phi + DW[along~] of every mode and number [modes x
  /// numbers], motions held; `along` [sector unknowns x modes]. After curvatures(). False likewise.
  bool slopes(const Eigen::MatrixXd& along,
              const std::vector<MovedNumber>& numbers,
              Eigen::MatrixXd& sums);

 private:
  static constexpr std::size_t kLanes = ElementBatch::kLanes;
  /// What stands in a lane: the real or imaginary part of a mode.
  struct Part {
    std::size_t mode;
    bool is_imaginary;
    double share;  // of the mode's parts
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
  std::vector<Alphas> alphas_;  // of every element and motion
};

}  // namespace latsch::fe_tire
