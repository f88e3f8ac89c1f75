// SPDX-License-Identifier: Apache-2.0
// Implements `latsch help`: describes the program, the options of a verb, and the keys of a study.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/console/console.h"
#include "cli/templates/study_reference.h"
#include "cli/verbs/verbs.h"
#include "correlation/study_keys.h"

namespace latsch::cli {
namespace {

std::string models_and_tests(const experiment::Language& language) {
  std::string text =
      "\n## Models and tests of this program\n\n| model | is | its file |\n| --- | --- | --- |\n";
  for (const experiment::SpecimenKind* kind : language.kinds)
    text += fmt::format("| `{}` | {} | {} |\n", kind->name(), kind->in_words(), kind->file());
  text += "\n| test | the model | models that can do it |\n| --- | --- | --- |\n";
  for (const experiment::TestKind* test : language.tests)
    text += fmt::format("| `{}` | {} | {} |\n",
                        test->name,
                        test->in_words,
                        fmt::join(language.kinds_for(test->needs), ", "));
  return text;
}

void help_on_study(const experiment::Language& language) {
  const experiment::KeyTable keys = correlation::read_study_keys(language);
  if (answers_in_json()) {
    answer()["sections"] = study_keys_json(keys);
  } else {
    put(study_reference(keys) + models_and_tests(language));
  }
}

void help(const CommandLine& app, const experiment::Language& language, const std::string& topic) {
  if (topic == "study") return help_on_study(language);
  const auto text = app.help(topic);
  if (!text) {
    std::vector<std::string> topics = app.verbs();
    topics.emplace_back("study");
    throw InputError("no help on " + in_quotes(topic) + did_you_mean(topic, topics) +
                     "\nlatsch help lists the verbs");
  }
  if (answers_in_json()) {
    answer()["text"] = *text;
  } else {
    put(*text);
  }
}

}  // namespace

void add_help(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("help", "What a verb takes, or what may stand in a study");
  verb.footer("Examples:\n  latsch help run\n  latsch help study");
  auto topic = std::make_shared<std::string>();
  verb.add_option("topic", *topic, "A verb, or \"study\"; without it all verbs");
  verb.callback([&app, &program, topic] { help(app, program.language, *topic); });
}

}  // namespace latsch::cli
