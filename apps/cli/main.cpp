// SPDX-License-Identifier: Apache-2.0
// The program latsch. `latsch --help` describes its command line.
#include "cli/run_cli.h"

int main(int argc, char** argv) {
  return latsch::cli::run_cli(argc, argv, latsch::experiment::language());
}
