#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

// Picture files as they are stored. Who only wants a picture, a disparity or a depth uses read_image and its like,
// which stand on this.

/// How a file stores a number.
struct NumberKind {
  int bits = 8;
  bool is_float = false;

  bool operator==(const NumberKind&) const = default;
};
inline constexpr NumberKind bytes_kind{8, false}, words_kind{16, false}, halves_kind{16, true}, floats_kind{32, true};

struct Ratio {
  int numerator = 0, denominator = 1;
};

/// What a file says of a picture beside its pixels, by the names that OpenImageIO gives.
using PictureAttribute =
    std::variant<int, float, Ratio, std::string, std::vector<std::string>, std::vector<std::uint8_t>>;

/// One picture of a file without its pixels. EXR, TIFF and GIF files may have several.
struct StoredPicture {
  int width = 0, height = 0, channels = 0;
  int depth = 1;          ///< more than 1 in volumes, which are no pictures
  bool has_deep = false;  ///< numbers of any count a pixel (EXR)
  NumberKind kind;
  std::vector<std::string> channel_names;  ///< empty: those that the format gives
  int alpha_channel = -1;
  int left = 0, top = 0;                                             ///< where the pixels lie
  int full_left = 0, full_top = 0, full_width = 0, full_height = 0;  ///< what they are a part of; 0: of themselves
  std::map<std::string, PictureAttribute, std::less<>> attributes;

  /// The attribute if it is of this type, else nothing.
  template <class Type>
  const Type* find(std::string_view name) const {
    const auto found = attributes.find(name);
    return found == attributes.end() ? nullptr : std::get_if<Type>(&found->second);
  }
  template <class Type>
  Type value_of(std::string_view name, Type otherwise) const {
    const Type* const found = find<Type>(name);
    return found != nullptr ? *found : otherwise;
  }
  void put(const std::string& name, PictureAttribute attribute);
};

/// Reads a file that is open. What returns false has failed; `complaint` then tells why.
class PictureReader {
 public:
  PictureReader() = default;
  virtual ~PictureReader() = default;
  PictureReader(const PictureReader&) = delete;
  PictureReader& operator=(const PictureReader&) = delete;

  /// "png", "jpeg", "openexr" and so on.
  virtual std::string format() const = 0;
  /// The picture that is read; the first, until `go_to`.
  virtual const StoredPicture& picture() const = 0;
  virtual bool go_to(int picture) = 0;
  /// All pixels of a picture of bytes, row after row, the channels of a pixel together.
  virtual bool read(std::uint8_t* to) = 0;
  /// The first `channels` of some rows, counted from 0; integers become 0 to 1.
  virtual bool read(int first_row, int rows, int channels, float* to) = 0;
  /// What went wrong since this was last asked, or nothing.
  virtual std::string complaint() = 0;
};

/// Whether colours are multiplied by alpha where the file has them apart.
enum class StoredAlpha { kept_apart, multiplied };

struct OpenedPicture {
  std::unique_ptr<PictureReader> reader;  ///< none where the file cannot be read
  std::string complaint;
};

/// Opens a file in any format. Throws Error{cannot_read_write} where a part of the installation is missing.
OpenedPicture open_picture_file(const std::filesystem::path& path, StoredAlpha alpha = StoredAlpha::multiplied);

/// Rows of pixels in memory, the channels of a pixel together: `kind` is of bytes, words or floats.
struct PixelRows {
  const void* first = nullptr;
  NumberKind kind;
  int first_row = 0, rows = 0;
  std::ptrdiff_t row_bytes = 0;
};

/// Writes a file: `begin`, the pixels of the first picture, `begin_next`, those of the second and so on, `end`. What
/// returns false has failed; `complaint` then tells why.
class PictureWriter {
 public:
  PictureWriter() = default;
  virtual ~PictureWriter() = default;
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// Some formats (EXR) want to know of all pictures before the first, others (GIF) only of the first.
  virtual bool begin(std::span<const StoredPicture> pictures) = 0;
  virtual bool begin_next(const StoredPicture& picture) = 0;
  virtual bool write(const PixelRows& rows) = 0;
  virtual bool end() = 0;
  virtual std::string complaint() = 0;
};

/// A writer in the format of this ending (".tif") that writes to the file `path`, whatever that is called. Throws
/// Error{cannot_read_write} where a part of the installation is missing, or cannot write this format.
std::unique_ptr<PictureWriter> picture_writer(const std::string& ending, const std::filesystem::path& path);

/// The same to memory, which outlives the writer.
std::unique_ptr<PictureWriter> picture_writer(const std::string& ending, std::vector<unsigned char>& bytes);

/// The bytes of a picture file, or why there are none.
struct EncodedPicture {
  std::string bytes;
  std::string complaint;
};

/// The bytes of a file with one picture, in the format of the ending of `path`, which is for messages, too: many
/// encoders do not notice that a disk is full. PNG, JPEG, TIFF of integers and WebP are made without OpenImageIO.
/// Throws Error{cannot_read_write}.
std::string encode_picture(const std::filesystem::path& path, const StoredPicture& picture, const PixelRows& rows);

/// All rows of an image.
PixelRows rows_of(ImageView<const Rgb8> image);
PixelRows rows_of(ImageView<const Rgb16> image);
PixelRows rows_of(ImageView<const std::uint8_t> image);
PixelRows rows_of(ImageView<const float> image);

/// The ending of a file name in small letters: ".png".
std::string ending_of(const std::filesystem::path& path);
/// Whether a file name ends as that of a TIFF does.
bool is_tiff_name(const std::filesystem::path& path);

}  // namespace wheatstone
