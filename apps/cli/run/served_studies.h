// SPDX-License-Identifier: Apache-2.0
// The studio's server around the studies of a folder, for `serve` and `run --watch`.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "experiment/language.h"

namespace latsch::cli {

struct ServeOptions {
  std::filesystem::path root;  // a folder, or one study's file
  std::string listen = "127.0.0.1";
  int port = 0;  // 0: a free one
};

/// Serves from its beginning to its end, in threads of its own.
class ServedStudies {
 public:
  ServedStudies(const ServeOptions& options, const experiment::Language& language);
  ~ServedStudies();
  ServedStudies(const ServedStudies&) = delete;
  ServedStudies& operator=(const ServedStudies&) = delete;

  /// With its token: who knows it may start runs.
  std::string address() const;
  /// A browser of this machine, where there is a display; false where none could be started.
  bool open_browser() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace latsch::cli
