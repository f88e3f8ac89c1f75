// SPDX-License-Identifier: Apache-2.0
// Describes the keys of a table in sentences, with samples that state them: a section of the
// reference.
//
// A reader declares the keys of its table by reading them (base/document_record.h): kind, unit,
// range, choices, default. A KeySection adds a sentence for each key, and samples that together
// state every key. KeyTable joins both. It finds keys without a sentence, sentences without a key,
// and keys that no sample states.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/document_record.h"

namespace latsch::experiment {

/// A key with the sentence that explains it. Several keys with the same explanation are separated
/// by ", ": "Fx, Fy, Fz".
struct KeySentence {
  /// Path below the section's table; "*" stands for a name that the user chooses and, at the end,
  /// for any path: "columns.*".
  std::string path;
  std::string sentence;        // Markdown
  std::string otherwise = "";  // default in words, if the recorded one depends on the sample
  std::string range = "";      // range in words, if the recorded one depends on the sample
};

struct KeySection;

/// Keys that another section describes: all those at `below`; "" means the same table.
struct SharedKeys {
  std::string below;
  const KeySection& (*section)();
};

struct KeySection {
  std::string heading;     // "[optimizer]"
  std::string below = "";  // the section's table in its document: "experiment.*"; "" is the root
  bool is_top = false;     // true: only the keys of the root itself, not those of its tables
  std::string about;       // Markdown, without the keys
  std::vector<KeySentence> sentences = {};  // in the order of the page
  std::vector<std::string> samples = {};    // TOML; the first is the example of the page
  std::vector<SharedKeys> shared = {};
  std::vector<std::string> refused =
      // Keys that the reader only looks for in order to refuse them: they belong elsewhere, or to
      // an older form.
      {};
};

/// Throws InputError for the first key of the table that its section does not describe, with the
/// key that is meant. A reader that stops at a missing key never comes to a mistyped one, so this
/// runs before it. Keys of inner tables are not examined. No key counts as read.
void refuse_unknown_keys(const Node& table, const KeySection& section);

/// One form in which a reader accepts a key: the data of DeclaredKey except value and default.
struct KeyForm {
  DeclaredKey::Kind kind = DeclaredKey::Kind::presence;
  std::vector<std::string> units = {};
  Range range = {};
  std::vector<std::string> choices = {}, expected = {};
};

/// A key as declared by all samples together.
struct TabledKey {
  KeySentence words;           // the description, with the path of this single key
  std::vector<KeyForm> forms;  // in the order of the samples; empty: no reader requested the key
  std::vector<std::string> defaults;  // TOML
  /// true if in no sample the key has a default or is only tested for presence
  bool is_required = true;
  bool is_measurable = false;  // {from = "measurement.NAME"} is allowed
  bool is_requested = false;   // a reader reads the key or tests whether it is present
  bool is_stated = false;      // a sample states the key
};

struct TabledSection {
  const KeySection* section;
  std::vector<TabledKey> keys;
};

class KeyTable {
 public:
  explicit KeyTable(const std::vector<const KeySection*>& sections);

  /// Adds what the reading of a sample of the section has declared, by paths from the root of the
  /// document. Keys outside of the section's table are left out.
  void add(const KeySection& section, const std::map<std::string, DeclaredKey>& declared);

  const std::vector<TabledSection>& sections() const { return sections_; }
  /// Returns a sentence for each requested key that has no sentence or that no sample states, and
  /// for each sentence whose key is never requested.
  std::vector<std::string> faults() const;

 private:
  struct Undescribed {
    bool needs_sentence = false, is_stated = false;
  };
  TabledKey* find(const KeySection& section, const std::string& path);

  std::vector<TabledSection> sections_;
  std::map<std::string, Undescribed> undescribed_;  // requested keys without a sentence
};

/// True if a path matches a pattern such as "experiment.*.noise"; a "*" at the end stands for any
/// path.
bool matches(const std::string& path, const std::string& pattern);

}  // namespace latsch::experiment
