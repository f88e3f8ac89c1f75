// SPDX-License-Identifier: Apache-2.0
// Estimates the limit of the results of a pressed tire, for which only few finer meshes are
// affordable.
//
// Elements have similar errors on and off the ground. Therefore the pressed tire is extrapolated
// from few meshes, and the error of the same extrapolation for the unloaded tire, whose limit is
// known from many meshes, is added mode by mode according to the mode's name. Orders of convergence
// need not be known: with refinement the rows of a smeared section pass the limit and come back
// slowly. The vertical force has no unloaded counterpart. Its correction is a share of its change
// by refining the section; the share is a least-squares fit to the modes. The error of sectors is
// computed from the pressed tire itself, because its sectors are narrow only at the contact.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiment/rigs/fe_tire/discretization.h"

namespace latsch {

/// A limit for infinitely fine meshes that is extrapolated from few meshes.
struct RoughLimit {
  double value = 0.0;
  double section = 0.0;  // change of the value by refining the section
  double around = 0.0;   // change of the value by halving sectors alone
  double unsure = 0.0;   // further uncertainty of the extrapolation
};

/// A set of meshes, and the extrapolation of a quantity's values on them.
struct FewMeshes {
  std::vector<fe_tire::MeshRefinement> refinements;  // the first is the mesh itself
  RoughLimit (*extrapolate)(const std::vector<double>& values);
};

/// The mesh, the mesh with halved sectors, the mesh with everything halved. Sectors have second
/// order, so a third of the change by halving them remains.
const FewMeshes& few_meshes();

/// Adds meshes with columns and sectors halved once and twice, which are extrapolated together, in
/// about four times the time. Rows are halved once. (On meshes refined 1, 2, 3 times patches would
/// end at arbitrary points of the few sectors.)
const FewMeshes& thorough_meshes();

/// Selects the meshes of `few_meshes` from those of `thorough_meshes`.
std::vector<MeshQuantities> few_of_thorough(const std::vector<MeshQuantities>& meshes);

/// Relative error of the extrapolation from few meshes, determined on the unloaded tire.
class Missed {
 public:
  /// `limits` are rows of many meshes, `few` those of few meshes, of which only the values count.
  Missed(const std::vector<DiscretizationRow>& limits,
         const std::vector<DiscretizationRow>& few,
         const FewMeshes& meshes);

  /// Sets the limit of a row of the pressed tire on the same meshes, and its uncertainty: the sum
  /// of that of the unloaded tire, that of the extrapolation itself, half of the change by halving
  /// sectors and half of the difference between the changes of both tires.
  void extrapolate(DiscretizationRow& row) const;

 private:
  struct Of {
    double missed = 0.0, section = 0.0, around = 0.0, uncertainty = 0.0;
  };
  FewMeshes meshes_;
  std::map<std::string, Of> of_;  // keys are mode labels
  double part_ = 0.0;             // error as a share of the change by refining the section
  Of all_;                        // root mean squares; `missed` is the error beyond that share
};

}  // namespace latsch
