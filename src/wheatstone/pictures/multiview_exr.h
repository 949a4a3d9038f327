#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// The names of so many views, from left to right, as other programs know them: "left" and "right" for two, "view00",
/// "view01" … for more.
std::vector<std::string> view_names(std::size_t count);

/// Writes views as one multi-view OpenEXR, half float, linear light: the first view is the default one, the channels of
/// the others are called after them ("right.R"), the attribute "multiView" names all. Appears only when it is whole.
/// Throws Error: wrong_usage where views are fewer than two or of different sizes, cannot_read_write.
void write_multiview_exr(const std::filesystem::path& path, std::span<const Image<Rgb8>> views);
void write_multiview_exr(const std::filesystem::path& path, std::span<const Image<Rgb16>> views);

/// Writes one picture as OpenEXR, in the same way. Throws Error{cannot_read_write}.
void write_picture_exr(const std::filesystem::path& path, ImageView<const Rgb8> picture);
void write_picture_exr(const std::filesystem::path& path, ImageView<const Rgb16> picture);

/// The views of such a file, as sRGB; of a file with layers and passes, as Blender writes it, those of the pass
/// "Combined" of the first layer that has one. Throws Error{bad_input} where it has none.
std::vector<Image<Rgb8>> read_multiview_exr(const std::filesystem::path& path);
/// The same with 16 bits a channel.
std::vector<Image<Rgb16>> read_deep_multiview_exr(const std::filesystem::path& path);

/// Whether the file is an OpenEXR that names several views.
bool is_multiview_exr(const std::filesystem::path& path);

/// What a renderer tells of a view beside its colours, as Blender's passes "Depth" and "Vector" do. Of the pictures'
/// size.
struct RenderedPasses {
  Image<float> depth;  ///< distance from the plane of the cameras, in the scene's units
  /// Where a pixel's point is in the picture of the frame before and of the frame after, from where it is here, in
  /// pixels, y down; NaN is unknown. Empty where the file has no motion.
  Image<float> before_x, before_y, after_x, after_y;
};

/// Whether each view of the file has a depth.
bool has_rendered_passes(const std::filesystem::path& path);

/// Those of each view. Throws Error{bad_input} where a view has no depth, or the file is damaged.
std::vector<RenderedPasses> read_rendered_passes(const std::filesystem::path& path);

}  // namespace wheatstone
