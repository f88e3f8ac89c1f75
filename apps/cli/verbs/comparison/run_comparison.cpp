// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/comparison/run_comparison.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/console/console.h"
#include "cli/verbs/comparison/compared_models.h"
#include "cli/verbs/verbs.h"
#include "correlation/comparison/model_comparison_file.h"

namespace latsch::cli {

int run_comparison(const std::string& name,
                   const experiment::Language& language,
                   bool records_only,
                   const std::function<int(const std::string& study)>& fit) {
  constexpr int kThreads = 2;
  Json runs = Json::array();
  correlation::expect_compared_channels(name, language);
  for (const auto& [fit_name, study] : correlation::studies_of_fits(name)) {
    say("== Fit {}: {}\n", fit_name, study.string());
    const int exit_code = fit(study.string());
    Json run = std::exchange(answer(), Json());
    run["name"] = fit_name;
    runs.push_back(std::move(run));
    if (exit_code != kDone) {
      answer()["runs"] = std::move(runs);
      return exit_code;
    }
    say("\n");
  }
  say("== Reference and models\n");
  record_reference(name, language);
  if (records_only) return kDone;
  const auto page = std::filesystem::path(name).replace_extension(".html").string();
  compare_models(name, language, "", page, kThreads);
  answer()["runs"] = std::move(runs);
  return kDone;
}

}  // namespace latsch::cli
