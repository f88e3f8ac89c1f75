// SPDX-License-Identifier: Apache-2.0
// Frequency responses of a finite-element tire at rest, in the air or on the ground.
//
// Channels, one value for each frequency: "frequency" (Hz), and for each output NAME of
// response_outputs() "re_NAME" and "im_NAME", the parts of the response to a unit of the input for
// e^(+i omega t), "tf_NAME", its size, and "phase_NAME" (rad, positive if the output leads). On the
// ground one value of "deflection", "loaded_radius" (m) and "force" (N).
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "experiment/rigs/fe_tire/tire_rig.h"

namespace latsch::experiment {

/// Input of the tire: a motion of the ground or of the wheel, a force on the rim that moves, or a
/// force on a point of the tire.
enum class ResponseInput { ground, wheel, hub, point };

/// Derivatives by time of the motions that are recorded.
enum class MotionAs { displacement, velocity, acceleration };

struct ResponseTest {
  ModalTest stand;  // pressure, ground, load or deflection, camber, rim
  ResponseInput input = ResponseInput::ground;
  std::string direction = "z";                   // one of response_directions()
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // m, wheel frame: where the force on a point acts
  std::vector<double> frequencies;               // Hz, ascending
  Eigen::Matrix3Xd points = {};                  // m, wheel frame, on the undeformed tire
  MotionAs motion = MotionAs::displacement;
};

/// "x", "y", "z", and "about_x", "about_y", "about_z" through the wheel center; for a force on a
/// point "x", "y", "z" and "radial".
std::vector<std::string> response_directions(ResponseInput input);

/// Returns names and SI units of the outputs.
std::vector<std::pair<std::string, std::string>> response_outputs(const ResponseTest& test);

/// Computes the channels. Throws InputError if the tire's file lacks the rim's data.
Result<Channels> respond(TireRig& rig, const ResponseTest& test);

}  // namespace latsch::experiment
