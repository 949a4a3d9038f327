// The module _wheatstone, which the package wheatstone wraps.

#include <pybind11/pybind11.h>

#include <exception>
#include <filesystem>
#include <string>

#include "bindings.h"
#include "calls.h"
#include "particles.h"
#include "wheatstone/app/process_memory.h"
#include "wheatstone/error.h"

namespace py = pybind11;

namespace {

/// Raises; names of files may be any bytes.
void raise(PyObject* kind, const std::string& message) {
  PyErr_SetObject(kind, py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefault(message.c_str())).ptr());
}

PyObject* kind_of(wheatstone::ErrorKind kind) {
  switch (kind) {
    case wheatstone::ErrorKind::cannot_read_write:
      return PyExc_OSError;
    case wheatstone::ErrorKind::interrupted:
      return PyExc_KeyboardInterrupt;
    default:
      return PyExc_ValueError;
  }
}

/// Our errors, and those of the system, as Python's own kinds.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const wheatstone::Error& error) {
    raise(kind_of(error.kind()), error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    raise(PyExc_OSError, error.path1().string() + ": " + error.code().message());
  }
}

}  // namespace

PYBIND11_MODULE(_wheatstone, module) {
  module.attr("__version__") = WHEATSTONE_VERSION;
  py::register_exception_translator(translate);
  wheatstone::use_huge_pages();
  wheatstone::python::add_end_of_calls(module);
  wheatstone::python::add_painting(module);
  wheatstone::python::add_particles(module);
  wheatstone::python::add_render(module);
  wheatstone::python::add_series(module);
  wheatstone::python::add_photographs(module);
  wheatstone::python::add_films(module);
  wheatstone::python::add_displays(module);
  wheatstone::python::add_pages(module);
}
