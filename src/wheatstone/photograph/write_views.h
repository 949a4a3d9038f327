#pragma once

#include <filesystem>
#include <span>

#include "wheatstone/image/image.h"
#include "wheatstone/pictures/picture_notes.h"
#include "wheatstone/stereo/stereo_layout.h"

namespace wheatstone {

/// What a stereo file is written with unless asked otherwise: 1 to 100.
inline constexpr int stereo_jpeg_quality = 95;

/// Writes views, from left to right, as one MPO (CIPA DC-007, baseline MP file, type disparity): whole JPEGs with their
/// chroma at full size, numbered from the left, the first the one that other programs show. Written under a temporary
/// name first, as write_image. Throws Error: wrong_usage for fewer than two views or views of different sizes,
/// cannot_read_write.
void write_mpo(const std::filesystem::path& path, std::span<const ImageView<const Rgb8>> views,
               int quality = stereo_jpeg_quality, const PictureNotes& notes = {});

/// Writes a pair as one JPEG with a JPS descriptor: cross-eyed as most JPS are, or in another layout. A half layout is
/// squeezed to half the size. Throws as write_mpo.
void write_jps(const std::filesystem::path& path, ImageView<const Rgb8> left, ImageView<const Rgb8> right,
               StereoLayout layout = StereoLayout::right_left, int quality = stereo_jpeg_quality,
               const PictureNotes& notes = {});

}  // namespace wheatstone
