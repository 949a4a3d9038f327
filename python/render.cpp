// Views, numbers and slices of particles, with the options of `wheatstone render`.

#include <fmt/format.h>
#include <pthread.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "cli/slices_argument.h"
#include "particles.h"
#include "wheatstone/app/annotate.h"
#include "wheatstone/app/render_model_file.h"
#include "wheatstone/error.h"
#include "wheatstone/particles/select.h"
#include "wheatstone/particles/unit_expression.h"

namespace wheatstone::python {
namespace {

namespace py = pybind11;

std::mutex reading;

void fork_between_files() {
  ::pthread_atfork([] { reading.lock(); }, [] { reading.unlock(); }, [] { reading.unlock(); });
}

/// The particles as the options choose them: of a file they are read again where these choose others.
Particles chosen(const Particles& particles, const RenderParticlesOptions& options, const Progress& progress) {
  CloudChoice choice = choice_of(options);
  if (particles->is_file)
    return choice == particles->choice ? particles : read_particles_of(particles->name, choice, progress);
  if (choice.quantity == "quantity" && !particles->cloud.quantity.empty()) choice.quantity.clear();
  choice.origin.reset();
  const std::optional<Condition> where = std::exchange(choice.where, std::nullopt);
  if (choice != CloudChoice())
    throw Error(ErrorKind::wrong_usage,
                "type, position and names of columns choose from a file; these particles are arrays, whose columns are "
                "density, temperature, smoothing_length, mass and quantity");
  if (!where) return particles;
  auto marked = std::make_shared<PyParticles>(*particles);
  mark_chosen(marked->cloud, *where, {}, marked->name, {});
  return marked;
}

RenderedParticles rendered(const Particles& given, const RenderParticlesOptions& options, const Progress& progress) {
  const Particles particles = chosen(given, options, progress);
  RenderedParticles made =
      render_ready(ready_particles(particles->cloud, particles->name, options, progress), options, progress);
  made.format = particles->source.format;
  made.redshift = particles->redshift;
  if (!made.redshift) made.time = particles->time;
  made.units = units_of(particles->source, options, made.has_mass);
  for (std::string& warning : discomforts_of(options)) made.warnings.push_back(std::move(warning));
  return made;
}

/// What a call asks for, of a file where the particles are not there yet.
struct Asked {
  explicit Asked(const CallOptions& call, const std::string& file = {})
      : arguments(cli::arguments_of_call(file, call)), options(cli::render_options_from(arguments)) {}
  cli::RenderArguments arguments;
  RenderParticlesOptions options;
};

py::tuple views_of(const Particles& particles, const CallOptions& call) {
  return views_and_facts(result_of([particles, asked = Asked(call)](const Progress& progress) {
    RenderedParticles made = rendered(particles, asked.options, progress);
    annotate_as_asked(asked.arguments, made);
    return made;
  }));
}

/// Of a file of particles, of a model, or of slices.
py::tuple views_of_file(const std::filesystem::path& file, const CallOptions& call) {
  return views_and_facts(result_of([file, call](const Progress& progress) {
    const Asked asked(call, file.string());
    if (cli::reads_slices(asked.arguments))
      return cli::render_slice_file(file, asked.arguments.given, asked.options, progress);
    if (cli::reads_model(asked.arguments)) return render_model_file(file, asked.options, progress);
    RenderedParticles made =
        rendered(read_particles_of(file, choice_of(asked.options), progress), asked.options, progress);
    annotate_as_asked(asked.arguments, made);
    return made;
  }));
}

/// The central view's numbers, how large a pixel is in the scene, and the numbers' unit.
py::tuple values_of(const Particles& particles, const CallOptions& call) {
  Asked asked(call);
  asked.options.framing.orthographic = true;
  asked.options.values = true;
  RenderedParticles made = result_of([particles, options = asked.options](const Progress& progress) {
    return rendered(particles, options, progress);
  });
  const Camera& camera = made.scene.camera;
  ViewValues& of_view = made.values[made.values.size() / 2];
  return py::make_tuple(array_of(std::move(of_view.mean.empty() ? of_view.column : of_view.mean)),
                        camera.orthographic_depth / camera.focal_px, made.units.value);
}

PySlices slices_of(const Particles& particles, const CallOptions& call) {
  Asked asked(call);
  asked.options.slices = asked.options.without_views = true;
  return {std::make_shared<const SliceStack>(result_of([particles, options = asked.options](const Progress& progress) {
    return rendered(particles, options, progress).stack;
  }))};
}

/// Each option's name, what it takes, its default and its help.
py::list option_rows() {
  cli::RenderArguments arguments;
  py::list rows;
  for (const cli::Row& row : cli::call_rows(arguments))
    rows.append(py::make_tuple(cli::plain_name_of(row),
                               row.value.takes == cli::Value::Takes::nothing ? "True|False" : row.value.type,
                               row.value.fallback, row.help));
  return rows;
}

}  // namespace

CloudSource told_by(CloudSource source) {
  source.next = {};
  source.reuse = {};
  source.skip = {};
  return source;
}

Particles read_particles_of(const std::filesystem::path& path, const CloudChoice& choice, const Progress& progress) {
  auto particles = std::make_shared<PyParticles>();
  with_files([&] {
    const CloudSource source = open_cloud(path, choice);
    *particles = {.cloud = read_cloud(source, path, progress),
                  .name = path.string(),
                  .source = told_by(source),
                  .redshift = source.redshift,
                  .time = source.time,
                  .is_file = true,
                  .choice = choice};
  });
  return particles;
}

void with_files(const std::function<void()>& work) {
  const std::scoped_lock alone(reading);
  work();
}

py::tuple views_and_facts(RenderedParticles made) {
  py::dict facts;
  facts["format"] = made.format;
  facts["particles"] = made.particles;
  facts["method"] = std::string(name_of(made.rendered.method));
  facts["least"] = made.least;
  facts["most"] = made.most;
  facts["quantity"] = made.units.name;
  facts["unit"] = made.units.value;
  facts["length_unit"] = made.units.length;
  facts["redshift"] = made.redshift;
  facts["time"] = made.time;
  facts["warnings"] = made.warnings;
  return py::make_tuple(array_of(made.rendered.views), facts);
}

void annotate_as_asked(const cli::RenderArguments& arguments, RenderedParticles& made) {
  if (!arguments.annotate) return;
  std::vector<std::string> left_out = annotate(made, made.rendered.views, arguments.annotation);
  std::ranges::move(left_out, std::back_inserter(made.warnings));
}

void add_render(py::module_& module) {
  fork_between_files();
  module.def("load_particles", [](const std::filesystem::path& path) {
    return std::const_pointer_cast<PyParticles>(
        result_of([path](const Progress& progress) { return read_particles_of(path, {}, progress); }));
  });
  module.def("holds_particles", [](const std::filesystem::path& path) {
    return result_of([path](const Progress& /*progress*/) {
      bool holds = false;
      with_files([&] { holds = holds_particles(path); });
      return holds;
    });
  });
  module.def("render", &views_of);
  module.def("render_file", &views_of_file);
  module.def("values", &values_of);
  module.def("column_unit", &column_unit);
  module.def("slices", &slices_of);
  module.def("option_rows", &option_rows);
}

}  // namespace wheatstone::python
