// SPDX-License-Identifier: Apache-2.0
// Tests spoiled files: whatever a person, an editor or a network did to a study file, reading it
// ends in a document or in an InputError, and all functions of a document that was read work as
// documented.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>

#include "base/document.h"
#include "base/file.h"
#include "base/spoiled_text_testing.h"

namespace latsch {
namespace {

constexpr std::uint64_t kSeed = 2'600;
constexpr int kMutations = 20'000;

std::vector<std::string> shipped_tires() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(LATSCH_SOURCE_DIR "/studies/tires"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const auto& file : files) texts.push_back(read_text_file(file, 1 << 20));
  return texts;
}

const std::vector<std::string>& pieces() {
  static const std::vector<std::string> kPieces = {"[",
                                                   "]",
                                                   "{",
                                                   "}",
                                                   "\"",
                                                   "'",
                                                   "\"\"\"",
                                                   "=",
                                                   ".",
                                                   ",",
                                                   "\n",
                                                   "\r\n",
                                                   "#",
                                                   "\\",
                                                   "\\u00e4",
                                                   "nan",
                                                   "inf",
                                                   "-inf",
                                                   "1e999",
                                                   "-0.0",
                                                   "0x10",
                                                   "1_000",
                                                   "1979-05-27",
                                                   "true",
                                                   "unit = \"mm\"",
                                                   " mm",
                                                   " degC",
                                                   " dB",
                                                   " s since 2000",
                                                   "^99999999",
                                                   "((((",
                                                   std::string(1, '\0'),
                                                   "\xff",
                                                   "\xc3",
                                                   "\xef\xbb\xbf",
                                                   "[layer.belt_1]",
                                                   "[[layer]]",
                                                   "a.b.c.d = 1",
                                                   "\"2.6 bar\""};
  return kPieces;
}

/// Calls every function that a study may call on a document.
void use(const std::string& text, RandomStream& random) {
  Document document = Document::parse(text, "spoiled.toml");
  const Node root = document.root();
  for (const Node& layer : root.named_tables("layer")) layer.quantity("angle", "rad");
  if (const auto section = root.find_table("section")) section->rows("contour", {"m", "m"});
  const std::vector<std::string> paths = document.paths();
  if (!paths.empty()) {
    const std::string& path = paths[random.below(paths.size())];
    const double value = document.get(path) * (0.5 + 1.5 * random.uniform());
    if (std::isfinite(value)) {
      document.set(path, value);
      const Document again = Document::parse(document.text(), "again.toml");
      ASSERT_EQ(std::bit_cast<std::uint64_t>(again.get(path)),
                std::bit_cast<std::uint64_t>(document.get(path)))
          << path << " in\n"
          << text;
    }
  }
  if (!paths.empty()) {
    EXPECT_THROW(root.close(), InputError);  // no getter has read most of the keys
  }
}

TEST(DocumentFuzz, TwentyThousandSpoiledTireFilesEndInADocumentOrAnInputError) {
  const std::vector<std::string> tires = shipped_tires();
  ASSERT_FALSE(tires.empty());
  int rejected = 0;
  for (int i = 0; i < kMutations; ++i) {
    RandomStream random(kSeed, i);
    const std::string text = spoiled(tires[random.below(tires.size())], pieces(), random);
    try {
      use(text, random);
      if (HasFatalFailure()) return;
    } catch (const InputError& error) {
      ++rejected;
      ASSERT_NE(std::string(error.what()).find(".toml"), std::string::npos) << error.what();
    }
  }
  // Checks that both outcomes, a document and an InputError, are frequent.
  EXPECT_GT(rejected, kMutations / 4);
  EXPECT_LT(rejected, 9 * kMutations / 10);
}

}  // namespace
}  // namespace latsch
