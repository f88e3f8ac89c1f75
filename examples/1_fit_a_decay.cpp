// SPDX-License-Identifier: Apache-2.0
// Example 1. Fits a decay A exp(-k t) to six measurements with the optimizers alone, and reports how well the
// measurements determine A and k. It needs no tire, no file and no worker process.
//
//   target_link_libraries(decay PRIVATE latsch::optimization)
//
//   $ 1_fit_a_decay
//   A = 2.025, identifiable
//   k = 0.503, identifiable
#include <latsch/optimization/design/sobol.h>
#include <latsch/optimization/identifiability/identification.h>
#include <latsch/optimization/trust_region/residual_trust_region.h>

#include <cstdio>

using namespace latsch;

Eigen::VectorXd residuals(const DesignPoint& p) {  // (measured - computed) / noise
  const Eigen::ArrayXd t{{0, 1, 2, 3, 4, 5}}, y{{2.03, 1.21, 0.75, 0.44, 0.27, 0.18}};
  return (y - p.values[0] * (-p.values[1] * t).exp()) / 0.02;
}

int main() {
  const DesignSpace space(
      {{.name = "A", .lower = 0.1, .upper = 10, .initial = 1},
       {.name = "k", .lower = 0.01, .upper = 5, .initial = 1, .scale = Scale::logarithmic}});
  ResidualTrustRegion optimizer(space);
  DesignPoint best;
  double least = 1e300;
  const auto evaluate = [&](const DesignPoint& p) {
    const Eigen::VectorXd r = residuals(p);
    if (r.squaredNorm() < least) least = r.squaredNorm(), best = p;
    optimizer.observe(p, Score{r.squaredNorm(), {r.begin(), r.end()}});
  };
  // evaluate points that are spread over the whole design space first
  for (const DesignPoint& p : sobol(space, 16).points) evaluate(p);
  while (!optimizer.converged()) evaluate(optimizer.propose(1)[0]);  // for 8 workers: propose(8)

  Identification what(space, best, {.confidence = {.sigma = 1.0}});
  while (!what.wanted().empty()) {
    // residuals, and their derivatives if the model knows them
    std::vector<Result<Evaluated>> outcomes;
    for (const DesignPoint& p : what.wanted()) outcomes.push_back(Evaluated(residuals(p)));
    what.observe(outcomes);
  }
  for (const TargetProfile& p : what.profiles())
    std::printf("%s = %.3f, %s\n",
                space[p.variable].name.c_str(),
                best.values[p.variable],
                in_words(p).c_str());
}
