// SPDX-License-Identifier: Apache-2.0
// Loads the library of a unit as another program does, on Linux or Windows, drives it, and prints
// the bits of outputs, so that runs on different systems can be compared (windows_test.py).
//
//   unit_caller VERSION LIBRARY RESOURCES TOKEN STEPS STEP PHASE [NUMBER=VALUE+RATE]... [NUMBER]...
//
// VERSION is 2 or 3; RESOURCES a URI (2) or a folder (3). NUMBER is a value reference: with a value
// it is set, to VALUE + RATE times the time before every step; without one it is printed after the
// start and every step, as sixteen hexadecimal digits. PHASE is the number of bytes by which the
// stack of the calls is moved, a multiple of 16. Errors of the unit go to the standard error; the
// exit code is 1 for an instance that is not made and 2 for a call that does not end well.
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "exchange/fmi2.h"
#include "exchange/fmi3.h"

#ifdef _WIN32
#include <malloc.h>
#include <windows.h>
#else
#include <alloca.h>
#include <dlfcn.h>
#endif

namespace {

using namespace latsch::exchange;

void* load(const char* file) {
#ifdef _WIN32
  return reinterpret_cast<void*>(LoadLibraryA(file));
#else
  return dlopen(file, RTLD_NOW | RTLD_LOCAL);
#endif
}

void* find(void* library, const char* name) {
#ifdef _WIN32
  return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(library), name));
#else
  return dlsym(library, name);
#endif
}

struct Input {
  unsigned reference;
  double value, rate;
};

struct Plan {
  bool two;
  std::string library, resources, token;
  int steps;
  double step;
  std::vector<Input> inputs;
  std::vector<unsigned> outputs;
};

void say2(void*, fmi2::Text, fmi2::Status, fmi2::Text, fmi2::Text format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  std::vfprintf(stderr, format, arguments);
  va_end(arguments);
  std::fputc('\n', stderr);
}

void say3(void*, fmi3::Status, fmi3::Text, fmi3::Text message) {
  std::fprintf(stderr, "%s\n", message);
}

void print(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  std::printf("%08x%08x ", static_cast<unsigned>(bits >> 32), static_cast<unsigned>(bits));
}

#define FUNCTION(version, name) \
  auto* name = reinterpret_cast<decltype(version::name)*>(find(library, #name))

/// Drives a unit of FMI 2.0. Returns the exit code.
int drive2(void* library, const Plan& plan) {
  FUNCTION(fmi2, fmi2Instantiate);
  FUNCTION(fmi2, fmi2SetupExperiment);
  FUNCTION(fmi2, fmi2EnterInitializationMode);
  FUNCTION(fmi2, fmi2ExitInitializationMode);
  FUNCTION(fmi2, fmi2SetReal);
  FUNCTION(fmi2, fmi2GetReal);
  FUNCTION(fmi2, fmi2DoStep);
  FUNCTION(fmi2, fmi2FreeInstance);
  fmi2::Callbacks callbacks{say2, nullptr, nullptr, nullptr, nullptr};
  const auto unit = fmi2Instantiate(
      "one", fmi2::co_simulation, plan.token.c_str(), plan.resources.c_str(), &callbacks, 0, 0);
  if (!unit) return 1;
  const auto set = [&](double time) {
    for (const Input& input : plan.inputs) {
      const double value = input.value + input.rate * time;
      if (fmi2SetReal(unit, &input.reference, 1, &value) != fmi2::ok) std::exit(2);
    }
  };
  const auto tell = [&] {
    for (const unsigned reference : plan.outputs) {
      double value = 0.0;
      if (fmi2GetReal(unit, &reference, 1, &value) != fmi2::ok) std::exit(2);
      print(value);
    }
    std::printf("\n");
  };
  set(0.0);
  fmi2SetupExperiment(unit, 0, 0.0, 0.0, 0, 0.0);
  fmi2EnterInitializationMode(unit);
  if (fmi2ExitInitializationMode(unit) > fmi2::warning) return 2;
  tell();
  for (int i = 0; i < plan.steps; ++i) {
    if (i > 0) set(plan.step * i);
    if (fmi2DoStep(unit, plan.step * i, plan.step, 0) > fmi2::warning) return 2;
    tell();
  }
  fmi2FreeInstance(unit);
  return 0;
}

/// Drives a unit of FMI 3.0. Returns the exit code.
int drive3(void* library, const Plan& plan) {
  FUNCTION(fmi3, fmi3InstantiateCoSimulation);
  FUNCTION(fmi3, fmi3EnterInitializationMode);
  FUNCTION(fmi3, fmi3ExitInitializationMode);
  FUNCTION(fmi3, fmi3SetFloat64);
  FUNCTION(fmi3, fmi3GetFloat64);
  FUNCTION(fmi3, fmi3DoStep);
  FUNCTION(fmi3, fmi3FreeInstance);
  const auto unit = fmi3InstantiateCoSimulation("one",
                                                plan.token.c_str(),
                                                plan.resources.c_str(),
                                                false,
                                                false,
                                                false,
                                                false,
                                                nullptr,
                                                0,
                                                nullptr,
                                                say3,
                                                nullptr);
  if (!unit) return 1;
  const auto set = [&](double time) {
    for (const Input& input : plan.inputs) {
      const double value = input.value + input.rate * time;
      if (fmi3SetFloat64(unit, &input.reference, 1, &value, 1) != fmi3::ok) std::exit(2);
    }
  };
  const auto tell = [&] {
    for (const unsigned reference : plan.outputs) {
      double value = 0.0;
      if (fmi3GetFloat64(unit, &reference, 1, &value, 1) != fmi3::ok) std::exit(2);
      print(value);
    }
    std::printf("\n");
  };
  set(0.0);
  fmi3EnterInitializationMode(unit, false, 0.0, 0.0, false, 0.0);
  if (fmi3ExitInitializationMode(unit) > fmi3::warning) return 2;
  tell();
  for (int i = 0; i < plan.steps; ++i) {
    if (i > 0) set(plan.step * i);
    bool event = false, end = false, early = false;
    double reached = 0.0;
    const auto status =
        fmi3DoStep(unit, plan.step * i, plan.step, false, &event, &end, &early, &reached);
    if (status > fmi3::warning) return 2;
    tell();
  }
  fmi3FreeInstance(unit);
  return 0;
}

#undef FUNCTION

/// Calls the unit with a stack that is `phase` bytes lower.
[[gnu::noinline]] int drive_from(int phase, void* library, const Plan& plan) {
  volatile char* room = static_cast<char*>(alloca(static_cast<std::size_t>(phase) + 16));
  room[0] = 0;
  return plan.two ? drive2(library, plan) : drive3(library, plan);
}

/// Returns the arguments in UTF-8, as FMI wants the names of folders.
std::vector<std::string> arguments_of(int argc, char** argv) {
#ifdef _WIN32
  (void)argv;
  std::vector<std::string> arguments;
  wchar_t** wide = CommandLineToArgvW(GetCommandLineW(), &argc);
  for (int i = 0; i < argc; ++i) {
    char text[4096] = {};
    WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, text, sizeof text - 1, nullptr, nullptr);
    arguments.emplace_back(text);
  }
  return arguments;
#else
  return {argv, argv + argc};
#endif
}

}  // namespace

int main(int argc, char** words) {
  const std::vector<std::string> all = arguments_of(argc, words);
  std::vector<const char*> argv;
  for (const std::string& one : all) argv.push_back(one.c_str());
  if (argc < 8) return 3;
  Plan plan{
      argv[1][0] == '2', argv[2], argv[3], argv[4], std::atoi(argv[5]), std::atof(argv[6]), {}, {}};
  for (int i = 8; i < argc; ++i) {
    char* end = nullptr;
    const auto reference = static_cast<unsigned>(std::strtoul(argv[i], &end, 10));
    if (*end != '=') {
      plan.outputs.push_back(reference);
      continue;
    }
    char* rate = nullptr;
    const double value = std::strtod(end + 1, &rate);
    plan.inputs.push_back({reference, value, *rate == '+' ? std::atof(rate + 1) : 0.0});
  }
  void* library = load(plan.library.c_str());
  if (!library) {
    std::fprintf(stderr, "%s cannot be loaded\n", plan.library.c_str());
    return 4;
  }
  return drive_from(std::atoi(argv[7]), library, plan);
}
