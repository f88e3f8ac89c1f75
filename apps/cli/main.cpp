// SPDX-License-Identifier: Apache-2.0
// latsch: the command line. See `latsch --help`.
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "cli/console/console.h"
#include "cli/verbs/verbs.h"
#include "numerics/kernels/kernel_set.h"

namespace {

constexpr const char* kDescription =
    "Latsch identifies tire models from rig measurements: finite-element, flexible-ring, "
    "rigid-ring\n"
    "and Magic Formula tires on virtual rigs, compared with what a laboratory measured; it finds "
    "the\n"
    "parameters and says how far to trust them.";

constexpr const char* kFooter = R"(
Start here:
  latsch new my_tire                    writes a study to start from: a tire, measurements, a study file
  latsch check my_tire/study.toml       reads all of it and says what it understood
  latsch run my_tire/study.toml         fits, and ends by naming the result and the report

`latsch help VERB` shows what a verb takes, with an example; `latsch help study` all that may stand in
a study. Every verb has --json, --quiet and --log FILE. A study can be interrupted (Ctrl-C, even kill -9) and goes on with
`latsch resume`; the result is the same to the last bit.

Exit codes: 0 done; 1 the run failed or was interrupted; 2 wrong input, with file, line, what was found, what was expected.)";

int run(int argc, char** argv) {
  using namespace latsch::cli;
  // An impossible LATSCH_KERNELS ends every verb here.
  const auto kernels = latsch::name(latsch::kernel_set());
  CommandLine app(kDescription,
                  kFooter,
                  fmt::format("latsch 0.1.0 ({}, kernels {})", latsch::processor_name(), kernels));
  int exit_code = kDone;
  for (const auto add :
       {add_new,    add_check,    add_mesh,   add_simulate,  add_evaluate, add_doe,
        add_run,    add_identify, add_report, add_pareto,    add_export,   add_process,
        add_doctor, add_road,     add_test,   add_footprint, add_ring,     add_compare,
        add_show,   add_help,     add_worker}) {
    add(app, exit_code);
  }
  if (!app.run(argc, argv)) return kWrongInput;
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace latsch::cli;
  try {
    return close_console(run(argc, argv));
  } catch (const latsch::InputError& error) {
    complain(error.what(), error.place());
    return close_console(kWrongInput);
  } catch (const std::filesystem::filesystem_error& error) {  // a folder that may not be written
    const std::string path = error.path1().string();
    complain(path + ": cannot be created or changed: " + error.code().message(), {path, 0});
    return close_console(kWrongInput);
  } catch (const std::exception& error) {
    complain(error.what());
    return close_console(kFailed);
  }
}
