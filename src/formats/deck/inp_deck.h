// SPDX-License-Identifier: Apache-2.0
// A finite-element model in the .inp language of CalculiX and Abaqus, as written: own numbers, own
// units.
//
// The part of the language a tire needs: nodes, eight-node elements, sets, hyperelastic and linear
// materials, cylindrical orientations, sections, layers of rebars in embedded surface elements,
// equations that hold a node on the line between two others, surfaces, one kind of contact,
// supports, face pressures, static and frequency steps. Everything else is refused by name, for a
// card skipped in silence is a wrong model: cards that are not known, their options
// (inp_options.h), values of options that mean another model.
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
#include "formats/deck/inp_units.h"

namespace latsch::formats {

/// A four-node element without stiffness of its own, which holds rebars.
struct InpSurfaceElement {
  int number = 0;
  std::array<int, 4> node;  // node numbers
  Place place;
};

struct InpElement {
  int number = 0;
  std::array<int, 8> node;  // node numbers
  Place place;
};

/// A node that equations hold on the straight line between two others, where it lies: x = (1 - at)
/// x_lower + at x_upper, and its displacement likewise.
struct InpTie {
  int lower = 0, upper = 0;  // node numbers
  double at = 0.0;           // 0 at the lower, 1 at the upper node
  Place place;
};

/// A number that can vary: a constant of a material, of a layer of rebars, an angle, the pressure.
/// What is made of it refers to it by its place in InpDeck::numbers.
struct InpNumber {
  std::string path;  // "material.RUBBER1.C10"
  InpQuantity quantity = InpQuantity::ratio;
  double value = 0.0;  // as written, own units
  struct Where {
    int line = 0;
    std::size_t field = 0;
    double times = 1.0;  // what stands there, in terms of the value
  };
  std::vector<Where> where;
};

struct InpMaterial {
  enum class Law {
    none,
    neo_hooke,              // C10, D1
    mooney_rivlin,          // C10, C01, D1
    isotropic,              // E, nu
    engineering_constants,  // E1, E2, E3, nu12, nu13, nu23, G12, G13, G23
    orthotropic,            // D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323
    anisotropic             // D1111, ... the upper triangle by columns, 11 22 33 12 13 23
  };
  std::string name;
  Law law = Law::none;
  std::vector<int> constants;  // numbers
  int density = -1;            // number; -1: none
  bool no_compression = false;
  Place place;
};

struct InpOrientation {
  bool cylindrical = false;
  Eigen::Vector3d a, b;  // cylindrical: two points of the axis
  int axis = 1;          // about which the axes are turned, 1 to 3
  int angle = -1;        // number, by so much; -1: not turned
  Place place;
};

/// Parallel rebars in surface elements.
struct InpRebars {
  std::string name, elset, material, orientation;
  int area = -1, spacing = -1, angle = -1;  // numbers
  Place place;
};

/// Element sets whose elements lie in those of another; no host: in any.
struct InpEmbedding {
  std::string host;
  std::vector<std::string> elsets;
  Place place;
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
  InpNumber::Where where = {};
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
  std::map<int, InpSurfaceElement> surface_elements;
  std::string element_type;  // "C3D8", of all; "" where there are none
  std::map<std::string, std::vector<int>> node_sets, element_sets;
  std::map<std::string, InpMaterial> materials;
  std::map<std::string, InpOrientation> orientations;
  std::vector<InpSection> sections;
  std::map<std::string, std::vector<InpFaces>> surfaces;
  std::map<std::string, InpInteraction> interactions;
  std::vector<InpContact> contacts;
  std::vector<InpSupport> supports;
  std::vector<InpStep> steps;
  std::vector<InpRebars> rebars;
  std::vector<InpEmbedding> embeddings;
  std::map<int, InpTie> ties;  // by the number of the tied node
  std::vector<InpNumber> numbers;
  int pressure = -1;  // number, of the last static step; -1: none
  InpUnits units;     // stated, else by the size of the mesh, else mm, N, tonne
  bool are_units_stated = false;

  double value(int number) const { return numbers[static_cast<std::size_t>(number)].value; }
};

/// Throws InputError with file and line for anything malformed, missing or not supported.
InpDeck read_inp(const std::filesystem::path& file);
InpDeck parse_inp(std::string_view text, const std::string& file_name);

/// Those a mesh of this size is written in: units_of_size(), mm, N, tonne where that is none of a
/// tire.
InpUnits units_by_size(const InpDeck& deck);

/// The text of that deck with its numbers as they are in `deck`: where one is another than in the
/// text, its field is, in as many digits as it takes to be read back as it is; all else stays,
/// byte by byte.
std::string with_numbers_of(const InpDeck& deck, std::string_view text);

}  // namespace latsch::formats
