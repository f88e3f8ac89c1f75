// SPDX-License-Identifier: Apache-2.0
// The limit of a pressed tire, of which few finer meshes can be afforded.
//
// Elements err on the ground much as they do off it. So the pressed tire is extrapolated from few
// meshes, and what the same meshes of the unloaded one miss of its limit, which many show, is added
// by the name of the mode. Orders need not be known: rows of a smeared section go to the far side
// of the limit, and come back slowly. The vertical force has no such name. It gets the part of what
// the section's refinement changes that modes have left, by least squares. How far sectors are off
// is the pressed tire's own: they are narrow at the contact alone.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiment/rigs/fe_tire/discretization.h"

namespace latsch {

/// A limit as few meshes have it.
struct RoughLimit {
  double value = 0.0;
  double section = 0.0;  // what the section's refinement changed of it
  double around = 0.0;   // what halved sectors alone changed
  double unsure = 0.0;   // by its own extrapolation, beside that
};

/// Which meshes, and what is made of a quantity's values on them.
struct FewMeshes {
  std::vector<fe_tire::Refinement> refinements;  // the first is the mesh itself
  RoughLimit (*extrapolate)(const std::vector<double>& values);
};

/// The mesh, its sectors halved, everything halved. Sectors err by second order, so a third of what
/// halving them changed is left.
const FewMeshes& few_meshes();

/// Also columns halved with the sectors, and both halved twice, these extrapolated together, in
/// some four times the time. Rows are halved once. (Patches would end anywhere in the few sectors
/// of meshes refined 1, 2, 3 times.)
const FewMeshes& thorough_meshes();

/// Of meshes as `thorough_meshes` has them those of `few_meshes`.
std::vector<MeshQuantities> few_of_thorough(const std::vector<MeshQuantities>& meshes);

/// What few meshes of the unloaded tire miss of its limit, relative.
class Missed {
 public:
  /// `limits` are rows of many meshes, `few` those of the few, of which the values alone count.
  Missed(const std::vector<DiscretizationRow>& limits,
         const std::vector<DiscretizationRow>& few,
         const FewMeshes& meshes);

  /// The limit of a row of the pressed tire on the same meshes, and how far it may be off: by as
  /// much as the unloaded one, as the extrapolation itself, and by half of what halved sectors
  /// change and of how unlike both tires change.
  void extrapolate(DiscretizationRow& row) const;

 private:
  struct Of {
    double missed = 0.0, section = 0.0, around = 0.0, uncertainty = 0.0;
  };
  FewMeshes meshes_;
  std::map<std::string, Of> of_;  // by label
  double part_ = 0.0;             // missed, of what the section changed
  Of all_;  // roots of mean squares; `missed`: of what that part does not show
};

}  // namespace latsch
