// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/keys/sample_files.h"

#include <map>

namespace latsch::experiment {
namespace {

/// Generates random numbers from 0 to 1 that are the same on every machine.
class DrawnNumbers {
 public:
  explicit DrawnNumbers(unsigned seed) : drawn_(seed) {}
  double next() {
    drawn_ = drawn_ * 1664525u + 1013904223u;
    return static_cast<double>(drawn_ >> 16) / 65536.0;
  }

 private:
  unsigned drawn_;
};

/// Returns a number that differs between the names of channels.
unsigned seed_of(const std::string& name) {
  unsigned seed = 0;
  for (const char letter : name) seed = 31u * seed + static_cast<unsigned char>(letter);
  return seed;
}

/// Returns the heights of four posts that move in every mode at all frequencies up to 50 Hz.
std::string heights_of_posts() {
  std::string text = "time [s],post_FL [mm],post_FR [mm],post_RL [mm],post_RR [mm]\n";
  constexpr int kSamples = 401;
  DrawnNumbers heights(1);
  for (int i = 0; i < kSamples; ++i) {
    text += std::to_string(0.01 * i);
    for (int post = 0; post < 4; ++post) text += "," + std::to_string(heights.next());
    text += "\n";
  }
  return text;
}

constexpr const char* kPlank = R"([MDI_HEADER]
 FILE_TYPE = 'rdf'
 FILE_VERSION = 5.00
 FILE_FORMAT = 'ASCII'
[UNITS]
 LENGTH = 'meter'
 FORCE = 'newton'
 ANGLE = 'radian'
 MASS = 'kg'
 TIME = 'sec'
[MODEL]
 METHOD = '2D'
 ROAD_TYPE = 'plank'
[PARAMETERS]
 HEIGHT = 0.02
 START = 1.0
 LENGTH = 0.5
 BEVEL_EDGE_LENGTH = 0.0
 MU = 1.0
 DIRECTION = 0.0
)";

}  // namespace

const std::vector<SampleFile>& sample_files() {
  static const std::vector<SampleFile> files = {
      {"states.csv", "time [s],Fz [N],alpha [deg]\n0,4000,5\n0.1,4000,-4\n"},
      {"heights.csv", heights_of_posts()},
      {"surface.crg",
       "$ROAD_CRG\nreference_line_increment = 1\n$\n$KD_DEFINITION\n#:LRFI\n"
       "D:long section at v = -1,m\nD:long section at v = 1,m\n$\n$$$$\n"
       " 0.1000000 0.1000000\n 0.2000000 0.2000000\n"},
      {"track.crg", "$ROAD_CRG_FILE\n surface.crg\n$\n"},
      {"track.rdf", kPlank},
      {"track.toml", "kind = \"flat\"\nfriction = 0.9\n"},
  };
  return files;
}

Channels sample_recording(const std::vector<MeasuredCondition>& conditions,
                          double scale,
                          int samples) {
  static const std::map<std::string, double> usual = {{"m", 0.01},
                                                      {"N", 4000.0},
                                                      {"N m", 100.0},
                                                      {"m/s", 20.0},
                                                      {"Pa", 2e5},
                                                      {"rad", 0.05},
                                                      {"Hz", 80.0},
                                                      {"1", 0.05}};
  Channels channels;
  for (const MeasuredCondition& condition : conditions) {
    const std::string& name = condition.channel;
    const bool is_of_one_wheel = name.ends_with("_L") || name.ends_with("_R");
    if (is_of_one_wheel && !condition.is_needed) continue;  // the rig loads only one wheel
    // Each post moves independently of the others, so that the motion contains all modes and all
    // frequencies.
    const bool is_post = name.starts_with("post_");
    DrawnNumbers heights(seed_of(name));
    std::vector<double> values;
    for (int i = 0; i < samples; ++i) {
      const double change = is_post ? heights.next() : 0.001 * (i % 3);
      const auto unit = usual.find(condition.unit);
      values.push_back(name == "time" ? 0.01 * i * scale
                       : name == "mode"
                           ? 1.0
                           : (unit == usual.end() ? 1.0 : unit->second) * scale * (1.0 + change));
    }
    channels.add({condition.channel, condition.unit, std::move(values)});
  }
  return channels;
}

TestSource source_of_samples(const std::filesystem::path& folder, double scale, int samples) {
  return {folder, [=](const Node& table, const std::vector<MeasuredCondition>& conditions) {
            table.text("from");
            if (conditions.size() == 1) table.text("channel", conditions[0].channel);
            return sample_recording(conditions, scale, samples);
          }};
}

}  // namespace latsch::experiment
