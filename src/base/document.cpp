// SPDX-License-Identifier: Apache-2.0
#include "base/document.h"

#include <cmath>

#include "base/document_node.h"
#include "base/document_tree.h"
#include "base/file.h"
#include "base/text.h"
#include "base/utf8.h"

namespace latsch {
namespace {

/// Returns the index of the value at `path`. Throws InputError if that value is no number.
int number_at(const DocumentTree& tree, std::string_view path, const Document& document) {
  const int index = tree.find(path);
  if (index >= 0 && tree.value(index).number) return index;
  if (index >= 0)
    throw InputError(tree.place(index),
                     std::string(path) + " is " + written(tree.value(index)) +
                         ", expected the path of a number with its unit");
  throw InputError({tree.file(), 0},
                   "no number at path " + in_quotes(path) + did_you_mean(path, document.paths()));
}

}  // namespace

Document Document::read(const std::filesystem::path& file) {
  return parse(read_text_file(file, DocumentTree::kLargestFile), file.string());
}

Document Document::parse(std::string_view text, std::string file_name) {
  refuse_utf16(text, file_name);
  Document document;
  document.tree_ = std::make_shared<DocumentTree>(text, std::move(file_name));
  document.changes_ = std::make_shared<DocumentChanges>();
  return document;
}

Node Document::root() const {
  return Node(std::make_shared<Node::Impl>(
      Node::Impl{tree_, changes_, std::make_shared<DocumentAsked>(), DocumentTree::kRoot}));
}

double Document::get(std::string_view path) const {
  return tree_->si(number_at(*tree_, path, *this), *changes_);
}

std::string Document::unit(std::string_view path) const {
  return si_unit(tree_->value(number_at(*tree_, path, *this)).number->unit.dimension());
}

void Document::set(std::string_view path, double value) {
  const int index = number_at(*tree_, path, *this);
  if (!std::isfinite(value))
    throw InputError(tree_->place(index),
                     std::string(path) + " cannot become " + format_number(value));
  // Copies the changed numbers first if another document or Node shares them, so that those keep
  // the earlier numbers.
  if (changes_.use_count() > 1) changes_ = std::make_shared<DocumentChanges>(*changes_);
  (*changes_)[index] = value;
}

std::vector<std::string> Document::paths() const {
  std::vector<std::string> paths;
  for (int i = 0; i < tree_->size(); ++i)
    if (tree_->value(i).number) paths.push_back(tree_->value(i).path);
  return paths;
}

std::string Document::text() const { return tree_->text(*changes_); }

const std::string& Document::file() const { return tree_->file(); }

}  // namespace latsch
