// SPDX-License-Identifier: Apache-2.0
// Response of a tire to harmonic forces and motions about a state at rest, on the ground or off it.
//
//   auto response = TireResponse::about(tire, losses, state, ports, {.highest = 300.0});
//   Eigen::MatrixXcd H = response->at(80.0);   // [ports x ports]
//
// Points in contact stay in contact, and with friction they stick. The tire moves in its modes up
// to kBeyond times the highest frequency and in its static displacements under each load, which are
// exact at 0 Hz: without them the motion near a load lacks what higher modes would add to it.
// Rubber and cords relax (Z.1): modes and a second set of static displacements are those of the
// moduli at the highest frequency. Elements, pressure, ground, and all stress in the state have
// their full tangent; the relaxing stiffness is projected with the strains of the shapes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/motion/reduced_motion.h"
#include "models/fe_tire/motion/response_port.h"

namespace latsch::fe_tire {

struct ResponseSettings;

class TireResponse {
 public:
  /// Modes are taken up to this multiple of the highest frequency unless the settings say
  /// otherwise.
  static constexpr double kBeyond = 2.25;

  /// Computes the shapes in which the tire moves and their equations. A Failure says that the state
  /// is unstable or why there are no modes. The tire has its materials afterwards.
  static Result<TireResponse> about(FeTire& tire,
                                    const LossMaterials& losses,
                                    const TireState& state,
                                    const std::vector<ResponsePort>& ports,
                                    const ResponseSettings& settings);

  /// Returns the response at a frequency, Hz, from 0 to the highest, [outputs x inputs] in the
  /// order of the ports and in their units (ResponsePort::Of), for e^(+i omega t).
  Eigen::MatrixXcd at(double frequency) const;

  int modes() const { return modes_; }
  int shapes() const;

 private:
  /// Motions that do not work on others: all, or even and odd ones.
  struct Part {
    ReducedMotion motion;
    Eigen::MatrixXd still, inertial;  // work of the ports' loads on the shapes, [shapes x ports]
  };
  std::vector<Part> parts_;
  Eigen::MatrixXd direct_, direct_inertial_;  // outputs without motion of the shapes
  Eigen::VectorXd sign_;
  int modes_ = 0;
};

struct ResponseSettings {
  double highest = 300.0;  // Hz, the highest frequency that will be asked for
  Rayleigh rayleigh = {};  // damps all stiffness and mass, for comparison with other programs
  /// False: modes alone, to show what static displacements add.
  bool has_static_shapes = true;
  double beyond = TireResponse::kBeyond;
};

}  // namespace latsch::fe_tire
