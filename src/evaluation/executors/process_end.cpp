// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/process_end.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cstring>

#include "base/text.h"

namespace latsch {
namespace {

std::string_view last_line(std::string_view text) {
  const std::string_view blank = " \r\n\t";
  text = text.substr(0, text.find_last_not_of(blank) + 1);
  return trimmed(text.substr(text.find_last_of('\n') + 1));
}

}  // namespace

std::string how_it_ended(int status, std::string_view printed) {
  const std::string how =
      WIFSIGNALED(status)
          ? fmt::format(
                "was killed by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)))
          : fmt::format("exited with code {}", WEXITSTATUS(status));
  const std::string_view line = last_line(printed);
  return line.empty() ? how : how + "; it last printed " + in_quotes(line);
}

}  // namespace latsch
