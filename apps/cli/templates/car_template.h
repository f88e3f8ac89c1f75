// SPDX-License-Identifier: Apache-2.0
// The studies that `latsch new --suspension` and `latsch new --car` write.
//
//   suspension  identifies the bushings of a suspension from sixteen numbers of a K&C rig:
//               studies/compliance, contained in the program
//   car         identifies the springs and dampers of a car on four posts from the forces of its
//               push-rods in a sweep. Car and suspensions are those of studies/four_post and
//               studies/kerb. The recording is an example: it was computed from the car with other
//               springs and dampers than the study's start, with the scatter of load cells. A kerb
//               to drive over is included.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiment/language.h"

namespace latsch::cli {

struct WrittenFile {
  std::string name, text;
};

/// Return texts that the program contains: files of studies/compliance, studies/four_post and
/// studies/kerb.
std::string_view published_corner();
std::string_view published_compliance_study();
std::string_view published_four_post_car();
std::string_view published_front_suspension();
std::string_view published_rear_suspension();

/// Returns the files corner.toml and study.toml.
std::vector<WrittenFile> suspension_study_files();
/// Returns the files car.toml, front.toml, rear.toml, kerb.toml and study.toml.
std::vector<WrittenFile> car_study_files();
/// Returns the text of the study's sweep.csv, an example recording computed from the car in
/// `car_file`.
std::string example_sweep(const std::string& car_file, const experiment::Language& language);

}  // namespace latsch::cli
