// SPDX-License-Identifier: Apache-2.0
// A program of somebody who has added a model: the same program with another language.
#include "correlation/study/spring_testing.h"

#include "cli/run_cli.h"

int main(int argc, char** argv) {
  return latsch::cli::run_cli(argc, argv, latsch::experiment::spring_language());
}
