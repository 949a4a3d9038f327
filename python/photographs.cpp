#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "wheatstone/calibration/rectify.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/photograph/carried_depth.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/single_view.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

/// The views of a file, where they come from, and the left one's disparity where the file tells it.
struct Read {
  std::vector<Image<Rgb8>> views;
  std::string how;  ///< empty: one picture of which nothing says that it has views
  Image<float> disparity = {};
};

/// A pair and its left disparity.
Read told(StereoPair pair, Image<float> disparity, const std::string& how) {
  std::vector<Image<Rgb8>> views;
  views.push_back(std::move(pair.left));
  views.push_back(std::move(pair.right));
  return {std::move(views), how, std::move(disparity)};
}

/// A picture and the depth that its file carries, as a pair.
Read told_with_depth(CarriedDepth found) {
  Image<float> disparity = disparity_from_depth(found.depth, found.picture, {.kind = found.kind});
  MadePair made = make_pair_from_single_view(std::move(found.picture), std::move(disparity));
  return told(std::move(made.pictures), std::move(made.geometry.left_disparity), "with " + found.how);
}

/// One picture where nothing but the likeness of its halves says that there are more.
Read read_photograph(const fs::path& path, const std::string& layout) {
  if (!layout.empty()) {
    const ViewsFile file = read_views(path, options_for_layout(layout));
    return {file.views, describe_views(file)};
  }
  if (path.extension() == ".exr" && is_multiview_exr(path))
    return {read_multiview_exr(path), "views of a multi-view OpenEXR"};
  if (const std::optional<NamedQuilt> quilt = quilt_of_name(path.filename().string()))
    return {views_of_quilt(read_image(path), quilt->layout), "a quilt (from its name)"};
  if (std::optional<CarriedDepth> found = find_carried_depth(path)) return told_with_depth(std::move(*found));
  const std::optional<ViewsFile> file = find_views(path);
  if (file && file->how_known != HowKnown::halves) return {file->views, describe_views(*file)};
  return {{read_image(path)}, {}};
}

/// As Python has it: the views, how and the disparity, or None; or one picture.
py::object array_or_tuple(Read read) {
  if (read.how.empty()) return array_of(std::move(read.views.front()));
  py::object disparity = py::none();
  if (!read.disparity.empty()) disparity = array_of(std::move(read.disparity));
  return py::make_tuple(array_of(read.views), read.how, disparity);
}

py::tuple in_px(const VerticalDisparity& rows) { return py::make_tuple(rows.median_px, rows.percentile_95_px); }

py::dict rectify_pictures(const py::object& left, const py::object& right, const std::optional<fs::path>& calibration,
                          const RectifyOptions& options) {
  RectifiedPair pair = result_of([photographs = pair_in(left, right), calibration, options](const Progress& progress) {
    if (!calibration) return rectify(photographs, options, progress);
    return rectify(photographs, read_stereo_calibration(*calibration), options, progress);
  });
  py::dict result;
  result["left"] = array_of(std::move(pair.pictures.left));
  result["right"] = array_of(std::move(pair.pictures.right));
  result["measured_matches"] = pair.measured_matches;
  result["rows_before"] = in_px(pair.before);
  result["rows_after"] = in_px(pair.after);
  result["shift"] = pair.shift_px;
  result["eyes_swapped"] = pair.eyes_swapped;
  return result;
}

py::object still(std::pair<int, int> size, std::uint64_t seed) {
  return array_or_tuple(result_of([size, seed](const Progress& progress) {
    SyntheticStill made = make_synthetic_still({.width = size.first, .height = size.second, .seed = seed}, progress);
    return told(std::move(made.pictures), std::move(made.geometry.left_disparity), "a synthetic still life");
  }));
}

}  // namespace

void add_photographs(py::module_& module) {
  module.def("read_photograph", [](const fs::path& path, const std::string& layout) {
    return array_or_tuple(result_of([=](const Progress& /*progress*/) { return read_photograph(path, layout); }));
  });
  module.def("is_multiview", [](const fs::path& path) { return is_multiview_exr(path); });
  module.def("rectify", [](const py::object& left, const py::object& right, const std::optional<fs::path>& calibration,
                           bool match_colour, bool keep_size) {
    return rectify_pictures(left, right, calibration, {.match_colour = match_colour, .keep_size = keep_size});
  });
  module.def("still", &still);
}

}  // namespace wheatstone::python
