// SPDX-License-Identifier: Apache-2.0
#include "base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace latsch {
namespace {

constexpr double kRedraw = 0.1;      // s between two states of the bar
constexpr double kLineInterval = 5;  // s between two lines in a pipe
constexpr int kBarWidth = 30;        // characters

}  // namespace

Progress::Progress(std::ostream& out, bool terminal, Clock clock)
    : out_(out), terminal_(terminal), clock_(std::move(clock)), start_(clock_()) {}

Progress::~Progress() {
  if (width_ > 0) out_ << '\n' << std::flush;
}

void Progress::update(long done, long total, const std::string& note) {
  const double now = clock_();
  const bool last = total > 0 && done >= total;
  if (any_ && !last && now - printed_ < (terminal_ ? kRedraw : kLineInterval)) return;
  any_ = true;
  printed_ = now;
  const std::string text = line(done, total, note, now - start_);
  if (!terminal_) {
    out_ << text << '\n' << std::flush;
    return;
  }
  const std::size_t rest = width_ > text.size() ? width_ - text.size() : 0;
  out_ << '\r' << text << std::string(rest, ' ') << std::flush;
  width_ = text.size();
}

std::string Progress::line(long done, long total, const std::string& note, double elapsed) const {
  std::string text;
  if (total > 0) {
    const double share =
        std::clamp(static_cast<double>(done) / static_cast<double>(total), 0.0, 1.0);
    if (terminal_) {
      const int filled = static_cast<int>(share * kBarWidth);
      text = fmt::format("[{:#<{}}{:.<{}}] ", "", filled, "", kBarWidth - filled);
    }
    text += fmt::format("{}/{} ({:.0f} %)", done, total, 100.0 * share);
    if (done >= total)
      text += ", " + format_duration(elapsed);
    else if (done > 0)
      text += ", " + format_duration(elapsed / share - elapsed) + " left";
  } else {
    text = fmt::format("{} done, {}", done, format_duration(elapsed));
  }
  return note.empty() ? text : text + ", " + note;
}

bool is_terminal(int descriptor) { return ::isatty(descriptor) == 1; }

std::string format_duration(double seconds) {
  const long whole = std::lround(std::max(0.0, seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace latsch
