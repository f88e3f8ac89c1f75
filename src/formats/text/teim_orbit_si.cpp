// SPDX-License-Identifier: Apache-2.0
#include "formats/text/teim_orbit_si.h"

#include <fmt/format.h>

#include "formats/text/document_si.h"
#include "formats/text/teim_orbit.h"

namespace latsch::formats {

std::string with_si_units(const std::string& text, const std::string& file_name) {
  const TeimOrbit file = TeimOrbit::parse(text, file_name);
  const TeimOrbitSection* section = file.find("UNITS");
  if (section == nullptr) return text;
  const TeimOrbitUnits units = file.units(TeimOrbitUnits::Missing::is_si);
  struct Scale {
    const char* key;
    double si;
    const char* unit;
  };
  const Scale scales[] = {{"LENGTH", units.length(), "m"},
                          {"FORCE", units.force(), "N"},
                          {"ANGLE", units.angle(), "rad"},
                          {"MASS", units.mass(), "kg"},
                          {"TIME", units.time(), "s"},
                          {"PRESSURE", units.pressure(), "Pa"}};
  std::string result;
  std::size_t copied = 0;
  for (const TeimOrbitEntry& entry : section->entries())  // in the order of the file
    for (const Scale& scale : scales) {
      if (entry.key != scale.key) continue;
      result.append(text, copied, entry.begin - copied);
      result += fmt::format("'{} {}'", digits_of(scale.si), scale.unit);
      copied = entry.end;
    }
  return result.append(text, copied);
}

}  // namespace latsch::formats
