// SPDX-License-Identifier: Apache-2.0
// The interface to the command line that the verbs use. It has the names of CLI11, which only one
// translation unit includes: including its header takes ten seconds of compiling.
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
  /// Sets the value that the option has if it is given without a value.
  Option& or_alone(const std::string& value);
  Option& capture_default_str();  // --help shows the default value
  /// Marks a file that is written in the stated format, such as "CSV". A name is refused if its
  /// ending belongs to another format, such as "out.xlsx"; an unknown ending is taken.
  Option& written_as(const std::string& format, const std::vector<std::string>& endings);

 private:
  CLI::Option* option_;
};

/// Variables bound to an option have to live until the line is parsed and the verb has run.
class Verb {
 public:
  explicit Verb(CLI::App* app) : app_(app) {}

  Option add_option(const std::string& name, std::string& value, const std::string& help);
  Option add_option(const std::string& name, int& value, const std::string& help);
  /// Adds an option that may be given more than once.
  Option add_option(const std::string& name,
                    std::vector<std::string>& values,
                    const std::string& help);
  void add_flag(const std::string& name, bool& value, const std::string& help);
  void footer(const std::string& text);
  /// States which options belong to which form of the verb; call it before `callback`. See forms.h.
  void forms(std::vector<Form> forms);
  /// Marks a verb that only the program itself calls: it is not listed and lacks the options that
  /// every other verb has.
  void hide();
  void callback(std::function<void()> run);

 private:
  CLI::App* app_;
  std::vector<Form> forms_;
};

/// The command line with all verbs. Every verb has the options --json, --quiet and --log FILE
/// (console.h); the first two may also precede the verb.
class CommandLine {
 public:
  CommandLine(const std::string& description,
              const std::string& footer,
              const std::string& version);
  ~CommandLine();

  Verb add_subcommand(const std::string& name, const std::string& description);

  /// Returns the output of `latsch VERB --help`; that of `latsch --help` if `verb` is empty;
  /// nothing if there is no such verb.
  std::optional<std::string> help(const std::string& verb) const;
  /// Returns the names of the listed verbs.
  std::vector<std::string> verbs() const;

  /// Runs the chosen verb. Returns false, after reporting the reason, if the command line was not
  /// understood. --help and --version return true.
  bool run(int argc, char** argv);

 private:
  void add_common_options(CLI::App& verb);
  /// Prints the text that --help or --version requests; returns true.
  bool give_text(const CLI::ParseError& request);

  std::unique_ptr<CLI::App> app_;
  std::unique_ptr<struct CommonOptions> common_;
  /// General help text, stored before a verb is chosen: afterward the parser returns the help of
  /// that verb.
  std::string general_help_;
};

}  // namespace latsch::cli
