// SPDX-License-Identifier: Apache-2.0
#include "exchange/unit/unit_reading.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "base/utf8.h"
#include "exchange/unit/car_unit.h"
#include "exchange/unit/tire_unit.h"
#include "formats/road/road_file.h"
#include "models/road/plane_road.h"

namespace latsch::exchange {

namespace fs = std::filesystem;

std::shared_ptr<const road::Road> road_of_unit(const fs::path& file) {
  if (file.empty()) return std::make_shared<road::PlaneRoad>(road::PlaneRoad::Settings{});
  return formats::read_road_file(file).road;
}

namespace {

/// Returns the file that a key names. Throws InputError if it is not in the unit's folder, because
/// a package has to be complete.
fs::path file_inside(const fs::path& folder, const Node& keys, const char* key) {
  const fs::path name = path_of_utf8(keys.text(key)).lexically_normal();
  if (name.empty() || name.has_root_path() || *name.begin() == "..")
    keys.reject(key,
                "is " + in_quotes(keys.text(key)) + ", expected a file in the folder of unit.toml");
  return folder / name;
}

/// Throws InputError for a format that the library does not read.
void check_format(const Node& root, const std::string& file, const UnitModels& models) {
  const long format = root.integer("format", 1, 1'000'000, 1);
  if (format > kUnitFormat)
    root.reject("format",
                fmt::format("is {}, expected at most {}: this library is older than the package",
                            format,
                            kUnitFormat));
  if (format < 2 && !models.reads_any_units())
    throw InputError({file, 0},
                     "is a unit of format 1, which an older version of latsch wrote: expected "
                     "format 2; export the model again");
}

/// Reads the tire of the table [tire].
TireFromFolder tire_of(const fs::path& folder, const Node& keys, const UnitModels& models) {
  const fs::path model = file_inside(folder, keys, "model");
  const std::string kind = keys.choice("model_kind", models.tire_kinds());
  return {models.tire(kind, model), kind};
}

}  // namespace

TireFromFolder read_tire_of_unit(const fs::path& folder, const UnitModels& models) {
  const Document document = Document::read(folder / kUnitFile);
  const Node root = document.root();
  root.choice("kind", {"tire"});
  check_format(root, document.file(), models);
  return tire_of(folder, root.table("tire"), models);
}

UnitFromFolder read_unit(const fs::path& folder, const UnitModels& models) {
  const Document document = Document::read(folder / kUnitFile);
  const Node root = document.root();
  const std::string name = root.choice("kind", {"tire", "car"});
  check_format(root, document.file(), models);
  UnitFromFolder result;
  result.token = root.text("token");
  const Node keys = root.table(name);
  if (name == "tire") {
    RollingModel tire = tire_of(folder, keys, models).tire;
    result.unit = std::make_unique<TireUnit>(std::move(tire),
                                             road_of_unit(file_inside(folder, keys, "road")));
  } else {
    const fs::path model = file_inside(folder, keys, "model");
    keys.choice("model_kind", {"car"});
    DrivingModel car = models.car(model);
    result.unit =
        std::make_unique<CarUnit>(std::move(car), road_of_unit(file_inside(folder, keys, "road")));
  }
  root.close();
  return result;
}

}  // namespace latsch::exchange
