// SPDX-License-Identifier: Apache-2.0
#include "cli/run/served_studies.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <mutex>
#include <thread>
#include <utility>

#include "cli/console/console.h"
#include "cli/console/version.h"
#include "numerics/kernels/kernel_set.h"
#include "studio/http/server.h"
#include "studio/studio.h"
#include "web/web_assets.h"

extern char** environ;

namespace latsch::cli {

/// The studio publishes messages through the server, and the server calls the studio. Messages
/// published before the server exists or after it has ended are dropped.
struct ServedStudies::Parts {
  std::unique_ptr<studio::Studio> studio;
  std::mutex publishing;  // protects the members below; held only briefly
  studio::Server* published_to = nullptr;
  std::unique_ptr<studio::Server> server;
};

ServedStudies::ServedStudies(const ServeOptions& options, const experiment::Language& language)
    : parts_(std::make_unique<Parts>()) {
  Parts& parts = *parts_;
  studio::ServerOptions server;
  server.listen = options.listen;
  server.port = static_cast<std::uint16_t>(options.port);
  // Most threads only wait for another one that computes; with this number of threads a few slow
  // views do not block the others.
  server.threads = 12;
  server.assets = studio::web_assets();
  server.report = [](std::string_view what) { warn("a request failed: " + std::string(what)); };
  const studio::StudioOptions about{options.root,
                                    std::filesystem::read_symlink("/proc/self/exe"),
                                    "latsch " + version_number(),
                                    !server.assets.empty()};
  parts.studio = std::make_unique<studio::Studio>(
      about, language, [&parts](auto topic, auto event, auto json) {
        const std::lock_guard lock(parts.publishing);
        if (parts.published_to) parts.published_to->publish(topic, event, json);
      });
  parts.server = std::make_unique<studio::Server>(
      std::move(server),
      [&parts](const studio::Request& request) { return parts.studio->answer(request); });
  const std::lock_guard lock(parts.publishing);
  parts.published_to = parts.server.get();
}

ServedStudies::~ServedStudies() {
  // Handlers of the server call the studio, and threads of the studio call the server. Therefore
  // publishing stops first, then the server with its sockets and handlers ends, then the threads of
  // the studio end.
  {
    const std::lock_guard lock(parts_->publishing);
    parts_->published_to = nullptr;
  }
  parts_->server.reset();
  parts_->studio.reset();
}

std::string ServedStudies::address() const { return parts_->server->address(); }

bool ServedStudies::open_browser() const {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return false;
  std::string program = "xdg-open", where = address();
  char* arguments[] = {program.data(), where.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {0, 1, 2})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  pid_t process = 0;
  const int error =
      ::posix_spawnp(&process, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return false;
  // The browser's process may end at any time; waitpid() prevents that it remains as a zombie.
  std::thread([process] { ::waitpid(process, nullptr, 0); }).detach();
  return true;
}

}  // namespace latsch::cli
