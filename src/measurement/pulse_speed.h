// SPDX-License-Identifier: Apache-2.0
// The speed of a drum from the pulses of a toothed wheel on its shaft.
//
// A pulse occurs where the signal rises through the middle between its least and greatest value.
// The next pulse counts only after the signal has fallen a quarter of that range below the middle,
// so noise on a flank is no pulse. The instant is interpolated linearly between the two samples
// around it.
//
// The distance traveled by the surface is linear between pulses, one pitch each; the speed of a
// sample is the distance of the step around it. So any mean of the speed is a distance over a time,
// which the scatter of the instants does not bias: the mean of pitch / interval would be too high
// by the square of the scatter, 0.3 % if an interval has five samples.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace latsch {

/// Returns the instants of the pulses, in samples.
std::vector<double> pulses_of(std::span<const double> signal);

/// Returns the speed (m/s) at every sample; `pitch` is in m. Before the first pulse and after the
/// last it is the speed of the adjacent interval, or the largest speed that produces no pulse there
/// if that is less. Throws InputError naming `source` and `channel` if there are fewer than three
/// pulses, or fewer than four samples between two pulses.
std::vector<double> speed_of_pulses(std::span<const double> signal,
                                    double rate,
                                    double pitch,
                                    const std::string& channel,
                                    const std::string& source);

}  // namespace latsch
