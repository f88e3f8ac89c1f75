// SPDX-License-Identifier: Apache-2.0
// The command line of a benchmark, read the same way by all of them. Every benchmark knows
// --smoke: the same code on a case so small that it ends within seconds. The tests run that
// (smoke.py), so that no benchmark can rot.
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

/// An option that a benchmark knows beside --smoke and --help.
struct Option {
  std::string name;   // "--draws"; without the dashes it stands alone, by its place: "SEED"
  std::string value;  // what the value is called, "N"; empty: a flag. Unused where it stands alone.
  std::string help;
};

class Options {
 public:
  /// Throws InputError for an option that is not known or has no value: it lists those there are.
  Options(std::string program,
          const std::vector<std::string>& arguments,
          std::vector<Option> known = {});

  bool is_smoke() const { return has("--smoke"); }
  /// `full`, in a smoke run `few`.
  template <class T>
  T size(T full, T few) const {
    return is_smoke() ? few : full;
  }

  bool has(std::string_view name) const;
  /// The value as it was given, or `fallback`.
  std::string text(std::string_view name, std::string fallback = {}) const;
  /// A whole number of at least 0, or `fallback`. Throws InputError where it is none.
  long integer(std::string_view name, long fallback) const;
  /// A finite number, or `fallback`. Throws InputError where it is none.
  double number(std::string_view name, double fallback) const;

  /// What --help prints.
  std::string usage() const;

 private:
  std::string program_;
  std::vector<Option> known_;
  std::map<std::string, std::string, std::less<>> given_;
};

/// What main() does: reads the options, runs the benchmark and returns its exit code. Prints what
/// the benchmark throws, a study that cannot be read for instance, and returns 2.
int run_benchmark(int argc,
                  char** argv,
                  std::vector<Option> known,
                  const std::function<int(const Options&)>& benchmark);

}  // namespace latsch::benchmarks
