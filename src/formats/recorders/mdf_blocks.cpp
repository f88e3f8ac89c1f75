// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/mdf_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "base/error.h"
#include "base/text.h"
#include "formats/recorders/recorded_file.h"

namespace latsch::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "blocks of MDF 4 are little-endian");

constexpr std::size_t kBlockHead = 24;  // bytes: identifier, reserved, length, number of links

/// Returns the text of the first element TX of an XML text, with the five entities of XML resolved.
std::string text_of_xml(std::string_view xml) {
  const std::size_t open = xml.find("<TX");
  const std::size_t begin = open == xml.npos ? xml.npos : xml.find('>', open);
  const std::size_t end = begin == xml.npos ? xml.npos : xml.find("</TX>", begin);
  if (end == xml.npos) return "";
  std::string_view inner = xml.substr(begin + 1, end - begin - 1);
  std::string text;
  while (!inner.empty()) {
    using Entity = std::pair<std::string_view, char>;
    std::size_t used = 1;
    char c = inner.front();
    for (const auto& [word, meant] : {Entity{"&lt;", '<'},
                                      Entity{"&gt;", '>'},
                                      Entity{"&quot;", '"'},
                                      Entity{"&apos;", '\''},
                                      Entity{"&amp;", '&'}})
      if (inner.starts_with(word)) {
        c = meant;
        used = word.size();
        break;
      }
    text += c;
    inner.remove_prefix(used);
  }
  return text;
}

}  // namespace

std::uint64_t MdfBlock::link(std::size_t index) const {
  std::uint64_t position = 0;
  if (index < link_count())
    std::memcpy(&position, links_.data() + index * sizeof(position), sizeof(position));
  return position;
}

void MdfBlock::fail(const std::string& message) const {
  throw InputError({*file_, 0}, fmt::format("block {} at byte {} {}", id_, at_, message));
}

const char* MdfBlock::bytes_at(std::size_t offset, std::size_t size) const {
  if (data_.size() < size || offset > data_.size() - size)
    fail(fmt::format("has {} bytes of data, expected {} or more", data_.size(), offset + size));
  return data_.data() + offset;
}

MdfBlock MdfBlocks::at(std::uint64_t position, bool may_be_open) const {
  const auto fail = [&](const std::string& message) {
    throw InputError({file_, 0}, fmt::format("links to byte {}, {}", position, message));
  };
  if (position > bytes_.size() || bytes_.size() - position < kBlockHead)
    fail(fmt::format("where it has no block, because it has {} bytes: the file is cut off",
                     bytes_.size()));
  const std::string_view rest = bytes_.substr(position);
  if (!rest.starts_with("##"))
    fail(fmt::format("where {} is, expected a block, which begins with \"##\"",
                     shown_bytes(rest.substr(0, 4))));
  std::uint64_t length = 0, links = 0;
  std::memcpy(&length, rest.data() + 8, sizeof(length));
  std::memcpy(&links, rest.data() + 16, sizeof(links));
  MdfBlock block;
  block.file_ = &file_;
  block.at_ = position;
  block.id_ = rest.substr(2, 2);
  if (may_be_open && (block.id_ == "DT" || block.id_ == "DV") &&
      (length <= kBlockHead || length > rest.size()))
    length = rest.size();
  if (length < kBlockHead || length > rest.size())
    block.fail(fmt::format("states a length of {} bytes where {} are left: is the file cut off?",
                           length,
                           rest.size()));
  if (links > (length - kBlockHead) / sizeof(std::uint64_t))
    block.fail(fmt::format("states {} links in {} bytes", links, length));
  block.links_ = rest.substr(kBlockHead, links * sizeof(std::uint64_t));
  block.data_ =
      rest.substr(kBlockHead + block.links_.size(), length - kBlockHead - block.links_.size());
  return block;
}

MdfBlock MdfBlocks::at(std::uint64_t position, std::string_view ids) const {
  MdfBlock block = at(position);
  for (std::size_t i = 0; i + 2 <= ids.size(); i += 2)
    if (block.id() == ids.substr(i, 2)) return block;
  block.fail(fmt::format("is where a block {} is expected", in_quotes(ids)));
}

std::string MdfBlocks::text(std::uint64_t position) const {
  if (position == 0) return "";
  const MdfBlock block = at(position, "TXMD");
  if (block.id() == "TX") return recorded_text(block.data(), file_);
  constexpr std::size_t kMostXml = 1 << 16;  // bytes; a comment beyond is not searched
  const std::string_view xml = block.data().substr(0, kMostXml);
  return recorded_text(text_of_xml(xml.substr(0, xml.find('\0'))), file_);
}

void MdfChain::visit(const MdfBlock& block) {
  if (!seen_.insert(block.at()).second) block.fail("is linked twice: its chain has no end");
}

}  // namespace latsch::formats
