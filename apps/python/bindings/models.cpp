// SPDX-License-Identifier: Apache-2.0
// Models and tests for Python: parameters by their paths, recordings as arrays. A model keeps the
// specimen of its last test: results that do not depend on a changed parameter are not computed
// again, and the recording equals that of a fresh specimen to the last bit (SpecimenKind::build).
#include "bindings/models.h"

#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/toml/toml_text.h"
#include "bindings/arrays.h"
#include "bindings/bindings.h"
#include "bindings/failures.h"
#include "bindings/long_call.h"
#include "correlation/study/ledgers/file_ledgers.h"
#include "correlation/study/ledgers/study_ledgers.h"
#include "experiment/language/usual_numbers.h"

namespace latsch::python {

using experiment::language;
using experiment::SpecimenKind;
using experiment::Test;

Model::Model(const SpecimenKind& kind, Document numbers)
    : kind_(&kind), numbers_(std::move(numbers)), kept_(std::make_shared<Kept>()) {}

namespace {

const SpecimenKind& kind_called(const std::string& name) {
  if (const SpecimenKind* kind = language().find_kind(name)) return *kind;
  std::string all;
  for (const std::string& one : language().kind_names()) all += (all.empty() ? "" : ", ") + one;
  throw InputError("there is no kind of model \"" + name + "\", expected one of " + all);
}

void warn_in_python(const std::string& sentence) {
  if (PyErr_WarnEx(PyExc_UserWarning, sentence.c_str(), 1) != 0) throw py::error_already_set();
}

/// Warns of a number that no tire and no car has: it is probably not in SI.
void warn_of_unit(const std::string& path, const std::string& unit, double value) {
  const auto* usual = experiment::usual_magnitude(path, unit);
  if (usual && std::isfinite(value) && experiment::judged(*usual, value) != experiment::Seen::usual)
    warn_in_python(path + " = " + format_number(value) + " is taken in " + unit + ", but " +
                   experiment::usual_in_words(*usual) +
                   "; a text such as \"2.4 bar\" states another unit");
}

/// Warns of what the terminal's `latsch test` warns of: unusual numbers and doubts about the file.
Model read_model(const std::filesystem::path& file, const std::optional<std::string>& kind) {
  if (!kind && file.extension() == ".toml" && Document::read(file).root().has("experiment"))
    throw InputError({file.string(), 0},
                     "is a study: read_study(file) reads it, and its method model(point) returns "
                     "the model");
  const SpecimenKind& of = kind ? kind_called(*kind) : language().kind_of_file(file);
  Model model{of, of.read(file)};
  for (const experiment::Finding& one : findings_of_model(of, model.numbers(), file))
    warn_in_python(in_words(one));
  const auto ledgers = correlation::ledgers_of_file(file, "the model");
  correlation::refuse_doubtful(ledgers);
  for (const Ledger& ledger : ledgers)
    for (const LedgerDoubt& doubt : ledger.doubts) {
      const std::string place = doubt.place.text();
      warn_in_python((place.empty() ? "" : place + ": ") + doubt.sentence);
    }
  return model;
}

/// Reads a test from its keys in braces, or from a file.
std::shared_ptr<const Test> test_of(const std::string& text) {
  if (!text.starts_with('{')) return language().read_test(std::filesystem::path(text));
  return language().read_test(Document::parse("test = " + text, "the test").root().table("test"),
                              {});
}

std::vector<std::string> channels_of(const Test& test) {
  std::vector<std::string> names;
  for (const auto& channel : test.channels()) names.push_back(channel.name);
  return names;
}

void check_slopes(const Model& model, const Test& test, const std::vector<std::string>& paths) {
  if (paths.empty()) return;
  const std::vector<std::string> channels = channels_of(test);
  if (std::ranges::none_of(channels, [&](const std::string& channel) {
        return test.tells_slopes(model.kind(), channel);
      }))
    throw InputError("slopes: this test (" + test.in_words() + ") tells none");
  for (const std::string& path : paths) {
    model.numbers().get(path);  // throws InputError if there is no number at the path
    if (!model.kind().knows_slopes_in(path))
      throw InputError("slopes: a " + model.kind().in_words() + " knows none in \"" + path + "\"");
  }
}

/// Joins blocks of samples into one recording. Between two blocks it checks whether the caller
/// still waits.
struct Recorded {
  std::vector<Channel> channels;
  std::vector<std::string> notes;

  void append(const Channels& block) {
    if (channels.empty()) {
      channels = block.all();
      return;
    }
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const auto& more = block.all()[i].values;
      channels[i].values.insert(channels[i].values.end(), more.begin(), more.end());
    }
  }
};

Result<Recorded> record(Kept& kept,
                        const SpecimenKind& kind,
                        const Document& numbers,
                        const Test& test,
                        const std::vector<std::string>& paths,
                        const Abandonment& abandonment) {
  const std::lock_guard lock(kept.mutex);
  kept.specimen = kind.build(numbers, std::move(kept.specimen));
  Recorded recorded;
  if (!paths.empty()) {
    auto found = test.run_with_slopes(*kept.specimen, {channels_of(test), paths});
    if (!found) return found.failure();
    recorded.append(*found);
    return recorded;
  }
  auto notes = test.run_in_blocks(*kept.specimen, [&](const Channels& block) {
    abandonment.check();
    recorded.append(block);
  });
  if (!notes) return notes.failure();
  recorded.notes = std::move(*notes);
  return recorded;
}

}  // namespace

py::tuple arrays_of(const std::vector<Channel>& channels, std::size_t paths) {
  py::dict values, units, slopes;
  for (const Channel& channel : channels) {
    const py::str name(channel.name);
    values[name] = array(channel.values);
    units[name] = channel.unit;
    if (channel.slopes.empty() || paths == 0) continue;
    // `slopes` contains the derivatives of all samples for the first path, then for the next; each
    // path becomes a column here.
    const auto samples = static_cast<Eigen::Index>(channel.values.size());
    slopes[name] = array(Eigen::MatrixXd(Eigen::Map<const Eigen::MatrixXd>(
        channel.slopes.data(), samples, static_cast<Eigen::Index>(paths))));
  }
  return py::make_tuple(values, units, slopes);
}

namespace {

/// Runs a test; returns (values, units, slopes, notes).
py::tuple run_test(const Model& model,
                   const std::string& text,
                   const std::vector<std::string>& paths) {
  const auto test = test_of(text);
  if (!experiment::can(model.kind(), *test)) {
    std::string able;
    for (const std::string& one : language().kinds_for(test->needs()))
      able += (able.empty() ? "" : ", ") + one;
    throw InputError("a " + model.kind().in_words() + " cannot do this test (" + test->in_words() +
                     "): the kind must be one of " + able);
  }
  check_slopes(model, *test, paths);
  const SpecimenKind* kind = &model.kind();
  auto found = long_call<Result<Recorded>>(
      [kept = model.kept(), kind, numbers = model.numbers(), test, paths](
          const Abandonment& abandonment) {
        return record(*kept, *kind, numbers, *test, paths, abandonment);
      });
  if (!found) raise(found.failure());
  return arrays_of(found->channels, paths.size()) + py::make_tuple(found->notes);
}

py::dict known_tests() {
  py::dict all;
  for (const experiment::TestKind* test : language().tests)
    all[py::str(test->name)] = py::make_tuple(test->in_words, language().kinds_for(test->needs));
  return all;
}

}  // namespace

void bind_models(py::module_& module) {
  py::class_<Model>(
      module,
      "Model",
      "A model as data: its numbers, in SI, are accessed by their paths. Copies are independent.")
      .def(
          "__getitem__",
          [](const Model& m, const std::string& path) { return m.numbers().get(path); },
          py::arg("path"))
      .def(
          "__setitem__",
          [](Model& m, const std::string& path, double value) {
            m.numbers().set(path, value);
            warn_of_unit(path, m.numbers().unit(path), value);
          },
          py::arg("path"),
          py::arg("value"))
      .def(
          "__setitem__",
          [](Model& m, const std::string& path, const std::string& quantity) {
            const std::string line = "value = " + toml_text(quantity);
            const Document read = Document::parse(line, path);
            m.numbers().set(path, read.root().quantity("value", m.numbers().unit(path), Range{}));
          },
          py::arg("path"),
          py::arg("quantity"),
          "Sets a number: one in SI, or a text with a unit such as \"100 kN/mm\".")
      .def(
          "unit",
          [](const Model& m, const std::string& path) { return m.numbers().unit(path); },
          py::arg("path"),
          "The SI unit of the number at a path.")
      .def(
          "paths",
          [](const Model& m) { return m.numbers().paths(); },
          "Every path that leads to a number.")
      .def(
          "knows_slopes",
          [](const Model& m, const std::string& path) {
            m.numbers().get(path);
            return m.kind().knows_slopes_in(path);
          },
          py::arg("path"),
          "True if the model has slopes in this number: test(..., slopes=[path]).")
      .def(
          "check",
          [](const Model& m) { m.kind().check(m.numbers()); },
          "Raises InputError if no specimen can be made from these numbers.")
      .def(
          "describe",
          [](const Model& m) { return m.kind().describe(m.numbers()); },
          "A description in one line.")
      .def(
          "text",
          [](const Model& m) { return m.kind().text(m.numbers()); },
          "The text of a file with these numbers.")
      .def("copy", [](const Model& m) { return Model(m.kind(), m.numbers()); })
      .def("__copy__", [](const Model& m) { return Model(m.kind(), m.numbers()); })
      .def("__deepcopy__",
           [](const Model& m, const py::dict&) { return Model(m.kind(), m.numbers()); })
      .def_property_readonly("kind", [](const Model& m) { return m.kind().name(); })
      .def_property_readonly("file", [](const Model& m) { return m.numbers().file(); })
      .def("__repr__", [](const Model& m) {
        return "<latsch.Model " + m.kind().name() + " of " + m.numbers().file() + ">";
      });
  module.def("read_model",
             &read_model,
             py::arg("file"),
             py::arg("kind") = py::none(),
             "Reads a model's file. kind: needed for a file that can be read as more than one kind "
             "of model (a .tir\nfile as \"magic_formula\" or \"rigid_ring\").");
  module.def("_test", &run_test);
  module.def("tests",
             &known_tests,
             "All kinds of tests: {name: (description, [kinds of models that support it])}.");
}

}  // namespace latsch::python
