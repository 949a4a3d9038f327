#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/photograph/scan_layout.h"
#include "wheatstone/stereo/stereo_layout.h"

namespace wheatstone {

/// How it is known where a file has its views.
enum class HowKnown {
  given,     ///< by who asks
  metadata,  ///< by the file itself: MPO's index, JPS's descriptor, PNG's chunk sTER
  name,      ///< by the file's name
  halves,    ///< by comparing the picture's halves
};

/// In words, as "from its metadata".
std::string_view how_known_words(HowKnown how);

struct ReadViewsOptions {
  std::optional<StereoLayout> layout;  ///< of a file that holds both views in one picture; none: find it
  std::optional<ScanLayout> scan;      ///< instead of `layout`: of a card or an anaglyph
  bool swap = false;                   ///< the eyes are the other way round than all else says
  bool keep_profile = false;           ///< leave the views in the ICC profile of the file, where they share one
};

/// The options for the layout of that name, which may be one of a scan. Throws Error{wrong_usage} that lists the names.
ReadViewsOptions options_for_layout(std::string_view name);

/// The names that options_for_layout knows, without their aliases.
std::vector<std::string_view> photograph_layout_names();

/// The views of one file, as read_image gives pictures.
struct ViewsFile {
  std::vector<Image<Rgb8>> views;      ///< two or more of the same size, from left to right
  std::string kind;                    ///< "MPO", "JPS", "HEIC", "JPEG", "PNG" …
  std::optional<StereoLayout> layout;  ///< as it lies in the file, before `swap`; none: a picture a view, or a scan
  std::optional<ScanLayout> scan;
  HowKnown how_known = HowKnown::metadata;
  std::string note;            ///< what may be worth a look, one line; else empty
  std::string colour_profile;  ///< of the views, with `keep_profile`; empty: sRGB
};

/// In words, as "side by side, left eye left (from its name)" or "2 pictures (from its metadata)".
std::string describe_views(const ViewsFile& file);

/// Reads the views of a stereo photograph in one file:
/// - MPO (CIPA DC-007): the JPEGs that its index calls views, ordered by their numbers; large thumbnails are left out.
///   A JPEG whose index lists anything else than views of one size (a gain map, a panorama) is an ordinary picture.
/// - JPS: by its descriptor; without one the right eye's picture is on the left. PNS is the same as PNG.
/// - JPEG of Google's VR photographs (VR180): the picture, and the right eye's in its XMP.
/// - HEIC with exactly two pictures of one size: left, right.
/// - GIF, animated WebP and animated PNG of exactly two frames: left, right.
/// - any other picture: by the layout that is given, else its metadata, its name, its halves, in this order.
/// EXIF orientation and, unless they are kept, ICC profiles are applied to each; squeezed halves are brought back to
/// full size. The middle column or row of an odd number belongs to neither view. Throws Error: bad_input where the file
/// is damaged, holds one view or an animation of more than two frames, or where no card is seen; wrong_usage where a
/// layout is given for a file with a picture a view.
ViewsFile read_views(const std::filesystem::path& path, const ReadViewsOptions& options = {});

/// The same; none instead of an error where a sound picture gives no sign of holding two views.
std::optional<ViewsFile> find_views(const std::filesystem::path& path, const ReadViewsOptions& options = {});

}  // namespace wheatstone
