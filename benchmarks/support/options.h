// SPDX-License-Identifier: Apache-2.0
// The command line of a benchmark, read in the same way by all of them. Every benchmark supports
// --smoke: the same code on a case so small that it ends within seconds. The tests run it
// (smoke.py), so that no benchmark becomes outdated.
//
//   int run(const Options& options) {
//     Table table("crash", options);
//     hunt(table, options.size(100, 2));  // kills: 100, in a smoke run 2
//     return table.exit_code();
//   }
//   int main(int argc, char** argv) { return run_benchmark(argc, argv, {}, run); }
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::benchmarks {

/// An option of a benchmark, in addition to --smoke and --help.
struct Option {
  std::string name;  // "--draws"; a name without dashes is positional: "SEED"
  /// name of the option's value, such as "N"; empty for a flag, and not used by a positional option
  std::string value;
  std::string help;
};

class Options {
 public:
  /// Throws InputError if an option is unknown or lacks its value; the message lists the options.
  Options(std::string program,
          const std::vector<std::string>& arguments,
          std::vector<Option> known = {});

  bool is_smoke() const { return has("--smoke"); }
  /// Returns `full`, or `few` in a smoke run.
  template <class T>
  T size(T full, T few) const {
    return is_smoke() ? few : full;
  }

  bool has(std::string_view name) const;
  /// Returns the value of the option, or `fallback` if it is not given.
  std::string text(std::string_view name, std::string fallback = {}) const;
  /// Returns the value of the option as an integer of at least 0, or `fallback` if it is not given.
  /// Throws InputError for any other value.
  long integer(std::string_view name, long fallback) const;
  /// Returns the value of the option as a finite number, or `fallback` if it is not given. Throws
  /// InputError for any other value.
  double number(std::string_view name, double fallback) const;

  /// Returns the text of --help.
  std::string usage() const;

 private:
  std::string program_;
  std::vector<Option> known_;
  std::map<std::string, std::string, std::less<>> given_;
};

/// Implements main(): reads the options, runs the benchmark and returns its exit code. Prints what
/// the benchmark throws, for instance for a study that cannot be read, and returns 2.
int run_benchmark(int argc,
                  char** argv,
                  std::vector<Option> known,
                  const std::function<int(const Options&)>& benchmark);

}  // namespace latsch::benchmarks
