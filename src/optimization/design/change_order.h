// SPDX-License-Identifier: Apache-2.0
// Orders tests so that dear settings change seldom.
//
// The cost of going from one test to the next is the sum of the costs of the settings that differ.
// The order is the cheapest of all for up to twelve different tests [Held, Karp, J. SIAM 10 (1962)
// 196]; of more, it is the best that reversing and moving parts of the order finds from the order
// sorted by the dearest setting first.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

/// Returns the indices of the tests, one in each row, in their order. Settings are in the unit
/// cube, `costs` one for each. Equal tests follow each other. Among orders of equal cost the one
/// whose settings move least is taken.
std::vector<int> order_of_few_changes(const Eigen::MatrixXd& tests,
                                      const std::vector<double>& costs);

/// Returns how often each setting changes between neighbors.
std::vector<int> setting_changes(const Eigen::MatrixXd& tests, const std::vector<int>& order);

}  // namespace latsch
