#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "particles.h"
#include "wheatstone/app/render_limits.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/particles/unit_expression.h"

namespace wheatstone::python {
namespace {

namespace py = pybind11;
using Units = std::vector<std::pair<std::string, std::string>>;

/// Positions relative to their middle, in double precision until then.
void put_positions(const py::object& given, Cloud& cloud) {
  const std::string expected = "real numbers of shape (number, 3), at least one row";
  const py::array array = real_numbers(given, "positions", expected);
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw py::value_error(
        fmt::format("positions have {} dimensions and {} numbers, expected {}", array.ndim(), array.size(), expected));
  const auto count = static_cast<std::size_t>(array.shape(0));
  const std::array<std::vector<float>*, 3> axes{&cloud.x, &cloud.y, &cloud.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // A column in place, whatever its stride; other kinds of numbers than double precision are converted.
    const auto column = py::cast<py::array_t<double, py::array::forcecast>>(
        py::object(array[py::make_tuple(py::slice(std::nullopt, std::nullopt, std::nullopt), axis)]));
    const auto numbers = column.unchecked<1>();  // borrows
    cloud.origin[axis] = numbers(0);
    axes[axis]->resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double number = numbers(static_cast<py::ssize_t>(i)), along = number - cloud.origin[axis];
      if (!(std::abs(along) <= position_range.most) && std::isfinite(number))
        throw py::value_error(
            fmt::format("positions are up to {} apart, expected at most {}", std::abs(along), position_range.most));
      (*axes[axis])[i] = static_cast<float>(along);
    }
  }
}

/// Columns of arrays belong to whoever calls; of files, the library leaves out such particles, and tells their number.
void check_not_negative(const std::vector<float>& column, const std::string& name) {
  const auto wrong = std::ranges::find_if_not(column, [](float number) { return number >= 0; });
  if (wrong != column.end())
    throw py::value_error(
        fmt::format("{} has {} at {}, expected numbers of at least 0", name, *wrong, wrong - column.begin()));
}

std::shared_ptr<PyParticles> particles_at(const py::object& positions, const py::dict& columns) {
  auto particles = std::make_shared<PyParticles>(PyParticles{.name = "positions", .source = {.format = "arrays"}});
  Cloud& cloud = particles->cloud;
  put_positions(positions, cloud);
  const auto column = [&](const char* name) { return column_of(columns[name], cloud.size(), name); };
  cloud.density = column("density");
  cloud.temperature = column("temperature");
  cloud.smoothing_length = column("smoothing_length");
  cloud.mass = column("mass");
  cloud.quantity = column("quantity");
  check_not_negative(cloud.smoothing_length, "smoothing_length");
  check_not_negative(cloud.mass, "mass");
  return particles;
}

py::array positions_of(const PyParticles& particles) {
  const Cloud& cloud = particles.cloud;
  py::array_t<double> array({static_cast<py::ssize_t>(cloud.size()), py::ssize_t{3}});
  auto to = array.mutable_unchecked<2>();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    to(row, 0) = cloud.origin[0] + cloud.x[i];
    to(row, 1) = cloud.origin[1] + cloud.y[i];
    to(row, 2) = cloud.origin[2] + cloud.z[i];
  }
  return array;
}

/// A column in place, which keeps the particles alive; None where they do not have it.
py::object column_in(const py::object& particles, std::vector<float> Cloud::*column) {
  const std::vector<float>& numbers = particles.cast<const PyParticles&>().cloud.*column;
  if (numbers.empty()) return py::none();
  py::array_t<float> array(static_cast<py::ssize_t>(numbers.size()), numbers.data(), particles);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// As unyt and astropy parse them.
Units units_of_particles(const PyParticles& particles) {
  Units units = particles.source.units;
  for (auto& [name, unit] : units) unit = unit_expression(unit);
  return units;
}

PySlices load_slices(const std::filesystem::path& path) {
  return {std::make_shared<const SliceStack>(
      result_of([path](const Progress& /*progress*/) { return read_slices(path); }))};
}

py::array views_of_slices(const PySlices& slices, int count, float span) {
  return array_of(result_of([stack = slices.stack, count, span](const Progress& progress) {
    const Rig rig = evenly_spaced(stack->width, stack->height, count, span);
    return render_slices(*stack, rig, RenderOptions{}.filter, progress);
  }));
}

void add_slices(py::module_& module) {
  py::class_<PySlices>(module, "Slices")
      .def_property_readonly("width", [](const PySlices& s) { return s.stack->width; })
      .def_property_readonly("height", [](const PySlices& s) { return s.stack->height; })
      .def_property_readonly("span", [](const PySlices& s) { return s.stack->span; })
      .def("__len__", [](const PySlices& s) { return s.stack->slices.size(); })
      .def("views", &views_of_slices)
      .def("save", [](const PySlices& s, const std::filesystem::path& path) {
        result_of([stack = s.stack, path](const Progress& /*progress*/) { write_slices(path, *stack); });
      });
  module.def("load_slices", &load_slices);
}

}  // namespace

void add_particles(py::module_& module) {
  py::class_<PyParticles, std::shared_ptr<PyParticles>>(module, "Particles")
      .def(py::init(&particles_at))
      .def("__len__", [](const PyParticles& p) { return p.cloud.size(); })
      .def("positions", &positions_of)
      .def_property_readonly("format", [](const PyParticles& p) { return p.source.format; })
      .def_property("units", &units_of_particles,
                    [](PyParticles& p, Units units) { p.source.units = std::move(units); })
      .def_property_readonly("box_size", [](const PyParticles& p) { return p.cloud.box_size; })
      .def_property_readonly("density", [](const py::object& p) { return column_in(p, &Cloud::density); })
      .def_property_readonly("temperature", [](const py::object& p) { return column_in(p, &Cloud::temperature); })
      .def_property_readonly("mass", [](const py::object& p) { return column_in(p, &Cloud::mass); })
      .def_property_readonly("smoothing_length",
                             [](const py::object& p) { return column_in(p, &Cloud::smoothing_length); });
  add_slices(module);
}

}  // namespace wheatstone::python
