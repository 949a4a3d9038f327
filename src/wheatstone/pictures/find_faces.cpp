#include "wheatstone/pictures/find_faces.h"

#include <array>
#include <filesystem>

#include "wheatstone/files/module.h"
#include "wheatstone/pictures/faces_module_internal.h"

namespace wheatstone {
namespace {

constexpr std::array cascade_folders{"/usr/share/opencv4/haarcascades", "/usr/local/share/opencv4/haarcascades"};
constexpr auto cascade_name = "haarcascade_frontalface_default.xml";

}  // namespace

std::optional<std::vector<PixelBox>> find_faces(ImageView<const Rgb8> picture, int searched_width_px) {
  for (const std::filesystem::path folder : cascade_folders) {
    const std::filesystem::path cascade = folder / cascade_name;
    if (!std::filesystem::exists(cascade)) continue;
    auto* const find =
        reinterpret_cast<FindFaces*>(function_of_module(faces_module_name, find_faces_name, faces_module_bytes));
    std::vector<PixelBox> faces;
    if (picture.empty() || find(cascade.string(), picture, searched_width_px, faces)) return faces;
  }
  return {};
}

}  // namespace wheatstone
