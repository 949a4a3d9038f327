// Snapshots of one simulation, and films of them.

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <utility>

#include "bindings.h"
#include "calls.h"
#include "particles.h"
#include "wheatstone/app/particle_frames.h"
#include "wheatstone/app/snapshot_series.h"
#include "wheatstone/error.h"

namespace wheatstone::python {
namespace {

namespace py = pybind11;

/// A series, which is read by one call at a time.
struct PySeries {
  std::string pattern;
  SnapshotSeries files;
  std::shared_ptr<SeriesReader> reader;
  CloudSource first;  ///< what the first file tells
};

PySeries open_series(const std::string& pattern) {
  return result_of([pattern](const Progress& /*progress*/) {
    PySeries series{.pattern = pattern};
    with_files([&] {
      std::optional<SnapshotSeries> found = find_series(pattern);
      if (!found)
        throw Error(
            ErrorKind::wrong_usage,
            fmt::format("path: is '{}', expected a name with a number for the snapshots, as snap_%03d.hdf5", pattern));
      series.files = *found;
      series.first = told_by(open_cloud(found->files.front()));
      series.reader = std::make_shared<SeriesReader>(*std::move(found), CloudChoice());
    });
    return series;
  });
}

std::shared_ptr<PyParticles> particles_between(const PySeries& series, double time) {
  const std::vector<double>& times = series.files.times;
  if (!(time >= times.front() && time <= times.back()))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("time: is {}, expected from {} to {}", time, times.front(), times.back()));
  // The time of a universe that expands is its scale factor.
  const std::optional<double> redshift = series.first.redshift ? std::optional(1 / time - 1) : std::nullopt;
  return result_of([series, time, redshift](const Progress& progress) {
    auto particles = std::make_shared<PyParticles>(
        PyParticles{.name = series.pattern, .source = series.first, .redshift = redshift, .time = time});
    with_files([&] { particles->cloud = series.reader->at(time, progress); });
    return particles;
  });
}

/// The frames of a film: what is the same in all of them is held.
struct PyFrames {
  cli::RenderArguments arguments;
  std::shared_ptr<ParticleFrames> frames;
};

PyFrames frames_of(const PySeries& series, const CallOptions& call, int count, float orbit_deg) {
  PyFrames made{.arguments = cli::arguments_of_call({}, call)};
  ParticleFramesOptions options{
      .particles = cli::render_options_from(made.arguments), .count = count, .orbit_deg = orbit_deg, .path = {}};
  made.frames = result_of([pattern = series.pattern, options](const Progress& progress) {
    std::shared_ptr<ParticleFrames> frames;
    with_files([&] { frames = std::make_shared<ParticleFrames>(pattern, options, progress); });
    return frames;
  });
  return made;
}

py::tuple frame_of(const PyFrames& film, int number) {
  return views_and_facts(result_of([film, number](const Progress& progress) {
    RenderedParticles made;
    with_files([&] { made = film.frames->frame(number, progress); });
    annotate_as_asked(film.arguments, made);
    return made;
  }));
}

}  // namespace

void add_series(py::module_& module) {
  py::class_<PyFrames>(module, "Frames")
      .def("__len__", [](const PyFrames& f) { return f.frames->count(); })
      .def("frame", &frame_of);
  py::class_<PySeries>(module, "Series")
      .def(py::init(&open_series))
      .def_property_readonly("files", [](const PySeries& s) { return s.files.files; })
      .def_property_readonly("times", [](const PySeries& s) { return s.files.times; })
      .def("at", &particles_between)
      .def("frames", &frames_of);
}

}  // namespace wheatstone::python
