// SPDX-License-Identifier: Apache-2.0
#include "models/rigid_ring/cam_contact.h"

#include <algorithm>
#include <cmath>

namespace latsch::rigid_ring {
namespace {

constexpr double kFirst = 4e-3;     // m: longer pieces are always halved
constexpr double kFine = 1e-3;      // m: bounds above the known maximum are not followed below this
                                    // length
constexpr double kSmooth = 1e-9;    // m: largest distance from a parabola at the quarters
constexpr double kShortest = 1e-7;  // m

}  // namespace

double CamContact::Piece::highest() const { return *std::max_element(h, h + 5); }

double CamContact::Piece::roughest() const {
  double most = 0.0;
  for (int i = 0; i < 4; ++i) most = std::max(most, std::abs(h[i + 1] - h[i]));
  return most;
}

/// True if the quarters lie on the parabola through ends and middle.
bool CamContact::Piece::smooth() const {
  const double one = 0.375 * h[0] + 0.75 * h[2] - 0.125 * h[4];
  const double three = -0.125 * h[0] + 0.75 * h[2] + 0.375 * h[4];
  return std::abs(h[1] - one) <= kSmooth && std::abs(h[3] - three) <= kSmooth;
}

CamContact::CamContact(const CamOutline& cam,
                       const Eigen::Vector2d& middle,
                       const Eigen::Vector2d& heading,
                       const road::Road& road,
                       double time)
    : cam_(cam), middle_(middle), heading_(heading), road_(road), time_(time), best_(-INFINITY) {
  const double rear = ground(-cam.a), below = ground(0.0), front = ground(cam.a);
  improve(-cam.a, rear);
  improve(0.0, below);
  improve(cam.a, front);
  look(0.0, below, cam.a, front);
  look(-cam.a, rear, 0.0, below);
}

double CamContact::ground(double x) const {
  const Eigen::Vector2d at = middle_ + x * heading_;
  return road_.height(at.x(), at.y(), time_);
}

road::GroundBounds CamContact::bounds(double l, double r) const {
  const Eigen::Vector2d from = middle_ + l * heading_, to = middle_ + r * heading_;
  const Eigen::Vector2d low = from.cwiseMin(to), high = from.cwiseMax(to);
  return road_.bounds({low.x(), high.x(), low.y(), high.y()}, time_);
}

/// Searches a piece on one side of the middle, whose ends are known and counted.
void CamContact::look(double l, double h_l, double r, double h_r) {
  const double nearest = cam_.depth(std::min(std::abs(l), std::abs(r)));
  const road::GroundBounds bound = bounds(l, r);
  if (bound.plane) return touch_line(l, h_l, r, h_r);
  if (bound.highest + nearest <= best_) return;
  if (r - l > kFirst) return halve(l, h_l, r, h_r);
  const double w = r - l;
  const Piece piece{
      l, r, {h_l, ground(l + 0.25 * w), ground(l + 0.5 * w), ground(l + 0.75 * w), h_r}};
  for (int i = 1; i < 4; ++i) improve(l + 0.25 * i * w, piece.h[i]);
  const double highest = piece.highest();
  const bool hides = w > kFine && std::isfinite(bound.highest) && bound.highest > highest + kSmooth;
  if (piece.smooth() && !hides) return touch_parabola(piece);
  if (w < kShortest) return;
  if (!hides && highest + piece.roughest() + nearest <= best_) return;
  halve(l, h_l, r, h_r);
}

/// The half nearer to the middle comes first, because the outline is lowest there.
void CamContact::halve(double l, double h_l, double r, double h_r) {
  const double m = 0.5 * (l + r), h_m = ground(m);
  improve(m, h_m);
  if (m > 0.0) {
    look(l, h_l, m, h_m);
    look(m, h_m, r, h_r);
  } else {
    look(m, h_m, r, h_r);
    look(l, h_l, m, h_m);
  }
}

void CamContact::touch_line(double l, double h_l, double r, double h_r) {
  const double rise = (h_r - h_l) / (r - l), x = cam_.touch(rise);
  if (x > l && x < r) improve(x, h_l + rise * (x - l));
}

/// Finds where d/dx (h + depth) = 0 by regula falsi in the Illinois variant.
void CamContact::touch_parabola(const Piece& piece) {
  constexpr int kMost = 50;
  constexpr double kClose = 1e-9;  // m: the height is flat there
  const double w = piece.width();
  const double rise = (piece.h[4] - piece.h[0]) / w;  // in the middle
  const double bend = 4.0 * (piece.h[4] - 2.0 * piece.h[2] + piece.h[0]) / (w * w);
  const double m = 0.5 * (piece.l + piece.r);
  const auto rate = [&](double x) { return rise + bend * (x - m) + cam_.slope(x); };
  double x0 = piece.l, x1 = piece.r, f0 = rate(x0), f1 = rate(x1);
  if (!(f0 > 0.0 && f1 < 0.0)) return;
  double x = m, last = x0;
  int side = 0;  // side of the last x: -1 left of the root
  for (int i = 0; i < kMost && std::abs(x - last) > kClose; ++i) {
    last = x;
    x = std::isfinite(f0) && std::isfinite(f1) ? (x0 * f1 - x1 * f0) / (f1 - f0) : 0.5 * (x0 + x1);
    const double f = rate(x);
    if (f > 0.0) {
      x0 = x, f0 = f;
      if (side == -1) f1 *= 0.5;
      side = -1;
    } else {
      x1 = x, f1 = f;
      if (side == 1) f0 *= 0.5;
      side = 1;
    }
  }
  improve(x, piece.h[2] + (rise + 0.5 * bend * (x - m)) * (x - m));
}

}  // namespace latsch::rigid_ring
