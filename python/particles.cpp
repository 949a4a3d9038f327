#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <string>

#include "arrays.h"
#include "bindings.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/particles/cloud_source.h"

namespace wheatstone::python {
namespace {

namespace py = pybind11;

/// Positions relative to their middle, in double precision until then.
void put_positions(const py::object& given, Cloud& cloud) {
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!array || array.ndim() != 2 || array.shape(1) != 3) {
    PyErr_Clear();
    throw py::value_error("positions are not an array of shape (number, 3)");
  }
  const auto count = static_cast<std::size_t>(array.shape(0));
  if (count == 0) throw py::value_error("there are no positions, expected at least one");
  const double* const numbers = array.data();
  const std::array<std::vector<float>*, 3> axes{&cloud.x, &cloud.y, &cloud.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cloud.origin[axis] = numbers[axis];
    axes[axis]->resize(count);
    for (std::size_t i = 0; i < count; ++i)
      (*axes[axis])[i] = static_cast<float>(numbers[3 * i + axis] - cloud.origin[axis]);
  }
}

py::array views_of(const ReadyParticles& particles, const RenderParticlesOptions& options) {
  RenderedParticles rendered;
  {
    const py::gil_scoped_release unlocked;
    rendered = render_ready(particles, options, with_signals());
  }
  return array_of(rendered.rendered.views);
}

RenderParticlesOptions options_for(int views, std::pair<int, int> size, float span) {
  RenderParticlesOptions options;
  options.views = views;
  options.width = size.first;
  options.height = size.second;
  options.span = span;
  return options;
}

/// Positions and what else is known of the particles, ready to be rendered.
ReadyParticles ready(const py::object& positions, const py::dict& columns, const RenderParticlesOptions& options) {
  Cloud cloud;
  put_positions(positions, cloud);
  const auto column = [&](const char* name) { return column_of(columns[name], cloud.size(), name); };
  cloud.density = column("density");
  cloud.temperature = column("temperature");
  cloud.smoothing_length = column("smoothing_length");
  cloud.mass = column("mass");
  const py::gil_scoped_release unlocked;
  return ready_particles(std::move(cloud), "positions", options, with_signals());
}

py::array render_positions(const py::object& positions, const py::dict& columns,
                           const RenderParticlesOptions& options) {
  return views_of(ready(positions, columns, options), options);
}

/// The central view's column densities, and how large a pixel is in the scene.
py::tuple column_density(const py::object& positions, const py::dict& columns, RenderParticlesOptions options) {
  options.framing.orthographic = true;
  options.values = true;
  const ReadyParticles particles = ready(positions, columns, options);
  RenderedParticles rendered;
  {
    const py::gil_scoped_release unlocked;
    rendered = render_ready(particles, options, with_signals());
  }
  const Camera& camera = rendered.scene.camera;
  return py::make_tuple(array_of(std::move(rendered.values.front().column)),
                        camera.orthographic_depth / camera.focal_px);
}

py::array render_file(const std::filesystem::path& path, const RenderParticlesOptions& options) {
  ReadyParticles ready;
  {
    const py::gil_scoped_release unlocked;
    ready = read_particles(path, options, with_signals());
  }
  return views_of(ready, options);
}

}  // namespace

void add_particles(py::module_& module) {
  py::class_<RenderParticlesOptions>(module, "RenderOptions")
      .def(py::init(&options_for))
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
            o.rendering.exposure = value;
            o.appearance.look = Look::thesis;  // the only one that has an exposure
          });
  module.def("render_positions", &render_positions);
  module.def("column_density", &column_density);
  module.def("render_file", &render_file);
}

}  // namespace wheatstone::python
