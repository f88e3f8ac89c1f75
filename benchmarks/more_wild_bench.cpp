// SPDX-License-Identifier: Apache-2.0
// The residual trust region and GSS on the 53 Moré-Wild problems, beside solvers of NLopt
//
// What to reach: for the trust region above DFO-LS 1.6.5 (.925/.981/.981 and .792/.943/.962), for
// GSS every figure of HOPSPACK 2.0.
#include <nlopt.h>

#include "more_wild_runs.h"

namespace {

int bench() {
  using namespace latsch::benchmarks;
  Table table("more_wild");
  const std::vector<Disturbance> none{{}};
  const Profile trust = measure(residual_trust_region(), none);
  reach(table, "residual trust region, tau 1e-3 @10", trust.tau_1e3[0], 0.95);
  reach(table, "residual trust region, tau 1e-3 @50", trust.tau_1e3[1], 0.985);
  reach(table, "residual trust region, tau 1e-5 @10", trust.tau_1e5[0], 0.85);
  reach(table, "residual trust region, tau 1e-5 @50", trust.tau_1e5[1], 0.96);
  note(table, "residual trust region", trust);
  const Profile gss = measure(latsch::benchmarks::gss(), none);
  const Profile hopspack{{10, 50, 100}, {.321, .642, .679}, {.226, .509, .604}};
  const char* budgets[] = {"10", "50", "100"};
  for (int k = 0; k < 3; ++k) {
    reach(table, std::string("GSS, tau 1e-3 @") + budgets[k], gss.tau_1e3[k], hopspack.tau_1e3[k]);
    reach(table, std::string("GSS, tau 1e-5 @") + budgets[k], gss.tau_1e5[k], hopspack.tau_1e5[k]);
  }
  note(table, "NLopt BOBYQA", measure(nlopt(NLOPT_LN_BOBYQA), none));
  note(table, "NLopt Nelder-Mead", measure(nlopt(NLOPT_LN_NELDERMEAD), none));
  // COBYLA of NLopt 2.7.1 can loop for ever and is left out.
  return table.exit_code();
}

}  // namespace

int main() { return latsch::benchmarks::guarded(bench); }
