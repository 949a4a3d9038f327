#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "wheatstone/calibration/rectify.h"
#include "wheatstone/display/multiview_exr.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/photograph/carried_depth.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/single_view.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

py::tuple told(const std::vector<Image<Rgb8>>& views, const std::string& how, py::object disparity = py::none()) {
  return py::make_tuple(array_of(views), how, std::move(disparity));
}

/// A pair and its left disparity.
py::tuple told(StereoPair pair, Image<float> disparity, const std::string& how) {
  std::vector<Image<Rgb8>> views;
  views.push_back(std::move(pair.left));
  views.push_back(std::move(pair.right));
  return told(views, how, array_of(std::move(disparity)));
}

/// A picture and the depth that its file carries, as a pair.
py::tuple told_with_depth(CarriedDepth found) {
  Image<float> disparity = disparity_from_depth(found.depth, found.picture, {.kind = found.kind});
  MadePair made = make_pair_from_single_view(std::move(found.picture), std::move(disparity));
  return told(std::move(made.pictures), std::move(made.geometry.left_disparity), "with " + found.how);
}

/// The views of a file, where they come from and the left one's disparity where the file tells it; one picture where
/// nothing but the likeness of its halves says that there are more.
py::object read_photograph(const fs::path& path, const std::string& layout) {
  if (!layout.empty()) {
    const ViewsFile file = read_views(path, options_for_layout(layout));
    return told(file.views, describe_views(file));
  }
  if (path.extension() == ".exr" && is_multiview_exr(path))
    return told(read_multiview_exr(path), "views of a multi-view OpenEXR");
  if (const std::optional<NamedQuilt> quilt = quilt_of_name(path.filename().string()))
    return told(views_of_quilt(read_image(path), quilt->layout), "a quilt (from its name)");
  if (std::optional<CarriedDepth> found = find_carried_depth(path)) return told_with_depth(std::move(*found));
  const std::optional<ViewsFile> file = find_views(path);
  if (file && file->how_known != HowKnown::halves) return told(file->views, describe_views(*file));
  return array_of(read_image(path));
}

py::tuple in_px(const VerticalDisparity& rows) { return py::make_tuple(rows.median_px, rows.percentile_95_px); }

py::dict rectify_pictures(const py::object& left, const py::object& right, const std::optional<fs::path>& calibration,
                          const RectifyOptions& options) {
  const StereoPair photographs = pair_in(left, right);
  RectifiedPair pair;
  {
    const py::gil_scoped_release unlocked;
    pair = calibration ? rectify(photographs, read_stereo_calibration(*calibration), options, with_signals())
                       : rectify(photographs, options, with_signals());
  }
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

py::tuple still(std::pair<int, int> size, std::uint64_t seed) {
  SyntheticStill made;
  {
    const py::gil_scoped_release unlocked;
    made = make_synthetic_still({.width = size.first, .height = size.second, .seed = seed}, with_signals());
  }
  return told(std::move(made.pictures), std::move(made.geometry.left_disparity), "a synthetic still life");
}

}  // namespace

void add_photographs(py::module_& module) {
  module.def("read_photograph", &read_photograph);
  module.def("is_multiview", [](const fs::path& path) { return is_multiview_exr(path); });
  module.def("rectify", [](const py::object& left, const py::object& right, const std::optional<fs::path>& calibration,
                           bool match_colour, bool keep_size) {
    return rectify_pictures(left, right, calibration, {.match_colour = match_colour, .keep_size = keep_size});
  });
  module.def("still", &still);
}

}  // namespace wheatstone::python
