// SPDX-License-Identifier: Apache-2.0
#include "cli/run/virtual_recordings.h"

#include <fmt/format.h>

#include <ctime>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "cli/console/console.h"
#include "correlation/laboratory/virtual_recording.h"
#include "evaluation/executors/launch.h"

namespace latsch::cli {
namespace {

double processor_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void make_recording(const correlation::VirtualRecording& one, const std::filesystem::path& study) {
  const double begin = processor_seconds();
  const auto limits = correlation::record(one);
  if (!limits)
    throw InputError({study.string(), 0},
                     fmt::format("{}, the {}, gives no recording: {}",
                                 one.name,
                                 one.in_words(),
                                 limits.failure().reason));
  for (const std::string& limit : *limits)
    warn(fmt::format("{}: {}", one.name, limit), {study.string(), 0});
  say("  wrote {}, {:.1f} s of processor time\n", one.file.string(), processor_seconds() - begin);
  answer()["recorded"].push_back(one.file.string());
}

}  // namespace

bool begin_recording(const std::filesystem::path& file,
                     const std::string& in_words,
                     const std::string& why) {
  if (why.empty()) {
    say("Recorded already: {} ({})\n", in_words, file.string());
    return false;
  }
  say("Recording {}, because {}\n", in_words, why);
  if (why == correlation::kEdited) {
    const std::filesystem::path beside = file.string() + ".changed";
    move_file(file, beside);
    say("  the changed values stay as {}\n", beside.string());
  }
  return true;
}

void make_recordings(const std::filesystem::path& study, const experiment::Language& language) {
  for (const correlation::VirtualRecording& one :
       correlation::virtual_recordings(study, language)) {
    const std::string why = correlation::why_to_record(one.file, one.recipe);
    if (!why.empty() && launch().tasks > 1)
      throw InputError({study.string(), 0},
                       fmt::format("{} is virtual, and {}: one process records it before others "
                                   "share the trials; expected: latsch run {} --record",
                                   one.name,
                                   why,
                                   study.string()));
    if (begin_recording(one.file, fmt::format("{}, the {}", one.name, one.in_words()), why))
      make_recording(one, study);
  }
}

}  // namespace latsch::cli
