// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/step/newmark.h"

#define LATSCH_KERNELS_IN "models/ring_tire/step/newmark_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

void at_knots_and_back(const Eigen::Vector4d& m, const NodeValues& a, NodeValues& to) {
  to.resize(4, a.cols());
  LATSCH_KERNEL(at_knots_and_back)(static_cast<int>(a.cols()), m.data(), a.data(), to.data());
}

void follow(const StepRule& rule,
            const NodeValues& q1,
            const NodeValues& predicted,
            const NodeValues& v,
            const NodeValues& a,
            NodeValues& v1,
            NodeValues& a1) {
  v1.resizeLike(q1);
  a1.resizeLike(q1);
  LATSCH_KERNEL(follow)
  (static_cast<int>(q1.size()),
   rule.velocity,
   rule.acceleration,
   q1.data(),
   predicted.data(),
   v.data(),
   a.data(),
   v1.data(),
   a1.data());
}

double find_residual(double theta,
                     const NodeValues& f1,
                     const NodeValues& f0,
                     const NodeValues& inertia,
                     NodeValues& residual) {
  residual.resizeLike(f1);
  return LATSCH_KERNEL(find_residual)(
      static_cast<int>(f1.size()), theta, f1.data(), f0.data(), inertia.data(), residual.data());
}

}  // namespace latsch::ring_tire
