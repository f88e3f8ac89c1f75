// SPDX-License-Identifier: Apache-2.0
#include "cli/run/written_tydex.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "cli/console/console.h"
#include "cli/console/version.h"
#include "cli/run/export_date.h"
#include "formats/text/letter_case.h"

namespace latsch::cli {

bool is_tydex(const std::string& file) {
  const std::string ending = formats::lower(std::filesystem::path(file).extension().string());
  return ending == ".tdx" || ending == ".tydex" || ending == ".tda" || ending == ".tdb";
}

formats::WrittenTydex write_tydex(formats::TydexRecord record,
                                  formats::TydexDigits digits,
                                  const std::string& file) {
  record.supplier = "Latsch " + version_number();
  record.date = export_date(calendar_of_system());
  formats::WrittenTydex written = formats::tydex_text(record, digits);
  write_text_file(file, written.text);
  say_written(file);
  return written;
}

void say_remarks(const formats::WrittenTydex& written, const std::string& more_digits) {
  const auto remarks = formats::remarks_on(written, more_digits);
  for (const std::string& remark : remarks) say("  {}\n", remark);
  Json names = Json::object();
  for (const auto& name : written.names) names[name.channel] = name.tydex;
  answer()["tydex"] = {{"names", names},
                       {"axes", written.axes},
                       {"rounding", written.rounding},
                       {"remarks", remarks}};
}

}  // namespace latsch::cli
