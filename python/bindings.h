#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "wheatstone/marks/painting.h"
#include "wheatstone/marks/slicing.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/multiview/slice_stack.h"

namespace wheatstone::python {

/// A painting, and the pictures of its eyes: None for an eye that it was not painted for.
struct PyPainting {
  std::shared_ptr<const Painting> painting;
  pybind11::object left, right;
};

/// Slices of particles.
struct PySlices {
  std::shared_ptr<const SliceStack> stack;
};

void add_displays(pybind11::module_& module);
void add_films(pybind11::module_& module);
void add_pages(pybind11::module_& module);
void add_painting(pybind11::module_& module);
void add_particles(pybind11::module_& module);
void add_photographs(pybind11::module_& module);

/// Slicing that keeps the strokes "back" or "front" of a plane. Throws ValueError.
Slicing slicing_of(const std::string& keep);

/// How pictures are matched at a quality's name. Throws ValueError that lists the names.
MatchOptions matching_for(const std::string& quality);

}  // namespace wheatstone::python
