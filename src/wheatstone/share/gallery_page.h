#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "wheatstone/share/page.h"

namespace wheatstone {

/// A page that a gallery leads to, and the small picture that stands for it.
struct GalleryEntry {
  std::string page, picture;  ///< names of files, relative to the gallery's folder, with '/' between their parts
  std::string title;          ///< UTF-8
};

/// The pages in a folder and below it that have a picture of the same name beside them (.jpg), in the order of their
/// names. The title is that of the page.
std::vector<GalleryEntry> gallery_entries(const std::filesystem::path& folder);

/// One page with all pictures, each of which leads to its page. It has no code and asks no other address for anything.
std::string gallery_page(std::span<const GalleryEntry> entries, const PageWords& words);

}  // namespace wheatstone
