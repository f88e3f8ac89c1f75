// SPDX-License-Identifier: Apache-2.0
// Statics and transients of bodies on bushings by Simbody, as a reference (oracle) for tests. It is
// a separate program and not part of the product.
//
//   simbody_oracle statics CASE.json       displacements, rotations, energy of every load case
//   simbody_oracle transient CASE.json [ACCURACY [explicit|cpodes]]      displacements over time
//   simbody_oracle bushing                 wrenches of one bushing, far from rest
//
// Results go to standard output as CSV, the computing time to standard error.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>

#include "oracle_bushing.h"
#include "oracle_model.h"
#include "oracle_statics.h"
#include "oracle_transient.h"

namespace {

using namespace SimTK;
// Returns the processor time, s, used since `start`: this program has one thread, and other
// programs may run beside it.
double seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void print_row(const std::string& of,
               const char* kind,
               const std::string& name,
               const Vec3& value) {
  std::printf(
      "%s,%s,%s,%.12e,%.12e,%.12e\n", of.c_str(), kind, name.c_str(), value[0], value[1], value[2]);
}

void statics(const oracle::Case& data) {
  std::printf("case,kind,name,x,y,z\n");
  for (const oracle::LoadCase& one : data.load_cases) {
    const oracle::Model model(data, one, oracle::Model::Held::as_in_statics);
    const auto start = std::clock();
    const oracle::Statics found = oracle::solve_statics(model);
    std::fprintf(stderr,
                 "%s: %d iterations, %.1e N left, %.2f ms\n",
                 one.name.c_str(),
                 found.iterations,
                 found.left,
                 1e3 * seconds_since(start));
    print_row(one.name, "energy", "bushings", Vec3(model.energy_of_bushings(found.state), 0, 0));
    for (std::size_t i = 0; i < data.outputs.size(); ++i)
      print_row(one.name,
                "point",
                data.outputs[i].name,
                model.displacement(found.state, static_cast<int>(i)));
    for (int i = 0; i < model.bodies(); ++i) {
      const Vec4 turn = model.body(i).getBodyRotation(found.state).convertRotationToAngleAxis();
      print_row(one.name,
                "rotation",
                data.bodies[static_cast<std::size_t>(i)].name,
                turn[0] * Vec3(turn[1], turn[2], turn[3]));
    }
  }
}

void transient(const oracle::Case& data, double accuracy, const std::string& method) {
  const auto start = std::clock();
  const oracle::TransientWork work = oracle::print_transient(data, accuracy, method);
  const double took = seconds_since(start);
  std::fprintf(stderr,
               "%d steps, %d evaluations, %.2f s: %.3g times real time\n",
               work.steps,
               work.evaluations,
               took,
               data.time / took);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  try {
    if (mode == "statics" && argc == 3) {
      statics(oracle::read_case(argv[2]));
    } else if (mode == "transient" && argc >= 3 && argc <= 5) {
      transient(oracle::read_case(argv[2]),
                argc > 3 ? std::atof(argv[3]) : oracle::kUsualAccuracy,
                argc > 4 ? argv[4] : "explicit");
    } else if (mode == "bushing" && argc == 2) {
      oracle::print_bushing_wrenches();
    } else {
      std::fprintf(stderr,
                   "simbody_oracle statics CASE.json\n"
                   "simbody_oracle transient CASE.json [ACCURACY [explicit|cpodes]]\n"
                   "simbody_oracle bushing\n");
      return 2;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "simbody_oracle: %s\n", error.what());
    return 1;
  }
}
