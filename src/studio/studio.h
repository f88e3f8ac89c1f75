// SPDX-License-Identifier: Apache-2.0
// The studio behind its server: turns requests into views, changes and runs, as described in
// docs/studio.md.
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
  std::filesystem::path program;  // executable of latsch itself, for runs
  std::string version;            // version shown on the page
  bool has_page = true;
};

class Studio {
 public:
  /// Signature of Server::publish.
  using Publish =
      std::function<void(std::string_view topic, std::string_view event, std::string_view json)>;

  Studio(const StudioOptions& options, const experiment::Language& language, Publish publish);
  ~Studio();

  /// May be called by any thread. Never throws because of a request's content.
  Response answer(const Request& request);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::studio
