// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/reference_tires.h"

#include <numbers>

namespace latsch::fe_tire {
namespace {

constexpr double kMegapascal = 1e6;
// Thickness of smeared cords, m. Only the product of modulus and thickness matters.
constexpr double kCordThickness = 1e-3;

CordPly ply(const char* name, double to, double stiffness, double angle_deg) {
  CordPly ply;
  ply.name = name;
  ply.extent = {0.0, to};
  ply.cords.E_tension = ply.cords.E_compression = stiffness / kCordThickness;
  ply.cords.thickness = kCordThickness;
  ply.cords.angle = angle_deg * std::numbers::pi / 180.0;
  return ply;
}

TireDescription passenger_tire() {
  TireDescription tire;
  tire.section.inside = {{0.0, 0.42, 0.52, 0.85, 1.0}, {6e-3, 6e-3, 4e-3, 4e-3, 7e-3}};
  tire.section.outside = {{0.0, 0.42, 0.52, 0.85, 1.0}, {9e-3, 9e-3, 5e-3, 4e-3, 6e-3}};
  const Hyperelastic law{1.0 * kMegapascal, 0.0, 100.0 * kMegapascal};
  tire.rubbers = {{"matrix", law, 1150.0}, {"belt", law, 1600.0}};
  tire.regions = {{"tread and sidewall", {0.0, 1.0}, LineSide::outside, 0},
                  {"belt", {0.0, 0.46}, LineSide::inside, 1},
                  {"carcass", {0.46, 1.0}, LineSide::inside, 0}};
  tire.plies = {ply("carcass", 1.0, 2e6, 90.0),
                ply("belt_1", 0.46, 20e6, 24.0),
                ply("belt_2", 0.46, 20e6, -24.0),
                ply("cap", 0.46, 2e6, 0.0)};
  tire.cord_model = CordModel::smeared;
  return tire;
}

/// Converts mm to m by division, not by multiplication, so that 310 mm has exactly the bits of
/// 0.31, as in a tire file.
std::vector<MeridianPoint> millimeters(std::vector<MeridianPoint> points) {
  for (MeridianPoint& p : points) p = {p.y / 1e3, p.r / 1e3};
  return points;
}

}  // namespace

TireDescription reference_tire_a() {
  TireDescription tire = passenger_tire();
  tire.name = "tire A, cords smeared";
  tire.size = "235/45R20";
  tire.pressure = 2.5e5;
  tire.section.contour = millimeters({{0, 353.5},
                                      {48, 352.5},
                                      {80, 350},
                                      {100, 344.5},
                                      {113, 332},
                                      {118, 313},
                                      {116, 293},
                                      {107, 274},
                                      {94, 262}});
  tire.section.meridional = 26;
  tire.section.rows_outside = 2;
  tire.section.sectors = 90;
  return tire;
}

TireDescription reference_tire_b() {
  TireDescription tire = passenger_tire();
  tire.name = "tire B, cords smeared";
  tire.size = "225/50R16";
  tire.pressure = 2.6e5;
  tire.section.contour = millimeters({{0, 310},
                                      {45, 309},
                                      {75, 306.5},
                                      {94, 301},
                                      {107, 288},
                                      {112, 268},
                                      {110, 246},
                                      {99, 224},
                                      {85, 211}});
  tire.section.clamp = BeadClamp::outside;
  return tire;
}

}  // namespace latsch::fe_tire
