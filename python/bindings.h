#pragma once

#include <pybind11/pybind11.h>

namespace wheatstone::python {

void add_painting(pybind11::module_& module);
void add_particles(pybind11::module_& module);

}  // namespace wheatstone::python
