#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "wheatstone/app/painted_film.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/files/output_paths.h"
#include "wheatstone/number_range.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

/// A film of one or two eyes, opened, and what it was opened with.
struct PyFilm {
  FilmFiles files;
  FilmReaderOptions reading;
  StereoFilmReader source;
  std::mutex use;  ///< by one call at a time

  PyFilm(const std::string& path, const std::string& layout, const FilmReaderOptions& options)
      : files(find_film(path, layout_named(layout))), reading(options), source(open_film(files, options)) {}

  static std::optional<StereoLayout> layout_named(const std::string& name) {
    if (name.empty()) return std::nullopt;
    const std::optional<StereoLayout> layout = find_stereo_layout(name);
    if (!layout) throw py::value_error(fmt::format("layout is '{}', expected {}", name, stereo_layout_names()));
    return layout;
  }

  std::optional<StereoFrame> next() {
    StereoFrame frame;
    return source.read(frame) ? std::optional(std::move(frame)) : std::nullopt;
  }
};

/// From and to which second of a film, and every how many-th frame.
using Part = std::tuple<std::optional<double>, std::optional<double>, int>;

std::shared_ptr<PyFilm> opened(const std::string& path, const std::string& layout, const Part& part) {
  const auto& [from, to, every] = part;
  constexpr NumberRange moments_s{0, 1e9};
  if (from) check_number("start", *from, moments_s);
  if (to) check_number("end", *to, moments_s);
  const FilmReaderOptions options{.from_s = from, .to_s = to, .every = every};
  return result_of([=](const Progress& /*progress*/) { return std::make_shared<PyFilm>(path, layout, options); });
}

double seconds_of(const StereoFrame& frame) { return static_cast<double>(frame.pts) * frame.time_base.value(); }

py::object eye(Image<Rgb8> picture) { return picture.empty() ? py::none() : py::object(array_of(std::move(picture))); }

/// The eyes of the next moment, and its time; None at the end.
py::object next_frame(const std::shared_ptr<PyFilm>& film) {
  std::optional<StereoFrame> frame = result_of([film](const Progress& /*progress*/) {
    const std::scoped_lock alone(film->use);
    return film->next();
  });
  if (!frame) return py::none();
  const double seconds = seconds_of(*frame);
  return py::make_tuple(array_of(std::move(frame->left)), eye(std::move(frame->right)), seconds);
}

py::dict facts_of(const PyFilm& film) {
  const FilmFacts& facts = film.source.facts();
  py::dict result;
  result["frame_rate"] = facts.frame_rate.value();
  result["duration"] = facts.duration_s;
  result["frame_count"] = facts.frame_count;
  result["codec"] = facts.codec;
  result["layout"] = layout_name(film.source.layout());
  return result;
}

/// A film that is painted frame by frame.
struct PyRotoscoping {
  std::shared_ptr<PyFilm> film;
  RotoscopeOptions options;
  RotoscopeState state;
};

RotoscopeOptions options_for(const Style& style, std::optional<float> depth_budget) {
  constexpr NumberRange budgets{0.001, 1};
  if (depth_budget) check_number("depth_budget", *depth_budget, budgets);
  RotoscopeOptions options{.style = style};
  options.depth_budget = depth_budget;
  return options;
}

using Rotoscoping = std::shared_ptr<PyRotoscoping>;

/// The next painted frame, its time and whether a scene begins; None at the end.
py::object next_painting(const Rotoscoping& rotoscoping) {
  auto next = result_of([rotoscoping](const Progress& progress) -> std::optional<std::pair<RotoscopedFrame, double>> {
    const std::scoped_lock alone(rotoscoping->film->use);
    std::optional<StereoFrame> frame = rotoscoping->film->next();
    if (!frame) return std::nullopt;
    const double seconds = seconds_of(*frame);
    return std::pair{rotoscope_frame({std::move(frame->left), std::move(frame->right)}, rotoscoping->options,
                                     rotoscoping->state, nullptr, progress),
                     seconds};
  });
  if (!next) return py::none();
  auto& [made, seconds] = *next;
  auto* const two = std::get_if<StereoPair>(&made.pictures);
  StereoPair eyes = two != nullptr ? std::move(*two) : StereoPair{std::get<Image<Rgb8>>(std::move(made.pictures)), {}};
  return py::make_tuple(PyPainting{std::make_shared<const Painting>(std::move(made.painting)),
                                   array_of(std::move(eyes.left)), eye(std::move(eyes.right))},
                        seconds, made.scene_begins);
}

/// As `wheatstone rotoscope` makes a film.
RotoscopeFilmOptions film_options(const PyFilm& film, const fs::path& output, const RotoscopeOptions& frames,
                                  FilmWriterOptions writing) {
  check_not_an_input(output, std::array{film.files.film, film.files.right});
  RotoscopeFilmOptions options{.frames = frames, .reading = film.reading};
  writing.layout = layout_of_painted_film(film.source, !film.files.right.empty());
  write_as_source(film.files.film, film.source.facts(), film.reading, writing);
  options.writing = std::move(writing);
  options.made_by = fmt::format("wheatstone {} from {}", WHEATSTONE_VERSION, layout_name(film.source.layout()));
  options.made_from.push_back(film.files.film);
  if (!film.files.right.empty()) options.made_from.push_back(film.files.right);
  options.expected_frames = expected_frames(film.source.facts(), film.reading);
  return options;
}

/// A film that is painted in the background.
struct PyJob {
  std::shared_ptr<Call> call;
  std::shared_ptr<RotoscopedFilm> made = std::make_shared<RotoscopedFilm>();
};

PyJob rotoscope_to(const Rotoscoping& rotoscoping, const fs::path& output, FilmWriterOptions writing, bool resume) {
  PyJob job;
  job.call = Call::start([=, made = job.made](const Progress& progress) {
    const std::scoped_lock alone(rotoscoping->film->use);
    RotoscopeFilmOptions options = film_options(*rotoscoping->film, output, rotoscoping->options, writing);
    options.resume = resume;
    *made = rotoscope_film(rotoscoping->film->source, output, options, progress);
  });
  return job;
}

/// Of a job that has ended. Throws what it threw.
py::dict result_of_job(const PyJob& job) {
  if (const std::exception_ptr failure = job.call->failure()) std::rethrow_exception(failure);
  py::dict result;
  result["frames"] = job.made->frames;
  result["scenes"] = job.made->totals.scenes;
  result["seconds"] = job.made->seconds;
  result["notes"] = job.made->notes;
  return result;
}

void add_job(py::module_& module) {
  py::class_<PyJob>(module, "Job")
      .def_property_readonly("step", [](const PyJob& job) { return job.call->step(); })
      .def_property_readonly("done", [](const PyJob& job) { return job.call->done(); })
      .def("cancel", [](const PyJob& job) { job.call->cancel(); })
      .def("is_cancelled", [](const PyJob& job) { return job.call->is_cancelled(); })
      .def("has_ended", [](const PyJob& job) { return job.call->has_ended(); })
      .def("wait", [](const PyJob& job, std::optional<double> seconds) { return job.call->wait(seconds); })
      .def("result", &result_of_job);
}

}  // namespace

void add_films(py::module_& module) {
  py::class_<PyFilm, std::shared_ptr<PyFilm>>(module, "Film").def("next", &next_frame).def("facts", &facts_of);
  add_job(module);
  module.def("is_film", [](const fs::path& path) {
    return result_of([path](const Progress& /*progress*/) { return is_film(path); });
  });
  module.def("open_film", &opened);
  py::class_<PyRotoscoping, Rotoscoping>(module, "Rotoscoping")
      .def(py::init([](const std::string& path, const std::string& layout, const Part& part, const Style& style,
                       std::optional<float> depth_budget) {
        return std::make_shared<PyRotoscoping>(
            PyRotoscoping{opened(path, layout, part), options_for(style, depth_budget), {}});
      }))
      .def("next", &next_painting)
      .def("write", [](const Rotoscoping& rotoscoping, const fs::path& output, const std::string& codec,
                       std::optional<double> crf, bool resume) {
        return rotoscope_to(rotoscoping, output, {.codec = codec, .crf = crf}, resume);
      });
}

}  // namespace wheatstone::python
