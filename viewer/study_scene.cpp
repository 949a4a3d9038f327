#include "study_scene.h"

#include <utility>

#include "wheatstone/marks/painting_file.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/painting/two_eyes.h"

namespace wheatstone::viewer {
namespace {

std::variant<PreparedPainting, SliceStack> read_scene(const std::filesystem::path& path) {
  if (path.extension() == ".exr") return read_slices(path);
  const Painting painting = read_painting(path);
  return prepare(painting, {.placement = {.zero_parallax_px = nearest_disparity(painting)}});
}

}  // namespace

bool StudyScene::is_named(const std::filesystem::path& path) {
  return path.extension() == ".wst" || path.extension() == ".exr";
}

StudyScene::StudyScene(const std::filesystem::path& path) : scene_(read_scene(path)) {}

Image<Rgb8> StudyScene::draw(ViewPosition view) const {
  if (const auto* const painting = std::get_if<PreparedPainting>(&scene_))
    return wheatstone::draw(*painting, view).picture;
  const auto& slices = std::get<SliceStack>(scene_);
  return std::move(
      render_slices(slices, {.width = slices.width, .height = slices.height, .positions = {view}}).front());
}

}  // namespace wheatstone::viewer
