// SPDX-License-Identifier: Apache-2.0
#include "dropped_wheel.h"

#include <Eigen/LU>
#include <cmath>

#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/motion/moving_inertia.h"
#include "models/fe_tire/passage/bossak_step.h"
#include "ring_mesh.h"

namespace latsch::verification {
namespace {

using namespace latsch::fe_tire;

constexpr int kDropSectors = 48;
constexpr double kTread = 0.30, kGap = 1e-6;  // m
constexpr double kSpeed = 1.0;                // m/s downward
/// Stiffness of every node of the tread that is below the ground, N/m: CalculiX' penalty of 2e8
/// Pa/m times the area that it gives to a node.
constexpr double kSpring = 1.168e5;
constexpr double kDropRho = 0.9;   // hardly damps, as alpha = -0.05 of CalculiX
constexpr double kDropped = 1e-7;  // N, residual of a step
constexpr int kMostTurns = 60;
/// Turns of Newton's method after which the tangent is renewed.
constexpr int kRenewAfter = 12;

/// The wheel of the decks drop_wheel.inp and drop_spinning_wheel.inp.
Mesh dropped_mesh() {
  const std::vector<double> sides = {0.01, -0.01};
  return ring_mesh({{{0.19, 0.20}, sides, 2},
                    {{0.20, 0.22, 0.24, 0.26, 0.28}, sides, 0},
                    {{0.28, 0.29, 0.30}, sides, 1}},
                   kDropSectors,
                   0.0);
}

Materials dropped_materials() {
  return {{linear_solid(2e6, 0.3, 1100.0),
           linear_solid(2e7, 0.3, 1200.0),
           linear_solid(2e10, 0.3, 2455.544095)},
          {}};
}

/// The wheel in plane strain, in axes that do not follow its hub.
class Wheel {
 public:
  Wheel(double spin, double step)
      : ring_(dropped_mesh(), ElementKind::full_integration),
        elements_(ring_, dropped_materials()),
        unknowns_(ring_, RingSymmetry::none, {}),
        assembly_(unknowns_),
        inertia_(elements_),
        rule_(step, kDropRho),
        spin_(spin) {
    const Mesh& mesh = ring_.mesh();
    const int size = unknowns_.size(), n = mesh.nodes_per_sector();
    for (int k = 0; k < size; ++k)
      if (k % 3 != 1) plane_.push_back(k);
    now_.x = now_.v = now_.a = Eigen::VectorXd::Zero(size);
    for (int s = 0; s < kDropSectors; ++s) {
      const Eigen::Vector3d up = mesh.frame(s).transpose().col(2);
      for (int k = 0; k < n; ++k) {
        const int first = unknowns_.of_node(s, k).first;
        now_.v.segment<3>(first) = -kSpeed * up;
        if (std::abs(mesh.X(2, k) + kTread) > kGap) continue;
        Eigen::VectorXd moves = Eigen::VectorXd::Zero(size);
        moves.segment<3>(first) = up;
        up_.emplace_back(moves(plane_));
        height_.push_back((mesh.frame(s) * mesh.X.col(k)).z() + kTread + kGap);
      }
    }
    begin();
  }

  /// Moves on by one step. Returns the load, N, or no number if the step has no equilibrium.
  double advance() {
    Eigen::VectorXd x = rule_.predicted(now_);
    for (int turn = 0; turn < kMostTurns; ++turn) {
      if (turn % kRenewAfter == kRenewAfter - 1 || flow_.size() == 0) renew(x);
      const BossakStep::Motion motion = rule_.at(now_, x);
      Eigen::VectorXd r = residual(motion, rule_.mean_acceleration(now_, motion))(plane_);
      std::vector<const Eigen::VectorXd*> touching;
      double load = 0.0;
      const Eigen::VectorXd moved = x(plane_);
      for (std::size_t k = 0; k < up_.size(); ++k) {
        const double depth = -(height_[k] + up_[k].dot(moved));
        if (!(depth > 0.0)) continue;
        load += kSpring * depth;
        r -= kSpring * depth * up_[k];
        touching.push_back(&up_[k]);
      }
      if (r.norm() <= kDropped) {
        now_ = motion;
        return load;
      }
      x(plane_) -= solve(r, touching);
    }
    return std::nan("");
  }

 private:
  Eigen::VectorXd inertia(const Eigen::VectorXd& x,
                          const Eigen::VectorXd& v,
                          const Eigen::VectorXd& a) const {
    const auto at = inertia_.forces(
        {unknowns_.expand(x), unknowns_.expand(v), unknowns_.expand(a), spin_, 0.0});
    return unknowns_.compress(at.at_nodes);
  }

  /// Internal forces and inertia, N.
  Eigen::VectorXd residual(const BossakStep::Motion& motion, const Eigen::VectorXd& a) const {
    AssembledState state = assembly_.zero_state();
    state.x = motion.x;
    Eigen::VectorXd f;
    int worst = 0;
    assembly_.assemble(elements_, state, 0.0, f, nullptr, &worst);
    return f + inertia(motion.x, motion.v, a);
  }

  /// Finds the acceleration of the first instant.
  void begin() {
    const Eigen::VectorXd still = 0.0 * now_.x;
    const Eigen::VectorXd none = inertia(still, still, still);
    Eigen::MatrixXd M(std::ssize(plane_), std::ssize(plane_));
    for (std::size_t k = 0; k < plane_.size(); ++k) {
      const Eigen::VectorXd one = Eigen::VectorXd::Unit(still.size(), plane_[k]);
      M.col(static_cast<Eigen::Index>(k)) = (inertia(still, still, one) - none)(plane_);
    }
    const Eigen::VectorXd r = residual(now_, still)(plane_);
    now_.a(plane_) = -M.partialPivLu().solve(r);
  }

  /// Factorizes the tangent of a step at x, without springs.
  void renew(const Eigen::VectorXd& x) {
    AssembledState state = assembly_.zero_state();
    state.x = x;
    numerics::SymmetricMatrix K(*assembly_.pattern());
    Eigen::VectorXd f, Kx(x.size());
    int worst = 0;
    assembly_.assemble(elements_, state, 0.0, f, &K, &worst);
    const Eigen::Index size = std::ssize(plane_);
    if (flow_.size() == 0) {  // derivative of the inertia, which is linear
      const Eigen::VectorXd still = 0.0 * x, none = inertia(still, still, still);
      flow_.resize(size, size);
      for (Eigen::Index k = 0; k < size; ++k) {
        const Eigen::VectorXd one = Eigen::VectorXd::Unit(x.size(), plane_[k]);
        flow_.col(k) =
            (inertia(one, rule_.of_damping() * one, rule_.of_mass() * one) - none)(plane_);
      }
    }
    Eigen::MatrixXd J = flow_;
    for (Eigen::Index k = 0; k < size; ++k) {
      const Eigen::VectorXd one = Eigen::VectorXd::Unit(x.size(), plane_[k]);
      K.multiply(one.data(), Kx.data());
      J.col(k) += Kx(plane_);
    }
    factor_.compute(J);
  }

  /// Solves (J + kSpring sum of u u^T) d = r.
  Eigen::VectorXd solve(const Eigen::VectorXd& r,
                        const std::vector<const Eigen::VectorXd*>& touching) const {
    const Eigen::VectorXd free = factor_.solve(r);
    if (touching.empty()) return free;
    Eigen::MatrixXd springs(r.size(), std::ssize(touching));
    for (std::size_t k = 0; k < touching.size(); ++k)
      springs.col(static_cast<Eigen::Index>(k)) = *touching[k];
    const Eigen::MatrixXd by = factor_.solve(springs);
    Eigen::MatrixXd small = springs.transpose() * by;
    small.diagonal().array() += 1.0 / kSpring;
    const Eigen::VectorXd forces = small.partialPivLu().solve(springs.transpose() * free);
    return free - by * forces;
  }

  Ring ring_;
  RingElements elements_;
  RingUnknowns unknowns_;
  RingAssembly assembly_;
  MovingInertia inertia_;
  BossakStep rule_;
  double spin_;
  std::vector<int> plane_;           // unknowns in the plane of the wheel
  std::vector<Eigen::VectorXd> up_;  // for each node of the tread: its motion upward, by plane_
  std::vector<double> height_;       // m, of these nodes without motion
  BossakStep::Motion now_;
  Eigen::MatrixXd flow_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
};

}  // namespace

const ListedDrop& listed_drop(bool spins) {
  // CalculiX 2.20 computed these loads, N, on both decks, *DYNAMIC with alpha = -0.05.
  static const ListedDrop standing = {
      {{62.63,  80.71,  90.23,  104.90, 112.83, 122.42, 132.19, 150.23, 167.91, 186.28, 249.81,
        272.32, 275.46, 296.39, 313.74, 333.17, 346.93, 363.35, 390.26, 386.74, 395.22, 417.72,
        426.00, 432.48, 443.60, 450.30, 459.08, 458.97, 460.58, 463.60, 465.81, 462.25, 462.50,
        455.40, 443.19, 432.17, 418.08, 396.31, 394.17, 389.44, 378.76, 356.25, 324.97, 295.98,
        264.49, 227.66, 200.52, 187.26, 187.84, 163.12, 146.06, 129.98},
       8.0099},
      {62.43,  78.65,  92.86,  102.35, 113.64, 123.28, 132.86, 149.08, 168.50, 185.51, 246.11,
       276.90, 275.33, 293.30, 318.13, 330.18, 346.47, 364.63, 385.46, 395.62, 393.26, 411.88,
       429.68, 434.91, 439.25, 453.09, 457.10, 461.56, 461.51, 460.19, 464.77, 465.66, 460.36,
       453.72, 447.11, 430.06, 417.77, 402.76, 389.48, 383.17, 379.32, 359.26, 327.39, 295.87,
       263.06, 231.31, 197.64, 188.91, 182.94, 166.94, 149.06, 125.70}};
  static const ListedDrop spinning = {
      {{61.14,  187.37, 242.51, 203.03, 387.30, 284.74, 213.00, 204.58, 228.81, 182.35, 155.94,
        190.52, 200.67, 204.16, 400.11, 384.56, 445.47, 599.39, 486.21, 570.14, 577.81, 453.60,
        359.31, 317.49, 371.49, 353.41, 306.45, 380.55, 438.86, 400.78, 540.09, 478.64, 412.33,
        587.44, 525.83, 354.10, 297.95, 312.06, 268.67, 201.81, 273.99, 311.56, 249.13, 190.57,
        289.69, 304.51, 225.53, 172.32, 196.48, 207.16, 98.45,  78.14},
       8.187},
      {60.82,  186.36, 247.41, 203.92, 378.81, 287.88, 210.57, 206.21, 225.80, 188.10, 160.47,
       175.93, 201.63, 206.68, 384.14, 394.37, 440.38, 585.86, 495.50, 571.43, 588.28, 449.95,
       355.88, 326.15, 365.05, 356.11, 318.65, 363.21, 429.49, 422.74, 532.13, 459.82, 426.42,
       582.58, 509.08, 377.63, 314.21, 297.69, 266.39, 225.64, 251.43, 302.57, 265.15, 182.11,
       255.36, 348.26, 210.14, 158.17, 232.37, 185.60, 88.61,  87.14}};
  return spins ? spinning : standing;
}

DroppedWheel drop_wheel(bool spins, double step, double end) {
  Wheel wheel(spins ? kDropSpin : 0.0, step);
  DroppedWheel found;
  const long steps = std::lround(end / step), every = std::lround(kDropInterval / step);
  double before = 0.0;
  for (long k = 1; k <= steps; ++k) {
    const double load = wheel.advance();
    found.impulse += 0.5 * step * (before + load);
    before = load;
    if (k % every == 0) found.Fz.push_back(load);
  }
  return found;
}

namespace {

/// Returns the rms of the difference of means over `width` successive values, over that of the
/// second ones.
double relative_rms(const std::vector<double>& of,
                    const std::vector<double>& to,
                    std::size_t width) {
  double difference = 0.0, size = 0.0;
  for (std::size_t k = 0; k + width <= of.size(); ++k) {
    double mean = 0.0, listed = 0.0;
    for (std::size_t j = k; j < k + width; ++j) {
      mean += of[j];
      listed += to[j];
    }
    difference += (mean - listed) * (mean - listed);
    size += listed * listed;
  }
  return std::sqrt(difference / size);
}

}  // namespace

DropErrors drop_errors(bool spins, const DroppedWheel& found) {
  constexpr std::size_t kPassage = 4;
  const DroppedWheel& listed = listed_drop(spins).by_short_steps;
  return {std::abs(found.impulse / listed.impulse - 1.0),
          relative_rms(found.Fz, listed.Fz, 1),
          relative_rms(found.Fz, listed.Fz, kPassage)};
}

}  // namespace latsch::verification
