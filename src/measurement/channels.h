// SPDX-License-Identifier: Apache-2.0
// Recordings of a real or virtual rig: named columns of numbers in SI units, with their derivatives
// by the varied parameters if a model knows them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace latsch {

/// One recorded quantity. `unit` is the SI unit of `values` ("N", "m", "Hz", "1").
struct Channel {
  std::string name;            // such as "Fz"
  std::string unit;            // SI
  std::vector<double> values;  // SI, in the order of recording
  /// d value / d variable in SI: all values for the first variable, then for the next. Empty: not
  /// known. The caller who requested the slopes knows which variables they refer to.
  std::vector<double> slopes = {};

  bool operator==(const Channel&) const = default;
};

/// The channels of one run in the order they were recorded. Names are unique.
class Channels {
 public:
  /// Appends a channel. Its name must be new.
  void add(Channel channel);

  /// Returns nullptr if no channel has the given name.
  const Channel* find(std::string_view name) const;
  /// Throws std::out_of_range naming the existing channels.
  const std::vector<double>& operator[](std::string_view name) const;

  /// Returns the channels in the order they were recorded.
  const std::vector<Channel>& all() const { return channels_; }
  /// True if at least one channel has slopes.
  bool has_slopes() const;
  /// True if there is no channel.
  bool empty() const { return channels_.empty(); }

  bool operator==(const Channels&) const = default;

 private:
  std::vector<Channel> channels_;
};

}  // namespace latsch
