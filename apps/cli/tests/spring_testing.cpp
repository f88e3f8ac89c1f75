// SPDX-License-Identifier: Apache-2.0
// A program that has only a model of the user's own, a spring: the program latsch with another set
// of models and tests.
#include "correlation/study/spring_testing.h"

#include "cli/run_cli.h"

int main(int argc, char** argv) {
  return latsch::cli::run_cli(argc, argv, latsch::experiment::spring_language());
}
