// SPDX-License-Identifier: Apache-2.0
// The studio without its server: turns requests into views, changes and runs, as docs/studio.md
// describes.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "experiment/language.h"
#include "studio/http/server.h"

namespace latsch::studio {

struct StudioOptions {
  std::filesystem::path root;     // a folder of studies, or the file of one study
  std::filesystem::path program;  // path of the program latsch, for runs
  std::string version;            // version of the program, shown on the page
  bool has_page = true;
};

class Studio {
 public:
  /// Publishes an event to the clients of a topic, as Server::publish does.
  using Publish =
      std::function<void(std::string_view topic, std::string_view event, std::string_view json)>;

  Studio(const StudioOptions& options, const experiment::Language& language, Publish publish);
  ~Studio();

  /// Answers a request of the page. May be called by any thread. Never throws because of the
  /// content of a request.
  Response answer(const Request& request);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::studio
