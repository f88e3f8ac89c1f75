// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/sign_view.h"

#include <algorithm>
#include <cassert>

namespace latsch::experiment {
namespace {

/// Reverses the signs without creating negative zeros.
void reverse(std::vector<double>& values) {
  for (double& value : values) value = 0.0 - value;
}

}  // namespace

const std::vector<std::string>& sign_view_names() {
  static const std::vector<std::string> names = {"iso", "sae", "adams"};
  return names;
}

suspension::SignView sign_view(const std::string& name) {
  const auto& names = sign_view_names();
  const auto found = std::find(names.begin(), names.end(), name);
  assert(found != names.end());
  return static_cast<suspension::SignView>(found - names.begin());
}

bool has_sign_views(const Test& test) {
  const auto channels = test.channels();
  return std::any_of(channels.begin(), channels.end(), [&](const ChannelInfo& channel) {
    return test.sense(channel.name).has_value();
  });
}

Channels in_signs(const Channels& recorded, const Test& test, suspension::SignView view) {
  Channels viewed;
  for (Channel channel : recorded.all()) {
    const auto sense = test.sense(channel.name);
    if (sense && suspension::sign(view, sense->of, sense->by) < 0.0) {
      reverse(channel.values);
      reverse(channel.slopes);
    }
    viewed.add(std::move(channel));
  }
  return viewed;
}

}  // namespace latsch::experiment
