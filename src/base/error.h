// SPDX-License-Identifier: Apache-2.0
// What is wrong with the user's data: where it stands, what was found, what was expected.
// (A bug of ours is an assert; a simulation that does not succeed is a Failure value, see
// result.h.)
#pragma once

#include <stdexcept>
#include <string>

namespace latsch {

/// A line of a file the user wrote. line 0: the file as a whole; empty file: no file is concerned.
struct Place {
  std::string file;
  int line = 0;

  /// "tire_b.toml:41"
  std::string text() const;
};

/// Thrown for wrong input. what() reads `tire_b.toml:41: belt.angle is "22 N", expected an angle
/// such as "22 deg"`.
class InputError : public std::runtime_error {
 public:
  InputError(const Place& place, const std::string& message);
  explicit InputError(const std::string& message);

  const Place& place() const { return place_; }

 private:
  Place place_;
};

}  // namespace latsch
