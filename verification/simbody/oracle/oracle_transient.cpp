// SPDX-License-Identifier: Apache-2.0
#include "oracle_transient.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "oracle_statics.h"

namespace oracle {
namespace {

using namespace SimTK;

// s, longest step of the integrator: it cannot skip a kerb, which lasts 13 ms.
constexpr double kLongestStep = 1e-3;  // s

void print_head(const Case& data) {
  std::printf("time [s]");
  for (const OutputPoint& one : data.outputs)
    for (const char axis : {'x', 'y', 'z'}) std::printf(",%s_%c [m]", one.name.c_str(), axis);
  std::printf("\n");
}

void print_row(const Model& model, const State& state, double time) {
  model.system().realize(state, Stage::Position);
  std::printf("%.6g", time);
  for (std::size_t i = 0; i < model.data().outputs.size(); ++i) {
    const Vec3 by = model.displacement(state, static_cast<int>(i));
    for (int k = 0; k < 3; ++k) std::printf(",%.10f", by[k]);
  }
  std::printf("\n");
}

TransientWork run(Integrator& integrator, const Model& model, State state, double accuracy) {
  const Case& data = model.data();
  integrator.setAccuracy(accuracy);
  integrator.setMaximumStepSize(kLongestStep);
  integrator.initialize(state);
  print_head(data);
  print_row(model, integrator.getState(), 0.0);
  const int rows = static_cast<int>(std::lround(data.time / data.output_step));
  for (int row = 1; row <= rows; ++row) {
    const double time = row * data.output_step;
    while (integrator.getTime() < time)
      if (integrator.stepTo(time) == Integrator::EndOfSimulation)
        throw std::runtime_error("the integrator ended early");
    print_row(model, integrator.getState(), time);
  }
  return {integrator.getNumStepsTaken(), integrator.getNumRealizations()};
}

}  // namespace

TransientWork print_transient(const Case& data, double accuracy, const std::string& method) {
  if (data.output_step <= 0.0 || data.time <= 0.0)
    throw std::runtime_error("time and output_step are needed");
  const LoadCase& load_case = data.load_cases.front();
  const Model at_rest(data, load_case, Model::Held::as_in_statics);
  const Model model(data, load_case, Model::Held::free);
  State state = model.at_rest();
  state.updQ() = solve_statics(at_rest).state.getQ();
  if (method == "explicit") {
    RungeKuttaMersonIntegrator integrator(model.system());
    return run(integrator, model, state, accuracy);
  }
  if (method != "cpodes") throw std::runtime_error("there is no method " + method);
  CPodesIntegrator integrator(model.system(), CPodes::BDF, CPodes::Newton);
  return run(integrator, model, state, accuracy);
}

}  // namespace oracle
