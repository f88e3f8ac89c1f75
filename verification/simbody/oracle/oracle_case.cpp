// SPDX-License-Identifier: Apache-2.0
#include "oracle_case.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace oracle {
namespace {

using nlohmann::json;
using SimTK::Vec3;

Vec3 vector(const json& from, const char* key) {
  const json& values = from.at(key);
  if (values.size() != 3) throw std::runtime_error(std::string(key) + ": three numbers expected");
  return {values[0].get<double>(), values[1].get<double>(), values[2].get<double>()};
}

BodyData body(const json& from) {
  const json& I = from.at("inertia");
  if (I.size() != 6) throw std::runtime_error("inertia: Ixx Iyy Izz Ixy Ixz Iyz expected");
  return {from.at("name"),
          from.at("mass"),
          vector(from, "center_of_mass"),
          {I[0].get<double>(), I[1].get<double>(), I[2].get<double>()},
          {I[3].get<double>(), I[4].get<double>(), I[5].get<double>()}};
}

BushingData bushing(const json& from) {
  return {from.at("name"),
          from.at("a"),
          from.at("b"),
          vector(from, "point"),
          vector(from, "stiffness"),
          vector(from, "rotational_stiffness"),
          vector(from, "damping"),
          vector(from, "rotational_damping")};
}

LoadData load(const json& from) {
  return {from.at("body"), vector(from, "point"), vector(from, "force"), vector(from, "moment")};
}

TireData tire(const json& from) {
  return {from.at("body"),
          vector(from, "wheel_center"),
          from.at("radius"),
          from.at("stiffness"),
          from.at("damping")};
}

RoadData road(const json& from) {
  const json& lateral = from.at("lateral");
  return {from.at("pitch"),
          from.at("height"),
          from.at("start"),
          from.at("count"),
          {lateral.at(0).get<double>(), lateral.at(1).get<double>()}};
}

/// Returns a spring, attached at the center of mass, that holds a body in a static computation.
BushingData hold(const json& from, const std::vector<BodyData>& bodies) {
  BushingData hold{"held_in_statics",
                   "ground",
                   from.at("body"),
                   Vec3(0),
                   vector(from, "stiffness"),
                   vector(from, "rotational_stiffness"),
                   Vec3(0),
                   Vec3(0)};
  for (const BodyData& body : bodies)
    if (body.name == hold.b) hold.point = body.center;
  return hold;
}

template <class Value, class Read>
std::vector<Value> list(const json& from, const char* key, Read read) {
  std::vector<Value> values;
  if (from.contains(key))
    for (const json& one : from.at(key)) values.push_back(read(one));
  return values;
}

}  // namespace

double RoadData::height_at(double s) const {
  const double along = s - start;
  if (along <= 0.0 || along >= count * pitch) return 0.0;
  return 0.5 * height * (1.0 - std::cos(2.0 * SimTK::Pi * along / pitch));
}

double RoadData::slope_at(double s) const {
  const double along = s - start;
  if (along <= 0.0 || along >= count * pitch) return 0.0;
  return height * SimTK::Pi / pitch * std::sin(2.0 * SimTK::Pi * along / pitch);
}

Case read_case(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + " cannot be read");
  const json from = json::parse(in);
  Case read;
  read.gravity = vector(from, "gravity");
  read.bodies = list<BodyData>(from, "bodies", body);
  read.bushings = list<BushingData>(from, "bushings", bushing);
  read.loads = list<LoadData>(from, "loads", load);
  read.load_cases = list<LoadCase>(from, "load_cases", [](const json& one) {
    return LoadCase{one.at("name"), list<LoadData>(one, "loads", load)};
  });
  if (read.load_cases.empty()) read.load_cases.push_back({"rest", {}});
  read.tires = list<TireData>(from, "tires", tire);
  if (from.contains("held_in_statics"))
    read.held_in_statics = hold(from.at("held_in_statics"), read.bodies);
  if (from.contains("road")) read.road = road(from.at("road"));
  read.speed = from.value("speed", 0.0);
  read.time = from.value("time", 0.0);
  read.output_step = from.value("output_step", 0.0);
  read.outputs = list<OutputPoint>(from, "outputs", [](const json& one) {
    return OutputPoint{one.at("name"), one.at("body"), vector(one, "point")};
  });
  return read;
}

}  // namespace oracle
