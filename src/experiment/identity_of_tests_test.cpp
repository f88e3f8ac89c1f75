// SPDX-License-Identifier: Apache-2.0
// The identity of a test contains everything that a recording depends on: every key of every kind
// of test, every named file and every measured number is changed in turn, and the identity has to
// change with it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

#include "base/document_record.h"
#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "experiment/language.h"
#include "experiment/test_samples_testing.h"

namespace latsch::experiment {
namespace {

/// Returns recordings of all measured conditions: every channel near a usual value times `scale`,
/// in `samples` samples.
Channels recorded(const std::vector<MeasuredCondition>& conditions, double scale, int samples) {
  static const std::map<std::string, double> usual = {{"m", 0.01},
                                                      {"N", 4000.0},
                                                      {"N m", 100.0},
                                                      {"m/s", 20.0},
                                                      {"Pa", 2e5},
                                                      {"rad", 0.05},
                                                      {"Hz", 80.0},
                                                      {"1", 0.05}};
  Channels channels;
  for (const MeasuredCondition& condition : conditions) {
    const std::string& name = condition.channel;
    const bool is_of_one_wheel = name.ends_with("_L") || name.ends_with("_R");
    if (is_of_one_wheel && !condition.is_needed) continue;  // the rig has loaded one wheel only
    // Each post moves independently, so that they move in every mode and at all frequencies.
    const bool is_post = name.starts_with("post_");
    unsigned drawn = static_cast<unsigned>(std::hash<std::string>()(name));
    const auto change = [&](int i) {
      if (!is_post) return 0.001 * (i % 3);
      drawn = drawn * 1664525u + 1013904223u;
      return static_cast<double>(drawn >> 16) / 65536.0;
    };
    std::vector<double> values;
    for (int i = 0; i < samples; ++i)
      values.push_back(condition.channel == "time" ? 0.01 * i * scale
                       : condition.channel == "mode"
                           ? 1.0
                           : (usual.contains(condition.unit) ? usual.at(condition.unit) : 1.0) *
                                 scale * (1.0 + change(i)));
    channels.add({condition.channel, condition.unit, std::move(values)});
  }
  return channels;
}

class IdentityOfTests : public testing::Test {
 protected:
  IdentityOfTests() {
    for (const SampleFile& file : sample_files()) write_text_file(folder_ / file.name, file.text);
  }

  TestSource source(double scale = 1.0, int samples = 12) const {
    return {folder_.path(), [=](const Node& table, const auto& conditions) {
              table.text("from");
              if (conditions.size() == 1) table.text("channel", conditions[0].channel);
              return recorded(conditions, scale, samples);
            }};
  }
  /// Returns nothing if the reader refuses the keys.
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

/// Returns the kind of a sample.
std::string kind_of(const TestSample& sample) {
  return Document::parse(sample.keys, "").root().text("kind");
}

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

/// Returns the sample with another value at a path.
std::string with(const std::vector<Line>& lines,
                 const std::string& path,
                 const std::string& value) {
  std::string text;
  for (const Line& line : lines)
    if (!is_at_or_below(line.path, path)) text += line.path + " = " + line.value + "\n";
  return text + path + " = " + value + "\n";
}

/// Returns other values for a key: each of its numbers changed a little and a lot, other choices,
/// the other flag.
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
  return found;
}

TEST_F(IdentityOfTests, EveryKindHasSamplesThatStateEveryKey) {
  for (const TestKind* kind : language().tests) {
    std::set<std::string> known, stated, measurable;
    for (const TestSample& sample : test_samples()) {
      if (kind_of(sample) != kind->name) continue;
      for (const auto& [path, key] : declared(sample.keys)) {
        known.insert(path);
        if (key.is_there) stated.insert(path);
        if (key.is_measurable) measurable.insert(path);
      }
    }
    ASSERT_FALSE(known.empty()) << "no sample of " << kind->name;
    for (const std::string& path : known) {
      const bool is_of_measured = std::any_of(measurable.begin(), measurable.end(), [&](auto& one) {
        return path.starts_with(one + ".");
      });
      EXPECT_TRUE(stated.contains(path) || is_of_measured)
          << "no sample of " << kind->name << " states " << path;
    }
  }
}

TEST_F(IdentityOfTests, EveryKeyCounts) {
  int changed = 0;
  std::map<std::string, int> of_key;  // accepted other values of each key
  for (const TestSample& sample : test_samples()) {
    const auto lines = lines_of(sample.keys);
    const auto before = identity(sample.keys);
    ASSERT_TRUE(before) << sample.keys;
    const auto keys = declared(sample.keys);
    for (const Line& line : lines) {
      const auto key = keys.find(line.path);
      if (key == keys.end() || !key->second.files.empty()) continue;  // another test varies it
      if (key->second.choices.size() == 1 || line.path == "kind") continue;
      if (line.path.ends_with(".from")) continue;  // the key is varied in another test
      std::vector<std::string> candidates = others(line.value, key->second);
      if (sample.others.contains(line.path)) candidates = {sample.others.at(line.path)};
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
        if (file->other.empty()) continue;  // the key only refers to the next file
        write_text_file(folder_ / file->name, file->other);
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

// A condition read from a measurement counts by its numbers: other numbers or another count of
// numbers change the identity, another name of the measurement does not.
TEST_F(IdentityOfTests, EveryMeasuredConditionCounts) {
  std::map<std::string, int> counted;
  for (const TestSample& sample : test_samples())
    for (const auto& [path, key] : declared(sample.keys)) {
      if (!key.is_measurable || !key.is_there) continue;
      const auto with_from = [&](const std::string& name) {
        return with(lines_of(sample.keys), path, "{from = \"measurement." + name + "\"}");
      };
      // This is the length of the conditions stated beside it (two samples), or of a signal that is
      // analyzed.
      int samples = 12;
      for (const int other : {2, 300})
        if (!identity(with_from("rig"), 1.0, samples)) samples = other;
      const auto before = identity(with_from("rig"), 1.0, samples);
      counted[kind_of(sample) + ": " + path] += before.has_value();
      if (!before) continue;  // not allowed beside the other keys of this sample
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
