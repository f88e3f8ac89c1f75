// SPDX-License-Identifier: Apache-2.0
// A finite-element model in the .inp language of CalculiX and Abaqus, as written: own numbers, own
// units.
//
// The part of the language a tire needs: nodes, C3D8 elements, sets, hyperelastic and linear
// materials, cylindrical orientations, sections, surfaces, one kind of contact, supports, face
// pressures, static and frequency steps. Everything else is refused by name, for a card skipped in
// silence is a wrong model.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace latsch::formats {

struct InpElement {
  int number = 0;
  std::array<int, 8> node;  // node numbers
  Place place;
};

struct InpMaterial {
  std::string name;
  struct NeoHooke {  // Mooney-Rivlin with C01 = 0
    double C10 = 0.0, C01 = 0.0, D1 = 0.0;
  };
  std::optional<NeoHooke> hyperelastic;
  std::vector<double> elastic;      // E, nu
  std::vector<double> anisotropic;  // 21 constants
  std::optional<double> density;
  Place place;
};

struct InpOrientation {
  bool cylindrical = false;
  Eigen::Vector3d a, b;  // cylindrical: two points of the axis
};

struct InpSection {
  std::string elset, material, orientation;
  Place place;
};

/// Face 1 to 6 of every element of a set.
struct InpFaces {
  std::vector<int> elements;
  int face = 0;
  Place place;
};

struct InpPressure {
  InpFaces faces;
  double value = 0.0;
};

/// Degrees of freedom first..last (1 to 3) of nodes held at a value.
struct InpSupport {
  std::vector<int> nodes;
  int first = 1, last = 3;
  double value = 0.0;
  Place place;
};

struct InpInteraction {
  double stiffness = 0.0;  // pressure per overclosure
  double mu = 0.0;
};

struct InpContact {
  std::string interaction, slave, master;
  Place place;
};

struct InpStep {
  enum class Kind { statics, frequency } kind = Kind::statics;
  bool perturbation = false;
  std::vector<InpPressure> pressures;
  std::vector<InpSupport> supports;
  int modes = 0;
  Place place;
};

struct InpDeck {
  std::string file;
  std::map<int, Eigen::Vector3d> nodes;
  std::map<int, InpElement> elements;
  std::map<std::string, std::vector<int>> node_sets, element_sets;
  std::map<std::string, InpMaterial> materials;
  std::map<std::string, InpOrientation> orientations;
  std::vector<InpSection> sections;
  std::map<std::string, std::vector<InpFaces>> surfaces;
  std::map<std::string, InpInteraction> interactions;
  std::vector<InpContact> contacts;
  std::vector<InpSupport> supports;
  std::vector<InpStep> steps;
};

/// Throws InputError with file and line for anything malformed, missing or not supported.
InpDeck read_inp(const std::filesystem::path& file);
InpDeck parse_inp(std::string_view text, const std::string& file_name);

}  // namespace latsch::formats
