// SPDX-License-Identifier: Apache-2.0
// latsch: the command line. See `latsch --help`.
#include <cstdio>
#include <exception>

#include "base/error.h"
#include "cli/verbs.h"

namespace {

constexpr const char* kDescription =
    "Latsch fits a finite-element tire to what a laboratory measured: it inflates the tire, "
    "presses it\n"
    "on the ground, computes its modes, compares, and finds the parameters.";

constexpr const char* kFooter = R"(
Start here:
  latsch new my_tire                    writes a study to start from: a tire, measurements, a study file
  latsch check my_tire/study.toml       reads all of it and says what it understood
  latsch run my_tire/study.toml         fits, and ends by naming the result and the report

Every verb has a --help with an example. A study can be interrupted (Ctrl-C, even kill -9) and goes on with
`latsch resume`; the result is the same to the last bit.

Exit codes: 0 done; 1 the run failed or was interrupted; 2 wrong input, with file, line, what was found, what was expected.)";

int run(int argc, char** argv) {
  using namespace latsch::cli;
  CLI::App app{kDescription, "latsch"};
  app.footer(kFooter);
  app.set_version_flag("--version", "latsch 0.1.0");
  app.require_subcommand(1);
  int exit_code = kDone;
  for (const auto add : {add_new,
                         add_check,
                         add_mesh,
                         add_simulate,
                         add_evaluate,
                         add_doe,
                         add_run,
                         add_identify,
                         add_report,
                         add_export,
                         add_process,
                         add_doctor,
                         add_road,
                         add_drum,
                         add_ring,
                         add_compare,
                         add_show,
                         add_worker}) {
    add(app, exit_code);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongInput;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const latsch::InputError& error) {
    std::fprintf(stderr, "latsch: %s\n", error.what());
    return latsch::cli::kWrongInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "latsch: %s\n", error.what());
    return latsch::cli::kFailed;
  }
}
