// SPDX-License-Identifier: Apache-2.0
#include "cli/run_cli.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "cli/console/console.h"
#include "cli/console/version.h"
#include "cli/verbs/campaign/design.h"
#include "cli/verbs/posterior/sample.h"
#include "cli/verbs/selection/select.h"
#include "cli/verbs/verbs.h"
#include "experiment/language/capabilities.h"

namespace latsch::cli {
namespace {

std::string description(const experiment::Language& language) {
  std::vector<std::string> models;
  for (const experiment::SpecimenKind* kind : language.kinds) models.push_back(kind->in_words());
  return fmt::format(
      "Latsch identifies models from rig measurements: it drives them through virtual tests, "
      "compares with\nwhat a laboratory measured, finds the parameters and says how far to trust "
      "them.\nModels: {}.",
      fmt::join(models, ", "));
}

/// A verb with the capability that at least one model of the program must have for the verb to be
/// offered.
struct OfferedVerb {
  void (*add)(CommandLine& app, Program& program);
  const char* capability = "";  // empty: any model
};

constexpr OfferedVerb kVerbs[] = {{add_new, experiment::IsPressed::kName},
                                  {add_check},
                                  {add_mesh, experiment::IsPressed::kName},
                                  {add_simulate},
                                  {add_doe},
                                  {add_run},
                                  {add_identify},
                                  {add_sample},
                                  {add_select},
                                  {add_design},
                                  {add_report},
                                  {add_serve},
                                  {add_pareto},
                                  {add_export},
                                  {add_process},
                                  {add_doctor},
                                  {add_road, Rolls::kName},
                                  {add_test},
                                  {add_validate},
                                  {add_compare, Rolls::kName},
                                  {add_show},
                                  {add_help},
                                  {add_worker}};

constexpr const char* kNew = R"(
  latsch new my_tire                    writes a study to start from: a tire, measurements, a study file)";

constexpr const char* kFooter = R"(
  latsch check my_tire/study.toml       reads all of it and says what it understood
  latsch run my_tire/study.toml         fits, and ends by naming the result and the report

`latsch help VERB` shows what a verb takes, with an example; `latsch help study` all that may stand in
a study. Every verb has --json, --quiet and --log FILE. A study can be interrupted (Ctrl-C, even kill -9) and goes on with
`latsch resume`; the result is the same to the last bit.

Exit codes: 0 done; 1 the run failed, or a model is not accepted; 2 wrong input, with file, line, what was found, what was expected; 130 stopped on request (Ctrl-C, SIGTERM), which is no failure.)";

int run(int argc, char** argv, const experiment::Language& language) {
  const auto offers = [&](const OfferedVerb& verb) {
    return !*verb.capability || !language.kinds_for({verb.capability}).empty();
  };
  // An invalid LATSCH_KERNELS makes every verb fail here.
  CommandLine app(description(language),
                  std::string("\nStart here:") + (offers(kVerbs[0]) ? kNew : "") + kFooter,
                  version_text());
  Program program{language};
  for (const OfferedVerb& verb : kVerbs)
    if (offers(verb)) verb.add(app, program);
  if (!app.run(argc, argv)) return kWrongInput;
  return program.exit_code;
}

}  // namespace

int run_cli(int argc, char** argv, const experiment::Language& language) {
  protect_read_files();
  try {
    return close_console(run(argc, argv, language));
  } catch (const InputError& error) {
    complain(error.what(), error.place());
    return close_console(kWrongInput);
  } catch (const std::filesystem::filesystem_error& error) {  // the folder is not writable
    const std::string path = error.path1().string();
    complain(path + ": cannot be created or changed: " + error.code().message(), {path, 0});
    return close_console(kWrongInput);
  } catch (const std::exception& error) {
    complain(error.what());
    return close_console(kFailed);
  }
}

}  // namespace latsch::cli
