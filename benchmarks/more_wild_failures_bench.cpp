// SPDX-License-Identifier: Apache-2.0
// The same where 5 % and 20 % of the points have no outcome, three draws
//
// NLopt's solvers know no failed point. DFO-LS falls from .925 to .396 at 5 % (tau 1e-3 @10).
#include "more_wild_runs.h"

namespace {

int bench() {
  using namespace latsch::benchmarks;
  Table table("more_wild_failures");
  const auto draws = [](double failures) {
    return std::vector<Disturbance>{{.failures = failures, .seed = 1},
                                    {.failures = failures, .seed = 2},
                                    {.failures = failures, .seed = 3}};
  };
  const Profile whole = measure(residual_trust_region(), {{}});
  const Profile some = measure(residual_trust_region(), draws(0.05));
  const Profile many = measure(residual_trust_region(), draws(0.2));
  // Three points: .030 of the share.
  reach(table, "5 %, tau 1e-3 @10", some.tau_1e3[0], whole.tau_1e3[0] - 0.03);
  reach(table, "5 %, tau 1e-3 @50", some.tau_1e3[1], whole.tau_1e3[1] - 0.03);
  reach(table, "20 %, tau 1e-3 @50", many.tau_1e3[1], 0.85);
  note(table, "no failures", whole);
  note(table, "5 %", some);
  note(table, "20 %", many);
  note(table, "GSS, 5 %", measure(gss(), draws(0.05)));
  note(table, "GSS, 20 %", measure(gss(), draws(0.2)));
  return table.exit_code();
}

}  // namespace

int main() { return latsch::benchmarks::guarded(bench); }
