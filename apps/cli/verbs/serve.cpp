// SPDX-License-Identifier: Apache-2.0
// Implements `latsch serve`: starts the studio, a web page for the studies of a folder.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "cli/console/console.h"
#include "cli/run/interrupt.h"
#include "cli/run/model_source.h"
#include "cli/run/served_studies.h"
#include "cli/verbs/verbs.h"
#include "studio/shelf/shelf.h"

namespace latsch::cli {
namespace {

struct AskedToServe {
  std::string folder = ".";
  std::string listen = "127.0.0.1";
  int port = 0;
  bool no_browser = false;
};

void serve(const AskedToServe& asked, const experiment::Language& language) {
  if (!std::filesystem::exists(asked.folder))
    throw InputError({asked.folder, 0}, "does not exist: expected a folder of studies, or a study");
  if (!std::filesystem::is_directory(asked.folder) && !is_study(asked.folder))
    throw InputError({asked.folder, 0}, "is not a study: expected a folder of studies, or a study");
  catch_interrupts();
  const ServedStudies served({asked.folder, asked.listen, asked.port}, language);
  if (asked.listen != "127.0.0.1" && asked.listen != "::1")
    warn(
        "other machines can reach this address: whoever knows it may start and stop runs of these "
        "studies; nothing on the way is encrypted. A tunnel is safer: ssh -L PORT:localhost:PORT");
  say("Studies below {}\n", std::filesystem::canonical(asked.folder).string());
  if (std::filesystem::is_directory(asked.folder) && studio::find_studies(asked.folder).empty())
    warn(asked.folder +
         ": there is no study in this folder or below it yet; the page shows one as soon as it is "
         "there. latsch new FOLDER writes one");
  put(served.address() + "\n");  // printed also with --quiet
  say("Ctrl-C ends the page; runs it has started continue\n");
  std::fflush(stdout);  // another program may wait for the address at the end of a pipe
  if (!asked.no_browser) served.open_browser();
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  say("\n");
}

}  // namespace

void add_serve(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand(
      "serve", "Opens a page over the studies of a folder: see fits, start, stop and change them");
  verb.footer(
      "The address it prints holds a token: it alone opens the page, and a new one is made every "
      "time.\nThe page reads journals while runs write them; it needs no network. From another "
      "machine:\n  ssh -L 8421:localhost:8421 lab7 latsch serve studies --port 8421\n\n"
      "Examples:\n  latsch serve                              # the studies below this folder\n"
      "  latsch serve my_tire/study.toml           # one of them\n"
      "  latsch run my_tire/study.toml --watch     # the same beside a run");
  auto asked = std::make_shared<AskedToServe>();
  verb.add_option(
      "folder", asked->folder, "Folder of studies, or a study; this folder unless given");
  verb.add_option("--port", asked->port, "Port, a free one unless given").between(0, 65535);
  verb.add_option(
      "--listen", asked->listen, "Address to listen on, instead of this machine's own (127.0.0.1)");
  verb.add_flag("--no-browser", asked->no_browser, "Prints the address alone");
  verb.callback([=, &program] { serve(*asked, program.language); });
}

}  // namespace latsch::cli
