#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace wheatstone {

/// Bytes that a page holds beside the facts of its picture.
struct PagePart {
  std::string name;
  std::vector<std::uint8_t> bytes;
};

/// A picture with its depth, as the code of a page draws it: page/manifest.ts says what the facts and parts are.
struct SharedPicture {
  std::string facts;  ///< a JSON object
  std::vector<PagePart> parts;
  std::string still_jpeg;  ///< shown until the depth is there, and where it cannot be
  int width = 0, height = 0;
  bool has_file_beside = false;  ///< the page plays a film that stands beside it
  std::string note;              ///< what gave way to a limit of the size, for who shares the picture; empty: nothing
};

/// What a page says; any text.
struct PageWords {
  std::string title;
  std::string description;  ///< what the picture shows, for who cannot see it; empty: the title
  std::string caption;      ///< below the picture; may be empty
};

/// One file that any browser shows, and that asks no other address for anything: its Content-Security-Policy allows the
/// page's own code and nothing else but, where there is one, the film beside it.
std::string html_page(const SharedPicture& picture, const PageWords& words);

/// Bytes of the page of a picture, but for its words.
std::size_t page_bytes(const SharedPicture& picture);

/// The code of the element <wheatstone-picture>, for sites that embed pages.
std::string_view page_element_code();

}  // namespace wheatstone
