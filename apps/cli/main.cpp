// SPDX-License-Identifier: Apache-2.0
// latsch: the command line. See `latsch --help`.
#include "cli/run_cli.h"

int main(int argc, char** argv) {
  return latsch::cli::run_cli(argc, argv, latsch::experiment::language());
}
