#include "write_views_output.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "wheatstone/app/output_folder.h"
#include "wheatstone/files/output_paths.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::cli {

std::vector<std::filesystem::path> pictures_in_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file() && is_picture_name(entry.path())) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

void check_views_output(const ViewsOutput& output) {
  if (!std::filesystem::is_directory(output.name)) return check_not_an_input(output.name, output.inputs);
  for (const std::filesystem::path& file : pictures_in_folder(output.name))
    if (file.filename().string().starts_with("view_")) check_not_an_input(file, output.inputs);
}

Value picture_format(std::string& format) {
  static constexpr std::array<std::string_view, 4> formats{"png", "jpg", "tif", "webp"};
  return name(format, formats);
}

void check_format_fits(const Given& given, const ViewsOutput& output) {
  const std::string ending = std::filesystem::path(output.name).extension().string();
  if (given("--format") && !ending.empty() && ending != "." + output.format)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--format: is '{}', but --output is '{}'", output.format, output.name));
}

void check_picture_ending(const std::string& option, const std::string& output) {
  if (!is_picture_name(output))
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected a name that ends in {}", option, output,
                                                    fmt::join(picture_endings(), ", ")));
}

std::string write_quilt(ImageView<const Rgb8> quilt, const QuiltLayout& layout, double aspect,
                        const ViewsOutput& output) {
  const std::filesystem::path path = output.name;
  if (!(aspect > 0)) aspect = static_cast<double>(quilt.width() * layout.rows) / (quilt.height() * layout.columns);
  const std::filesystem::path file =
      path.has_extension()
          ? path
          : path.parent_path() / std::filesystem::path(quilt_name(path.filename().string(), layout, aspect))
                                     .replace_extension(output.format);
  check_not_an_input(file, output.inputs);
  write_image(file, quilt, output.notes);
  return file.string();
}

std::string write_lenticular(ImageView<const Rgb8> picture, const ViewsOutput& output) {
  std::filesystem::path file = output.name;
  if (!file.has_extension()) file += "." + output.format;
  check_not_an_input(file, output.inputs);
  write_image(file, picture, output.notes);
  return file.string();
}

void write_view_folder(std::span<const Image<Rgb8>> views, const ViewsOutput& output, const Progress& progress) {
  OutputFolder folder(output.name, output.inputs);
  for (std::size_t v = 0; v < views.size(); ++v) {
    report(progress, "writing", static_cast<double>(v) / static_cast<double>(views.size()));
    write_image(folder.file(fmt::format("view_{:03}.{}", v, output.format)), views[v], output.notes);
  }
  folder.commit();
}

}  // namespace wheatstone::cli
