// SPDX-License-Identifier: Apache-2.0
#include "base/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace latsch {
namespace {

constexpr double kRedraw = 0.1;      // time between two redraws of the bar, s
constexpr double kLineInterval = 5;  // time between two lines if the output is a pipe, s
constexpr int kBarWidth = 30;        // characters
// Time after the start, s, within which results are taken to come from a journal and do not count
// for the speed.
constexpr double kRemembered = 1;
constexpr long kFewestCounted = 3;  // evaluations before which the end is not forecast
constexpr double kAlike = 1.25;   // ratio of bounds of the time left that is said as a single time
constexpr double kFarApart = 10;  // ratio from which on nothing is said

}  // namespace

Progress::Progress(std::ostream& out, bool terminal, Clock clock, int columns)
    : out_(out),
      terminal_(terminal),
      clock_(std::move(clock)),
      columns_(static_cast<std::size_t>(std::max(columns, 2))),
      start_(clock_()),
      counted_from_(start_) {}

Progress::~Progress() {
  if (state_ != shown_) print(state_);
  if (width_ > 0) out_ << '\n' << std::flush;
}

void Progress::update(long done, long total, const std::string& note) {
  const double now = clock_();
  const bool last = total > 0 && done >= total;
  if (now - start_ < kRemembered) {
    counted_from_ = now;
    counted_done_ = done;
  }
  if (total > 0) count(done, total, now);
  state_ = line(done, total, note, now);
  if (!shown_.empty() && !last && now - printed_ < (terminal_ ? kRedraw : kLineInterval)) return;
  printed_ = now;
  print(state_);
}

void Progress::print(const std::string& state) {
  shown_ = state;
  std::string text = state;
  if (!terminal_) {
    out_ << text << '\n' << std::flush;
    return;
  }
  if (text.size() >= columns_) text.resize(columns_ - 1);  // a line that wraps cannot be redrawn
  const std::size_t rest = width_ > text.size() ? width_ - text.size() : 0;
  out_ << '\r' << text << std::string(rest, ' ') << std::flush;
  width_ = text.size();
}

void Progress::count(long done, long total, double now) {
  const long counted = done - counted_done_;
  if (counted <= 0) return;
  if (counted_first_ == 0) {
    counted_first_ = counted;
    first_counted_ = now;
  }
  if (totals_.empty() || totals_.back().total != total) totals_.push_back({counted, total});
  totals_.back().counted = counted;
  while (2 * totals_.front().counted < counted) totals_.pop_front();
}

std::string Progress::left_in_words(long done, double now) const {
  const long counted = done - counted_done_;
  if (counted < kFewestCounted || counted == counted_first_) return "";
  const double by_start = (now - counted_from_) / static_cast<double>(counted),
               by_first = (now - first_counted_) / static_cast<double>(counted - counted_first_);
  const auto [fewest, most] = std::ranges::minmax(totals_, {}, &Total::total);
  const double least = std::min(by_start, by_first) *
                       static_cast<double>(std::max(fewest.total - done, 0L)),
               longest = std::max(by_start, by_first) * static_cast<double>(most.total - done);
  const std::string from = format_duration(least), to = format_duration(longest);
  if (longest <= kAlike * least || from == to)
    return fmt::format(", {} left", format_duration(0.5 * (least + longest)));
  if (longest > kFarApart * least) return "";
  return fmt::format(", {} to {} left", from, to);
}

std::string Progress::line(long done, long total, const std::string& note, double now) const {
  const double elapsed = now - start_;
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
    else
      text += left_in_words(done, now);
  } else {
    text = fmt::format("{} done, {}", done, format_duration(elapsed));
  }
  return note.empty() ? text : text + ", " + note;
}

bool is_terminal(int descriptor) { return ::isatty(descriptor) == 1; }

int terminal_columns(int descriptor) {
  constexpr int kUsual = 80;
  winsize size{};
  const bool known = ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kUsual;
}

std::string format_duration(double seconds) {
  const long whole = std::lround(std::max(0.0, seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace latsch
