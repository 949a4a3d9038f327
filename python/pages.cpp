#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/share/page.h"
#include "wheatstone/share/share_pictures.h"

namespace wheatstone::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

/// A page of what `share`, which owns all that it uses, makes.
template <class Share>
std::string page_of(const PageWords& words, Share share) {
  return result_of([words, share = std::move(share)](const Progress& progress) mutable {
    return html_page(share(progress), words);
  });
}

std::string page_of_painting(const PyPainting& painting, const PageWords& words) {
  return page_of(words, [painting = painting.painting, words](const Progress& /*progress*/) {
    return share_painting(*painting, {.title = words.title});
  });
}

std::string page_of_slices(const PySlices& slices, const PageWords& words) {
  return page_of(words, [stack = slices.stack, words](const Progress& /*progress*/) {
    return share_slices(*stack, {.title = words.title});
  });
}

std::string page_of_views(const py::object& given, const PageWords& words) {
  return page_of(words, [views = views_in(given, "views"), words](const Progress& /*progress*/) {
    return share_views(views, words.title);
  });
}

/// Matched where no disparity is given.
std::string page_of_photograph(const py::object& left, const py::object& right, const py::object& disparity,
                               const PageWords& words) {
  StereoPair pair = pair_in(left, right);
  PaintPhotographOptions options;
  if (!disparity.is_none()) options.left_disparity = copy_of(disparities_in(disparity, "disparity"));
  return page_of(words, [pair = std::move(pair), options = std::move(options), words](const Progress& progress) {
    return share_photograph(pair, find_geometry(pair, options, progress).geometry, words.title);
  });
}

/// A film stays beside the page where it is large; ValueError where the page has no place in a folder (empty).
std::string page_of_film(const fs::path& film, const std::string& layout, const fs::path& page,
                         const PageWords& words) {
  ShareFilmOptions options{.title = words.title, .page = page};
  if (!layout.empty()) options.layout = find_stereo_layout(layout);
  return page_of(words, [film, options, page](const Progress& /*progress*/) {
    SharedPicture shared = share_film(film, options);
    if (shared.has_file_beside && page.empty())
      throw Error(ErrorKind::wrong_usage, film.string() + ": is too large for the page itself");
    return shared;
  });
}

}  // namespace

void add_pages(py::module_& module) {
  py::class_<PageWords>(module, "PageWords")
      .def(py::init([](std::string title, std::string caption, std::string description) {
        return PageWords{std::move(title), std::move(description), std::move(caption)};
      }));
  module.def("page_of_painting", &page_of_painting);
  module.def("page_of_slices", &page_of_slices);
  module.def("page_of_views", &page_of_views);
  module.def("page_of_photograph", &page_of_photograph);
  module.def("page_of_film", &page_of_film);
  module.def("write_page", [](const fs::path& path, const std::string& page) {
    result_of([=](const Progress& /*progress*/) { write_whole_file(path, page); });
  });
}

}  // namespace wheatstone::python
