// SPDX-License-Identifier: Apache-2.0
// Frequency responses of finite-element tires: accuracy beside independent results, and CPU time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "cpu_time.h"
#include "harmonic_ring.h"
#include "models/fe_tire/motion/tire_response.h"
#include "relaxation_rows.h"
#include "shipped_tires.h"
#include "spinning_rings.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr double kDeflection = 0.015;  // m
constexpr double kSlow = 0.1;          // Hz
constexpr double kNoResidual = 1e-10;  // relative to the pressure's force
constexpr double kHighest = 300.0;     // Hz

ResponsePort moved(ResponsePort::Of of, int axis, bool turns = false) {
  return {.of = of, .axis = Eigen::Vector3d::Unit(axis), .turns = turns};
}

std::string percent(double error) { return fmt::format("{:.4f} %", 100.0 * error); }

void ring_rows(Table& table) {
  const auto errors = verification::harmonic_errors(verification::harmonic_response(true));
  table.row("harmonic_ring, all unknowns of an independent program: at the force",
            percent(errors.drive),
            "<= 0.1 %",
            errors.drive <= 1e-3);
  table.row("the same at the opposite place", percent(errors.top), "<= 0.1 %", errors.top <= 1e-3);
  const auto modal = verification::harmonic_errors(verification::harmonic_response(false));
  table.note("the same in modes alone",
             fmt::format("{}, {}", percent(modal.drive), percent(modal.top)));
  const double reaction = verification::reaction_error();
  table.row("its forces on the rim, reactions of its nodes by all unknowns",
            percent(reaction),
            "<= 0.1 %",
            reaction <= 1e-3);
}

/// The whole tire with a loss factor of 0.15 of every rubber above 10 Hz, so that it is relaxed at
/// kSlow.
TireDescription lossy_tire(const Options& options) {
  TireDescription tire = tire_for(options, "passenger_225_50R16");
  for (Rubber& rubber : tire.rubbers)
    rubber.prony = value_of(constant_loss_factor(0.15, 10.0, 1000.0));
  return tire;
}

void slope_rows(Table& table, FeTire& tire, const LossMaterials& losses, const Inflated& inflated) {
  constexpr double kStep = 1e-5;  // m, rad
  const auto rows = [&](const std::string& what, double found, double slope) {
    const double error = std::abs(found / slope - 1.0);
    table.row(
        "at 0.1 Hz, slope of the steady force: " + what, percent(error), "<= 0.5 %", error <= 5e-3);
  };
  const auto pressed =
      value_of(tire.press(inflated, {}, {kDeflection - kStep, kDeflection, kDeflection + kStep}));
  const auto vertical = value_of(TireResponse::about(
      tire, losses, pressed[1], {moved(ResponsePort::Of::ground, 2)}, {.highest = kHighest / 3.0}));
  rows("Fz by the ground's height, no friction",
       vertical.at(kSlow)(0, 0).real(),
       (tire.stand(pressed[2]).force.z() - tire.stand(pressed[0]).force.z()) / (2.0 * kStep));

  const Ground rough{.mu = 5.0};
  const GroundPose pose = FeTire::below(inflated, kDeflection);
  const auto standing =
      value_of(tire.advance(tire.over(inflated, rough, FeTire::Poses::any), {pose})).back();
  const auto sticking = value_of(TireResponse::about(tire,
                                                     losses,
                                                     standing,
                                                     {moved(ResponsePort::Of::ground, 0),
                                                      moved(ResponsePort::Of::ground, 1),
                                                      moved(ResponsePort::Of::ground, 2, true)},
                                                     {.highest = kHighest / 3.0}))
                            .at(kSlow);
  const auto slope = [&](const auto& move) -> Eigen::Vector3d {
    GroundPose plus = pose, minus = pose;
    move(plus, kStep), move(minus, -kStep);
    const auto more = tire.stand(value_of(tire.advance(standing, {plus})).back());
    const auto less = tire.stand(value_of(tire.advance(standing, {minus})).back());
    return Eigen::Vector3d((more.force.x() - less.force.x()),
                           (more.force.y() - less.force.y()),
                           (more.moment.z() - less.moment.z())) /
           (2.0 * kStep);
  };
  rows("Fx by sticking ground that moves along x",
       sticking(0, 0).real(),
       slope([](GroundPose& at, double d) { at.x += d; }).x());
  rows("Fy by sticking ground that moves along y",
       sticking(1, 1).real(),
       slope([](GroundPose& at, double d) { at.y += d; }).y());
  rows("Mz by sticking ground that turns about z",
       sticking(2, 2).real(),
       slope([](GroundPose& at, double d) { at.yaw += d; }).z());
}

void cost_rows(Table& table,
               const Options& options,
               FeTire& tire,
               const LossMaterials& losses,
               const Inflated& inflated) {
  const int points = options.size(300, 10);
  const double highest = options.size(kHighest, 100.0);
  const std::vector<ResponsePort> ports = {moved(ResponsePort::Of::ground, 2),
                                           moved(ResponsePort::Of::wheel, 0),
                                           moved(ResponsePort::Of::wheel, 2)};
  const auto state = value_of(tire.press(inflated, {.mu = 0.8}, {kDeflection})).back();
  const double before = cpu_seconds();
  const auto response =
      value_of(TireResponse::about(tire, losses, state, ports, {.highest = highest}));
  const double prepared = cpu_seconds();
  std::vector<Eigen::MatrixXcd> found;
  for (int k = 1; k <= points; ++k) found.push_back(response.at(highest * k / points));
  const double seconds = cpu_seconds() - before;
  table.note("shapes of the response",
             fmt::format("{} modes up to {:g} Hz, {} shapes in all",
                         response.modes(),
                         TireResponse::kBeyond * highest,
                         response.shapes()));
  table.full_row(
      fmt::format("{} frequencies, ground and wheel driven, with losses", points),
      fmt::format(
          "{:.1f} s CPU, {:.1f} of them before the first frequency", seconds, prepared - before),
      "<= 15 s",
      seconds <= 15.0);
  const auto more = value_of(TireResponse::about(
      tire, losses, state, ports, {.highest = highest, .beyond = 2.0 * TireResponse::kBeyond}));
  double change = 0.0, largest = 0.0;
  for (int k = 1; k <= points; ++k) {
    const Eigen::MatrixXcd finer = more.at(highest * k / points);
    change = std::max(change,
                      (finer - found[k - 1]).cwiseAbs().maxCoeff() / finer.cwiseAbs().maxCoeff());
    largest = std::max(largest, finer.cwiseAbs().maxCoeff());
  }
  table.row("forces with modes up to twice that multiple differ by at most",
            percent(change),
            "<= 0.5 % of the largest at the frequency",
            change <= 5e-3);
}

}  // namespace

int run(const Options& options) {
  Table table("response", options);
  ring_rows(table);
  const TireDescription description = lossy_tire(options);
  const LossMaterials losses = build_losses(description);
  // Differences of steady forces over small steps need equilibria without any residual.
  const FeTire meshed(description);
  FeTire tire(meshed.mesh(),
              meshed.materials(),
              {.element = description.element, .tolerance = kNoResidual});
  const Inflated inflated = value_of(tire.inflate(description.pressure));
  table.note("unknowns of the whole ring", fmt::format("{}", tire.mesh().free_dofs()));
  slope_rows(table, tire, losses, inflated);
  cost_rows(table, options, tire, losses, inflated);
  relaxation_rows(table, options, tire, inflated);
  const auto decay = verification::damped_ring_errors(options.size(240, 60));
  table.full_row("damped waves of a spinning ring, their frequencies",
                 percent(decay.frequency),
                 "<= 0.1 %",
                 decay.frequency <= 1e-3);
  table.full_row(
      "the same, their damping", percent(decay.damping), "<= 1 %", decay.damping <= 1e-2);
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
