// SPDX-License-Identifier: Apache-2.0
// Designs of experiments for Python; a design is an array with one row for each point.
#include <cmath>

#include "bindings/arrays.h"
#include "bindings/bindings.h"
#include "optimization/design/basins.h"
#include "optimization/design/full_factorial.h"
#include "optimization/design/latin_hypercube.h"
#include "optimization/design/morris.h"
#include "optimization/design/sobol.h"

namespace latsch::python {
namespace {

/// A screening design, with the design space that its effects refer to.
struct Screening {
  DesignSpace space;
  MorrisDesign design;

  py::ssize_t trajectories() const { return static_cast<py::ssize_t>(design.trajectories.size()); }
};

Array trajectories_of(const Screening& of) {
  const py::ssize_t n = of.space.size();
  Array all({of.trajectories(), n + 1, n});
  double* to = all.mutable_data();
  for (const auto& trajectory : of.design.trajectories)
    for (const DesignPoint& p : trajectory) to = std::copy(p.values.begin(), p.values.end(), to);
  return all;
}

/// Returns a dict of arrays: the Morris measures mu, mu_star and sigma, and the single effects.
py::dict effects_of(const Screening& of, const Array& values) {
  const int n = of.space.size();
  const Eigen::MatrixXd given = matrix(values, of.trajectories(), n + 1, "values of trajectories");
  std::vector<std::vector<std::optional<double>>> all(given.rows());
  for (Eigen::Index r = 0; r < given.rows(); ++r)
    for (Eigen::Index k = 0; k <= n; ++k)
      all[r].push_back(std::isfinite(given(r, k)) ? std::optional(given(r, k)) : std::nullopt);
  std::vector<double> mu, mu_star, sigma, effects;
  for (const ElementaryEffects& one : elementary_effects(of.space, of.design, all)) {
    mu.push_back(one.mu);
    mu_star.push_back(one.mu_star);
    sigma.push_back(one.sigma);
    effects.push_back(one.effects);
  }
  py::dict found;
  found["mu"] = array(mu);
  found["mu_star"] = array(mu_star);
  found["sigma"] = array(sigma);
  found["effects"] = array(effects);
  return found;
}

/// Returns a tuple: the basins as rows of (index of the minimum, number of points that lead to it,
/// value), and the doubtful basins.
py::tuple basins_of(const Array& values, const std::vector<int>& levels) {
  const std::vector<double> known = vector(values);
  std::size_t points = 1;
  for (const int count : levels) points *= static_cast<std::size_t>(std::max(count, 0));
  if (levels.empty() || points != known.size())
    throw InputError("a grid of these levels has " + std::to_string(points) + " points, found " +
                     std::to_string(known.size()) + " values");
  py::list basins;
  for (const Basin& basin : find_basins(known, grid_neighbors(levels)))
    basins.append(py::make_tuple(basin.lowest, basin.points, basin.value));
  return py::make_tuple(basins, grid_doubt(known, levels));
}

}  // namespace

void bind_designs(py::module_& module) {
  module.def(
      "full_factorial",
      [](const DesignSpace& space, const std::vector<int>& levels) {
        return array(full_factorial(space, levels).points, space.size());
      },
      py::arg("space"),
      py::arg("levels"),
      "A full factorial design: every combination of levels[i] values of variable i; the first "
      "variable\nchanges slowest. Array (N, n).");
  module.def(
      "latin_hypercube",
      [](const DesignSpace& space, int points, std::uint64_t seed) {
        SamplingPlan plan;
        {
          const py::gil_scoped_release others;
          plan = latin_hypercube(space, points, seed);
        }
        return array(plan.points, space.size());
      },
      py::arg("space"),
      py::arg("points"),
      py::arg("seed") = 0,
      "A maximin Latin hypercube; ten points for each variable are a usual first choice. Array "
      "(points, n).");
  module.def(
      "sobol",
      [](const DesignSpace& space, int points, std::uint64_t seed) {
        return array(sobol(space, points, seed).points, space.size());
      },
      py::arg("space"),
      py::arg("points"),
      py::arg("seed") = 0,
      "The first points of Sobol's sequence; choose a power of two for `points`. Array (points, "
      "n).");
  module.def("basins_of_grid",
             &basins_of,
             py::arg("values"),
             py::arg("levels"),
             "Minima of a full factorial design: ([(position, points, value), ...] lowest first, "
             "doubt).\nNaN in `values` (N,) marks a failed point. `doubt` is the reason for which "
             "the minima are\nunreliable; empty if there is none.");
  py::class_<Screening>(module, "Morris", "Morris' screening of the variables by their effects.")
      .def(py::init([](const DesignSpace& space, int trajectories, std::uint64_t seed, int levels) {
             return Screening{space, morris(space, trajectories, seed, levels)};
           }),
           py::arg("space"),
           py::arg("trajectories"),
           py::arg("seed") = 0,
           py::arg("levels") = 4)
      .def_property_readonly("trajectories", &trajectories_of, "Array (trajectories, n + 1, n).")
      .def_property_readonly(
          "points",
          [](const Screening& of) { return array(of.design.plan().points, of.space.size()); },
          "The different points of the design, each once. Array (N, n).")
      .def("effects",
           &effects_of,
           py::arg("values"),
           "Returns mu, mu_star, sigma and the number of effects, arrays (n,), from "
           "values\n(trajectories, n + 1) with NaN for failed points. An effect is the change over "
           "the whole range\nof a variable.");
}

}  // namespace latsch::python
