#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "wheatstone/image/image.h"
#include "wheatstone/pictures/picture_notes.h"

namespace wheatstone {

/// The endings of file names that a picture can be written under: ".png", ".jpg" and so on.
std::span<const std::string_view> picture_endings();

/// Whether a picture can be written under this name, by its ending.
bool is_picture_name(const std::filesystem::path& path);

/// Writes a picture in the format of its file name (picture_endings), under a temporary name that becomes the real one
/// when the file is whole. Throws Error{wrong_usage} for another ending, Error{cannot_read_write}; then nothing is left
/// behind. JPEG and PNG take all notes, TIFF the title, the time, the pixels an inch and the colour profile, the others
/// none.
void write_image(const std::filesystem::path& path, ImageView<const Rgb8> image, const PictureNotes& notes = {});
void write_image(const std::filesystem::path& path, ImageView<const std::uint8_t> image);
/// The same with 16 bits a channel; only where takes_sixteen_bits.
void write_image(const std::filesystem::path& path, ImageView<const Rgb16> image);

/// Whether a picture of this name is one of a format that takes the notes' colour profile: PNG, JPEG or TIFF.
bool takes_profile(const std::filesystem::path& path);

/// Whether a picture of this name is one of a format that keeps 16 bits a channel: PNG or TIFF.
bool takes_sixteen_bits(const std::filesystem::path& path);

/// The picture as a PNG. Throws Error{cannot_read_write}.
std::string encode_png(ImageView<const Rgb8> image);

/// The picture as a baseline JPEG of this quality, 1 to 100, with its chroma at full size (4:4:4).
/// Throws Error{cannot_read_write}.
std::string encode_jpeg(ImageView<const Rgb8> image, int quality);

}  // namespace wheatstone
