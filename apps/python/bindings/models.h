// SPDX-License-Identifier: Apache-2.0
// A model of any kind with its parameters, as a Python object.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <vector>

#include "base/document.h"
#include "experiment/language.h"
#include "measurement/channels.h"

namespace latsch::python {

/// The specimen of the last test, from which the next one reuses what is still valid.
struct Kept {
  std::mutex mutex;
  std::unique_ptr<experiment::Specimen> specimen;
};

class Model {
 public:
  Model(const experiment::SpecimenKind& kind, Document numbers);

  const experiment::SpecimenKind& kind() const { return *kind_; }
  const Document& numbers() const { return numbers_; }
  Document& numbers() { return numbers_; }
  const std::shared_ptr<Kept>& kept() const { return kept_; }

 private:
  const experiment::SpecimenKind* kind_;
  Document numbers_;
  std::shared_ptr<Kept> kept_;
};

/// Converts channels; returns (values, units, slopes), each a dict by channel name. An array of
/// slopes has the shape (samples, paths).
pybind11::tuple arrays_of(const std::vector<Channel>& channels, std::size_t paths);

}  // namespace latsch::python
