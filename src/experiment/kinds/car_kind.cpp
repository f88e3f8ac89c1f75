// SPDX-License-Identifier: Apache-2.0
// A car as a kind of specimen: its file names those of its suspensions and tires, which become
// tables of its numbers, "front_suspension.bushing.ubj.y", "front_tire.sidewall.radial.stiffness".
// A file that contains them as tables already, as latsch writes it, is read unchanged.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "base/document_parts.h"
#include "base/text.h"
#include "experiment/kinds/car_doubts.h"
#include "experiment/kinds/hardpoint_doubts.h"
#include "experiment/kinds/pictures/films_of_tests.h"
#include "experiment/kinds/pictures/suspension_scene.h"
#include "experiment/kinds/specimen_kinds.h"
#include "experiment/kinds/tir_numbers.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/language/specimen.h"
#include "experiment/language/specimen_models.h"
#include "formats/text/letter_case.h"
#include "models/car/car_reader.h"
#include "models/car/rolling_car.h"
#include "models/suspension/suspension_reader.h"
#include "report/report.h"

namespace latsch::experiment {

namespace {

using car::is_elements;
using car::kAxles;
using car::tire_key;

/// Returns the kind of rolling tire of this name (car::tire_kind_name).
const SpecimenKind& named_kind(const std::string& name) {
  for (const SpecimenKind* kind : {&ring_tire_kind(), &rigid_ring_kind(), &magic_formula_kind()})
    if (kind->name() == name) return *kind;
  return fe_tire_kind();
}

const SpecimenKind& tire_kind(const Node& car, const Document& tire, const std::string& part) {
  return named_kind(car::tire_kind_name(car, tire, part));
}

/// Reads the file of a tire of any kind that a car's file names.
Document read_named_tire(const Node& car,
                         const std::string& part,
                         const std::filesystem::path& of) {
  const std::string ending = formats::lower(of.extension().string());
  if (ending == ".tir") return read_tir_numbers(of);
  const char* const expected =
      "which does not roll in a car: expected the file of a flexible ring, of a rigid ring or of a "
      "finite-element tire, or a .tir";
  if (ending == ".inp") car.reject(part, "is " + of.string() + ", a deck, " + expected);
  Document tire = Document::read(of);
  if (!tire.root().has("kind") && !is_elements(tire))
    car.reject(part,
               "is " + of.string() +
                   ", which states neither a kind nor the section of a finite-element tire, " +
                   expected);
  return tire;
}

class CarSpecimen : public Specimen, public Drives, public HasAxles, public KnowsLimits {
 public:
  explicit CarSpecimen(const Document& numbers)
      : numbers_(numbers),
        car_(numbers,
             [this](const std::string& kind,
                    const Document& tire,
                    const std::string& key,
                    bool is_own) { return add_tire(named_kind(kind).build(tire), key, is_own); }) {}

  void check_tires() const { car_.check_tires(); }
  std::vector<std::string> limits_met() const override { return car_.limits_met(); }
  Result<std::unique_ptr<car::Car>> car(const car::CarInputs& at_rest) const override {
    return car_.car(at_rest);
  }

  /// Returns no limits, because no car rolls over a single cleat.
  std::vector<std::string> limits_on(const Cleat&) const override { return {}; }
  std::vector<std::string> limits_across() const override { return limits_across_; }
  /// Returns the least section height of the tires, m.
  std::optional<double> section_height() const override { return section_; }
  /// Returns the smallest value of the tires; 0 if any tire is a spring, which touches the road
  /// along one line.
  double felt_half_width() const override {
    return rolling_ < car::kCorners ? 0.0 : felt_.value_or(0.0);
  }
  /// Returns the largest value of the tires.
  std::optional<double> tread_half_width() const override { return tread_; }

  Result<Channels> load(const AxleKcTest& test, const Asked& asked) const override {
    const auto car = on_rig(test);
    if (!car) return car.failure();
    KcSlopes slopes{{}, asked.channels};
    for (const std::string& path : asked.paths) slopes.varied.push_back(of_axle(*car, test, path));
    return run(*car, test, slopes);
  }
  Result<Channels> watch(const AxleKcTest& test, const RigWatcher& watcher) const override {
    const auto car = on_rig(test);
    return car ? run(*car, test, {}, watcher) : car.failure();
  }
  Result<Channels> compliance(const AxleKcTest& test) const override {
    const auto car = on_rig(test);
    return car ? axle_compliance(*car, test) : car.failure();
  }

 private:
  /// Takes a tire into account and returns it as a model that rolls.
  RollingModel add_tire(std::shared_ptr<Specimen> specimen, const std::string& key, bool is_own) {
    ++rolling_;
    const auto* knows = specimen->find<KnowsLimits>();
    if (knows) {
      if (const auto height = knows->section_height())
        section_ = std::min(section_.value_or(*height), *height);
      felt_ = std::min(felt_.value_or(knows->felt_half_width()), knows->felt_half_width());
      if (const auto half = knows->tread_half_width())
        tread_ = std::max(tread_.value_or(*half), *half);
      if (is_own)
        for (const std::string& limit : knows->limits_across())
          limits_across_.push_back(key + ": " + limit);
    }
    RollingModel model = rolling_model(specimen);
    if (const auto felt = model.rolls->felt()) {
      section_ = std::min(section_.value_or(felt->section), felt->section);
      felt_ = std::min(felt_.value_or(felt->half_width), felt->half_width);
      tread_ = std::max(tread_.value_or(felt->half_width), felt->half_width);
    }
    return model;
  }
  /// Returns the mechanism of the car on the rig. Its springs have the preloads that carry the
  /// weight if pads are below the wheels; without pads the rig needs no preloads.
  Result<car::CarMechanism> on_rig(const AxleKcTest& test) const {
    if (!test.travel) return car::build(car_.file().parameters);
    const auto stands = car({});
    if (!stands) return stands.failure();
    return car::CarMechanism{(*stands)->mechanism(), (*stands)->parts()};
  }
  /// Returns the stiffnesses in the axle on the rig that a parameter changes: joints of both sides,
  /// none of the other axle.
  Stiffnesses of_axle(const car::CarMechanism& car,
                      const AxleKcTest& test,
                      const std::string& path) const {
    const std::string suspension = std::string(kAxles[test.front ? 0 : 1]) + "_suspension";
    if (!path.starts_with(suspension + ".")) return {};
    const car::Axle& axle = test.front ? car_.file().parameters.front : car_.file().parameters.rear;
    Stiffnesses found;
    for (const auto& [joint, axis] : suspension::stiffnesses_at(part_of(numbers_, suspension),
                                                                path.substr(suspension.size() + 1),
                                                                axle.corner.joints()))
      for (std::size_t side = 0; side < 2; ++side)
        found.emplace_back(
            car.parts.corners[(test.front ? car::kFL : car::kRL) + side].first_joint + joint, axis);
    return found;
  }

  Document numbers_;
  std::vector<std::string> limits_across_;
  std::optional<double> section_, felt_, tread_;  // m; felt_ and tread_ are half widths
  int rolling_ = 0;                               // tires that are no springs
  car::RollingCar car_;  // adds its tires to the members above, so it is the last one
};

/// Returns a sentence if tires of the car are flexible rings whose belts have no weight, as on a
/// rig that is tared: the car then stands with less than its weight.
std::string weightless_belts_in_words(const Document& car) {
  double mass = 0.0;
  for (std::size_t axle = 0; axle < 2; ++axle)
    for (std::size_t side = 0; side < 2; ++side) {
      const auto tire = car.root().find_table(tire_key(axle, side));
      const auto belt = tire ? tire->find_table("belt") : std::nullopt;
      if (!belt || !belt->has("mass")) continue;
      if (belt->quantity("gravity", "m/s^2", Range::not_negative(), 0.0) == 0.0)
        mass += belt->quantity("mass", "kg", Range::positive());
    }
  if (!(mass > 0.0)) return "";
  return fmt::format(
      "belt.gravity of its tires is 0, so the car stands without the weight of their belts, "
      "{:.3g} kg in all; belt.gravity = \"9.81 m/s^2\" adds it",
      mass);
}

class CarKind : public SpecimenKind {
 public:
  std::string name() const override { return "car"; }
  std::string in_words() const override { return "car"; }
  std::string file() const override { return "a TOML file with kind = \"car\""; }
  int version() const override { return 3; }
  std::vector<std::string> abilities() const override { return abilities_of<CarSpecimen>(); }

  bool recognizes(const std::filesystem::path&) const override { return false; }
  Document read(const std::filesystem::path& file) const override {
    const Document written = Document::read(file);
    Document document = written;
    for (std::size_t axle = 0; axle < 2; ++axle) {
      const std::string suspension = std::string(kAxles[axle]) + "_suspension";
      if (!has_part(written, suspension))
        document = with_part(
            document, suspension, suspension_kind().read(named_file(file, written, suspension)));
      for (std::size_t side = 0; side < 2; ++side) {
        const std::string tire = tire_key(axle, side);
        if (!written.root().has(tire) || has_part(written, tire)) continue;
        const std::filesystem::path named = named_file(file, written, tire);
        const Document of = read_named_tire(written.root(), tire, named);
        document = with_part(document, tire, tire_kind(written.root(), of, tire).read(named));
      }
    }
    (void)CarSpecimen{document};  // throws for a wrong file
    return document;
  }
  std::vector<Part> parts(const std::filesystem::path& file) const override {
    const Document written = Document::read(file);
    std::vector<Part> parts;
    for (std::size_t axle = 0; axle < 2; ++axle) {
      const std::string suspension = std::string(kAxles[axle]) + "_suspension";
      if (written.root().has(suspension) && !has_part(written, suspension))
        parts.push_back({suspension, &suspension_kind(), named_file(file, written, suspension)});
      for (std::size_t side = 0; side < 2; ++side) {
        const std::string tire = tire_key(axle, side);
        if (!written.root().has(tire) || has_part(written, tire)) continue;
        const std::filesystem::path named = named_file(file, written, tire);
        const Document of = read_named_tire(written.root(), tire, named);
        parts.push_back({tire, &tire_kind(written.root(), of, tire), named});
      }
    }
    return parts;
  }
  void check(const Document& numbers) const override { CarSpecimen(numbers).check_tires(); }
  bool has_usual_numbers() const override { return true; }
  /// Returns notes about the suspensions and tires of the car, whether they are files of their own
  /// or tables in the car's file.
  std::vector<std::string> notes(const std::filesystem::path& file) const override {
    std::vector<std::string> notes;
    std::set<std::filesystem::path> told;
    for (const Part& part : parts(file)) {
      if (!told.insert(part.file).second) continue;
      for (std::string& note : part.kind->notes(part.file)) notes.push_back(std::move(note));
    }
    const Document written = Document::read(file), whole = read(file);
    for (const std::string& doubt : doubts_about_car(written, whole))
      notes.push_back(file.string() + ": " + doubt);
    if (std::string note = weightless_belts_in_words(whole); !note.empty())
      notes.push_back(file.string() + ": " + note);
    for (const char* axle : kAxles) {
      const std::string suspension = std::string(axle) + "_suspension";
      if (!has_part(written, suspension)) continue;
      const Document part = part_of(written, suspension);
      for (const std::string& doubt : doubts_about_hardpoints(part.root()))
        notes.push_back(fmt::format("{}: {}: {}", file.string(), suspension, doubt));
    }
    return notes;
  }
  std::string describe(const Document& numbers) const override {
    std::string words = SpecimenKind::describe(numbers);
    for (std::size_t axle = 0; axle < 2; ++axle) {
      const Node root = numbers.root();
      if (!root.has(tire_key(axle, 0))) continue;
      words += fmt::format("; {} tires: ", kAxles[axle]);
      const Document left = part_of(numbers, tire_key(axle, 0));
      words += side_in_words(left);
      if (root.has(tire_key(axle, 1))) {
        const Document right = part_of(numbers, tire_key(axle, 1));
        words += fmt::format(", right one from a file of its own, {}{}",
                             side_in_words(right),
                             car::side_of(right) == TireSide::left ? ", mirrored" : "");
      } else {
        words += car::side_of(left) == TireSide::left ? ", mirrored on the right"
                                                      : ", mirrored on the left";
      }
    }
    return words;
  }
  std::unique_ptr<Specimen> build(const Document& numbers,
                                  std::unique_ptr<Specimen>) const override {
    return std::make_unique<CarSpecimen>(numbers);
  }
  bool knows_slopes_in(const std::string& path) const override {
    for (const char* axle : kAxles)
      if (const std::string part = std::string(axle) + "_suspension."; path.starts_with(part))
        return suspension::is_stiffness(path.substr(part.size()));
    return false;
  }
  bool has_body() const override { return true; }
  void draw_body(const Document& numbers,
                 const std::vector<const Test*>& tests,
                 report::StudyReport& page) const override {
    std::vector<suspension::CornerGeometry> axles;
    for (const char* axle : kAxles)
      axles.push_back(
          suspension::read_corner(part_of(numbers, std::string(axle) + "_suspension").root())
              .geometry);
    page.scene = suspension_scene(axles);
    CarSpecimen specimen(numbers);
    add_films(tests, specimen, *page.scene);
  }

 private:
  static std::filesystem::path named_file(const std::filesystem::path& car,
                                          const Document& written,
                                          const std::string& part) {
    const std::filesystem::path named = car.parent_path() / written.root().text(part);
    if (!std::filesystem::is_regular_file(named))
      written.root().reject(part, "is not a file: there is no " + named.string());
    return named;
  }
};

}  // namespace

const SpecimenKind& car_kind() {
  static const CarKind kind;
  return kind;
}

}  // namespace latsch::experiment
