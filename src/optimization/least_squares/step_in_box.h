// SPDX-License-Identifier: Apache-2.0
// A step of least squares in a box,  lower <= p <= upper:  the free step, with every variable that
// would leave the box held at its face and the others sought again, until all are inside.
//
// At most n solutions. The result is in the box, and the least one of the free variables where the
// others are held; none that is held once is let go again, so it need not be the least in the box:
// that takes multipliers [Nocedal & Wright, Numerical Optimization, 2006, ch. 16.5].
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace latsch {

/// The components `free`, in this order, of the step whose other components are those of p, where
/// the free ones are 0.
using FreeStep =
    std::function<Eigen::VectorXd(const Eigen::VectorXd& p, const std::vector<int>& free)>;

/// Variables that the slope g does not push over a bound they are at.
std::vector<int> free_in_box(const Eigen::VectorXd& z,
                             const Eigen::VectorXd& g,
                             const Eigen::VectorXd& lower,
                             const Eigen::VectorXd& upper);

/// Components that are not `free`, in ascending order, are 0.
Eigen::VectorXd step_in_box(const Eigen::VectorXd& lower,
                            const Eigen::VectorXd& upper,
                            std::vector<int> free,
                            const FreeStep& step);

}  // namespace latsch
