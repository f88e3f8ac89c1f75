// SPDX-License-Identifier: Apache-2.0
// The command line as the verbs see it: CLI11 under the same names, in one translation unit.
// CLI11's header costs every file that includes it ten seconds of compiling.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/console/forms.h"

namespace CLI {
class App;
class Option;
class ParseError;
}  // namespace CLI

namespace latsch::cli {

/// An argument of a verb: "file" by its position, "-o,--output" by its name.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  Option& between(int least, int most);
  Option& one_of(const std::vector<std::string>& values);
  Option& or_alone(const std::string& value);  // may be given without a value, which is then this
                                               // one
  Option& capture_default_str();               // --help shows its present value

 private:
  CLI::Option* option_;
};

/// Variables bound to an option have to live until the line is parsed and the verb has run.
class Verb {
 public:
  explicit Verb(CLI::App* app) : app_(app) {}

  Option add_option(const std::string& name, std::string& value, const std::string& help);
  Option add_option(const std::string& name, int& value, const std::string& help);
  /// The option may be given more than once.
  Option add_option(const std::string& name,
                    std::vector<std::string>& values,
                    const std::string& help);
  void add_flag(const std::string& name, bool& value, const std::string& help);
  void footer(const std::string& text);
  /// States which options belong to which form of the verb, before `callback`; see forms.h.
  void forms(std::vector<Form> forms);
  /// Marks a verb that the program itself calls: it is not listed and lacks the options of every
  /// verb.
  void hide();
  void callback(std::function<void()> run);

 private:
  CLI::App* app_;
  std::vector<Form> forms_;
};

/// Every verb has --json, --quiet and --log FILE, see console.h. The first two may also precede it.
class CommandLine {
 public:
  CommandLine(const std::string& description,
              const std::string& footer,
              const std::string& version);
  ~CommandLine();

  Verb add_subcommand(const std::string& name, const std::string& description);

  /// Returns the output of `latsch VERB --help`; for all verbs together if `verb` is empty. Returns
  /// nothing if there is no such verb.
  std::optional<std::string> help(const std::string& verb) const;
  /// Returns the names of the listed verbs.
  std::vector<std::string> verbs() const;

  /// Runs the chosen verb. Returns false if the line was not understood, after reporting why;
  /// --help and --version return true.
  bool run(int argc, char** argv);

 private:
  void add_common_options(CLI::App& verb);
  /// Gives the text that --help or --version requests; returns true.
  bool give_text(const CLI::ParseError& request);

  std::unique_ptr<CLI::App> app_;
  std::unique_ptr<struct CommonOptions> common_;
  std::string general_help_;  // stored before a verb is chosen, because the parser's help is then
                              // that of the verb
};

}  // namespace latsch::cli
