// SPDX-License-Identifier: Apache-2.0
// latsch help: what the program can do, what a verb takes, what may stand in a study.
#include "base/text.h"
#include "cli/console/console.h"
#include "cli/templates/study_reference.h"
#include "cli/verbs/verbs.h"

namespace latsch::cli {
namespace {

void help(const CommandLine& app, const std::string& topic) {
  if (topic == "study") return put(study_reference());
  const auto text = app.help(topic);
  if (!text) {
    std::vector<std::string> topics = app.verbs();
    topics.emplace_back("study");
    throw InputError("no help on " + in_quotes(topic) + did_you_mean(topic, topics) +
                     "\nlatsch help lists the verbs");
  }
  put(*text);
}

}  // namespace

void add_help(CommandLine& app, int&) {
  Verb verb = app.add_subcommand("help", "What a verb takes, or what may stand in a study");
  verb.footer("Examples:\n  latsch help run\n  latsch help study");
  auto topic = std::make_shared<std::string>();
  verb.add_option("topic", *topic, "A verb, or \"study\"; without it all verbs");
  verb.callback([&app, topic] { help(app, *topic); });
}

}  // namespace latsch::cli
