// SPDX-License-Identifier: Apache-2.0
// The functions of toml++ that the program's objects call, compiled from its header.
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
