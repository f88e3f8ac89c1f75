// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/response_rig.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "base/error.h"
#include "base/units.h"
#include "models/fe_tire/motion/response_rim.h"
#include "models/fe_tire/motion/tire_response.h"

namespace latsch::experiment {
namespace {

using fe_tire::ResponsePort;
using fe_tire::RimMotion;

const char* const kAxes[] = {"x", "y", "z"};

/// Returns the SI unit of an output over that of the input.
std::string per_input(const std::string& output, const ResponseTest& test) {
  const bool turns = test.direction.starts_with("about_");
  const char* over = turns ? "/rad" : "/m";
  if (test.input == ResponseInput::point) over = "/N";
  if (test.input == ResponseInput::hub) over = turns ? "/N/m" : "/N";
  return si_unit(Unit::of(output + over).dimension());
}

bool moves_rim(const ResponseTest& test) { return test.stand.rim != RimMotion::held; }

/// The ports of a test and the index of the one that drives.
struct TestPorts {
  std::vector<ResponsePort> ports;
  Eigen::Index driven = 0;
};

ResponsePort rigid(ResponsePort::Of of, int k) {
  return {.of = of, .axis = Eigen::Vector3d::Unit(k % 3), .turns = k >= 3};
}

/// Returns the index of a rigid motion: 0 ... 2 along and 3 ... 5 about x, y, z.
int rigid_index(const std::string& direction) {
  const int axis = direction.back() - 'x';
  return direction.starts_with("about_") ? 3 + axis : axis;
}

Eigen::Vector3d direction_at(const ResponseTest& test) {
  if (test.direction != "radial") return Eigen::Vector3d::Unit(test.direction.back() - 'x');
  return Eigen::Vector3d(test.at.x(), 0.0, test.at.z()).normalized();
}

/// Returns the factor by which a displacement becomes the motion that is recorded.
std::complex<double> recorded(MotionAs motion, double omega) {
  const std::complex<double> s(0.0, omega);
  if (motion == MotionAs::displacement) return 1.0;
  return motion == MotionAs::velocity ? s : s * s;
}

std::string unit_of_motion(MotionAs motion, const char* of) {
  if (motion == MotionAs::displacement) return of;
  return std::string(of) + (motion == MotionAs::velocity ? "/s" : "/s^2");
}

/// One output: its name, its unit, and whether it is a motion.
struct OutputRow {
  std::string name, unit;
  bool is_motion;
};

/// Returns the outputs in the order of the ports: points, the ground, the wheel.
std::vector<OutputRow> output_rows(const ResponseTest& test) {
  std::vector<OutputRow> rows;
  for (Eigen::Index k = 0; k < test.points.cols(); ++k)
    for (const char* axis : kAxes)
      rows.push_back(
          {fmt::format("point_{}_{}", k + 1, axis), unit_of_motion(test.motion, "m"), true});
  const auto add_forces = [&](const char* where) {
    for (const char* axis : kAxes) rows.push_back({fmt::format("{}_F{}", where, axis), "N", false});
    for (const char* axis : kAxes)
      rows.push_back({fmt::format("{}_M{}", where, axis), "N m", false});
  };
  if (test.stand.loaded()) add_forces("patch");
  if (!moves_rim(test)) {
    add_forces("hub");
    return rows;
  }
  for (const char* axis : kAxes)
    rows.push_back({fmt::format("rim_{}", axis), unit_of_motion(test.motion, "m"), true});
  for (const char* axis : kAxes)
    rows.push_back({fmt::format("rim_about_{}", axis), unit_of_motion(test.motion, "rad"), true});
  return rows;
}

/// Returns the ports in the order of output_rows(), with a driven point in front of the wheel's
/// six.
TestPorts ports_of(const fe_tire::Mesh& mesh, const ResponseTest& test) {
  TestPorts found;
  const auto sensors = nearest_sensors(mesh, test.points).nodes;
  for (const int node : sensors)
    for (int d = 0; d < 3; ++d)
      found.ports.push_back({.node = node, .axis = Eigen::Vector3d::Unit(d)});
  const Eigen::Index ground = std::ssize(found.ports);
  if (test.stand.loaded())
    for (int k = 0; k < 6; ++k) found.ports.push_back(rigid(ResponsePort::Of::ground, k));
  if (test.input == ResponseInput::point) {
    const Eigen::Matrix3Xd at = test.at;
    found.driven = std::ssize(found.ports);
    found.ports.push_back(
        {.node = nearest_sensors(mesh, at).nodes.front(), .axis = direction_at(test)});
  }
  const Eigen::Index wheel = std::ssize(found.ports);
  for (int k = 0; k < 6; ++k) found.ports.push_back(rigid(ResponsePort::Of::wheel, k));
  if (test.input == ResponseInput::ground) found.driven = ground + rigid_index(test.direction);
  if (test.input == ResponseInput::wheel || test.input == ResponseInput::hub)
    found.driven = wheel + rigid_index(test.direction);
  return found;
}

/// Four channels of one output over frequency.
struct OutputChannels {
  Channel re, im, tf, phase;
  OutputChannels(const std::string& name, const std::string& unit)
      : re{"re_" + name, unit, {}},
        im{"im_" + name, unit, {}},
        tf{"tf_" + name, unit, {}},
        phase{"phase_" + name, "rad", {}} {}
  void add(std::complex<double> value) {
    re.values.push_back(value.real());
    im.values.push_back(value.imag());
    tf.values.push_back(std::abs(value));
    phase.values.push_back(std::arg(value));
  }
};

Result<fe_tire::TireState> state_of(TireRig& rig, const ResponseTest& test) {
  const auto& inflated = rig.inflated(test.stand.pressure.value_or(rig.own_pressure()));
  if (!inflated) return inflated.failure();
  if (test.stand.loaded()) return rig.stand(test.stand, *inflated);
  fe_tire::TireState state = rig.tire().over(*inflated, {});
  state.pose.height *= 2.0;  // the ground is far below
  return state;
}

}  // namespace

std::vector<std::string> response_directions(ResponseInput input) {
  if (input == ResponseInput::point) return {"x", "y", "z", "radial"};
  return {"x", "y", "z", "about_x", "about_y", "about_z"};
}

std::vector<std::pair<std::string, std::string>> response_outputs(const ResponseTest& test) {
  std::vector<std::pair<std::string, std::string>> outputs;
  for (const OutputRow& row : output_rows(test))
    outputs.emplace_back(row.name, per_input(row.unit, test));
  return outputs;
}

Result<Channels> respond(TireRig& rig, const ResponseTest& test) {
  fe_tire::Rim rim{.motion = test.stand.rim};
  if (moves_rim(test)) {
    if (!rig.rim())
      throw InputError(
          "the rim of this test moves, and the tire file states none: expected a table [rim] with "
          "mass, inertia_spin and inertia_diameter in it, or rim = \"held\"");
    rim.body = *rig.rim();
  }
  const fe_tire::Mesh& mesh = rig.tire().mesh();
  for (const Eigen::Matrix3Xd& points :
       {test.points,
        test.input == ResponseInput::point ? Eigen::Matrix3Xd(test.at) : Eigen::Matrix3Xd(3, 0)})
    if (const Status near = points_on_tire(mesh, points); !near) return near.failure();
  const auto state = state_of(rig, test);
  if (!state) return state.failure();
  const TestPorts ports = ports_of(mesh, test);
  const auto response = fe_tire::TireResponse::about(
      rig.tire(), rig.losses(), *state, ports.ports, {.highest = test.frequencies.back()});
  if (!response) return response.failure();

  const std::vector<OutputRow> rows = output_rows(test);
  std::vector<OutputChannels> outputs;
  for (const auto& [name, unit] : response_outputs(test)) outputs.emplace_back(name, unit);
  // A driven point stands between the other outputs and the wheel's, and is no output itself.
  const bool has_driven_point = test.input == ResponseInput::point;
  const std::size_t before_wheel = rows.size() - 6;
  for (const double frequency : test.frequencies) {
    const double omega = 2.0 * std::numbers::pi * frequency;
    Eigen::MatrixXcd H = response->at(frequency);
    if (moves_rim(test)) H = on_moving_rim(H, rim, omega);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const auto row =
          static_cast<Eigen::Index>(k + (has_driven_point && k >= before_wheel ? 1 : 0));
      const std::complex<double> value = H(row, ports.driven);
      outputs[k].add(rows[k].is_motion ? recorded(test.motion, omega) * value : value);
    }
  }
  Channels channels;
  channels.add({"frequency", "Hz", test.frequencies});
  for (OutputChannels& output : outputs)
    for (Channel* channel : {&output.re, &output.im, &output.tf, &output.phase})
      channels.add(std::move(*channel));
  if (!test.stand.loaded()) return channels;
  const fe_tire::Standing standing = rig.tire().stand(*state);
  channels.add({"deflection", "m", {standing.deflection}});
  channels.add({"loaded_radius", "m", {standing.loaded_radius}});
  channels.add({"force", "N", {standing.force.z()}});
  return channels;
}

}  // namespace latsch::experiment
