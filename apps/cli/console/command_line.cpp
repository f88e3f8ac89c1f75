// SPDX-License-Identifier: Apache-2.0
#include "cli/console/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/text.h"
#include "cli/console/console.h"
#include "cli/console/version.h"

namespace latsch::cli {
namespace {

/// Returns the present replacement of a verb of former versions; empty if there was no such verb.
std::string_view in_place_of(std::string_view verb) {
  if (verb == "ring") return "a ring from measured data is a study: latsch new FOLDER --ring-data";
  if (verb == "evaluate" || verb == "footprint" || verb == "drum")
    return "every model goes through every test by latsch test MODEL TEST; latsch test --list";
  return {};
}

/// Returns true if the first word of the command line is a verb or an option. Otherwise reports the
/// error with the verb that may have been meant.
bool known(const CLI::App& app, const std::string& word) {
  if (word.starts_with('-')) return true;
  std::vector<std::string> shown;
  for (const CLI::App* verb : app.get_subcommands({})) {
    if (verb->get_name() == word) return true;
    if (!verb->get_group().empty()) shown.push_back(verb->get_name());
  }
  const std::string_view now = in_place_of(word);
  complain("no verb " + in_quotes(word) +
           (now.empty() ? did_you_mean(word, shown) : " any more: " + std::string(now)) +
           "\nlatsch --help lists the verbs");
  return false;
}

/// Returns the message for arguments that the verb does not know, with the option that may have
/// been meant; for other errors the parser's message. An unknown option comes before an argument
/// that is missing, because `latsch run --hlep` asks for help and not for a study.
std::string complaint(const CLI::App* verb, const CLI::ParseError& error) {
  const bool unknown = dynamic_cast<const CLI::ExtrasError*>(&error);
  if (!verb || (!unknown && !dynamic_cast<const CLI::RequiredError*>(&error))) return error.what();
  std::vector<std::string> options{"--help"};
  for (const CLI::Option* option : verb->get_options()) {
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  }
  const std::vector<std::string> extras = verb->remaining();
  for (const std::string& word : extras) {
    if (word.starts_with('-')) return "no option " + in_quotes(word) + did_you_mean(word, options);
  }
  if (!unknown) return error.what();
  return "unexpected argument " + in_quotes(extras.empty() ? "" : extras.front());
}

/// Refuses an empty text, because an option with an empty value would count as not given.
const CLI::Validator kNotEmpty(
    [](const std::string& text) {
      return text.empty() ? std::string("expected a value, found an empty text") : std::string();
    },
    "",
    "not empty");

/// Returns the ending of the file's name with its point, in lower case: ".csv"; "" without one.
std::string ending_of(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  for (char& letter : ending) letter = static_cast<char>(std::tolower(letter));
  return ending;
}

bool is_among(const std::string& word, const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Endings that tell a reader, or another program, the format of a file.
const std::vector<std::string> kEndings{
    ".csv",  ".tdx", ".tydex", ".tda", ".tdb",  ".mat",  ".mf4",   ".uff", ".unv",
    ".tdms", ".rsp", ".ld",    ".tir", ".toml", ".inp",  ".html",  ".htm", ".vtu",
    ".vtk",  ".fmu", ".rdf",   ".crg", ".bus",  ".xlsx", ".xls",   ".ods", ".json",
    ".xml",  ".pdf", ".png",   ".svg", ".zip",  ".md",   ".latsch"};

/// Returns the long names of the options, and the names of the positional arguments, that the user
/// gave.
std::vector<std::string> given_options(const CLI::App& verb) {
  std::vector<std::string> given;
  for (const CLI::Option* option : verb.get_options())
    if (option->count() > 0)
      given.push_back(option->get_lnames().empty() ? option->get_name()
                                                   : "--" + option->get_lnames().front());
  return given;
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::between(int least, int most) {
  option_->check([=](const std::string& text) {
    const auto number = parse_number(text);
    if (number && *number >= least && *number <= most && *number == std::floor(*number))
      return std::string();
    return "is " + in_quotes(text) + ", expected a whole number from " + std::to_string(least) +
           " to " + std::to_string(most);
  });
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& values) {
  option_->check(CLI::IsMember(values));
  return *this;
}

Option& Option::or_alone(const std::string& value) {
  option_->expected(0, 1)->default_str(value);
  return *this;
}

Option& Option::capture_default_str() {
  option_->capture_default_str();
  return *this;
}

Option& Option::written_as(const std::string& format, const std::vector<std::string>& endings) {
  option_->check([=](const std::string& file) {
    const std::string ending = ending_of(file);
    if (is_among(ending, endings) || !is_among(ending, kEndings)) return std::string();
    return "writes " + format + ", and " + in_quotes(file) +
           " ends as a file of another format; expected a name that ends in " + list_of(endings);
  });
  return *this;
}

Option Verb::add_option(const std::string& name, std::string& value, const std::string& help) {
  return Option(app_->add_option(name, value, help)->check(kNotEmpty));
}

Option Verb::add_option(const std::string& name, int& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}

Option Verb::add_option(const std::string& name,
                        std::vector<std::string>& values,
                        const std::string& help) {
  return Option(app_->add_option(name, values, help)->check(kNotEmpty));
}

void Verb::add_flag(const std::string& name, bool& value, const std::string& help) {
  app_->add_flag(name, value, help);
}

void Verb::footer(const std::string& text) { app_->footer(text); }

void Verb::hide() {
  app_->group("");
  for (const char* option : {"--json", "--quiet", "--log"})
    app_->remove_option(app_->get_option(option));
}

void Verb::forms(std::vector<Form> forms) { forms_ = std::move(forms); }

void Verb::callback(std::function<void()> run) {
  app_->callback([app = app_, forms = forms_, run = std::move(run)] {
    check_forms(app->get_name(), forms, given_options(*app));
    run();
  });
}

CommandLine::CommandLine(const std::string& description,
                         const std::string& footer,
                         const std::string& version)
    : app_(std::make_unique<CLI::App>(description, "latsch")),
      common_(std::make_unique<CommonOptions>()) {
  app_->footer(footer);
  app_->set_version_flag("--version", version);
  app_->require_subcommand(1);
}

CommandLine::~CommandLine() = default;

Verb CommandLine::add_subcommand(const std::string& name, const std::string& description) {
  CLI::App* verb = app_->add_subcommand(name, description);
  add_common_options(*verb);
  return Verb(verb);
}

void CommandLine::add_common_options(CLI::App& verb) {
  constexpr const char* kGroup = "Options of every verb";
  verb.add_flag("--json", common_->json, "Prints the results as one JSON object")->group(kGroup);
  verb.add_flag("--quiet", common_->quiet, "Prints nothing but warnings, errors and requested data")
      ->group(kGroup);
  verb.add_option("--log", common_->log, "File to which all messages are appended")->group(kGroup);
}

std::optional<std::string> CommandLine::help(const std::string& verb) const {
  if (verb.empty()) return general_help_;
  for (const CLI::App* found : app_->get_subcommands({}))
    if (found->get_name() == verb) return found->help("latsch");
  return std::nullopt;
}

std::vector<std::string> CommandLine::verbs() const {
  std::vector<std::string> names;
  for (const CLI::App* verb : app_->get_subcommands({}))
    if (!verb->get_group().empty()) names.push_back(verb->get_name());
  return names;
}

namespace {

std::string as_typed(int argc, char** argv) {
  std::string line = "latsch";
  for (int i = 1; i < argc; ++i) line += std::string(" ") + argv[i];
  return line;
}

/// Returns the words after the program's name. --json and --quiet are moved from before the verb,
/// where the parser does not expect them, to the end.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc), moved;
  while (!words.empty() && (words[0] == "--json" || words[0] == "--quiet")) {
    moved.push_back(words[0]);
    words.erase(words.begin());
  }
  words.insert(words.end(), moved.begin(), moved.end());
  return words;
}

}  // namespace

bool CommandLine::give_text(const CLI::ParseError& request) {
  std::ostringstream text;
  app_->exit(request, text, text);
  put(text.str());
  answer()["text"] = text.str();
  if (dynamic_cast<const CLI::CallForVersion*>(&request)) answer()["version"] = version_number();
  return true;
}

bool CommandLine::run(int argc, char** argv) {
  std::vector<std::string> words = words_of(argc, argv);
  // If the command line cannot be parsed, the error is still printed in the requested form: as JSON
  // or as text.
  CommonOptions asked;
  asked.json = is_among("--json", words);
  const std::string first = words.empty() || words[0] == "--json" ? "" : words[0];
  open_console(asked, first, "");
  if (!first.empty() && !known(*app_, first)) return false;
  general_help_ = app_->help();
  app_->parse_complete_callback([&] {
    const auto verbs = app_->get_subcommands();
    if (!verbs.empty()) open_console(*common_, verbs[0]->get_name(), as_typed(argc, argv));
  });
  try {
    std::reverse(words.begin(), words.end());  // the parser takes words from the end
    app_->parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return give_text(error);  // --help, --version
    const std::vector<CLI::App*> verbs = app_->get_subcommands();
    const CLI::App* verb = verbs.empty() ? nullptr : verbs.front();
    const std::string name = verb ? "latsch " + verb->get_name() : "latsch";
    complain((verb ? name + ": " : "") + complaint(verb, error) + "\n" + name +
             " --help lists its options");
    return false;
  }
  return true;
}

}  // namespace latsch::cli
