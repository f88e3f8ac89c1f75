// SPDX-License-Identifier: Apache-2.0
// How far a result depends on which hits happened to be measured: the result again and again from
// as many hits drawn with replacement [Efron 1979].
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace latsch {

/// Standard deviation of every number of the result over `draws` draws; draw number i is the same
/// for a seed whatever the others. Results of another length or not finite are left out.
std::vector<double> bootstrap_deviation(
    int hits,
    int draws,
    std::uint64_t seed,
    const std::function<std::vector<double>(const std::vector<int>& chosen)>& result);

}  // namespace latsch
