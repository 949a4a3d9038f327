#pragma once

// What JPEG and PNG files may say of the two eyes that their one picture holds.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace wheatstone {

/// The stereoscopic descriptor of a JPS file, in its segment APP3 "_JPSJPS_" (VRex, 1997).
struct JpsDescriptor {
  enum class Arrangement { interleaved = 1, side_by_side = 2, over_under = 3, anaglyph = 4 };
  bool stereo = true;  ///< false: for one eye only, the rest says nothing
  Arrangement arrangement = Arrangement::side_by_side;
  bool half_height = false;
  bool half_width = false;
  bool left_first = false;  ///< the left eye's picture is the left, the upper one
};

/// None where the JPEG has no descriptor. Throws Error{bad_input} that names `path` where it is cut short or of an
/// unknown arrangement.
std::optional<JpsDescriptor> read_jps_descriptor(std::string_view bytes, const std::filesystem::path& path);

/// The JPEG with this descriptor put in, behind JFIF's and Exif's segments.
std::string with_jps_descriptor(const std::string& jpeg, const JpsDescriptor& descriptor);

/// The chunk sTER of a PNG (Extensions to PNG 1.2, sec. 3.2): its two pictures lie side by side, the right one begins
/// at a column that is a multiple of eight.
struct StereoChunk {
  bool left_first = false;  ///< diverging: the left eye's picture is the left one
};

/// None where the PNG has no such chunk, or a damaged one.
std::optional<StereoChunk> read_stereo_chunk(std::string_view bytes);

}  // namespace wheatstone
