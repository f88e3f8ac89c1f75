// SPDX-License-Identifier: Apache-2.0
// Chooses the abscissa over which samples are drawn that are compared one by one: a side force over
// the slip angle, a toe angle over the travel or load of a K&C rig.
//
// The abscissa is the slip (alpha, kappa, gamma) that covers the largest part of its usual range.
// Without slip it is the travel dz or the load, force or moment that the rig varies. Samples with
// different other conditions (load, camber, pressure) belong to different groups, so that each
// group is a curve of its own. Over a slip every such condition counts that the rig set to up to
// eight values, even if a value has a single sample.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/laboratory/measurement.h"

namespace latsch::correlation {

struct NaturalAbscissa {
  std::string channel;         // "alpha"
  std::string unit;            // SI
  std::string shown;           // unit of the file, or the usual one
  std::vector<double> values;  // SI, one for each sample
  /// Samples in drawing order: group by group, rising in each.
  std::vector<std::size_t> order;
  struct Group {
    std::string name;  // for example "Fz 1050 N, gamma 0 deg"; empty: there is one group
    /// The entry of the legend: the name of the group or, if there are more groups than colors, its
    /// first condition alone, "Fz 1050 N"; groups with the same level share a color.
    std::string level;
    std::size_t from, end;  // indices into `order`
  };
  std::vector<Group> groups;
};

/// Returns nullopt if no such channel varies over the samples. `y` is the channel that is compared.
std::optional<NaturalAbscissa> natural_abscissa(const Measurement& measurement,
                                                const std::string& y);

/// Returns the unit in which a person reads a channel: the unit of the file if it states one.
std::string unit_of_file(const Measurement& measurement,
                         const std::string& channel,
                         const std::string& otherwise);

}  // namespace latsch::correlation
