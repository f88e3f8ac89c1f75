// SPDX-License-Identifier: Apache-2.0
// Bootstrap: measures how much a result depends on chance in the set of measured hammer hits, by
// computing it repeatedly from as many hits drawn with replacement [Efron 1979].
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace latsch {

/// Returns the standard deviation of every number of the result over `draws` draws. Draw number i
/// depends on the seed only, not on the other draws. Results of another length or with numbers that
/// are not finite are left out.
std::vector<double> bootstrap_deviation(
    int hits,
    int draws,
    std::uint64_t seed,
    const std::function<std::vector<double>(const std::vector<int>& chosen)>& result);

}  // namespace latsch
