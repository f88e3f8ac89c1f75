// SPDX-License-Identifier: Apache-2.0
// The identity of a test contains everything that a recording depends on: every key of every kind
// of test, every named file and every measured number is changed in turn, and the identity has to
// change with it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

#include "base/document_record.h"
#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "experiment/keys_of_tests.h"
#include "experiment/language.h"
#include "experiment/tests/keys/sample_files.h"

namespace latsch::experiment {
namespace {

/// A sample text of a kind of test, which states some of its keys.
struct TestSample {
  const TestKind* kind;
  std::string keys;
};

std::vector<TestSample> test_samples() {
  std::vector<TestSample> samples;
  for (const TestKind* kind : language().tests) {
    if (!kind->keys) continue;
    for (const std::string& keys : kind->keys().samples) samples.push_back({kind, keys});
  }
  return samples;
}

/// Replacement texts for keys whose values are neither numbers nor choices.
const std::map<std::string, std::string>& other_texts() {
  static const std::map<std::string, std::string> others = {{"frame", "[\"H\"]"},
                                                            {"measures", "[\"slip\"]"},
                                                            {"directions", "[\"vertical\"]"},
                                                            {"inputs", "[\"gamma\"]"}};
  return others;
}

/// Returns the content of a file with one number changed; "" for a file that only refers to the
/// next file.
std::string other_content(const SampleFile& file) {
  static const std::map<std::string, std::pair<std::string, std::string>> changes = {
      {"states.csv", {"-4", "-4.1"}},
      {"heights.csv", {"\n4.", "\n4.0"}},
      {"surface.crg", {"0.2000000\n", "0.3000000\n"}},
      {"track.rdf", {"HEIGHT = 0.02", "HEIGHT = 0.03"}},
      {"track.toml", {"0.9", "0.8"}}};
  const auto change = changes.find(file.name);
  if (change == changes.end()) return "";
  const auto& [from, to] = change->second;
  const std::size_t at = file.text.rfind(from);
  if (at == file.text.npos) throw InputError(file.name + " does not hold " + from);
  return std::string(file.text).replace(at, from.size(), to);
}

class IdentityOfTests : public testing::Test {
 protected:
  IdentityOfTests() { write_sample_files(folder_.path()); }

  TestSource source(double scale = 1.0, int samples = 12) const {
    return source_of_samples(folder_.path(), scale, samples);
  }
  /// Returns the identity of the test with these keys; nothing if the reader refuses them.
  std::optional<std::string> identity(const std::string& keys,
                                      double scale = 1.0,
                                      int samples = 12) const {
    try {
      const Document document = Document::parse(keys, "test.toml");
      return language().read_identified_test(document.root(), source(scale, samples)).identity;
    } catch (const InputError&) {
      return std::nullopt;
    }
  }
  /// Returns the keys of a sample, each with its reader's declaration.
  std::map<std::string, DeclaredKey> declared(const std::string& keys) const {
    const Document document = Document::parse(keys, "test.toml");
    const DocumentRecord record(document.root());
    language().read_test(record.node(), source());
    return record.keys();
  }

  ScratchFolder folder_;
};

const std::string& kind_of(const TestSample& sample) { return sample.kind->name; }

struct Line {
  std::string path, value;
};

/// Returns a sample with every value on a line of its own.
std::vector<Line> lines_of(const std::string& keys) {
  std::istringstream text(canonical_text(Document::parse(keys, "test.toml")));
  std::vector<Line> lines;
  for (std::string line; std::getline(text, line);) {
    const std::size_t at = line.find(" = ");
    lines.push_back({line.substr(0, at), line.substr(at + 3)});
  }
  return lines;
}

bool is_at_or_below(const std::string& path, const std::string& table) {
  return path == table || path.starts_with(table + ".");
}

/// Returns the sample with a changed value at a path.
std::string with(const std::vector<Line>& lines,
                 const std::string& path,
                 const std::string& value) {
  std::string text;
  for (const Line& line : lines)
    if (!is_at_or_below(line.path, path)) text += line.path + " = " + line.value + "\n";
  return text + path + " = " + value + "\n";
}

/// Returns changed values for a key: each of its numbers changed a little and a lot, the other
/// choices, the other flag, another name.
std::vector<std::string> others(const std::string& value, const DeclaredKey& key) {
  std::vector<std::string> found;
  if (value == "true" || value == "false") return {value == "true" ? "false" : "true"};
  for (const std::string& choice : key.choices)
    if ("\"" + choice + "\"" != value) found.push_back("\"" + choice + "\"");
  if (!key.choices.empty()) return found;
  static const std::regex number(R"((^|[\[" ])(-?\d+(\.\d+)?(e-?\d+)?)(?=[\], "]|$))");
  for (auto at = std::sregex_iterator(value.begin(), value.end(), number);
       at != std::sregex_iterator();
       ++at) {
    const double was = std::stod((*at)[2]);
    for (const double now : {1.01 * was, 0.99 * was, 2.0 * was, 0.5 * was, was + 1.0, was - 1.0}) {
      const bool is_integer = key.kind == DeclaredKey::Kind::integer;
      if (now == was || (is_integer && now != std::round(now))) continue;
      std::string other = value;
      other.replace(static_cast<std::size_t>(at->position(2)),
                    static_cast<std::size_t>(at->length(2)),
                    is_integer ? fmt::format("{:.0f}", now) : fmt::format("{}", now));
      found.push_back(other);
    }
  }
  if (found.empty() && key.kind == DeclaredKey::Kind::text) found.emplace_back("\"another\"");
  return found;
}

// Each key that a reader requests must have a description and a sample that states it, and each
// description must have a key.
TEST_F(IdentityOfTests, EveryKindHasSamplesAndSentencesForEveryKey) {
  for (const TestKind* kind : language().tests)
    EXPECT_TRUE(kind->keys && !kind->keys().samples.empty()) << "no sample of " << kind->name;
  KeyTable table(test_sections(language()));
  add_keys_of_tests(language(), folder_.path(), table);
  for (const std::string& fault : table.faults()) ADD_FAILURE() << fault;
}

TEST_F(IdentityOfTests, ASentenceOrASampleThatIsMissingIsFound) {
  KeySection section = language().find_test("mass_properties")->keys();
  section.shared.clear();
  section.sentences = {{"rpessure", "Pressure."}};
  KeyTable table({&section});
  table.add(section, keys_of_test(language(), section.samples.front(), folder_.path()));
  EXPECT_EQ(table.faults(),
            (std::vector<std::string>{
                section.heading + ": `pressure` has no sentence",
                section.heading + ": `rpessure` has a sentence, but no reader requests it"}));
  section.sentences = {{"pressure", "Pressure."}};
  KeyTable unstated({&section});
  unstated.add(section, keys_of_test(language(), "kind = \"mass_properties\"\n", folder_.path()));
  EXPECT_EQ(unstated.faults(),
            (std::vector<std::string>{section.heading + ": `pressure` is stated by no sample"}));
}

TEST_F(IdentityOfTests, EveryKeyCounts) {
  int changed = 0;
  std::map<std::string, int> of_key;  // number of accepted changed values for each key
  for (const TestSample& sample : test_samples()) {
    const auto lines = lines_of(sample.keys);
    const auto before = identity(sample.keys);
    ASSERT_TRUE(before) << sample.keys;
    const auto keys = declared(sample.keys);
    for (const Line& line : lines) {
      const auto key = keys.find(line.path);
      // A separate test changes the content of the named file.
      if (key == keys.end() || !key->second.files.empty()) continue;
      if (key->second.choices.size() == 1 || line.path == "kind") continue;
      if (line.path.ends_with(".from")) continue;  // another test changes this key
      std::vector<std::string> candidates = others(line.value, key->second);
      if (other_texts().contains(line.path)) candidates = {other_texts().at(line.path)};
      int accepted = 0;
      for (const std::string& other : candidates) {
        const auto after = identity(with(lines, line.path, other));
        if (!after) continue;
        ++accepted;
        EXPECT_NE(*after, *before) << kind_of(sample) << ": " << line.path << " = " << other;
      }
      of_key[kind_of(sample) + ": " + line.path] += accepted;
      changed += accepted;
    }
  }
  for (const auto& [key, accepted] : of_key)
    EXPECT_GT(accepted, 0) << "no other value is accepted for " << key;
  EXPECT_GT(changed, 1000);
}

TEST_F(IdentityOfTests, EveryFileCountsByItsContent) {
  std::set<std::string> counted;
  for (const TestSample& sample : test_samples()) {
    const auto before = identity(sample.keys);
    bool names_a_file = false;
    for (const auto& [path, key] : declared(sample.keys))
      for (const auto& named : key.files) {
        names_a_file = true;
        const auto file =
            std::find_if(sample_files().begin(), sample_files().end(), [&](const SampleFile& one) {
              return one.name == named.filename().string();
            });
        ASSERT_NE(file, sample_files().end()) << named;
        const std::string other = other_content(*file);
        if (other.empty()) continue;
        write_text_file(folder_ / file->name, other);
        const auto after = identity(sample.keys);
        ASSERT_TRUE(after) << file->name;
        EXPECT_NE(*after, *before) << path << " names " << file->name;
        write_text_file(folder_ / file->name, file->text);
        counted.insert(file->name);
      }
    EXPECT_EQ(identity(sample.keys), before);
    EXPECT_EQ(names_a_file,
              sample.keys.find(".csv\"") != std::string::npos ||
                  sample.keys.find("\"track.") != std::string::npos)
        << sample.keys;
  }
  EXPECT_EQ(counted,
            (std::set<std::string>{
                "states.csv", "heights.csv", "surface.crg", "track.rdf", "track.toml"}));
}

// The identity contains the numbers of a condition read from a measurement: other numbers or
// another count of numbers change it, another name of the measurement does not.
TEST_F(IdentityOfTests, EveryMeasuredConditionCounts) {
  std::map<std::string, int> counted;
  for (const TestSample& sample : test_samples())
    for (const auto& [path, key] : declared(sample.keys)) {
      if (!key.is_measurable || !key.is_there) continue;
      const auto with_from = [&](const std::string& name) {
        return with(lines_of(sample.keys), path, "{from = \"measurement." + name + "\"}");
      };
      // Number of samples: equal to that of the other stated conditions (two), or enough for a
      // signal that is analyzed.
      int samples = 12;
      for (const int other : {2, 300})
        if (!identity(with_from("rig"), 1.0, samples)) samples = other;
      const auto before = identity(with_from("rig"), 1.0, samples);
      counted[kind_of(sample) + ": " + path] += before.has_value();
      if (!before) continue;  // the other keys of this sample exclude the condition
      EXPECT_EQ(identity(with_from("other"), 1.0, samples), before) << path;
      const auto scaled = identity(with_from("rig"), 1.01, samples),
                 longer = identity(with_from("rig"), 1.0, 18);
      EXPECT_TRUE((scaled && scaled != before) || (longer && longer != before))
          << kind_of(sample) << ": " << path;
    }
  for (const auto& [key, times] : counted) EXPECT_GT(times, 0) << key << " is never measured";
  EXPECT_GT(counted.size(), 25u);
}

TEST_F(IdentityOfTests, NotesUnitsAndOrderDoNotCount) {
  for (const TestSample& sample : test_samples()) {
    std::string text = "# a note\n";
    auto lines = lines_of(sample.keys);
    std::reverse(lines.begin(), lines.end());
    for (const Line& line : lines) text += line.path + "   =  " + line.value + "  # noted\n\n";
    EXPECT_EQ(identity(text), identity(sample.keys)) << text;
  }
}

}  // namespace
}  // namespace latsch::experiment
