// SPDX-License-Identifier: Apache-2.0
// Errors in the user's data say where they are, what was found and what was expected. (A bug of
// ours is an assert; a simulation that does not succeed is a Failure value, see result.h.)
#pragma once

#include <stdexcept>
#include <string>

namespace latsch {

/// A line of a user's file. Line 0 is the file as a whole; an empty file name means that no file is
/// concerned.
struct Place {
  std::string file;  // name of the file in messages
  int line = 0;      // counted from 1; 0: the file as a whole

  /// Returns file and line, such as "tire_b.toml:41".
  std::string text() const;
};

/// Thrown for wrong input. what() reads `tire_b.toml:41: belt.angle is "22 N", expected an angle
/// such as "22 deg"`.
class InputError : public std::runtime_error {
 public:
  /// The text of the error is the place followed by the message.
  InputError(const Place& place, const std::string& message);
  /// An error that concerns no file.
  explicit InputError(const std::string& message);

  /// The place of the wrong input; its file is empty if no file is concerned.
  const Place& place() const { return place_; }

 private:
  Place place_;
};

}  // namespace latsch
