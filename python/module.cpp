// The module _wheatstone, which the package wheatstone wraps.

#include <pybind11/pybind11.h>

#include "bindings.h"
#include "wheatstone/error.h"

namespace py = pybind11;

namespace {

/// Our errors as Python's own kinds.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const wheatstone::Error& error) {
    switch (error.kind()) {
      case wheatstone::ErrorKind::cannot_read_write:
        return PyErr_SetString(PyExc_OSError, error.what());
      case wheatstone::ErrorKind::interrupted:
        return PyErr_SetString(PyExc_KeyboardInterrupt, error.what());
      default:
        return PyErr_SetString(PyExc_ValueError, error.what());
    }
  }
}

}  // namespace

PYBIND11_MODULE(_wheatstone, module) {
  module.attr("__version__") = WHEATSTONE_VERSION;
  py::register_exception_translator(translate);
  wheatstone::python::add_painting(module);
  wheatstone::python::add_particles(module);
  wheatstone::python::add_photographs(module);
  wheatstone::python::add_films(module);
  wheatstone::python::add_displays(module);
  wheatstone::python::add_pages(module);
}
