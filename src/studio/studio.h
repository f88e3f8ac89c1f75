// SPDX-License-Identifier: Apache-2.0
// The studio behind its server: requests to views, changes and runs, as docs/studio.md has them.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "experiment/language.h"
#include "studio/http/server.h"

namespace latsch::studio {

struct StudioOptions {
  std::filesystem::path root;     // a folder of studies, or one study's file
  std::filesystem::path program;  // latsch itself, for runs
  std::string version;            // as the page shows it
  bool has_page = true;
};

class Studio {
 public:
  /// As Server::publish.
  using Publish =
      std::function<void(std::string_view topic, std::string_view event, std::string_view json)>;

  Studio(const StudioOptions& options, const experiment::Language& language, Publish publish);
  ~Studio();

  /// From any thread. Never throws for what a request says.
  Response answer(const Request& request);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::studio
