// SPDX-License-Identifier: Apache-2.0
// The Python extension module latsch._latsch: the libraries of the program without additions.
// Python code in apps/python/latsch adds the convenient interface.
#include <pybind11/pybind11.h>

#include "base/error.h"
#include "bindings/bindings.h"
#include "evaluation/journal/trial_store.h"
#include "numerics/kernels/kernel_set.h"

namespace py = pybind11;

namespace {

py::object class_of_errors(const char* name) {
  return py::module_::import("latsch._errors").attr(name);
}

/// Translates InputError, with its file and line, and JournalError to Python exceptions.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const latsch::InputError& error) {
    const py::object type = class_of_errors("InputError");
    PyErr_SetObject(type.ptr(), type(error.what(), error.place().file, error.place().line).ptr());
  } catch (const latsch::JournalError& error) {
    const py::object type = class_of_errors("JournalError");
    PyErr_SetObject(type.ptr(), type(error.what()).ptr());
  }
}

}  // namespace

PYBIND11_MODULE(_latsch, module) {
  using namespace latsch::python;
  module.doc() = "Latsch's libraries; see the package latsch.";
  py::register_exception_translator(translate);
  module.def(
      "kernels",
      [] { return std::string(latsch::name(latsch::kernel_set())); },
      "The set of vector instructions in use: \"baseline\", \"avx2\" or \"avx512\".");
  bind_spaces(module);
  bind_designs(module);
  bind_optimizers(module);
  bind_identifiability(module);
  bind_models(module);
  bind_studies(module);
}
