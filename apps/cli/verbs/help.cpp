// SPDX-License-Identifier: Apache-2.0
// Implements `latsch help`: describes the program, the options of a verb, and the keys of a study.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/console/console.h"
#include "cli/templates/schema_files.h"
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

void print_text(const std::string& text) {
  if (answers_in_json()) {
    answer()["text"] = text;
  } else {
    put(text);
  }
}

/// Prints the keys of one kind of test or of one table of a study. Throws an InputError if no
/// section of the reference is about `part`.
void help_on_part(const experiment::Language& language, const std::string& part) {
  const experiment::KeyTable keys = correlation::read_study_keys(language);
  const std::string text = study_reference_on(keys, part);
  if (text.empty()) {
    const std::vector<std::string> words = study_reference_words(keys);
    throw InputError(fmt::format("no help on the keys of {}{}\nthere is help on {}",
                                 in_quotes(part),
                                 did_you_mean(part, words),
                                 fmt::join(words, ", ")));
  }
  print_text(text);
}

void help(const CommandLine& app,
          const experiment::Language& language,
          const std::string& topic,
          const std::string& part,
          const std::string& schema) {
  if (!schema.empty()) {
    if (!topic.empty()) throw InputError("--schema " + schema + ": expected no topic beside it");
    return print_text(schema_of(schema));
  }
  if (!part.empty()) {
    if (topic != "study" && topic != "test")
      throw InputError(in_quotes(topic) + " has no part " + in_quotes(part) +
                       "; only \"study\" and \"test\" are followed by a part");
    return help_on_part(language, part);
  }
  if (topic == "study") return help_on_study(language);
  const auto text = app.help(topic);
  if (!text) {
    std::vector<std::string> topics = app.verbs();
    topics.emplace_back("study");
    throw InputError("no help on " + in_quotes(topic) + did_you_mean(topic, topics) +
                     "\nlatsch help lists the verbs; latsch help study PART has the keys of one "
                     "kind of test or table");
  }
  print_text(*text);
}

}  // namespace

void add_help(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("help", "What a verb takes, or what may stand in a study");
  verb.footer(
      "Examples:\n  latsch help run\n  latsch help study\n"
      "  # The keys of one table of a study, and those of one kind of test.\n"
      "  latsch help study optimizer\n  latsch help test rolling\n"
      "  # The JSON schema of a kind of file, for an editor.\n"
      "  latsch help --schema study");
  auto topic = std::make_shared<std::string>();
  auto part = std::make_shared<std::string>();
  verb.add_option("topic", *topic, "A verb, or \"study\"; without it all verbs");
  verb.add_option("part",
                  *part,
                  "After \"study\" or \"test\": a kind of test such as \"footprint\", or a "
                  "table such as \"variable\"");
  auto schema = std::make_shared<std::string>();
  verb.add_option("--schema",
                  *schema,
                  "Prints the JSON schema (draft-07) of a kind of TOML file instead, such as "
                  "\"study\" or \"car\"; docs/editors.md says how an editor uses it");
  verb.callback([&app, &program, topic, part, schema] {
    help(app, program.language, *topic, *part, *schema);
  });
}

}  // namespace latsch::cli
