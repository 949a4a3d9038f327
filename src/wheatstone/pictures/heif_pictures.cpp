#include "wheatstone/pictures/heif_pictures.h"

#include <fmt/format.h>
#include <libheif/heif.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/pictures/colour_profile_internal.h"
#include "wheatstone/pictures/open_picture.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

struct FreeContext {
  void operator()(heif_context* context) const { heif_context_free(context); }
};
struct ReleaseHandle {
  void operator()(heif_image_handle* handle) const { heif_image_handle_release(handle); }
};
struct ReleaseImage {
  void operator()(heif_image* image) const { heif_image_release(image); }
};
using Context = std::unique_ptr<heif_context, FreeContext>;
using Handle = std::unique_ptr<heif_image_handle, ReleaseHandle>;
using Decoded = std::unique_ptr<heif_image, ReleaseImage>;

/// The file's directory; none where it is damaged. The bytes must outlive it.
Context open_context(std::string_view bytes) {
  Context context(heif_context_alloc());
  const heif_error error =
      heif_context_read_from_memory_without_copy(context.get(), bytes.data(), bytes.size(), nullptr);
  return error.code == heif_error_Ok ? std::move(context) : nullptr;
}

/// The profile of colours that are told by numbers (ISO/IEC 23091-2): those of a wide gamut, as Display P3, that are
/// coded by sRGB's curve, or video's, which is shown alike. Others are taken for sRGB, as other programs do.
std::string profile_of_numbers(const Handle& handle) {
  heif_color_profile_nclx* found = nullptr;
  if (heif_image_handle_get_nclx_color_profile(handle.get(), &found).code != heif_error_Ok) return {};
  const std::unique_ptr<heif_color_profile_nclx, decltype(&heif_nclx_color_profile_free)> colours(
      found, &heif_nclx_color_profile_free);
  const bool is_wide = colours->color_primaries == heif_color_primaries_ITU_R_BT_2020_2_and_2100_0 ||
                       colours->color_primaries == heif_color_primaries_SMPTE_RP_431_2 ||
                       colours->color_primaries == heif_color_primaries_SMPTE_EG_432_1;
  constexpr std::array usual_curves{
      heif_transfer_characteristic_ITU_R_BT_709_5,        heif_transfer_characteristic_unspecified,
      heif_transfer_characteristic_ITU_R_BT_601_6,        heif_transfer_characteristic_IEC_61966_2_1,
      heif_transfer_characteristic_ITU_R_BT_2020_2_10bit, heif_transfer_characteristic_ITU_R_BT_2020_2_12bit};
  if (!is_wide || std::ranges::find(usual_curves, colours->transfer_characteristics) == usual_curves.end()) return {};
  return profile_with_primaries({{{colours->color_primary_red_x, colours->color_primary_red_y},
                                  {colours->color_primary_green_x, colours->color_primary_green_y},
                                  {colours->color_primary_blue_x, colours->color_primary_blue_y},
                                  {colours->color_primary_white_x, colours->color_primary_white_y}}});
}

std::string profile_of(const Handle& handle) {
  std::string profile(heif_image_handle_get_raw_color_profile_size(handle.get()), '\0');
  if (profile.empty()) return profile_of_numbers(handle);
  const heif_error error = heif_image_handle_get_raw_color_profile(handle.get(), profile.data());
  return error.code == heif_error_Ok ? profile : std::string();
}

PictureInProfile decoded(const fs::path& path, const Context& context, heif_item_id id) {
  heif_image_handle* found = nullptr;
  heif_error error = heif_context_get_image_handle(context.get(), id, &found);
  const Handle handle(found);
  if (error.code != heif_error_Ok) refuse_damaged(path, error.message);
  heif_image* pixels = nullptr;
  error = heif_decode_image(handle.get(), &pixels, heif_colorspace_RGB, heif_chroma_interleaved_RGB, nullptr);
  const Decoded image(pixels);
  if (error.code != heif_error_Ok) refuse_damaged(path, error.message);
  int stride = 0;
  const std::uint8_t* plane = heif_image_get_plane_readonly(image.get(), heif_channel_interleaved, &stride);
  Image<Rgb8> picture(heif_image_get_width(image.get(), heif_channel_interleaved),
                      heif_image_get_height(image.get(), heif_channel_interleaved));
  for (int y = 0; y < picture.height(); ++y)
    std::memcpy(picture.row(y).data(), plane + static_cast<std::ptrdiff_t>(y) * stride, picture.row(y).size_bytes());
  return {std::move(picture), profile_of(handle)};
}

/// The grey levels of an image, 0..1.
Image<float> grey_levels(const fs::path& path, const Handle& handle) {
  heif_image* pixels = nullptr;
  const heif_error error =
      heif_decode_image(handle.get(), &pixels, heif_colorspace_undefined, heif_chroma_undefined, nullptr);
  const Decoded image(pixels);
  if (error.code != heif_error_Ok) refuse_damaged(path, error.message);
  // What is stored without colours may be decoded as equal ones.
  const heif_channel channel =
      heif_image_has_channel(image.get(), heif_channel_Y) != 0 ? heif_channel_Y : heif_channel_G;
  int stride = 0;
  const std::uint8_t* plane = heif_image_get_plane_readonly(image.get(), channel, &stride);
  const int bits = heif_image_get_bits_per_pixel_range(image.get(), channel);
  if (plane == nullptr || bits < 1 || bits > 16) refuse_damaged(path, "its depth image has no grey levels");
  Image<float> levels(heif_image_get_width(image.get(), channel), heif_image_get_height(image.get(), channel));
  for (int y = 0; y < levels.height(); ++y) {
    const std::uint8_t* row = plane + static_cast<std::ptrdiff_t>(y) * stride;
    for (int x = 0; x < levels.width(); ++x) {
      std::uint16_t level = row[x];
      if (bits > 8) std::memcpy(&level, row + 2 * static_cast<std::ptrdiff_t>(x), sizeof(level));
      levels(x, y) = static_cast<float>(level) / static_cast<float>((1 << bits) - 1);
    }
  }
  return levels;
}

struct FreeInfo {
  void operator()(const heif_depth_representation_info* info) const { heif_depth_representation_info_free(info); }
};

/// Brings levels of 0..1 to what they stand for.
HeifDepth interpreted(Image<float> levels, const heif_depth_representation_info* info) {
  HeifDepth found{std::move(levels), HeifDepthKind::inverse};
  if (info == nullptr || info->depth_representation_type != heif_depth_representation_type_uniform_Z) return found;
  found.kind = HeifDepthKind::distance;
  const bool has_range = info->has_z_near != 0 && info->has_z_far != 0 && info->z_near >= 0 &&
                         info->z_far > info->z_near && std::isfinite(info->z_far);
  if (!has_range) return found;
  const auto near = static_cast<float>(info->z_near), far = static_cast<float>(info->z_far);
  for (float& level : found.depth.pixels()) level = near + level * (far - near);
  return found;
}

}  // namespace

// ISO/IEC 14496-12, sec. 4.3: the first box names what the file is.
bool is_heif(std::string_view bytes) {
  if (bytes.size() < 12 || bytes.substr(4, 4) != "ftyp") return false;
  constexpr std::string_view brands[] = {"heic", "heix", "heim", "heis", "hevc",
                                         "hevx", "mif1", "msf1", "avif", "avis"};
  return std::find(std::begin(brands), std::end(brands), bytes.substr(8, 4)) != std::end(brands);
}

std::string heif_profile(std::string_view bytes) {
  const Context context = open_context(bytes);
  heif_image_handle* found = nullptr;
  if (!context || heif_context_get_primary_image_handle(context.get(), &found).code != heif_error_Ok) return {};
  return profile_of(Handle(found));
}

std::string heif_exif(std::string_view bytes) {
  const Context context = open_context(bytes);
  heif_image_handle* found = nullptr;
  if (!context || heif_context_get_primary_image_handle(context.get(), &found).code != heif_error_Ok) return {};
  const Handle handle(found);
  heif_item_id id = 0;
  if (heif_image_handle_get_list_of_metadata_block_IDs(handle.get(), "Exif", &id, 1) != 1) return {};
  std::string exif(heif_image_handle_get_metadata_size(handle.get(), id), '\0');
  constexpr std::size_t offset_bytes = 4;  // how far behind it the TIFF header begins (ISO/IEC 23008-12, annex A)
  if (exif.size() < offset_bytes || heif_image_handle_get_metadata(handle.get(), id, exif.data()).code != heif_error_Ok)
    return {};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < offset_bytes; ++i) begin = begin << 8 | static_cast<std::uint8_t>(exif[i]);
  return begin <= exif.size() - offset_bytes ? exif.substr(offset_bytes + begin) : std::string();
}

std::vector<PictureInProfile> read_heif_pictures(const fs::path& path) {
  const std::string bytes = read_picture_bytes(path);
  const Context context = open_context(bytes);
  if (!is_heif(bytes) || !context)
    throw Error(ErrorKind::bad_input, fmt::format("{}: not a HEIC file, or a damaged one", path.string()));
  std::vector<heif_item_id> ids(heif_context_get_number_of_top_level_images(context.get()));
  ids.resize(heif_context_get_list_of_top_level_image_IDs(context.get(), ids.data(), static_cast<int>(ids.size())));
  std::vector<PictureInProfile> pictures;
  pictures.reserve(ids.size());
  for (const heif_item_id id : ids) pictures.push_back(decoded(path, context, id));
  return pictures;
}

std::optional<HeifDepth> read_heif_depth(const fs::path& path) {
  const std::string bytes = read_picture_bytes(path);
  const Context context = open_context(bytes);
  heif_image_handle* found = nullptr;
  if (!is_heif(bytes) || !context || heif_context_get_primary_image_handle(context.get(), &found).code != heif_error_Ok)
    throw Error(ErrorKind::bad_input, fmt::format("{}: not a HEIC file, or a damaged one", path.string()));
  const Handle picture(found);
  heif_item_id id = 0;
  if (heif_image_handle_get_list_of_depth_image_IDs(picture.get(), &id, 1) < 1) return {};
  heif_image_handle* found_depth = nullptr;
  const heif_error error = heif_image_handle_get_depth_image_handle(picture.get(), id, &found_depth);
  const Handle depth(found_depth);
  if (error.code != heif_error_Ok) refuse_damaged(path, error.message);
  const heif_depth_representation_info* found_info = nullptr;
  heif_image_handle_get_depth_image_representation_info(picture.get(), id, &found_info);
  const std::unique_ptr<const heif_depth_representation_info, FreeInfo> info(found_info);
  return interpreted(grey_levels(path, depth), info.get());
}

std::string heif_version() { return heif_get_version(); }

}  // namespace wheatstone
