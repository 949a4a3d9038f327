#include "wheatstone/app/write_results.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <functional>
#include <mutex>

#include "wheatstone/app/gallery.h"
#include "wheatstone/app/present_pair.h"
#include "wheatstone/app/write_svg.h"
#include "wheatstone/display/anaglyph.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/display/disparity_picture.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone {

std::vector<std::string> result_names(const ResultOptions& options) {
  std::vector<std::string> names;
  const auto add_pictures = [&](std::initializer_list<const char*> pictures) {
    for (const char* picture : pictures) names.push_back(fmt::format("{}.{}", picture, options.format));
  };
  add_pictures({"left", "right", "side_by_side", "anaglyph"});
  names.insert(names.end(), {"disparity.png", "left_disparity.pfm", "right_disparity.pfm", "left_occlusion.png",
                             "right_occlusion.png", "painting.wst", "report.json"});
  if (options.svg) names.insert(names.end(), {"left.svg", "right.svg"});
  if (options.photographs || options.html) add_pictures({"left_photograph", "right_photograph"});
  if (options.html) names.emplace_back("index.html");
  return names;
}

std::vector<std::string> write_results(OutputFolder& folder, const StereoPair& photographs, const PaintingReport& told,
                                       const ResultOptions& options, const Progress& progress) {
  using Path = std::filesystem::path;
  struct Output {
    std::string name;
    std::function<void(const Path&)> write;
  };
  const PaintedPhotograph& result = told.painted;
  const StereoPair& pictures = result.painted.pictures;
  const StereoGeometry& geometry = result.geometry;
  const Painting& painting = result.painted.painting;
  const float separation = comfortable_separation(painting, told.depth_budget);
  const std::vector<Image<Rgb8>>& others = result.painted.other_views;
  const StereoPair presented = separation < 1 && !others.empty()
                                   ? present_pair(others, pictures, separation, result.zero_parallax_px)
                                   : present_pair(painting, pictures, separation, result.zero_parallax_px);
  const auto picture = [&](const char* name) { return fmt::format("{}.{}", name, options.format); };
  std::vector<Output> outputs{
      {picture("left"), [&](const Path& path) { write_image(path, pictures.left); }},
      {picture("right"), [&](const Path& path) { write_image(path, pictures.right); }},
      {picture("side_by_side"), [&](const Path& path) { write_image(path, side_by_side(presented)); }},
      {picture("anaglyph"), [&](const Path& path) { write_image(path, anaglyph(presented)); }},
      {"disparity.png", [&](const Path& path) { write_image(path, disparity_picture(geometry.left_disparity)); }},
      {"left_disparity.pfm", [&](const Path& path) { write_disparity(path, geometry.left_disparity); }},
      {"right_disparity.pfm", [&](const Path& path) { write_disparity(path, geometry.right_disparity); }},
      {"left_occlusion.png", [&](const Path& path) { write_image(path, geometry.left_occlusion); }},
      {"right_occlusion.png", [&](const Path& path) { write_image(path, geometry.right_occlusion); }},
      {"painting.wst", [&](const Path& path) { write_painting(path, painting); }},
      {"report.json", [&](const Path& path) { write_whole_file(path, report_json(told)); }},
  };
  if (options.svg) {
    outputs.push_back({"left.svg", [&](const Path& path) { write_svg(path, painting, left_eye); }});
    outputs.push_back({"right.svg", [&](const Path& path) { write_svg(path, painting, right_eye); }});
  }
  if (options.photographs || options.html) {
    outputs.push_back({picture("left_photograph"), [&](const Path& path) { write_image(path, photographs.left); }});
    outputs.push_back({picture("right_photograph"), [&](const Path& path) { write_image(path, photographs.right); }});
  }
  if (options.html) {
    outputs.push_back({"index.html", [&](const Path& path) {
                         write_whole_file(path, gallery_html(options.format, report_json(told)));
                       }});
  }

  std::mutex reporting;
  std::size_t written = 0;
  report(progress, "writing", 0);
  tbb::parallel_for(std::size_t{0}, outputs.size(), [&](std::size_t i) {
    outputs[i].write(folder.file(outputs[i].name));
    const std::scoped_lock lock(reporting);
    report(progress, "writing", static_cast<double>(++written) / static_cast<double>(outputs.size()));
  });
  folder.commit();
  std::vector<std::string> names;
  for (const Output& output : outputs) names.push_back(output.name);
  return names;
}

}  // namespace wheatstone
