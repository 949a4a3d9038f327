#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/app/slice_film.h"
#include "wheatstone/display/anaglyph.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/display/wiggle.h"
#include "wheatstone/error.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

using Views = std::vector<Image<Rgb8>>;

std::optional<AnaglyphKind> anaglyph_named(const std::string& name) {
  const auto kinds = anaglyph_kinds();
  if (name == "anaglyph") return kinds.front();
  const auto found = std::ranges::find(kinds, name, &AnaglyphKind::name);
  return found == kinds.end() ? std::nullopt : std::optional(*found);
}

[[noreturn]] void refuse_format(const std::string& name) {
  std::string names = "quilt, lenticular, anaglyph";
  for (const AnaglyphKind& kind : anaglyph_kinds()) names += fmt::format(", {}", kind.name);
  for (const std::string_view layout : layout_names()) names += fmt::format(", {}", layout);
  throw py::value_error(fmt::format("to is '{}', expected one of: {}", name, names));
}

/// One picture of two views.
Image<Rgb8> packed_pair(const Views& views, const std::string& to) {
  const std::optional<AnaglyphKind> kind = anaglyph_named(to);
  const std::optional<StereoLayout> layout = find_stereo_layout(to);
  if (!kind && !(layout && is_packed(*layout))) refuse_format(to);
  if (views.size() != 2) throw py::value_error(fmt::format("there are {} views, expected 2 for {}", views.size(), to));
  if (kind) return anaglyph(StereoPairView{views[0], views[1]}, *kind);
  return put_together(views[0], views[1], *layout);
}

py::array pack(const py::object& given, const std::string& to, std::pair<int, int> quilt, const std::string& screen,
               float screen_disparity) {
  return array_of(result_of([=, views = views_in(given, "views")](const Progress& /*progress*/) mutable {
    if (screen_disparity != 0) views = shifted_views(std::move(views), screen_disparity);
    if (to == "quilt") return make_quilt(views, {quilt.first, quilt.second});
    if (to == "lenticular") return interleave(views, find_lenticular(screen));
    return packed_pair(views, to);
  }));
}

/// Writes views to one file, by its ending.
void write_views(const fs::path& path, const Views& views) {
  const std::string ending = path.extension().string();
  if (ending == ".mpo") {
    write_mpo(path, std::vector<ImageView<const Rgb8>>(views.begin(), views.end()));
  } else if (ending == ".exr") {
    write_multiview_exr(path, views);
  } else if (ending == ".gif" || ending == ".webp") {
    write_wiggle(path, views);
  } else if (ending == ".jps" && views.size() == 2) {
    write_jps(path, views[0], views[1]);
  } else {
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: {} views, expected a name that ends in .mpo, .exr, .gif or .webp; .jps holds "
                            "2 views; other pictures are made by pack()",
                            path.string(), views.size()));
  }
}

py::dict measure(const py::object& left, const py::object& right, const py::object& disparity) {
  const PairMeasures measured =
      result_of([pair = pair_in(left, right), truth = copy_of(disparities_in(disparity, "disparity"))](
                    const Progress& /*progress*/) { return measure_pair(pair, truth); });
  py::dict result;
  result["mean_absolute_difference"] = measured.difference.mean_absolute;
  result["rmse"] = measured.difference.rmse;
  result["compared_share"] = measured.difference.compared_share;
  result["density"] = measured.survival.density;
  result["end_point_error"] = measured.survival.end_point_error;
  result["bad_1"] = measured.survival.bad_1;
  result["bad_2"] = measured.survival.bad_2;
  result["left_gradient_energy"] = measured.left_gradient_energy;
  result["right_gradient_energy"] = measured.right_gradient_energy;
  return result;
}

/// A film in which planes travel through a painting, of the eyes in this format.
void write_slices_film(const PyPainting& painting, const fs::path& path, const std::string& from, const std::string& to,
                       int frames, double rate, const std::string& format, const std::string& keep) {
  SliceFilmOptions options{.slicing = slicing_of(keep),
                           .from = parse_slice_depths(from, "begin"),
                           .to = parse_slice_depths(to, "end"),
                           .frames = frames};
  constexpr int ticks_a_second = 1000;
  options.writing.frame_rate = {static_cast<int>(std::lround(rate * ticks_a_second)), ticks_a_second};
  options.writing.layout = find_stereo_layout(format).value_or(StereoLayout::mono);
  if (options.writing.layout == StereoLayout::mono) options.writing.pixel_format = "yuv444p";
  result_of([painting = painting.painting, path, options, format](const Progress& progress) {
    const auto picture = [&](const Painting& part) { return packed_pair(present(part, for_two_eyes()).views, format); };
    write_slice_film(*painting, picture, path, options, progress);
  });
}

}  // namespace

void add_displays(py::module_& module) {
  module.def("pack", &pack);
  module.def("write_slice_film", &write_slices_film);
  module.def("write_views", [](const fs::path& path, const py::object& given) {
    result_of([path, views = views_in(given, "views")](const Progress& /*progress*/) { write_views(path, views); });
  });
  module.def("write_picture", [](const fs::path& path, const py::object& given) {
    result_of([path, picture = copy_of(picture_in(given, "picture"))](const Progress& /*progress*/) {
      write_image(path, picture);
    });
  });
  module.def("measure", &measure);
}

}  // namespace wheatstone::python
