// SPDX-License-Identifier: Apache-2.0
// Shows how far a long run is and when it will end: by a bar that redraws itself on a terminal, by
// plain lines at most every few seconds in a pipe or a file.
//
// The time that is left is said as far as it is known. Of n evaluations that finished at t_1 .. t_n
// after the start, where workers finish them side by side, the time of one is between
//
//   (t_n - t_1) / (n - 1)        w workers that finish together at t_1 = .. = t_w: 0
//   t_n / n                      the first of w workers to finish: w times the time of one
//
// and both come together after a few rounds of the workers. A total that changes is a forecast
// itself: all totals count that were said since half of n was finished. Below three evaluations, or
// if the bounds are far apart, nothing is said; a range while they differ; then a single time.
#pragma once

#include <deque>
#include <iosfwd>
#include <string>

#include "base/clock.h"

namespace latsch {

/// True if standard error (or the given descriptor) is a terminal.
bool is_terminal(int descriptor = 2);
/// Characters in a line of that terminal; 80 if unknown.
int terminal_columns(int descriptor = 2);

class Progress {
 public:
  /// `terminal` says whether `out` can redraw a line, see is_terminal(); `columns` is the width of
  /// its lines.
  Progress(std::ostream& out,
           bool terminal,
           Clock clock = steady_clock(),
           int columns = terminal_columns());
  /// Prints the last state unless it was printed already, and ends the line of the bar.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of `total` evaluations are finished; if `total` is 0, it is unknown. `note` is one
  /// short text, such as the best value so far. Prints the first and the last state, and the states
  /// between them at intervals.
  void update(long done, long total, const std::string& note = "");

 private:
  /// A total, and the number of counted evaluations when it was said last.
  struct Total {
    long counted, total;
  };
  void print(const std::string& state);
  /// Takes note of finished evaluations, from which left_in_words() forecasts.
  void count(long done, long total, double now);
  /// Returns ", 2:05 left", a range, or an empty text if the end is not known.
  std::string left_in_words(long done, double now) const;
  std::string line(long done, long total, const std::string& note, double now) const;

  std::ostream& out_;
  bool terminal_;
  Clock clock_;
  std::size_t columns_;
  double start_;
  double counted_from_;         // s; start of the time over which the speed is measured
  long counted_done_ = 0;       // number of evaluations finished at counted_from_
  double first_counted_ = 0.0;  // s; time at which the first counted evaluations were finished
  long counted_first_ = 0;      // number of these; 0: none yet
  std::deque<Total> totals_;    // those said since half of the present number was finished
  double printed_ = 0.0;        // s; time of the last output
  std::size_t width_ = 0;       // number of characters of the bar on the screen
  std::string state_;           // text for the state of the last call
  std::string shown_;           // text of the last output; empty: none yet
};

/// Returns a duration such as "7 s", "2:05", "1:02:05".
std::string format_duration(double seconds);

}  // namespace latsch
