// SPDX-License-Identifier: Apache-2.0
#include "formats/road/rdf_spline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/text.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStation = 0.5;  // m, distance of cross-sections
// Largest number of cross-sections in an interval between two points; in a long interval their
// distance is larger.
constexpr double kMostPieces = 200.0;
constexpr double kLargestSpline = 1e6;  // m
constexpr double kLeastStep = 1e-3;     // m, least horizontal distance of two points

struct DataPoint {
  Vector3d center = Vector3d::Zero();
  double width = 0.0, mu_left = 1.0, mu_right = 1.0;
};

class SplineReading {
 public:
  explicit SplineReading(const TeimOrbit& file)
      : file_(file),
        units_(file.units()),
        data_(file.section("DATA_POINTS")),
        global_(file.find("GLOBAL_PARAMETERS")) {}

  road::TriangleMesh run() {
    closed_ = global_ && lower(global_->text("CLOSED_ROAD", "no")) == "yes";
    check_vertical();
    read_points();
    return mesh();
  }

 private:
  double global(const char* key, double fallback) const {
    return global_ ? global_->number(key, fallback) : fallback;
  }

  void check_vertical() const {
    if (!global_ || !global_->has("ROAD_VERTICAL")) return;
    const std::string text = global_->text("ROAD_VERTICAL");
    std::istringstream words(text);
    std::vector<double> numbers;
    for (std::string word; words >> word;)
      numbers.push_back(parse_number(word).value_or(std::nan("")));
    if (numbers.size() == 3 && numbers[0] == 0.0 && numbers[1] == 0.0 && numbers[2] > 0.0) return;
    throw InputError(global_->place(global_->find("ROAD_VERTICAL")->line),
                     "ROAD_VERTICAL is " + in_quotes(text) + ", expected '0 0 1'");
  }

  /// Returns the number in a row of the table or, if the row has 0 or no number, the number common
  /// to all rows.
  double own(const std::vector<double>& row, std::size_t column, double of_all) const {
    return column < row.size() && row[column] != 0.0 ? row[column] : of_all;
  }

  void read_points() {
    for (const TeimOrbitTable& table : data_.tables()) {
      for (const TeimOrbitRow& row : table.rows) read_point(row);
    }
    if (closed_ && points_.size() > 2 &&
        (points_.front().center - points_.back().center).head<2>().norm() < kLeastStep) {
      points_.pop_back();
    }
    if (points_.size() < (closed_ ? 3u : 2u))
      throw InputError(data_.place(),
                       fmt::format("has {} points, expected {} at least",
                                   points_.size(),
                                   closed_ ? "3 for a closed road" : "2"));
  }

  void read_point(const TeimOrbitRow& row) {
    const Place place = data_.place(row.line);
    TeimOrbitRow numbers_only = row;
    if (numbers_only.fields.size() > 7) {
      throw InputError(place,
                       "names the obstacle " + in_quotes(row.fields[7]) +
                           ", which is not read on a spline road; expected a road without "
                           "obstacles, or the road with them as triangles or OpenCRG");
    }
    const std::vector<double> numbers = data_.numbers(numbers_only, 3);
    if (numbers.size() > 4 && numbers[4] != 0.0) {
      throw InputError(place,
                       "has a bank angle, whose sign the format's description does not define; "
                       "expected 0, or the road as triangles or OpenCRG");
    }
    DataPoint point;
    point.center = units_.length() * Vector3d(numbers[0], numbers[1], numbers[2]);
    point.width = units_.length() * own(numbers, 3, global("WIDTH", 0.0));
    point.mu_left = own(numbers, 5, global("MU_LEFT", 1.0));
    point.mu_right = own(numbers, 6, global("MU_RIGHT", 1.0));
    if (!(point.center.cwiseAbs().maxCoeff() <= kLargestSpline))
      throw InputError(place, "has a point further away than 1e6 m");
    if (!(point.width >= 1e-3 && point.width <= kLargestSpline))
      throw InputError(place, "has a width that is not between 1 mm and 1e6 m");
    if (!(std::min(point.mu_left, point.mu_right) >= 0.0 &&
          std::max(point.mu_left, point.mu_right) <= 100.0))
      throw InputError(place, "has a friction below 0 or above 100");
    if (!points_.empty() && (point.center - points_.back().center).head<2>().norm() < kLeastStep)
      throw InputError(place, "repeats the point before, expected the road to continue");
    points_.push_back(point);
  }

  const DataPoint& point(long i) const {
    const long count = std::ssize(points_);
    return points_[static_cast<std::size_t>(closed_ ? ((i % count) + count) % count
                                                    : std::clamp(i, 0l, count - 1))];
  }

  double chord(long i) const { return (point(i + 1).center - point(i).center).head<2>().norm(); }

  /// Returns the slope of the parabola through the point and its neighbors over the chord length;
  /// at an end, the slope of the chord.
  Vector3d slope(long i) const {
    const long last = std::ssize(points_) - 1;
    const auto rise = [&](long k) {
      return Vector3d((point(k + 1).center - point(k).center) / chord(k));
    };
    if (!closed_ && i == 0) return rise(0);
    if (!closed_ && i == last) return rise(last - 1);
    const double before = chord(i - 1), after = chord(i);
    return (after * rise(i - 1) + before * rise(i)) / (before + after);
  }

  struct Station {
    Vector3d center, direction;
    double width;
  };

  Station station(long i, double part) const {
    const double h = chord(i), t = part;
    const Vector3d a = point(i).center, b = point(i + 1).center;
    const Vector3d m = slope(i) * h, n = slope(i + 1) * h;
    const Vector3d rise = b - a;
    // The Hermite cubic is written as a chord plus a term that bends it, so that collinear points
    // give an exactly straight line.
    const Vector3d bend = (1.0 - t) * (m - rise) - t * (n - rise);
    const Vector3d change = -(m - rise) - (n - rise);
    const double width = point(i).width + t * (point(i + 1).width - point(i).width);
    return {a + t * rise + t * (1.0 - t) * bend,
            rise + (1.0 - 2.0 * t) * bend + t * (1.0 - t) * change,
            width};
  }

  void add(const Station& at, road::TriangleMesh& mesh) const {
    const Vector2d along = at.direction.head<2>().normalized();
    const Vector3d left(-along.y(), along.x(), 0.0);
    if (!left.allFinite())
      throw InputError(data_.place(), "turns on the spot, expected a road that continues");
    for (const double side : {-0.5, 0.0, 0.5})
      mesh.nodes.push_back(at.center + side * at.width * left);
  }

  road::TriangleMesh mesh() const {
    const long intervals = std::ssize(points_) - (closed_ ? 0 : 1);
    road::TriangleMesh mesh;
    add(station(0, 0.0), mesh);
    for (long i = 0; i < intervals; ++i) {
      const int pieces = static_cast<int>(std::min(std::ceil(chord(i) / kStation), kMostPieces));
      for (int k = 1; k <= pieces; ++k) {
        add(station(i, static_cast<double>(k) / pieces), mesh);
        const int near = static_cast<int>(mesh.nodes.size()) - 6;
        for (const int side : {0, 1}) {
          const double mu = side == 0 ? point(i).mu_right : point(i).mu_left;
          const int right = near + side, left = right + 1;
          mesh.triangles.push_back({{right, right + 3, left}, mu});
          mesh.triangles.push_back({{left, right + 3, left + 3}, mu});
        }
      }
    }
    return mesh;
  }

  const TeimOrbit& file_;
  TeimOrbitUnits units_;
  const TeimOrbitSection& data_;
  const TeimOrbitSection* global_;
  bool closed_ = false;
  std::vector<DataPoint> points_;
};

}  // namespace

bool is_rdf_spline(const TeimOrbit& file) { return file.find("DATA_POINTS") != nullptr; }

road::TriangleMesh read_rdf_spline(const TeimOrbit& file) { return SplineReading(file).run(); }

}  // namespace latsch::formats
