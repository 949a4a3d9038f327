#include "write_views_output.h"

#include <fmt/format.h>

#include <filesystem>

#include "wheatstone/app/output_folder.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::cli {

std::string write_quilt(std::span<const Image<Rgb8>> views, const QuiltLayout& layout, double aspect,
                        const std::string& output) {
  const std::filesystem::path path = output;
  if (!(aspect > 0)) aspect = static_cast<double>(views.front().width()) / views.front().height();
  const std::filesystem::path file =
      path.has_extension() ? path : path.parent_path() / quilt_name(path.filename().string(), layout, aspect);
  write_image(file, make_quilt(views, layout));
  return file.string();
}

std::string write_lenticular(std::span<const Image<Rgb8>> views, const LenticularScreen& screen,
                             const std::string& output) {
  std::filesystem::path file = output;
  if (!file.has_extension()) file += ".png";
  write_image(file, interleave(views, screen));
  return file.string();
}

void write_view_folder(std::span<const Image<Rgb8>> views, const std::string& folder, const Progress& progress) {
  OutputFolder output(folder);
  for (std::size_t v = 0; v < views.size(); ++v) {
    report(progress, "writing", static_cast<double>(v) / static_cast<double>(views.size()));
    write_image(output.file(fmt::format("view_{:03}.png", v)), views[v]);
  }
  output.commit();
}

}  // namespace wheatstone::cli
