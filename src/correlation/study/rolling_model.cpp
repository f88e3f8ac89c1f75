// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/rolling_model.h"

#include <algorithm>

#include "base/file.h"
#include "base/text.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

fs::path existing(const Node& table, const fs::path& folder) {
  const fs::path file = (folder / table.text("file")).lexically_normal();
  if (!fs::exists(file))
    table.reject("file", "is " + in_quotes(file.string()) + ", which does not exist");
  return file;
}

[[noreturn]] void reject_no_test(const experiment::TireKind& kind, const Node& study) {
  study.reject("test",
               "is missing: a " + kind.in_words +
                   " gives channels by the tests it is driven through, and there is none. Add one "
                   "or more, such as\n\n    [test.cleat]\n    file = \"cleat.toml\"\n\n"
                   "and in cleat.toml, beside the study, its kind: \"drum_cleat\", "
                   "\"slip_sweep\", \"static_stiffness\"" +
                   (kind.steady ? " or \"steady_states\"" : "") +
                   ". Experiments compare its channels as y = \"cleat/...\"");
}

/// What the channels depend on: the file, and the states it names.
std::string text_of(const fs::path& file, const experiment::RollingTest& test) {
  std::string text = read_text_file(file);
  if (const auto* steady = std::get_if<experiment::SteadyStates>(&test))
    text += read_text_file(steady->states.file());
  return text;
}

}  // namespace

fs::path rolling_tire_file(const Node& model, const fs::path& folder) {
  return existing(model, folder);
}

RollingModel read_rolling_model(const Node& model, const Node& study, const fs::path& folder) {
  RollingModel rolling;
  rolling.kind = experiment::find_tire_kind(model.choice("kind", experiment::tire_kind_names()));
  for (const Node& table : study.named_tables("test")) {
    const fs::path file = existing(table, folder);
    RollingModel::Test test{table.name(), file, experiment::read_rolling_test(file), {}};
    if (std::holds_alternative<experiment::SteadyStates>(test.test) && !rolling.kind->steady) {
      table.reject("file",
                   "is a test of steady states, which a " + rolling.kind->in_words +
                       " does not answer; expected kind = \"magic_formula\" in [model], or "
                       "another test");
    }
    if (std::holds_alternative<experiment::VibrationTest>(test.test) && !rolling.kind->modes) {
      table.reject("file",
                   "asks for modes, which a " + rolling.kind->in_words +
                       " does not have; expected kind = \"ring_tire\" in [model], or another test");
    }
    test.text = text_of(file, test.test);
    rolling.tests.push_back(std::move(test));
  }
  if (rolling.tests.empty()) reject_no_test(*rolling.kind, study);
  return rolling;
}

std::vector<KnownChannel> known_channels(const RollingModel& model) {
  std::vector<KnownChannel> channels;
  for (const RollingModel::Test& test : model.tests) {
    for (const auto& channel : experiment::recorded(test.test)) {
      channels.push_back({test.name + "/" + channel.name, channel.unit, channel.frame});
    }
  }
  return channels;
}

Result<Channels> run(const RollingModel& model,
                     const Document& numbers,
                     const std::vector<std::string>& tests) {
  Channels all;
  for (const RollingModel::Test& test : model.tests) {
    if (std::find(tests.begin(), tests.end(), test.name) == tests.end()) continue;
    const auto channels = experiment::run(*model.kind, numbers, test.test);
    if (!channels) {
      return Failure{"test " + test.name + ": " + channels.failure().reason,
                     channels.failure().cause};
    }
    for (Channel channel : channels->all()) {
      channel.name = test.name + "/" + channel.name;
      all.add(std::move(channel));
    }
  }
  return all;
}

std::string test_of(const std::string& channel) { return channel.substr(0, channel.find('/')); }

}  // namespace latsch::correlation
