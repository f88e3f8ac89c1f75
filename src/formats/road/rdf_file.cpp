// SPDX-License-Identifier: Apache-2.0
// Reads Adams road data files; road_file.h describes their meaning.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "base/text.h"
#include "base/units.h"
#include "formats/road/rdf_spline.h"
#include "formats/road/road_file.h"
#include "formats/text/letter_case.h"
#include "models/road/drum_road.h"
#include "models/road/placed_road.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"
#include "models/road/two_track_road.h"
#include "models/road/wave_road.h"

namespace latsch::formats {
namespace {

using road::Profile;

constexpr double kLargestRoad = 1e7;  // m: no road is longer
constexpr double kMostCleats = 1e4;
constexpr double kMostOblique = 80.0 / 180.0 * std::numbers::pi;  // rad, largest angle of a bar
constexpr double kSmoothest = 1e-6;  // m; least length of an obstacle or wave

const std::vector<std::string> kRoadTypes = {"flat",
                                             "plank",
                                             "pothole",
                                             "ramp",
                                             "roof",
                                             "sine",
                                             "sweep",
                                             "poly_line",
                                             "drum",
                                             "stochastic_uneven"};

/// Keys that [PARAMETERS] may have for every type of road.
const std::vector<std::string> kRoadKeys = {"MU",
                                            "MU_FACTOR_CLEAT",
                                            "OFFSET",
                                            "ROTATION_ANGLE_XY_PLANE",
                                            "START",
                                            "END",
                                            "HEIGHT",
                                            "DEPTH",
                                            "LENGTH",
                                            "SLOPE",
                                            "DIRECTION",
                                            "BEVEL_EDGE_LENGTH",
                                            "AMPLITUDE",
                                            "WAVE_LENGTH",
                                            "AMPLITUDE_AT_START",
                                            "AMPLITUDE_AT_END",
                                            "WAVE_LENGTH_AT_START",
                                            "WAVE_LENGTH_AT_END",
                                            "SWEEP_TYPE",
                                            "DIAMETER",
                                            "V",
                                            "ACCELERATION_TIME",
                                            "NUMBER_CLEATS",
                                            "CLEAT_HEIGHT",
                                            "CLEAT_LENGTH",
                                            "CLEAT_BEVEL_EDGE_LENGTH",
                                            "CLEAT_DIRECTION",
                                            "CLEAT_STARTING_ANGLE"};

/// Kind of a quantity, which determines the unit of a number.
enum class Of { ratio, length, angle, time, speed };

class RdfReading {
 public:
  explicit RdfReading(const TeimOrbit& file)
      : file_(file), units_(file.units()), model_(file.section("MODEL")) {
    parameters_ = file.find("PARAMETERS") ? file.find("PARAMETERS") : &model_;
  }

  RoadFile run() {
    const std::string method = lower(model_.text("METHOD", file_.find("NODES") ? "3D" : "2D"));
    if ((method == "3d" || method == "3d_spline") && is_rdf_spline(file_)) {
      result_.kind = "Adams spline";
      take_surface(read_rdf_spline(file_));
    } else if (method == "3d" && file_.find("NODES")) {
      read_triangles();
    } else if (method == "2d" || (method == "3d" && model_.has("ROAD_TYPE"))) {
      read_2d();
    } else {
      throw InputError(
          model_.place(),
          "METHOD is " + in_quotes(method) +
              R"(, expected "2D", "3D" with [NODES] or "3D_SPLINE" with [DATA_POINTS])");
    }
    result_.unused = file_.unread();
    if (friction_across_) result_.unused.push_back(*friction_across_);
    doubt_unused();
    return std::move(result_);
  }

 private:
  /// Adds doubts about unused parts that would move, rotate or scale the surface, or change its
  /// friction.
  void doubt_unused() {
    const std::map<std::string, std::array<double, 3>, std::less<>> of_surface = {
        {"SCALE", {1.0, 1.0, 1.0}},
        {"ORIENTATION", {1.0, 0.0, 0.0}},
        {"ORIGIN", {0.0, 0.0, 0.0}},
        {"UP", {0.0, 0.0, 1.0}}};
    for (const TeimOrbitSection& section : file_.sections()) {
      const auto known = of_surface.find(section.name());
      if (known == of_surface.end() || leaves_surface(section, known->second)) continue;
      result_.doubts.push_back(
          {"[" + section.name() + "]",
           fmt::format("[{}] is not read here: the surface is as without it, although it would be "
                       "another one with it; expected the nodes in their final place and scale",
                       section.name()),
           section.place()});
    }
    for (const TeimOrbitPart& part : result_.unused) {
      constexpr std::string_view kSection = "[PARAMETERS] ";
      if (!part.name.starts_with(kSection)) continue;
      // A key that belongs to another ROAD_TYPE is often left in a file and has no effect, so it
      // causes no doubt.
      const std::string key = part.name.substr(kSection.size());
      if (key.starts_with("{") ||
          std::find(kRoadKeys.begin(), kRoadKeys.end(), key) != kRoadKeys.end())
        continue;
      result_.doubts.push_back(
          {part.name,
           part.name + " is no key of a road: it has no effect" + did_you_mean(key, kRoadKeys),
           Place{file_.file(), part.line}});
    }
    if (friction_across_)
      result_.doubts.push_back({friction_across_->name,
                                "the friction across the road differs from that along it; here "
                                "the friction along the road (the first of the two) counts for "
                                "both directions",
                                Place{file_.file(), friction_across_->line}});
  }

  /// True if X, Y, Z of the section have no effect: they have the values of `neutral` or are
  /// missing.
  static bool leaves_surface(const TeimOrbitSection& section,
                             const std::array<double, 3>& neutral) {
    if (!section.tables().empty()) return false;
    constexpr std::array<const char*, 3> kAxes = {"X", "Y", "Z"};
    std::size_t known = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const TeimOrbitEntry* entry = section.find(kAxes[i]);
      if (!entry) continue;
      ++known;
      if (parse_number(entry->value) != neutral[i]) return false;
    }
    return known == section.entries().size();
  }

  [[noreturn]] void reject(const char* key, const std::string& message) {
    const TeimOrbitEntry* entry = find(key);
    throw InputError(
        entry ? parameters_->place(entry->line) : parameters_->place(),
        std::string(key) + (entry ? " is " + entry->value + ", " : " is missing, ") + message);
  }

  const TeimOrbitEntry* find(const char* key) {
    const TeimOrbitEntry* entry = parameters_->find(key);
    return entry || parameters_ == &model_ ? entry : model_.find(key);
  }

  /// Returns the SI value of one unit. It throws if the file does not state the unit, so it is
  /// called only for numbers other than 0; 0 is the same in any unit.
  double in_si(Of quantity) const {
    switch (quantity) {
      case Of::length:
        return units_.length();
      case Of::angle:
        return units_.angle();
      case Of::time:
        return units_.time();
      case Of::speed:
        return units_.length() / units_.time();
      case Of::ratio:
        break;
    }
    return 1.0;
  }

  double number(const char* key, Of quantity, double low, double high) {
    const TeimOrbitEntry* entry = find(key);
    if (!entry) reject(key, "expected a number");
    const double written = parameters_->number(*entry);
    const double value = written == 0.0 ? written : written * in_si(quantity);
    if (!(value >= low && value <= high)) {
      reject(key, fmt::format("expected {} to {} in SI units", low, high));
    }
    return value;
  }
  double number(const char* key, Of quantity, double low, double high, double fallback) {
    return find(key) ? number(key, quantity, low, high) : fallback;
  }
  double length(const char* key) { return number(key, Of::length, kSmoothest, kLargestRoad); }
  double place(const char* key, double fallback = 0.0) {
    return number(key, Of::length, -kLargestRoad, kLargestRoad, fallback);
  }
  /// Reads the height of an obstacle or wave. Adds a doubt about one above a meter, because a unit
  /// may be wrong.
  double height(const char* key) {
    constexpr double kHighest = 1.0;  // m
    const double value = number(key, Of::length, -kLargestRoad, kLargestRoad);
    if (std::abs(value) > kHighest)
      result_.doubts.push_back(
          {"[PARAMETERS] " + std::string(key),
           fmt::format("{} is {}, higher than any obstacle: is LENGTH of [UNITS] right?",
                       key,
                       format_quantity(value, "m", 4)),
           parameters_->place(find(key)->line)});
    return value;
  }
  double friction(const char* key) { return number(key, Of::ratio, 0.0, 100.0, 1.0); }

  void read_2d() {
    std::string type = lower(model_.text("ROAD_TYPE"));
    if (type == "pot_hole") type = "pothole";
    if (type == "cleat") type = "plank";
    if (type == "sine_sweep") type = "sweep";
    result_.kind = "Adams " + type;
    std::unique_ptr<road::Road> road = read_type(type);
    const double angle = number("ROTATION_ANGLE_XY_PLANE", Of::angle, -1e3, 1e3, 0.0);
    const double offset = place("OFFSET");
    if (angle != 0.0 || offset != 0.0) {
      result_.facts.push_back(fmt::format("turned by {} deg, lifted by {} m",
                                          format_number(angle * 180.0 / std::numbers::pi, 6),
                                          offset));
      road = std::make_unique<road::PlacedRoad>(
          std::move(road), angle, Eigen::Vector3d(0.0, 0.0, offset));
    }
    result_.road = std::move(road);
  }

  std::unique_ptr<road::Road> read_type(const std::string& type) {
    if (type == "flat") {
      road::PlaneRoad::Settings settings;
      settings.friction = friction("MU");
      return std::make_unique<road::PlaneRoad>(settings);
    }
    if (type == "plank") return read_plank();
    if (type == "pothole") return read_pothole();
    if (type == "ramp") return read_ramp();
    if (type == "roof") return read_roof();
    if (type == "sine" || type == "sweep") return read_wave(type == "sweep");
    if (type == "poly_line") return read_poly_line();
    if (type == "drum") return read_drum();
    const Place where = model_.place(model_.find("ROAD_TYPE")->line);
    if (type == "stochastic_uneven") {
      throw InputError(where,
                       "ROAD_TYPE is \"stochastic_uneven\", whose random numbers only the program "
                       "that made it knows; expected the road itself, as poly_line or OpenCRG");
    }
    throw InputError(where,
                     "unknown ROAD_TYPE " + in_quotes(type) + did_you_mean(type, kRoadTypes));
  }

  std::unique_ptr<road::Road> obstacle(Profile profile, double x, double angle = 0.0) {
    road::ProfileRoad::Settings settings;
    settings.along = std::move(profile);
    settings.origin.x() = x;
    settings.angle = angle;
    settings.friction = friction("MU");
    settings.obstacle_friction = settings.friction * friction("MU_FACTOR_CLEAT");
    return std::make_unique<road::ProfileRoad>(settings);
  }

  Profile bar(const char* height_key, const char* length_key, const char* bevel_key, double angle) {
    const double high = height(height_key);
    const double across = length(length_key) * std::cos(angle);
    const double bevel = number(bevel_key, Of::length, 0.0, kLargestRoad, 0.0) * std::cos(angle);
    if (bevel > std::abs(high) || bevel > across / 2.0) {
      reject(bevel_key, "expected at most the height and half of the length");
    }
    return road::cleat_profile(high, across, bevel);
  }

  std::unique_ptr<road::Road> read_plank() {
    const double angle = number("DIRECTION", Of::angle, -kMostOblique, kMostOblique, 0.0);
    const double half = length("LENGTH") / 2.0;
    return obstacle(
        bar("HEIGHT", "LENGTH", "BEVEL_EDGE_LENGTH", angle), place("START") + half, angle);
  }

  std::unique_ptr<road::Road> read_pothole() {
    const double end = length("LENGTH"), depth = height("DEPTH");
    return obstacle(Profile({{0.0, 0.0}, {0.0, -depth}, {end, -depth}, {end, 0.0}}),
                    place("START"));
  }

  std::unique_ptr<road::Road> read_ramp() {
    const double high = height("HEIGHT");
    const double slope = std::abs(number("SLOPE", Of::ratio, -1e6, 1e6));
    if (slope < 1e-9) reject("SLOPE", "expected a slope that is not zero");
    return obstacle(Profile({{0.0, 0.0}, {std::abs(high) / slope, high}}), place("START"));
  }

  std::unique_ptr<road::Road> read_roof() {
    const double end = length("LENGTH"), high = height("HEIGHT");
    return obstacle(Profile({{0.0, 0.0}, {end / 2.0, high}, {end, 0.0}}), place("START"));
  }

  std::unique_ptr<road::Road> read_wave(bool sweep) {
    road::WaveRoad::Settings settings;
    settings.start = place("START");
    settings.friction = friction("MU");
    settings.amplitude_begin = height(sweep ? "AMPLITUDE_AT_START" : "AMPLITUDE");
    settings.wave_length_begin = length(sweep ? "WAVE_LENGTH_AT_START" : "WAVE_LENGTH");
    settings.amplitude_end = settings.amplitude_begin;
    settings.wave_length_end = settings.wave_length_begin;
    if (sweep) {
      settings.end = place("END", settings.start);
      if (!(settings.end - settings.start >= kSmoothest))
        reject("END", "expected a place behind START");
      settings.amplitude_end = height("AMPLITUDE_AT_END");
      settings.wave_length_end = length("WAVE_LENGTH_AT_END");
      settings.exponential = number("SWEEP_TYPE", Of::ratio, 0.0, 1.0, 0.0) == 0.0;
    }
    return std::make_unique<road::WaveRoad>(settings);
  }

  const TeimOrbitTable& table(const char* block) {
    const TeimOrbitTable* found = parameters_->find_table(block);
    if (!found || found->rows.empty()) {
      throw InputError(parameters_->place(),
                       "has no rows of numbers in (" + std::string(block) + ")");
    }
    return *found;
  }

  /// Returns the rows of a table in SI (`units` has the SI value of each column's unit). The first
  /// column must rise.
  std::vector<std::vector<double>> rows(const char* block, const std::vector<double>& units) {
    std::vector<std::vector<double>> result;
    for (const TeimOrbitRow& row : table(block).rows) {
      std::vector<double> numbers = parameters_->numbers(row, units.size());
      for (std::size_t i = 0; i < units.size(); ++i) {
        numbers[i] *= units[i];
        if (!(std::abs(numbers[i]) <= kLargestRoad)) {
          throw InputError(parameters_->place(row.line), "has a number beyond 1e7 in SI units");
        }
      }
      if (!result.empty() && numbers[0] < result.back()[0]) {
        throw InputError(parameters_->place(row.line), "goes back, expected a rising first column");
      }
      result.push_back(std::move(numbers));
    }
    return result;
  }

  std::unique_ptr<road::Road> read_poly_line() {
    std::vector<Profile::Point> left, right;
    for (const auto& row : rows("XZ_DATA", {units_.length(), units_.length(), units_.length()})) {
      left.push_back({row[0], row[1]});
      right.push_back({row[0], row[2]});
    }
    result_.facts.push_back(fmt::format("{} points, left track where y > 0", left.size()));
    return std::make_unique<road::TwoTrackRoad>(
        Profile(std::move(left)), Profile(std::move(right)), friction("MU"));
  }

  road::Travel read_speed() {
    if (const TeimOrbitTable* table = parameters_->find_table("TV_DATA"); table && !find("V")) {
      std::vector<road::Travel::Point> points;
      for (const auto& row : rows("TV_DATA", {units_.time(), in_si(Of::speed)})) {
        if (!points.empty() && row[0] <= points.back().time) {
          throw InputError(parameters_->place(table->line), "has one time twice in (TV_DATA)");
        }
        points.push_back({row[0], row[1]});
      }
      return road::Travel(std::move(points));
    }
    const double speed = number("V", Of::speed, -1e4, 1e4, 0.0);
    const double time = number("ACCELERATION_TIME", Of::time, 0.0, 1e6, 0.0);
    if (time == 0.0) return road::Travel(speed);
    return road::Travel({{0.0, 0.0}, {time, speed}});
  }

  std::unique_ptr<road::Road> read_drum() {
    road::DrumRoad::Settings settings;
    const double diameter = number("DIAMETER", Of::length, -kLargestRoad, kLargestRoad);
    if (std::abs(diameter) < 1e-3) reject("DIAMETER", "expected the diameter of a drum");
    settings.diameter = std::abs(diameter);
    settings.inner = diameter > 0.0;
    settings.friction = friction("MU");
    settings.surface = read_speed();
    const int cleats = static_cast<int>(number("NUMBER_CLEATS", Of::ratio, 0.0, kMostCleats, 0.0));
    result_.facts.push_back(fmt::format("{} drum of {} m, {} cleats",
                                        settings.inner ? "inner" : "outer",
                                        format_number(settings.diameter, 6),
                                        cleats));
    if (cleats > 0) settings.cleats = road::equally_spaced(cleats, read_cleat(settings));
    if (const std::string fault = road::DrumRoad::fault(settings); !fault.empty())
      throw InputError(parameters_->place(), fault);
    return std::make_unique<road::DrumRoad>(settings);
  }

  road::DrumRoad::Cleat read_cleat(const road::DrumRoad::Settings& drum) {
    road::DrumRoad::Cleat cleat;
    cleat.angle = number("CLEAT_DIRECTION", Of::angle, -kMostOblique, kMostOblique, 0.0);
    cleat.starting_angle = number("CLEAT_STARTING_ANGLE", Of::angle, -1e3, 1e3, 0.0);
    cleat.friction = drum.friction * friction("MU_FACTOR_CLEAT");
    if (parameters_->find_table("XZR_DATA") && !find("CLEAT_HEIGHT")) {
      std::vector<Profile::Point> points;
      std::vector<double> radii;
      for (const auto& row :
           rows("XZR_DATA", {units_.length(), units_.length(), units_.length()})) {
        points.push_back({row[0], row[1]});
        radii.push_back(row[2]);
      }
      // The angle turns the bar about its middle.
      const double middle = (points.front().s + points.back().s) / 2.0;
      for (Profile::Point& point : points) point.s -= middle;
      cleat.profile = road::rounded_profile(points, radii);
    } else {
      cleat.profile = bar("CLEAT_HEIGHT", "CLEAT_LENGTH", "CLEAT_BEVEL_EDGE_LENGTH", 0.0);
    }
    for (const Profile::Point& point : cleat.profile.points()) {
      if (point.z < 0.0 || point.z > drum.diameter / 4.0 || std::abs(point.s) > drum.diameter) {
        throw InputError(parameters_->place(),
                         "has a cleat larger than its drum or below its surface");
      }
    }
    return cleat;
  }

  void read_triangles() {
    const TeimOrbitSection& nodes = file_.section("NODES");
    const TeimOrbitSection& elements = file_.section("ELEMENTS");
    if (lower(model_.text("HT_INTERPOLATION", "barycentric")) != "barycentric") {
      throw InputError(model_.place(model_.find("HT_INTERPOLATION")->line),
                       "HT_INTERPOLATION is " + in_quotes(model_.text("HT_INTERPOLATION")) +
                           R"(, expected "BARYCENTRIC")");
    }
    road::TriangleMesh mesh;
    std::map<long, int> index;
    read_nodes(nodes, mesh, index);
    read_elements(elements, index, mesh);
    result_.kind = "Adams triangles";
    take_surface(std::move(mesh));
  }

  void take_surface(road::TriangleMesh mesh) {
    result_.facts.push_back(
        fmt::format("{} nodes, {} triangles", mesh.nodes.size(), mesh.triangles.size()));
    auto surface = std::make_unique<road::TriangleRoad>(std::move(mesh));
    result_.facts.push_back(fmt::format("x {} m to {} m, y {} m to {} m",
                                        format_number(surface->low().x(), 6),
                                        format_number(surface->high().x(), 6),
                                        format_number(surface->low().y(), 6),
                                        format_number(surface->high().y(), 6)));
    result_.triangles = surface.get();
    result_.road = std::move(surface);
  }

  /// Returns the number of a node or element; some programs write it as a real number.
  long id(const TeimOrbitSection& section, const TeimOrbitRow& row, double number) const {
    if (number == std::floor(number) && std::abs(number) < 1e15) return static_cast<long>(number);
    throw InputError(section.place(row.line),
                     "has the number " + format_number(number) + ", expected an integer");
  }

  void read_nodes(const TeimOrbitSection& nodes,
                  road::TriangleMesh& mesh,
                  std::map<long, int>& index) {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    const Eigen::Vector3d offset = read_offset(turn);
    for (const TeimOrbitTable& table : nodes.tables()) {
      for (const TeimOrbitRow& row : table.rows) {
        const auto numbers = nodes.numbers(row, 4);
        const Eigen::Vector3d place =
            units_.length() * Eigen::Vector3d(numbers[1], numbers[2], numbers[3]);
        if (!(place.cwiseAbs().maxCoeff() <= kLargestRoad)) {
          throw InputError(nodes.place(row.line), "has a node further away than 1e7 m");
        }
        const long number = id(nodes, row, numbers[0]);
        if (!index.insert({number, static_cast<int>(mesh.nodes.size())}).second) {
          throw InputError(nodes.place(row.line), fmt::format("node {} comes twice", number));
        }
        mesh.nodes.push_back(turn * place + offset);
      }
    }
    expect_count(nodes, "NUMBER_OF_NODES", mesh.nodes.size());
  }

  void read_elements(const TeimOrbitSection& elements,
                     const std::map<long, int>& index,
                     road::TriangleMesh& mesh) {
    bool level = false;
    for (const TeimOrbitTable& table : elements.tables()) {
      for (const TeimOrbitRow& row : table.rows) {
        const auto numbers = elements.numbers(row, 3);
        road::TriangleMesh::Triangle triangle;
        for (int i = 0; i < 3; ++i) {
          const long number = id(elements, row, numbers[i]);
          const auto node = index.find(number);
          if (node == index.end()) {
            throw InputError(elements.place(row.line),
                             fmt::format("names node {}, which [NODES] does not have", number));
          }
          triangle.nodes[i] = node->second;
        }
        triangle.friction = numbers.size() > 3 ? numbers[3] : 1.0;
        if (numbers.size() > 4 && numbers[4] != numbers[3] && !friction_across_)
          friction_across_ = TeimOrbitPart{"[ELEMENTS] mu_y", row.line};
        if (!(triangle.friction >= 0.0 && triangle.friction <= 100.0)) {
          throw InputError(elements.place(row.line), "has a friction below 0 or above 100");
        }
        mesh.triangles.push_back(triangle);
        level = level || road::TriangleRoad::has_area(mesh, triangle);
      }
    }
    expect_count(elements, "NUMBER_OF_ELEMENTS", mesh.triangles.size());
    if (!level) throw InputError(elements.place(), "has no triangle that is seen from above");
  }

  void expect_count(const TeimOrbitSection& section, const char* key, std::size_t found) const {
    const TeimOrbitEntry* entry = section.find(key);
    if (!entry || section.number(*entry) == static_cast<double>(found)) return;
    throw InputError(section.place(entry->line),
                     fmt::format("{} is {}, but {} follow", key, entry->value, found));
  }

  /// Reads the section [OFFSET] or [REFSYS].
  Eigen::Vector3d read_offset(Eigen::Matrix3d& turn) const {
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    if (const TeimOrbitSection* section = file_.find("OFFSET")) {
      offset = {section->number("X", 0.0), section->number("Y", 0.0), section->number("Z", 0.0)};
    }
    if (const TeimOrbitSection* section = file_.find("REFSYS")) {
      if (const TeimOrbitEntry* entry = section->find("OFFSET")) offset = three(*section, *entry);
      double angle = section->number("ROTATION_ANGLE_XY_PLANE", 0.0);
      if (angle != 0.0) angle *= units_.angle();
      if (!(std::abs(angle) < 1e3)) throw InputError(section->place(), "is turned too far");
      turn.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle),
          std::cos(angle);
    }
    offset *= units_.length();
    if (!(offset.cwiseAbs().maxCoeff() <= kLargestRoad)) {
      throw InputError(model_.place(), "has an offset beyond 1e7 m");
    }
    return offset;
  }

  Eigen::Vector3d three(const TeimOrbitSection& section, const TeimOrbitEntry& entry) const {
    Eigen::Vector3d result;
    std::string_view rest = entry.value;
    for (int i = 0; i < 3; ++i) {
      rest = rest.substr(std::min(rest.find_first_not_of(" \t,"), rest.size()));
      const std::size_t end = std::min(rest.find_first_of(" \t,"), rest.size());
      const auto number = parse_number(rest.substr(0, end));
      if (!number || !std::isfinite(*number)) {
        throw InputError(section.place(entry.line),
                         entry.key + " is " + in_quotes(entry.value) + ", expected three numbers");
      }
      result[i] = *number;
      rest = rest.substr(end);
    }
    return result;
  }

  const TeimOrbit& file_;
  TeimOrbitUnits units_;
  const TeimOrbitSection& model_;
  const TeimOrbitSection* parameters_;
  // the first triangle whose coefficient mu_y differs from mu_x
  std::optional<TeimOrbitPart> friction_across_;
  RoadFile result_;
};

}  // namespace

RoadFile read_rdf(const TeimOrbit& file) { return RdfReading(file).run(); }

}  // namespace latsch::formats
