// SPDX-License-Identifier: Apache-2.0
// Channels of a universal file's functions: their names, units, places and groups.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "formats/recorders/recorded_file.h"
#include "formats/recorders/uff_numbers.h"

namespace latsch::formats {

/// Record of an axis in the head of a function.
struct UffAxis {
  long quantity = 0;
  std::string label, unit;
};

/// A point of the structure that was measured.
struct UffPoint {
  double x = 0.0, y = 0.0, z = 0.0;  // in the file's unit of length
};

/// One function, before its unit is known.
struct UffFunction {
  long kind = 0;
  std::string title;
  long point = 0, direction = 0, reference_point = 0, reference_direction = 0;
  UffLayout layout;
  std::size_t samples = 0;
  double first = 0.0, step = 0.0;
  UffAxis abscissa, ordinate, denominator;
  std::vector<double> numbers;
  int line = 0;
};

/// Turns functions into channels. The units of data set 164 and the points must be complete before
/// the first function is added.
class UffChannels {
 public:
  UffChannels(RecordedFile& file, NumberBudget& budget) : file_(file), budget_(budget) {}

  /// Sets the factors by which numbers of the file are divided to get SI units.
  void set_units(double length, double force) {
    length_ = length;
    force_ = force;
  }
  void set_point(long label, const UffPoint& point) { points_[label] = point; }
  /// Takes the numbers of a function. One of an unknown type is left out.
  void add(UffFunction& function);

 private:
  /// A unit and the factor that converts numbers of the file to it.
  struct AxisUnit {
    std::string unit;
    double factor = 1.0;
  };
  AxisUnit unit_of(const UffAxis& axis, const UffFunction& function, std::string& remark);
  /// Adds a doubt about the label of an axis, at most one for each file.
  void doubt_label(const UffAxis& axis, const UffFunction& function, const char* sentence);
  std::string place_of(long label) const;
  RecordedGroup& group_of(const UffFunction& function);

  RecordedFile& file_;
  NumberBudget& budget_;
  double length_ = 1.0, force_ = 1.0;  // data set 164: SI = number / factor
  bool is_doubted_ = false;
  std::map<long, UffPoint> points_;
  std::map<std::string, int> groups_;
  std::map<std::tuple<std::string, std::size_t, double, double>, std::vector<std::size_t>>
      groups_alike_;
};

}  // namespace latsch::formats
