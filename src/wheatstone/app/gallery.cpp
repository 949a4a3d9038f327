#include "wheatstone/app/gallery_internal.h"

#include <fmt/format.h>

#include <array>

#include "wheatstone/files/html_text.h"

namespace wheatstone {
namespace {

struct GalleryPicture {
  std::string_view file;  ///< without an ending: in the format of the pictures
  std::string_view caption;
};

constexpr std::array<GalleryPicture, 10> pictures{{
    {"left_photograph", "Photograph, left eye"},
    {"right_photograph", "Photograph, right eye"},
    {"left", "Painting, left eye"},
    {"right", "Painting, right eye"},
    {"anaglyph", "Anaglyph, for red–cyan glasses"},
    {"side_by_side", "Side by side, for parallel viewing"},
    {"disparity.png", "Disparity: near is red, far is blue"},
    {"left_occlusion.png", "Seen by the left eye only"},
    {"right_occlusion.png", "Seen by the right eye only"},
}};

constexpr std::string_view head = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>A painting for two eyes</title>
<style>
  body { font: 16px/1.4 sans-serif; margin: 2rem auto; max-width: 80rem; padding: 0 1rem; background: #f6f3ee; color: #222; }
  main { display: grid; grid-template-columns: repeat(auto-fit, minmax(28rem, 1fr)); gap: 1.5rem; }
  figure { margin: 0; } img { width: 100%; display: block; background: #ddd; } figcaption { padding: .4rem 0; }
  pre { background: #fff; padding: 1rem; overflow: auto; }
</style></head><body>
<h1>A painting for two eyes</h1>
<main>
)";

}  // namespace

std::string gallery_html(std::string_view format, std::string_view report_json) {
  std::string page(head);
  for (const GalleryPicture& picture : pictures) {
    const bool has_ending = picture.file.find('.') != std::string_view::npos;
    const std::string file = has_ending ? std::string(picture.file) : fmt::format("{}.{}", picture.file, format);
    page +=
        fmt::format("<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"></a><figcaption>{1}</figcaption></figure>\n",
                    file, picture.caption);
  }
  page += fmt::format("</main>\n<h2>Numbers</h2>\n<pre>{}</pre>\n</body></html>\n", html_text(report_json));
  return page;
}

}  // namespace wheatstone
