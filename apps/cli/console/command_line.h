// SPDX-License-Identifier: Apache-2.0
// The command line as the verbs see it: CLI11 with the names it has there, in one translation unit.
// Its header costs every file that includes it ten seconds of compiling.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace latsch::cli {

/// An argument of a verb: "file" by its place, "-o,--output" by its name.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  Option& between(int least, int most);
  Option& one_of(const std::vector<std::string>& values);
  Option& or_alone(const std::string& value);  // may stand without a value, for this one
  Option& capture_default_str();               // --help tells the value it has now

 private:
  CLI::Option* option_;
};

/// What is bound to an option has to live until the line is parsed and the verb has run.
class Verb {
 public:
  explicit Verb(CLI::App* app) : app_(app) {}

  Option add_option(const std::string& name, std::string& value, const std::string& help);
  Option add_option(const std::string& name, int& value, const std::string& help);
  /// May be given more than once.
  Option add_option(const std::string& name,
                    std::vector<std::string>& values,
                    const std::string& help);
  void add_flag(const std::string& name, bool& value, const std::string& help);
  void footer(const std::string& text);
  /// A part of the program itself: neither listed nor with the options every verb has.
  void hide();
  void callback(std::function<void()> run);

 private:
  CLI::App* app_;
};

/// Every verb has --json, --quiet and --log FILE, see console.h.
class CommandLine {
 public:
  CommandLine(const std::string& description,
              const std::string& footer,
              const std::string& version);
  ~CommandLine();

  Verb add_subcommand(const std::string& name, const std::string& description);

  /// What `latsch VERB --help` prints; of all verbs together where `verb` is empty. Nothing where
  /// there is no such verb.
  std::optional<std::string> help(const std::string& verb) const;
  /// Names of the verbs that are listed.
  std::vector<std::string> verbs() const;

  /// Runs the verb that was chosen. False where the line was not understood, after saying why;
  /// --help and --version are true.
  bool run(int argc, char** argv);

 private:
  void add_common_options(CLI::App& verb);

  std::unique_ptr<CLI::App> app_;
  std::unique_ptr<struct CommonOptions> common_;
  std::string general_help_;  // taken before a verb is chosen, of which the parser then speaks
};

}  // namespace latsch::cli
