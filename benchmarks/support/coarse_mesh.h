// SPDX-License-Identifier: Apache-2.0
// A finite-element tire on a coarse mesh, for benchmarks that need a cheap trial rather than an
// accurate one.
#pragma once

#include <string>

namespace latsch::benchmarks {

/// Numbers of elements, from bead to bead and around the tire. All elements are equally long and
/// wide.
struct CoarseMesh {
  int meridional = 13, sectors = 24;
};

/// Returns the text of a tire file with this mesh instead of its own columns, spacing and sector
/// zones. The rows of elements through the wall, plies and rubbers stay. Throws InputError if the
/// resulting file does not have that mesh.
std::string with_coarse_mesh(const std::string& tire, const CoarseMesh& mesh = {});

}  // namespace latsch::benchmarks
