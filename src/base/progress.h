// SPDX-License-Identifier: Apache-2.0
// How far a long run is and when it will end: a bar that redraws itself on a terminal, plain lines
// at most every few seconds in a pipe or a file.
#pragma once

#include <iosfwd>
#include <string>

#include "base/clock.h"

namespace latsch {

/// Whether standard error (or the descriptor given) is a terminal.
bool is_terminal(int descriptor = 2);
/// Characters in a line of that terminal; 80 where nobody knows.
int terminal_columns(int descriptor = 2);

class Progress {
 public:
  /// `terminal`: whether `out` can redraw a line, see is_terminal(). `columns`: how wide it is.
  Progress(std::ostream& out,
           bool terminal,
           Clock clock = steady_clock(),
           int columns = terminal_columns());
  /// Prints the last state where it was not due, and ends the line of the bar.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of `total` are finished; total 0: nobody knows how many there will be. `note` is one
  /// short text, such as the best value so far. Prints the first and the last call and what falls
  /// due in between.
  void update(long done, long total, const std::string& note = "");

 private:
  void print(const std::string& state);
  std::string line(long done, long total, const std::string& note, double now) const;

  std::ostream& out_;
  bool terminal_;
  Clock clock_;
  std::size_t columns_;
  double start_;
  double counted_from_;    // time and
  long counted_done_ = 0;  // number from which the speed is counted
  double printed_ = 0.0;   // time of the last print
  std::size_t width_ = 0;  // characters of the bar on the screen
  std::string state_;      // of the last call
  std::string shown_;      // of the last print; empty: none yet
};

/// "7 s", "2:05", "1:02:05".
std::string format_duration(double seconds);

}  // namespace latsch
