#include "wheatstone/photograph/write_views.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/photograph/multi_picture_internal.h"
#include "wheatstone/photograph/stereo_marks_internal.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone {
namespace {

void check(const std::filesystem::path& path, std::span<const ImageView<const Rgb8>> views) {
  if (views.size() < 2)
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: {} views, expected two or more", path.string(), views.size()));
  for (const ImageView<const Rgb8>& view : views)
    if (view.empty() || !same_size(view, views.front()))
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: views of {}x{} and {}x{} pixels, expected one size", path.string(),
                              views.front().width(), views.front().height(), view.width(), view.height()));
}

}  // namespace

void write_mpo(const std::filesystem::path& path, std::span<const ImageView<const Rgb8>> views, int quality,
               const PictureNotes& notes) {
  check(path, views);
  std::vector<std::string> jpegs;
  jpegs.reserve(views.size());
  for (const ImageView<const Rgb8>& view : views) jpegs.push_back(with_notes(encode_jpeg(view, quality), notes));
  write_whole_file(path, join_multi_pictures(jpegs));
}

void write_jps(const std::filesystem::path& path, ImageView<const Rgb8> left, ImageView<const Rgb8> right,
               StereoLayout layout, int quality, const PictureNotes& notes) {
  const ImageView<const Rgb8> views[] = {left, right};
  check(path, views);
  const LayoutTraits& traits = traits_of(layout);
  if (traits.arrangement != Arrangement::side_by_side && traits.arrangement != Arrangement::over_under)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: a JPS cannot hold eyes {}, expected side by side or one above the other",
                            path.string(), traits.words));
  JpsDescriptor descriptor;
  descriptor.arrangement =
      is_side_by_side(layout) ? JpsDescriptor::Arrangement::side_by_side : JpsDescriptor::Arrangement::over_under;
  (is_side_by_side(layout) ? descriptor.half_width : descriptor.half_height) = is_half_size(layout);
  descriptor.left_first = is_left_first(layout);
  const std::string jpeg = with_notes(encode_jpeg(put_together(left, right, layout), quality), notes);
  write_whole_file(path, with_jps_descriptor(jpeg, descriptor));
}

}  // namespace wheatstone
