// SPDX-License-Identifier: Apache-2.0
#include "correlation/campaign/campaign_files.h"

#include <fmt/format.h>

#include <fstream>
#include <ostream>
#include <string>
#include <string_view>
#include <system_error>

#include "base/file.h"
#include "base/text.h"
#include "base/units.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

// The first words of every file of a test, by which files of an earlier design are known.
constexpr const char* kOfDesign = "# A test chosen by latsch design";
constexpr int kSettingDigits = 12;

/// True if an earlier design wrote the file. It does not use read_text_file(), after which the file
/// could not be replaced.
bool is_of_design(const fs::path& file) {
  std::ifstream in(file);
  std::string words(std::string_view(kOfDesign).size(), ' ');
  in.read(words.data(), std::ssize(words));
  return file.extension() == ".toml" && words == kOfDesign;
}

}  // namespace

fs::path campaign_table_file(const Study& study) {
  return fs::path(study.file).replace_extension(".design.csv");
}

fs::path campaign_folder(const Study& study) {
  return fs::path(study.file).replace_extension(".design");
}

std::string campaign_test_file(const Campaign& campaign, std::size_t test) {
  const int first = campaign.tests[test].replicate_of;
  return fmt::format("test_{:02}.toml", first < 0 ? test + 1 : static_cast<std::size_t>(first) + 1);
}

void write_campaign_table(const Study& study, const Campaign& campaign, const fs::path& file) {
  const auto& settings = study.campaign->settings;
  write_file(file, [&](std::ostream& out) {
    out << "test,rank,file";
    for (const CampaignSetting& setting : settings)
      out << "," << setting.name << (setting.unit == "1" ? "" : " [" + setting.unit + "]");
    out << "\n";
    for (std::size_t k = 0; k < campaign.tests.size(); ++k) {
      out << fmt::format(
          "{},{},{}", k + 1, campaign.tests[k].rank, campaign_test_file(campaign, k));
      for (std::size_t i = 0; i < settings.size(); ++i)
        out << ","
            << format_number(Unit::of(settings[i].unit).from_si(campaign.tests[k].values[i]),
                             kSettingDigits);
      out << "\n";
    }
  });
}

void write_campaign_tests(const Study& study, const Campaign& campaign, const fs::path& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault)
    throw InputError("the folder " + folder.string() + " cannot be made (" + fault.message() +
                     "); name another one with -o");
  for (std::size_t k = 0; k < campaign.tests.size(); ++k)
    if (const fs::path file = folder / campaign_test_file(campaign, k);
        fs::exists(file) && !is_of_design(file))
      throw InputError(in_quotes(file.string()) +
                       " was not written by latsch design and would be replaced; move it, or name "
                       "another folder with -o");
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && is_of_design(entry.path())) fs::remove(entry.path());
  for (std::size_t k = 0; k < campaign.tests.size(); ++k) {
    if (campaign.tests[k].replicate_of >= 0) continue;
    experiment::MovableTest moved = *study.campaign->movable;
    for (std::size_t i = 0; i < study.campaign->settings.size(); ++i)
      moved.set(study.campaign->settings[i].path, campaign.tests[k].values[i]);
    write_file(folder / campaign_test_file(campaign, k), [&](std::ostream& out) {
      out << kOfDesign << " for " << study.file.filename().string() << ": number " << k + 1
          << " of " << campaign.tests.size() << "\n"
          << moved.text(folder);
    });
  }
}

}  // namespace latsch::correlation
