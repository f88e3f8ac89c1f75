// SPDX-License-Identifier: Apache-2.0
#include "base/document.h"

#include <cmath>

#include "base/document_node.h"
#include "base/document_number.h"
#include "base/document_tree.h"
#include "base/file.h"
#include "base/text.h"

namespace latsch {
namespace {

/// The value a path leads to, which must be a number.
int number_at(const DocumentTree& tree, std::string_view path, const Document& document) {
  const int index = tree.find(path);
  if (index >= 0 && number_of(tree.value(index))) return index;
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
  Document document;
  document.tree_ = std::make_shared<DocumentTree>(text, std::move(file_name));
  return document;
}

Node Document::root() const {
  return Node(std::make_shared<Node::Impl>(
      Node::Impl{tree_, std::make_shared<DocumentAsked>(), DocumentTree::kRoot}));
}

double Document::get(std::string_view path) const {
  return number_of(tree_->value(number_at(*tree_, path, *this)))->si;
}

std::string Document::unit(std::string_view path) const {
  return si_unit(number_of(tree_->value(number_at(*tree_, path, *this)))->unit.dimension());
}

void Document::set(std::string_view path, double value) {
  const int index = number_at(*tree_, path, *this);
  if (!std::isfinite(value))
    throw InputError(tree_->place(index),
                     std::string(path) + " cannot become " + format_number(value));
  // Copies of this document and nodes read from it keep what they have.
  if (tree_.use_count() > 1) tree_ = std::make_shared<DocumentTree>(*tree_);
  set_number(tree_->value(index), value);
}

std::vector<std::string> Document::paths() const {
  std::vector<std::string> paths;
  for (int i = 0; i < tree_->size(); ++i)
    if (number_of(tree_->value(i))) paths.push_back(tree_->value(i).path);
  return paths;
}

std::string Document::text() const { return tree_->text(); }

const std::string& Document::file() const { return tree_->file(); }

}  // namespace latsch
