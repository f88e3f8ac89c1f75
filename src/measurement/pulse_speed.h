// SPDX-License-Identifier: Apache-2.0
// The speed of a drum from the pulses of a toothed wheel on its shaft.
//
// A pulse is where the signal rises through the middle between its least and greatest value; the
// next one counts once it has fallen a quarter of that range below the middle, so noise on a flank
// is no pulse. The instant is read between the samples, on the straight line through the two
// around it.
//
// The way of the surface is linear from one pulse to the next, a pitch each; the speed of a sample
// is the way of the step around it. So any mean of it is a way over a time, which the scatter of
// the instants does not bias: the mean of pitch / interval would be too high by the square of the
// scatter, 0.3 % where an interval has five samples.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace latsch {

/// The instants of the pulses, in samples.
std::vector<double> pulses_of(std::span<const double> signal);

/// Speed (m/s) at every sample; `pitch` in m. Before the first pulse and after the last it is that
/// of the next interval, or what leaves no pulse there if that is less. Throws InputError naming
/// `source` and `channel`: fewer than three pulses, or fewer than four samples from one to the
/// next.
std::vector<double> speed_of_pulses(std::span<const double> signal,
                                    double rate,
                                    double pitch,
                                    const std::string& channel,
                                    const std::string& source);

}  // namespace latsch
