// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <utility>

#include "base/error.h"

namespace latsch::benchmarks {
namespace {

const Option kSmoke{"--smoke", "", "the same on a tiny case, in seconds: times do not count"};
const Option kHelp{"--help", "", "prints this"};

bool stands_alone(const Option& option) { return !option.name.starts_with("--"); }

template <class Number>
Number parsed(const std::string& program, std::string_view name, const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc{} && end == text.data() + text.size()) return number;
  throw InputError(
      fmt::format("{}: {} is \"{}\", expected a {}",
                  program,
                  name,
                  text,
                  std::is_integral_v<Number> ? "whole number of at least 0" : "number"));
}

}  // namespace

Options::Options(std::string program,
                 const std::vector<std::string>& arguments,
                 std::vector<Option> known)
    : program_(std::move(program)), known_(std::move(known)) {
  known_.push_back(kSmoke);
  known_.push_back(kHelp);
  auto place = known_.begin();  // name of the next positional argument
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    auto option = known_.begin();
    if (argument.starts_with("--")) {
      while (option != known_.end() && option->name != argument) ++option;
    } else {
      while (place != known_.end() && !stands_alone(*place)) ++place;
      option = place;
    }
    if (option == known_.end()) {
      throw InputError(fmt::format("{}: \"{}\" is not known\n{}", program_, argument, usage()));
    }
    if (stands_alone(*option)) {
      given_[option->name] = argument;
      ++place;
    } else if (option->value.empty()) {
      given_[option->name] = "";
    } else if (i + 1 < arguments.size()) {
      given_[option->name] = arguments[++i];
    } else {
      throw InputError(fmt::format("{}: {} needs {}", program_, argument, option->value));
    }
  }
}

bool Options::has(std::string_view name) const { return given_.contains(name); }

std::string Options::text(std::string_view name, std::string fallback) const {
  const auto found = given_.find(name);
  return found == given_.end() ? std::move(fallback) : found->second;
}

long Options::integer(std::string_view name, long fallback) const {
  if (!has(name)) return fallback;
  const std::string given = text(name);
  const auto number = parsed<long>(program_, name, given);
  return number >= 0 ? number : parsed<long>(program_, name, given + " below 0");
}

double Options::number(std::string_view name, double fallback) const {
  if (!has(name)) return fallback;
  const auto number = parsed<double>(program_, name, text(name));
  return std::isfinite(number) ? number : parsed<double>(program_, name, "not finite");
}

std::string Options::usage() const {
  std::string line = "usage: " + program_, each;
  for (const Option& option : known_) {
    const std::string name = option.value.empty() ? option.name : option.name + " " + option.value;
    line += " [" + name + "]";
    each += fmt::format("  {:22} {}\n", name, option.help);
  }
  return line + "\n" + each;
}

int run_benchmark(int argc,
                  char** argv,
                  std::vector<Option> known,
                  const std::function<int(const Options&)>& benchmark) {
  const std::string program = std::filesystem::path(argv[0]).filename().string();
  try {
    const Options options(program, {argv + 1, argv + argc}, std::move(known));
    if (options.has("--help")) {
      fmt::print("{}", options.usage());
      return 0;
    }
    return benchmark(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", program, error.what());
    return 2;
  }
}

}  // namespace latsch::benchmarks
