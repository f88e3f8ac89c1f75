// SPDX-License-Identifier: Apache-2.0
// The studies that `latsch new --suspension` and `--car` write.
//
//   suspension  sixteen numbers of a K&C rig and the bushings that cause them: studies/compliance,
//               built into the program
//   car         a car on four posts, whose springs and dampers are found from the forces of its
//               push-rods in a sweep: car and suspensions of studies/four_post and studies/kerb.
//               The recording is an example, of that car with springs and dampers different from
//               the study's start, with the scatter of load cells; and a kerb to drive over.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiment/language.h"

namespace latsch::cli {

struct WrittenFile {
  std::string name, text;
};

/// Contained in the program.
std::string_view published_corner();
std::string_view published_compliance_study();
std::string_view published_four_post_car();
std::string_view published_front_suspension();
std::string_view published_rear_suspension();

/// Writes corner.toml, study.toml.
std::vector<WrittenFile> suspension_study_files();
/// Writes car.toml, front.toml, rear.toml, kerb.toml, study.toml.
std::vector<WrittenFile> car_study_files();
/// Returns the sweep.csv of the study, recorded from the car in `car_file`.
std::string example_sweep(const std::string& car_file, const experiment::Language& language);

}  // namespace latsch::cli
