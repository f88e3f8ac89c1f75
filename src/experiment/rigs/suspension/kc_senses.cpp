// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/suspension/kc_senses.h"

#include "measurement/meaning/channel_sense.h"

namespace latsch::experiment {
namespace {

suspension::Sense sense_of(ChannelSense sense) {
  using suspension::Sense;
  switch (sense) {
    case ChannelSense::along_x:
      return Sense::along_x;
    case ChannelSense::along_y:
      return Sense::along_y;
    case ChannelSense::along_z:
    case ChannelSense::load:
      return Sense::along_z;
    case ChannelSense::about_x:
      return Sense::about_x;
    case ChannelSense::about_y:
      return Sense::about_y;
    case ChannelSense::about_z:
      return Sense::about_z;
    case ChannelSense::same:
    case ChannelSense::slip:
    case ChannelSense::unknown:
      break;
  }
  return Sense::same;
}

}  // namespace

suspension::SignSense kc_sense(std::string_view channel) {
  const ChannelSenses senses = channel_senses(channel);
  return {sense_of(senses.of), sense_of(senses.by)};
}

}  // namespace latsch::experiment
