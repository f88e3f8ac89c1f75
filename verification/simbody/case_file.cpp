// SPDX-License-Identifier: Apache-2.0
#include "simbody/case_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"

namespace latsch::verification {
namespace {

using Eigen::Vector3d;
using multibody::kGround;
using nlohmann::json;

class Reader {
 public:
  Reader(const json& from, const std::string& file) : from_(from), file_(file) {}

  CaseFile read() {
    CaseFile to;
    to.gravity = vector(from_, "gravity");
    each(from_, "bodies", [&](const json& one) {
      to.bodies.push_back(
          {one.at("name"), vector(one, "center_of_mass"), one.at("mass"), inertia(one)});
      names_.push_back(to.bodies.back().name);
    });
    each(from_, "bushings", [&](const json& one) {
      to.joints.push_back({.name = one.at("name"),
                           .a = body(one, "a"),
                           .b = body(one, "b"),
                           .point = vector(one, "point"),
                           .bushing = stiffness(one)});
      to.joints.back().bushing.damping = vector(one, "damping");
      to.joints.back().bushing.rotational_damping = vector(one, "rotational_damping");
    });
    to.loads = loads(from_);
    each(from_, "load_cases", [&](const json& one) {
      to.load_cases.push_back({one.at("name"), loads(one)});
    });
    if (to.load_cases.empty()) to.load_cases.push_back({"rest", {}});
    read_drive(to);
    each(from_, "outputs", [&](const json& one) {
      to.outputs.push_back({one.at("name"), body(one, "body"), vector(one, "point")});
    });
    return to;
  }

 private:
  void read_drive(CaseFile& to) const {
    each(from_, "tires", [&](const json& one) {
      to.tires.push_back({one.at("name"),
                          body(one, "body"),
                          vector(one, "wheel_center"),
                          one.at("radius"),
                          one.at("stiffness"),
                          one.at("damping")});
    });
    if (from_.contains("held_in_statics")) {
      const json& held = from_.at("held_in_statics");
      const int at = body(held, "body");
      to.held_in_statics = {.name = "held_in_statics",
                            .a = kGround,
                            .b = at,
                            .point = to.bodies.at(static_cast<std::size_t>(at)).origin,
                            .bushing = stiffness(held)};
    }
    if (from_.contains("road")) {
      const json& road = from_.at("road");
      to.road = {road.at("pitch"),
                 road.at("height"),
                 road.at("start"),
                 road.at("count"),
                 road.at("lateral").at(0),
                 road.at("lateral").at(1)};
    }
    to.speed = from_.value("speed", 0.0);
    to.time = from_.value("time", 0.0);
    to.output_step = from_.value("output_step", 0.0);
  }

  template <class Read>
  static void each(const json& from, const char* key, Read read) {
    if (from.contains(key))
      for (const json& one : from.at(key)) read(one);
  }

  Vector3d vector(const json& from, const char* key) const {
    const json& values = from.at(key);
    if (values.size() != 3)
      throw InputError({file_}, fmt::format("{} has {} numbers, expected 3", key, values.size()));
    return {values[0].get<double>(), values[1].get<double>(), values[2].get<double>()};
  }

  Eigen::Matrix3d inertia(const json& from) const {
    const json& I = from.at("inertia");
    if (I.size() != 6)
      throw InputError(
          {file_},
          fmt::format("inertia has {} numbers, expected Ixx Iyy Izz Ixy Ixz Iyz", I.size()));
    const auto at = [&](std::size_t i) { return I[i].get<double>(); };
    Eigen::Matrix3d tensor;
    tensor << at(0), at(3), at(4), at(3), at(1), at(5), at(4), at(5), at(2);
    return tensor;
  }

  multibody::BushingParameters stiffness(const json& from) const {
    return {vector(from, "stiffness"), vector(from, "rotational_stiffness")};
  }

  int body(const json& from, const char* key) const {
    const std::string name = from.at(key);
    if (name == "ground") return kGround;
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (names_[i] == name) return static_cast<int>(i);
    throw InputError({file_}, fmt::format("{} is \"{}\", expected the name of a body", key, name));
  }

  std::vector<multibody::Load> loads(const json& from) const {
    std::vector<multibody::Load> loads;
    each(from, "loads", [&](const json& one) {
      loads.push_back(
          {body(one, "body"), vector(one, "point"), vector(one, "force"), vector(one, "moment")});
    });
    return loads;
  }

  const json& from_;
  std::string file_;
  std::vector<std::string> names_;
};

}  // namespace

CaseFile read_case_file(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  try {
    const json from = json::parse(text);
    return Reader(from, file.string()).read();
  } catch (const json::exception& error) {
    throw InputError({file.string()}, error.what());
  }
}

std::vector<multibody::Load> loads_of(const CaseFile& file, const LoadCase& load_case) {
  std::vector<multibody::Load> loads = file.loads;
  loads.insert(loads.end(), load_case.loads.begin(), load_case.loads.end());
  for (std::size_t i = 0; i < file.bodies.size(); ++i)
    loads.push_back(
        {static_cast<int>(i), file.bodies[i].origin, file.bodies[i].mass * file.gravity});
  return loads;
}

std::vector<multibody::Joint> joints_in_statics(const CaseFile& file) {
  std::vector<multibody::Joint> joints = file.joints;
  if (file.held_in_statics) joints.push_back(*file.held_in_statics);
  for (const LinearTire& tire : file.tires)
    joints.push_back({.name = tire.name,
                      .a = kGround,
                      .b = tire.body,
                      .point = tire.wheel_center,
                      .bushing = {{0.0, 0.0, tire.stiffness}, Vector3d::Zero()}});
  return joints;
}

Vector3d displacement(const CaseFile& file,
                      const OutputPoint& output,
                      const multibody::Poses& poses) {
  const std::size_t body = static_cast<std::size_t>(output.body);
  return poses[body].at(output.point - file.bodies[body].origin) - output.point;
}

}  // namespace latsch::verification
