#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "wheatstone/app/display_views.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/marks/slicing.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/painting/style_parameters.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::python {
namespace {

namespace py = pybind11;

py::dict match_pictures(const py::object& left, const py::object& right, const std::string& quality) {
  MatchedPair matched = result_of([options = matching_for(quality), pictures = pair_in(left, right)](
                                      const Progress& progress) { return match(pictures, options, progress); });
  py::dict result;
  result["left_disparity"] = array_of(std::move(matched.geometry.left_disparity));
  result["right_disparity"] = array_of(std::move(matched.geometry.right_disparity));
  result["left_occlusion"] = array_of(std::move(matched.geometry.left_occlusion));
  result["right_occlusion"] = array_of(std::move(matched.geometry.right_occlusion));
  result["found_share"] = matched.left_found_share;
  return result;
}

Style style_of(const std::string& preset, const std::map<std::string, std::string>& parameters, std::uint64_t seed) {
  Style style = read_style(preset);
  for (const auto& [name, value] : parameters) {
    const auto known = style_parameters();
    const auto found = std::ranges::find(known, name, &StyleParameter::name);
    if (found == known.end()) throw py::value_error("there is no style parameter '" + name + "'");
    found->set(style, value);
  }
  style.seed = seed;
  return style;
}

std::unique_ptr<PyPainting> painting_of(PaintedPair painted) {
  StereoPair& pictures = painted.pictures;
  return std::make_unique<PyPainting>(PyPainting{std::make_shared<const Painting>(std::move(painted.painting)),
                                                 array_of(std::move(pictures.left)),
                                                 array_of(std::move(pictures.right))});
}

std::unique_ptr<PyPainting> paint_pictures(const py::object& left, const py::object& right, const Style& style,
                                           const std::string& quality, const py::object& disparity,
                                           const py::object& detail) {
  PaintPhotographOptions options{.style = style, .matching = matching_for(quality), .depth_budget = {}};
  StereoPair photographs = pair_in(left, right);
  if (!disparity.is_none()) options.left_disparity = copy_of(disparities_in(disparity, "disparity"));
  if (!detail.is_none()) options.detail = copy_of(levels_in(detail, "detail"));
  return painting_of(
      result_of([photographs = std::move(photographs), options = std::move(options)](const Progress& progress) {
        return paint_photograph(photographs, options, progress).painted;
      }));
}

py::array draw_views(const PyPainting& painting, int count, float span, std::optional<float> screen_disparity) {
  // 0 would leave the choice to the library.
  check_number("span", span, {0.01, view_span_range.most});
  const DisplayViewsOptions options{.views = count,
                                    .width = width_of(*painting.painting),
                                    .height = height_of(*painting.painting),
                                    .span = span,
                                    .zero_parallax_px = screen_disparity};
  return array_of(result_of([painting = painting.painting, options](const Progress& progress) {
    return draw_display_views(*painting, options, progress).shown.views;
  }));
}

/// A painting with the pictures of its eyes.
PaintedPair with_pictures(Painting painting) {
  std::vector<Image<Rgb8>> eyes = present(painting, for_two_eyes()).views;
  return {std::move(painting), {std::move(eyes.front()), std::move(eyes.back())}};
}

std::unique_ptr<PyPainting> sliced_painting(const PyPainting& painting, std::optional<int> layer,
                                            const std::string& depth, const std::string& keep) {
  Slicing slicing = slicing_of(keep);
  if (!depth.empty()) slicing.depths = parse_slice_depths(depth, "depth");
  if (layer) slicing.finest_layer = *layer;
  return painting_of(result_of([painting = painting.painting, slicing](const Progress& /*progress*/) {
    return with_pictures(sliced(*painting, slicing));
  }));
}

std::unique_ptr<PyPainting> load_painting(const std::filesystem::path& path) {
  return painting_of(result_of([path](const Progress& /*progress*/) { return with_pictures(read_painting(path)); }));
}

}  // namespace

Slicing slicing_of(const std::string& keep) {
  if (keep != "back" && keep != "front") throw py::value_error("keep is '" + keep + "', expected back or front");
  return {.keeps = keep == "back" ? SliceKeeps::back : SliceKeeps::front};
}

MatchOptions matching_for(const std::string& quality) {
  const std::optional<MatchQuality> found = match_quality_by_name(quality);
  if (!found) throw py::value_error("quality is '" + quality + "', expected fast, good or best");
  return match_options_for(*found);
}

void add_painting(py::module_& module) {
  py::class_<Style>(module, "Style").def("toml", &style_to_toml);
  module.def("style", &style_of);
  module.def("style_names", [] {
    std::vector<std::string> names;
    for (const StyleParameter& parameter : style_parameters()) names.emplace_back(parameter.name);
    return names;
  });
  py::class_<PyPainting>(module, "Painting")
      .def_readonly("left", &PyPainting::left)
      .def_readonly("right", &PyPainting::right)
      .def_property_readonly("width", [](const PyPainting& p) { return width_of(*p.painting); })
      .def_property_readonly("height", [](const PyPainting& p) { return height_of(*p.painting); })
      .def("views", &draw_views)
      .def("sliced", &sliced_painting)
      .def("save", [](const PyPainting& p, const std::filesystem::path& path) {
        result_of([painting = p.painting, path](const Progress& /*progress*/) { write_painting(path, *painting); });
      });
  module.def("match", &match_pictures);
  module.def("paint", &paint_pictures);
  module.def("load_painting", &load_painting);
  module.def("png", [](const py::object& given) {
    return py::bytes(result_of([picture = copy_of(picture_in(given, "picture"))](const Progress& /*progress*/) {
      return encode_png(picture);
    }));
  });
}

}  // namespace wheatstone::python
