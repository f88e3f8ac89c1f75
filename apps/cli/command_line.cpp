// SPDX-License-Identifier: Apache-2.0
#include "cli/command_line.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/text.h"

namespace latsch::cli {
namespace {

/// Whether the first word is a verb or an option; otherwise says what it may have been.
bool known(const CLI::App& app, const std::string& word) {
  if (word.starts_with('-')) return true;
  std::vector<std::string> shown;
  for (const CLI::App* verb : app.get_subcommands({})) {
    if (verb->get_name() == word) return true;
    if (!verb->get_group().empty()) shown.push_back(verb->get_name());
  }
  std::fprintf(stderr,
               "latsch: no verb %s%s\nlatsch --help lists the verbs\n",
               in_quotes(word).c_str(),
               did_you_mean(word, shown).c_str());
  return false;
}

/// The arguments a verb did not expect, with what an option may have been; otherwise what the
/// parser says.
std::string complaint(const CLI::App* verb, const CLI::ParseError& error) {
  if (!verb || !dynamic_cast<const CLI::ExtrasError*>(&error)) return error.what();
  std::vector<std::string> options;
  for (const CLI::Option* option : verb->get_options()) {
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  }
  const std::vector<std::string> extras = verb->remaining();
  for (const std::string& word : extras) {
    if (word.starts_with('-')) return "no option " + in_quotes(word) + did_you_mean(word, options);
  }
  return "unexpected argument " + in_quotes(extras.empty() ? "" : extras.front());
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::between(int least, int most) {
  option_->check(CLI::Range(least, most));
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& values) {
  option_->check(CLI::IsMember(values));
  return *this;
}

Option& Option::capture_default_str() {
  option_->capture_default_str();
  return *this;
}

Option Verb::add_option(const std::string& name, std::string& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}

Option Verb::add_option(const std::string& name, int& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}

Option Verb::add_option(const std::string& name,
                        std::vector<std::string>& values,
                        const std::string& help) {
  return Option(app_->add_option(name, values, help));
}

void Verb::add_flag(const std::string& name, bool& value, const std::string& help) {
  app_->add_flag(name, value, help);
}

void Verb::footer(const std::string& text) { app_->footer(text); }

void Verb::hide() { app_->group(""); }

void Verb::callback(std::function<void()> run) { app_->callback(std::move(run)); }

CommandLine::CommandLine(const std::string& description,
                         const std::string& footer,
                         const std::string& version)
    : app_(std::make_unique<CLI::App>(description, "latsch")) {
  app_->footer(footer);
  app_->set_version_flag("--version", version);
  app_->require_subcommand(1);
}

CommandLine::~CommandLine() = default;

Verb CommandLine::add_subcommand(const std::string& name, const std::string& description) {
  return Verb(app_->add_subcommand(name, description));
}

bool CommandLine::run(int argc, char** argv) {
  if (argc > 1 && !known(*app_, argv[1])) return false;
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app_->exit(error) == 0;  // --help, --version
    const std::vector<CLI::App*> verbs = app_->get_subcommands();
    const CLI::App* verb = verbs.empty() ? nullptr : verbs.front();
    const std::string name = verb ? "latsch " + verb->get_name() : "latsch";
    std::fprintf(stderr,
                 "%s: %s\n%s --help lists what it takes\n",
                 name.c_str(),
                 complaint(verb, error).c_str(),
                 name.c_str());
    return false;
  }
  return true;
}

}  // namespace latsch::cli
