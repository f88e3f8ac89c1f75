// SPDX-License-Identifier: Apache-2.0
// The studio's server for the studies of a folder, used by the verbs `serve` and `run --watch`.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "experiment/language.h"

namespace latsch::cli {

struct ServeOptions {
  std::filesystem::path root;  // a folder, or the file of one study
  std::string listen = "127.0.0.1";
  int port = 0;  // 0: a free one
};

/// Serves the studies in separate threads as long as the object exists.
class ServedStudies {
 public:
  ServedStudies(const ServeOptions& options, const experiment::Language& language);
  ~ServedStudies();
  ServedStudies(const ServedStudies&) = delete;
  ServedStudies& operator=(const ServedStudies&) = delete;

  /// Returns the URL with its access token, which permits starting runs.
  std::string address() const;
  /// Opens a browser on this machine if there is a display. Returns false if none could be started.
  bool open_browser() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace latsch::cli
