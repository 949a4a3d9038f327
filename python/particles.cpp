#include <fmt/format.h>
#include <pthread.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "wheatstone/app/render_limits.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/particles/unit_expression.h"

namespace wheatstone::python {
namespace {

namespace py = pybind11;

/// Positions relative to their middle, in double precision until then.
void put_positions(const py::object& given, Cloud& cloud) {
  const std::string expected = "real numbers of shape (number, 3), at least one row";
  const auto array = py::cast<py::array_t<double, py::array::c_style | py::array::forcecast>>(
      real_numbers(given, "positions", expected));
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw py::value_error(
        fmt::format("positions have {} dimensions and {} numbers, expected {}", array.ndim(), array.size(), expected));
  const auto count = static_cast<std::size_t>(array.shape(0));
  const double* const numbers = array.data();
  const std::array<std::vector<float>*, 3> axes{&cloud.x, &cloud.y, &cloud.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cloud.origin[axis] = numbers[axis];
    axes[axis]->resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double along = numbers[3 * i + axis] - cloud.origin[axis];
      if (!(std::abs(along) <= position_range.most) && std::isfinite(numbers[3 * i + axis]))
        throw py::value_error(
            fmt::format("positions are up to {} apart, expected at most {}", std::abs(along), position_range.most));
      (*axes[axis])[i] = static_cast<float>(along);
    }
  }
}

/// Particles, and what messages call them.
struct PyParticles {
  Cloud cloud;
  std::string name, format;
  std::vector<std::pair<std::string, std::string>> units;
};

/// Columns of arrays belong to whoever calls; of files, the library leaves out such particles, and tells their number.
void check_not_negative(const std::vector<float>& column, const std::string& name) {
  const auto wrong = std::ranges::find_if_not(column, [](float number) { return number >= 0; });
  if (wrong != column.end())
    throw py::value_error(
        fmt::format("{} has {} at {}, expected numbers of at least 0", name, *wrong, wrong - column.begin()));
}

std::shared_ptr<PyParticles> particles_at(const py::object& positions, const py::dict& columns) {
  auto particles = std::make_shared<PyParticles>(PyParticles{.name = "positions", .format = "arrays"});
  Cloud& cloud = particles->cloud;
  put_positions(positions, cloud);
  const auto column = [&](const char* name) { return column_of(columns[name], cloud.size(), name); };
  cloud.density = column("density");
  cloud.temperature = column("temperature");
  cloud.smoothing_length = column("smoothing_length");
  cloud.mass = column("mass");
  check_not_negative(cloud.smoothing_length, "smoothing_length");
  check_not_negative(cloud.mass, "mass");
  return particles;
}

/// The libraries behind some formats are for one thread at a time. A process is forked between two files, not within
/// one: its child would never see the end.
std::mutex reading;

void fork_between_files() {
  ::pthread_atfork([] { reading.lock(); }, [] { reading.unlock(); }, [] { reading.unlock(); });
}

std::shared_ptr<PyParticles> load_particles(const std::filesystem::path& path) {
  return result_of([path](const Progress& progress) {
    const std::scoped_lock alone(reading);
    const CloudSource source = open_cloud(path);
    auto particles = std::make_shared<PyParticles>(
        PyParticles{read_cloud(source, path, progress), path.string(), source.format, source.units});
    for (auto& [name, unit] : particles->units) unit = unit_expression(unit);
    return particles;
  });
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

RenderParticlesOptions render_options(int views, std::pair<int, int> size, float span) {
  RenderParticlesOptions options;
  options.views = views;
  options.width = size.first;
  options.height = size.second;
  options.span = span;
  return options;
}

using Particles = std::shared_ptr<PyParticles>;

RenderedParticles rendered(const Particles& particles, const RenderParticlesOptions& options) {
  return result_of([particles, options](const Progress& progress) {
    return render_ready(ready_particles(particles->cloud, particles->name, options, progress), options, progress);
  });
}

py::array views_of(const Particles& particles, const RenderParticlesOptions& options) {
  return array_of(rendered(particles, options).rendered.views);
}

/// The central view's column densities, and how large a pixel is in the scene.
py::tuple column_density(const Particles& particles, RenderParticlesOptions options) {
  options.framing.orthographic = true;
  options.values = true;
  RenderedParticles made = rendered(particles, options);
  const Camera& camera = made.scene.camera;
  return py::make_tuple(array_of(std::move(made.values.front().column)), camera.orthographic_depth / camera.focal_px);
}

PySlices slices_of(const Particles& particles, RenderParticlesOptions options) {
  options.slices = options.without_views = true;
  return {std::make_shared<const SliceStack>(rendered(particles, options).stack)};
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

void add_options(py::module_& module) {
  py::class_<RenderParticlesOptions>(module, "RenderOptions")
      .def(py::init(&render_options))
      .def_property(
          "azimuth", [](const RenderParticlesOptions& o) { return o.framing.azimuth_deg; },
          [](RenderParticlesOptions& o, float value) { o.framing.azimuth_deg = value; })
      .def_property(
          "elevation", [](const RenderParticlesOptions& o) { return o.framing.elevation_deg; },
          [](RenderParticlesOptions& o, float value) { o.framing.elevation_deg = value; })
      .def_property(
          "zoom", [](const RenderParticlesOptions& o) { return o.framing.zoom; },
          [](RenderParticlesOptions& o, float value) { o.framing.zoom = value; })
      .def_property(
          "exposure", [](const RenderParticlesOptions& o) { return o.rendering.exposure; },
          [](RenderParticlesOptions& o, float value) {
            check_number("exposure", value, exposure_range);
            o.rendering.exposure = value;
            o.appearance.look = Look::thesis;  // the only one that has an exposure
          });
}

}  // namespace

void add_particles(py::module_& module) {
  add_options(module);
  py::class_<PyParticles, std::shared_ptr<PyParticles>>(module, "Particles")
      .def(py::init(&particles_at))
      .def("__len__", [](const PyParticles& p) { return p.cloud.size(); })
      .def("positions", &positions_of)
      .def_readonly("format", &PyParticles::format)
      .def_readonly("units", &PyParticles::units)
      .def_property_readonly("box_size", [](const PyParticles& p) { return p.cloud.box_size; })
      .def_property_readonly("density", [](const py::object& p) { return column_in(p, &Cloud::density); })
      .def_property_readonly("temperature", [](const py::object& p) { return column_in(p, &Cloud::temperature); })
      .def_property_readonly("mass", [](const py::object& p) { return column_in(p, &Cloud::mass); })
      .def_property_readonly("smoothing_length",
                             [](const py::object& p) { return column_in(p, &Cloud::smoothing_length); });
  fork_between_files();
  module.def("load_particles", &load_particles);
  module.def("holds_particles", [](const std::filesystem::path& path) {
    return result_of([path](const Progress& /*progress*/) {
      const std::scoped_lock alone(reading);
      return holds_particles(path);
    });
  });
  module.def("render", &views_of);
  module.def("column_density", &column_density);
  module.def("column_unit", &column_unit);
  module.def("slices", &slices_of);
  add_slices(module);
}

}  // namespace wheatstone::python
