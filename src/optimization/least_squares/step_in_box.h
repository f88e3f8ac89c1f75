// SPDX-License-Identifier: Apache-2.0
// A least-squares step in a box,  lower <= p <= upper. It starts from the step without bounds,
// holds every variable that would leave the box at the face it would cross, and solves again for
// the others until all are inside.
//
// It needs at most n solutions. The result is in the box and is the minimum over the free variables
// with the others held. A variable once held is not released, so the result need not be the minimum
// in the box, whose determination would require Lagrange multipliers [Nocedal & Wright, Numerical
// Optimization, 2006, ch. 16.5].
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace latsch {

/// Returns the components `free`, in this order, of the step that minimizes over them. The other
/// components are held at those of p; the free components of p are 0.
using FreeStep =
    std::function<Eigen::VectorXd(const Eigen::VectorXd& p, const std::vector<int>& free)>;

/// Returns the variables that are free: all except those at a bound that the slope g pushes
/// outward.
std::vector<int> free_in_box(const Eigen::VectorXd& z,
                             const Eigen::VectorXd& g,
                             const Eigen::VectorXd& lower,
                             const Eigen::VectorXd& upper);

/// Computes the step. Components that are not `free` are 0. `free` is in ascending order.
Eigen::VectorXd step_in_box(const Eigen::VectorXd& lower,
                            const Eigen::VectorXd& upper,
                            std::vector<int> free,
                            const FreeStep& step);

}  // namespace latsch
