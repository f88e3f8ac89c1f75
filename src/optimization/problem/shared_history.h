// SPDX-License-Identifier: Apache-2.0
// The outcomes that a method has observed. A method that looks ahead copies its state. A copy
// shares all outcomes known when it was made and stores later ones separately, so that copying is
// cheap however long the history is.
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace latsch {

/// A vector that only grows.
template <class T>
class SharedHistory {
 public:
  int size() const { return static_cast<int>(shared_->size() + own_.size()); }
  const T& operator[](int i) const {
    const auto k = static_cast<std::size_t>(i);
    return k < shared_->size() ? (*shared_)[k] : own_[k - shared_->size()];
  }
  void push_back(T value) {
    if (shared_.use_count() > 1) return own_.push_back(std::move(value));
    for (T& item : own_) shared_->push_back(std::move(item));
    own_.clear();
    shared_->push_back(std::move(value));
  }

 private:
  std::shared_ptr<std::vector<T>> shared_ = std::make_shared<std::vector<T>>();
  std::vector<T> own_;
};

/// A table of values whose keys are the bits of a point.
class SharedTable {
 public:
  /// Returns the value of a point, given by its bits; nullptr if the point is not known.
  const double* find(const std::string& bits) const {
    for (const Table* table : {&own_, static_cast<const Table*>(shared_.get())}) {
      if (const auto found = table->find(bits); found != table->end()) return &found->second;
    }
    return nullptr;
  }
  void set(const std::string& bits, double value) {
    if (shared_.use_count() > 1) {
      own_.insert_or_assign(bits, value);
      return;
    }
    for (const auto& [own, known] : own_) shared_->insert_or_assign(own, known);
    own_.clear();
    shared_->insert_or_assign(bits, value);
  }

 private:
  using Table = std::unordered_map<std::string, double>;
  std::shared_ptr<Table> shared_ = std::make_shared<Table>();
  Table own_;
};

}  // namespace latsch
