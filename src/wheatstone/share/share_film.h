#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "wheatstone/display/quilt.h"
#include "wheatstone/share/page.h"
#include "wheatstone/stereo/stereo_layout.h"

namespace wheatstone {

struct ShareFilmOptions {
  std::string title;
  std::filesystem::path page = "page.html";  ///< where the page will stand, from which a film beside it is found
  std::optional<StereoLayout> layout;        ///< by default what the film says, or lets guess
  std::optional<QuiltLayout> quilt;          ///< each frame is a quilt
  std::filesystem::path subtitles;           ///< a WebVTT file; empty: none
  std::size_t most_bytes = 32'000'000;       ///< of the page; a film that is larger stays beside it
};

/// A film of both eyes, or of quilts, for a page that plays it as it is: frames are not coded again. Throws
/// Error{bad_input} where browsers cannot play such files, or its layout cannot be shown by a page.
SharedPicture share_film(const std::filesystem::path& film, const ShareFilmOptions& options);

}  // namespace wheatstone
