// SPDX-License-Identifier: Apache-2.0
// An archive is read by libzip, which checks that headers, sizes and sums of all files agree.
#include "exchange/package/zip_archive.h"

#include <gtest/gtest.h>
#include <zip.h>

#include <map>
#include <random>

namespace latsch::exchange {
namespace {

struct UnzippedFile {
  std::string bytes;
  zip_uint16_t method = 0;
  std::uint32_t permissions = 0;
};

std::map<std::string, UnzippedFile> unzipped(const std::string& bytes) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* zip = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error);
  if (!zip) throw std::runtime_error(zip_error_strerror(&error));
  std::map<std::string, UnzippedFile> files;
  for (zip_int64_t i = 0; i < zip_get_num_entries(zip, 0); ++i) {
    const auto place = static_cast<zip_uint64_t>(i);
    zip_stat_t entry;
    zip_stat_index(zip, place, 0, &entry);
    UnzippedFile file;
    file.bytes.resize(entry.size);
    zip_file_t* stream = zip_fopen_index(zip, place, 0);
    const zip_int64_t count = zip_fread(stream, file.bytes.data(), file.bytes.size());
    EXPECT_EQ(count, static_cast<zip_int64_t>(entry.size));
    EXPECT_EQ(zip_fclose(stream), 0);  // checks the sum
    file.method = entry.comp_method;
    zip_uint8_t system = 0;
    zip_uint32_t attributes = 0;
    zip_file_get_external_attributes(zip, place, 0, &system, &attributes);
    EXPECT_EQ(system, ZIP_OPSYS_UNIX);
    file.permissions = attributes >> 16;
    files[zip_get_name(zip, place, ZIP_FL_ENC_STRICT)] = file;
  }
  zip_discard(zip);
  return files;
}

TEST(ZipArchive, IsReadByAnotherProgramWithEveryByteAndName) {
  std::mt19937 random(7);
  std::string noise(300000, '\0');  // cannot be deflated
  for (char& byte : noise) byte = static_cast<char>(random());
  const std::map<std::string, std::string> content = {{"modelDescription.xml", "<a/>"},
                                                      {"resources/empty", ""},
                                                      {"resources/r\xc3\xbc"
                                                       "ck.toml",
                                                       std::string(70000, 'x')},
                                                      {"binaries/linux64/noise.so", noise}};
  ZipArchive zip;
  for (const auto& [name, bytes] : content) zip.add(name, bytes);
  const auto files = unzipped(zip.bytes());
  ASSERT_EQ(files.size(), content.size());
  for (const auto& [name, file] : files) {
    EXPECT_EQ(file.bytes, content.at(name)) << name;
    EXPECT_EQ(file.method, ZIP_CM_DEFLATE) << name;
    EXPECT_EQ(file.permissions, 0100644u) << name;
  }
  EXPECT_LT(zip.bytes().size(), noise.size() + 2000);
}

TEST(ZipArchive, WithoutFilesIsTheEmptyArchiveOfTheStandard) {
  EXPECT_EQ(ZipArchive().bytes(), std::string("PK\x05\x06") + std::string(18, '\0'));
}

TEST(ZipArchive, OfEqualContentHasEqualBytesAndTheFirstDateOfTheFormat) {
  ZipArchive one, other;
  one.add("a", "text");
  other.add("a", "text");
  EXPECT_EQ(one.bytes(), other.bytes());
  EXPECT_EQ(one.bytes().substr(10, 4), std::string("\0\0\x21\0", 4));  // time 0, January 1, 1980
}

}  // namespace
}  // namespace latsch::exchange
