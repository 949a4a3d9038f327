#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "wheatstone/app/painted_film.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/files/input_guard.h"
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

  PyFilm(const std::string& path, const std::string& layout, const FilmReaderOptions& options)
      : files(find_film(path, layout_named(layout))), reading(options), source(open_film(files, options)) {}

  static std::optional<StereoLayout> layout_named(const std::string& name) {
    if (name.empty()) return std::nullopt;
    const std::optional<StereoLayout> layout = find_stereo_layout(name);
    if (!layout) throw py::value_error(fmt::format("layout is '{}', expected {}", name, stereo_layout_names()));
    return layout;
  }

  bool next(StereoFrame& frame) {
    const py::gil_scoped_release unlocked;
    return source.read(frame);
  }
};

/// From and to which second of a film, and every how many-th frame.
using Part = std::tuple<std::optional<double>, std::optional<double>, int>;

std::unique_ptr<PyFilm> opened(const std::string& path, const std::string& layout, const Part& part) {
  const auto& [from, to, every] = part;
  return std::make_unique<PyFilm>(path, layout, FilmReaderOptions{.from_s = from, .to_s = to, .every = every});
}

double seconds_of(const StereoFrame& frame) { return static_cast<double>(frame.pts) * frame.time_base.value(); }

py::object eye(Image<Rgb8> picture) { return picture.empty() ? py::none() : py::object(array_of(std::move(picture))); }

/// The eyes of the next moment, and its time; None at the end.
py::object next_frame(PyFilm& film) {
  StereoFrame frame;
  if (!film.next(frame)) return py::none();
  const double seconds = seconds_of(frame);
  return py::make_tuple(array_of(std::move(frame.left)), eye(std::move(frame.right)), seconds);
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
  std::unique_ptr<PyFilm> film;
  RotoscopeOptions options;
  RotoscopeState state;
};

RotoscopeOptions options_for(const Style& style, std::optional<float> depth_budget) {
  RotoscopeOptions options{.style = style};
  options.depth_budget = depth_budget;
  return options;
}

/// The next painted frame, its time and whether a scene begins; None at the end.
py::object next_painting(PyRotoscoping& rotoscoping) {
  StereoFrame frame;
  if (!rotoscoping.film->next(frame)) return py::none();
  const double seconds = seconds_of(frame);
  RotoscopedFrame made;
  {
    const py::gil_scoped_release unlocked;
    made = rotoscope_frame({std::move(frame.left), std::move(frame.right)}, rotoscoping.options, rotoscoping.state,
                           nullptr, with_signals());
  }
  auto* const two = std::get_if<StereoPair>(&made.pictures);
  StereoPair eyes = two != nullptr ? std::move(*two) : StereoPair{std::get<Image<Rgb8>>(std::move(made.pictures)), {}};
  return py::make_tuple(
      PyPainting{std::move(made.painting), array_of(std::move(eyes.left)), eye(std::move(eyes.right))}, seconds,
      made.scene_begins);
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

py::dict rotoscope_to(PyRotoscoping& rotoscoping, const fs::path& output, FilmWriterOptions writing, bool resume,
                      const py::object& told) {
  RotoscopeFilmOptions options = film_options(*rotoscoping.film, output, rotoscoping.options, std::move(writing));
  options.resume = resume;
  RotoscopedFilm film;
  {
    const py::gil_scoped_release unlocked;
    film = rotoscope_film(rotoscoping.film->source, output, options, with_signals(told));
  }
  py::dict result;
  result["frames"] = film.frames;
  result["scenes"] = film.totals.scenes;
  result["seconds"] = film.seconds;
  result["notes"] = film.notes;
  return result;
}

}  // namespace

void add_films(py::module_& module) {
  py::class_<PyFilm>(module, "Film").def("next", &next_frame).def("facts", &facts_of);
  module.def("is_film", [](const fs::path& path) { return is_film(path); });
  module.def("open_film", &opened);
  py::class_<PyRotoscoping>(module, "Rotoscoping")
      .def(py::init([](const std::string& path, const std::string& layout, const Part& part, const Style& style,
                       std::optional<float> depth_budget) {
        return PyRotoscoping{opened(path, layout, part), options_for(style, depth_budget), {}};
      }))
      .def("next", &next_painting)
      .def("write", [](PyRotoscoping& rotoscoping, const fs::path& output, const std::string& codec,
                       std::optional<double> crf, bool resume, const py::object& told) {
        return rotoscope_to(rotoscoping, output, {.codec = codec, .crf = crf}, resume, told);
      });
}

}  // namespace wheatstone::python
