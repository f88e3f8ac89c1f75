// SPDX-License-Identifier: Apache-2.0
// A finite-element model in the .inp language of CalculiX and Abaqus, with the numbering and units
// of the file.
//
// The supported part of the language is what tires need: nodes, eight-node elements, sets,
// hyperelastic and linear materials with their Prony terms, cylindrical orientations, sections,
// layers of rebars in embedded surface elements, equations that tie a node to the line between two
// others or to a mean of the corners of an element, springs and masses at such means, surfaces, one
// kind of contact, supports, face pressures, static and frequency steps. Unknown cards, unknown
// options (inp_options.h) and values of options that mean another model are refused with their
// names, because ignoring them would give a wrong model.
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
#include "formats/deck/inp_remarks.h"
#include "formats/deck/inp_units.h"

namespace latsch::formats {

/// A four-node surface element without own stiffness that holds rebars.
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

/// A node that equations tie to the straight line between two others, at its initial position: x =
/// (1 - at) x_lower + at x_upper, and likewise for its displacement.
struct InpTie {
  int lower = 0, upper = 0;  // node numbers
  double at = 0.0;           // 0 at the node `lower`, 1 at the node `upper`
  Place place;
};

/// A node that equations tie to a weighted mean of others; the weights add up to one.
struct InpMean {
  std::map<int, double> weights;  // weights by node number
  Place place;
};

/// A spring between two nodes. Its force depends on its elongation and is linear between given
/// points.
struct InpSpring {
  struct Point {
    double force = 0.0, elongation = 0.0;
  };
  int number = 0;
  std::array<int, 2> node;  // node numbers
  std::vector<Point> law;
  Place place;
};

/// A number of the deck that a study may vary: a constant of a material or of a layer of rebars, an
/// angle, or the pressure. Other structs refer to such a number by its index in InpDeck::numbers.
struct InpNumber {
  std::string path;  // "material.RUBBER1.C10"
  InpQuantity quantity = InpQuantity::ratio;
  double value = 0.0;  // in the units of the file
  struct Where {
    int line = 0;
    std::size_t field = 0;
    double times = 1.0;  // factor by which this field of the deck is a multiple of the number
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
  std::vector<int> constants;  // indices in InpDeck::numbers
  int density = -1;            // index in InpDeck::numbers; -1: none
  bool no_compression = false;
  /// A row of *VISCOELASTIC, TIME=PRONY.
  struct Relaxation {
    int share = -1, time = -1;  // indices in InpDeck::numbers of g and tau
    double bulk = 0.0;          // k
    Place place;
  };
  std::vector<Relaxation> relaxation;
  bool instantaneous = false;  // true: moduli are those of fast loading
  Place place;
};

struct InpOrientation {
  bool cylindrical = false;
  Eigen::Vector3d a, b;  // two points on the axis of the cylindrical system
  int axis = 1;          // axis, 1 to 3, of the additional rotation
  int angle = -1;        // index in InpDeck::numbers of the angle of that rotation; -1: no rotation
  Place place;
};

/// Parallel rebars in surface elements.
struct InpRebars {
  std::string name, elset, material, orientation;
  int area = -1, spacing = -1, angle = -1;  // indices in InpDeck::numbers
  Place place;
};

/// Element sets that are embedded in the elements of a host set; without a host, in any elements.
struct InpEmbedding {
  std::string host;
  std::vector<std::string> elsets;
  Place place;
};

struct InpSection {
  std::string elset, material, orientation;
  Place place;
};

/// A face, with number 1 to 6, of every element of a set.
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

/// A support: the degrees of freedom first..last (1 to 3) of the nodes have a prescribed value.
struct InpSupport {
  std::vector<int> nodes;
  int first = 1, last = 3;
  double value = 0.0;
  Place place;
};

struct InpInteraction {
  double stiffness = 0.0;  // contact stiffness, pressure per overclosure
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
  std::string element_type;  // type common to all elements, such as "C3D8"; "" if there are none
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
  std::map<int, InpTie> ties;    // ties by the number of the tied node
  std::map<int, InpMean> means;  // means by the number of the node that is tied to the mean
  std::vector<InpSpring> springs;
  std::map<int, double> masses;  // point masses by node number
  std::vector<InpNumber> numbers;
  int pressure = -1;  // index in InpDeck::numbers of the pressure of the last static step; -1: none
  /// units that the file states, else those that suit the size of the mesh, else mm, N, tonne
  InpUnits units;
  bool are_units_stated = false;
  InpRemarks remarks;

  double value(int number) const { return numbers[static_cast<std::size_t>(number)].value; }
};

/// Throws InputError with file and line for anything malformed, missing or not supported.
InpDeck read_inp(const std::filesystem::path& file);
InpDeck parse_inp(std::string_view text, const std::string& file_name);

/// Returns the units in which a mesh of this size is probably written: those of units_of_size(), or
/// mm, N, tonne if that recognizes none.
InpUnits units_by_size(const InpDeck& deck);

/// Returns the text of the deck with its numbers replaced by those of `deck`. A number that differs
/// is written with as many digits as are needed to read it back exactly; every other byte stays.
/// See inp_numbers.cpp.
std::string with_numbers_of(const InpDeck& deck, std::string_view text);

}  // namespace latsch::formats
