// SPDX-License-Identifier: Apache-2.0
#include "rolling_rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "models/fe_tire/rolling/rolling_forces.h"
#include "ring_mesh.h"

namespace latsch::verification {
namespace {

using namespace fe_tire;

constexpr double kSpeed = 1.0;  // m/s

template <class T>
T value_of(Result<T> result) {
  if (!result) throw std::runtime_error(result.failure().reason);
  return *std::move(result);
}

/// Radii from the outer one inward, each row thicker than the one before by `growth`.
std::vector<double> radii(double inner, double outer, double first, double growth) {
  std::vector<double> rows{first};
  double sum = first;
  while (sum < outer - inner) {
    rows.push_back(rows.back() * growth);
    sum += rows.back();
  }
  std::vector<double> at{outer};
  for (const double row : rows) at.push_back(at.back() - row * (outer - inner) / sum);
  at.back() = inner;
  std::ranges::reverse(at);
  return at;
}

Mesh carter_mesh(int across, double width) {
  const double fine = 2.0 * CarterRing::kHalf / across;
  Mesh mesh = ring_mesh({{radii(CarterRing::kRim, CarterRing::kR, 0.75 * fine, 1.25),
                          {0.5 * width, -0.5 * width},
                          0}},
                        3,
                        CarterRing::kRim);
  mesh.theta = planes_finer_at_contact(CarterRing::kR, fine, 1.4 * CarterRing::kHalf, 1.25, 0.03);
  mesh.sectors = static_cast<int>(mesh.theta.size());
  return mesh;
}

Materials carter_materials() {
  return {{{Hyperelastic::from_young_modulus(CarterRing::kE, CarterRing::kNu), 1.0}}, {}};
}

Mesh brush_mesh(int across) {
  const double fine = 2.0 * BrushRing::half_length() / across;
  Mesh mesh = ring_mesh({{{BrushRing::kR - BrushRing::kHeight, BrushRing::kR},
                          {0.5 * BrushRing::kWidth, -0.5 * BrushRing::kWidth},
                          0}},
                        3,
                        BrushRing::kR - BrushRing::kHeight);
  mesh.theta =
      planes_finer_at_contact(BrushRing::kR, fine, 1.4 * BrushRing::half_length(), 1.25, 0.03);
  mesh.sectors = static_cast<int>(mesh.theta.size());
  return mesh;
}

Materials brush_materials() {
  StVenantKirchhoff law;
  const double little = 1e-3 * BrushRing::kRadial;
  law.D.diagonal() << BrushRing::kRadial, little, little, little, little, BrushRing::kShear;
  return {{{law, 1.0}}, {}};
}

}  // namespace

std::vector<double> planes_finer_at_contact(
    double radius, double fine, double reach, double growth, double widest) {
  std::vector<double> half{0.0};
  double width = fine / radius;
  while (half.back() * radius < reach - 1e-9) half.push_back(half.back() + width);
  while (half.back() + width < std::numbers::pi) {
    width = std::min(width * growth, widest / radius);
    half.push_back(half.back() + width);
  }
  // The wider sectors are stretched so that the last one ends opposite the contact.
  const double from = reach / radius, stretch = (std::numbers::pi - from) / (half.back() - from);
  for (double& theta : half)
    if (theta > from) theta = from + stretch * (theta - from);
  half.back() = std::numbers::pi;
  std::vector<double> all = half;
  for (auto at = half.rbegin() + 1; at + 1 != half.rend(); ++at)
    all.push_back(2.0 * std::numbers::pi - *at);
  return all;
}

RollingRing::RollingRing(
    Mesh mesh, Materials materials, double deflection, double mu, double curvature)
    // Wide elements need full integration: enhanced strains of elements a thousand times as wide as
    // long lose the tangent's positive sign.
    : tire_(std::move(mesh),
            std::move(materials),
            {.element = ElementKind::full_integration, .tread = TreadShape::smooth}),
      rolling_(tire_) {
  const Inflated round = value_of(tire_.inflate(0.0));
  const RollingState start = rolling_.start(tire_.over(round, {}, FeTire::Poses::any));
  RollingCase of;
  of.speed = kSpeed;
  of.curvature = curvature;
  of.height = round.radius - deflection;
  of.spin = kSpeed / of.height;
  of.friction.at_rest = mu;
  of.drive = 0.0;
  free_ = value_of(rolling_.roll(start, of));
}

RollingState RollingRing::slipping(double kappa, double alpha) {
  RollingCase of = free_.of;
  of.drive.reset();
  of.slip_angle = alpha;
  of.speed = kSpeed / std::cos(alpha);
  of.spin = (1.0 + kappa) * free_.of.spin;
  return value_of(rolling_.roll(free_, of));
}

RollingState RollingRing::turning(double turn_slip) {
  RollingCase of = free_.of;
  of.drive.reset();
  of.turn_slip = turn_slip;
  return value_of(rolling_.roll(free_, of));
}

namespace {

/// Least squares of p^power = A - B x^2.
HertzFit fit(const RollingState& state, int power) {
  double n = 0.0, x2 = 0.0, x4 = 0.0, y = 0.0, x2y = 0.0;
  for (const RollingPatchPoint& point : state.patch) {
    const double x = point.x * point.x, value = std::pow(point.pressure, power);
    n += 1.0;
    x2 += x;
    x4 += x * x;
    y += value;
    x2y += x * value;
  }
  const double B = (x2 * y - n * x2y) / (n * x4 - x2 * x2), A = (y + B * x2) / n;
  return {std::sqrt(A / B), std::pow(A, 1.0 / power)};
}

}  // namespace

HertzFit fit_hertz(const RollingState& state) { return fit(state, 2); }
HertzFit fit_parabola(const RollingState& state) { return fit(state, 1); }

CarterRing::CarterRing(int across, double drum)
    : ring_(carter_mesh(across, width(drum)),
            carter_materials(),
            kDeflection * kR / radius(drum),
            kMu,
            curvature(drum)) {}

double BrushRing::half_length() { return std::sqrt(2.0 * kR * kDeflection); }
double BrushRing::stiffness() {
  return 1.0 / (kR * std::log(kR / (kR - kHeight)) / kShear + 1.0 / fe_tire::kAlongPenalty);
}

BrushRing::BrushRing(int across) : ring_(brush_mesh(across), brush_materials(), kDeflection, kMu) {}

}  // namespace latsch::verification
