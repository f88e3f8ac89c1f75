// SPDX-License-Identifier: Apache-2.0
// What a rig records, real or virtual: named columns of numbers in SI units, and how they change
// with what was varied, where a model knows that.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace latsch {

/// One recorded quantity. `unit` is the SI unit of `values` ("N", "m", "Hz", "1").
struct Channel {
  std::string name;
  std::string unit;
  std::vector<double> values;
  /// d value / d variable in SI, all values for the first variable, then for the next; empty: not
  /// known. Which variables these are says who asked for them.
  std::vector<double> slopes = {};

  bool operator==(const Channel&) const = default;
};

/// The channels of one run in the order they were recorded. Names are unique.
class Channels {
 public:
  void add(Channel channel);

  /// nullptr where no channel has that name.
  const Channel* find(std::string_view name) const;
  /// Throws std::out_of_range naming the channels there are.
  const std::vector<double>& operator[](std::string_view name) const;

  const std::vector<Channel>& all() const { return channels_; }
  /// Of one of them at least.
  bool has_slopes() const;
  bool empty() const { return channels_.empty(); }

  bool operator==(const Channels&) const = default;

 private:
  std::vector<Channel> channels_;
};

}  // namespace latsch
