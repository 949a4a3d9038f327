#include "wheatstone/share/gallery_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "wheatstone/files/text_encoding.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

/// The path of a file as a link: what has a meaning in addresses, or is not ASCII, as its bytes in hexadecimal.
std::string link_to(std::string_view file) {
  std::string link;
  for (const char letter : file) {
    const auto code = static_cast<unsigned char>(letter);
    constexpr std::string_view plain = "-_.~/";
    const bool is_plain = (code >= '0' && code <= '9') || (code >= 'A' && code <= 'Z') ||
                          (code >= 'a' && code <= 'z') || plain.find(letter) != std::string_view::npos;
    if (is_plain)
      link += letter;
    else
      link += fmt::format("%{:02X}", code);
  }
  return link;
}

/// What html_text made of a title, as text again.
std::string from_html(std::string text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> references{
      {{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}, {"&amp;", "&"}}};
  for (const auto& [reference, letter] : references)
    for (std::size_t at = text.find(reference); at != text.npos; at = text.find(reference, at + letter.size()))
      text.replace(at, reference.size(), letter);
  return text;
}

/// The title that a page of ours has near its beginning; empty where it is none.
std::string title_of(const fs::path& page) {
  constexpr std::size_t enough = 4096;
  std::string head(enough, '\0');
  std::ifstream file(page, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  constexpr std::string_view begin_tag = "<title>";
  const std::size_t begin = head.find(begin_tag), end = head.find("</title>");
  if (begin == head.npos || end == head.npos || end < begin) return {};
  return from_html(head.substr(begin + begin_tag.size(), end - begin - begin_tag.size()));
}

constexpr std::string_view style =
    "body{margin:0;padding:1.5rem;background:#16181c;color:#e8e6e3;font:16px/1.4 system-ui,sans-serif}"
    "h1{font-weight:500;font-size:1.5rem;margin:0 0 1rem}"
    "main{display:grid;grid-template-columns:repeat(auto-fill,minmax(16rem,1fr));gap:1.25rem}"
    "figure{margin:0}a{color:inherit;text-decoration:none;display:block}"
    "img{width:100%;aspect-ratio:4/3;object-fit:contain;background:#0c0d0f;display:block;border-radius:4px}"
    "a:hover img,a:focus img{outline:2px solid #7aa7ff}"
    "figcaption{padding:.4rem .1rem;overflow-wrap:anywhere}p{max-width:45rem}";

}  // namespace

std::vector<GalleryEntry> gallery_entries(const fs::path& folder) {
  std::vector<GalleryEntry> entries;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, error)) {
    const fs::path& page = entry.path();
    const fs::path picture = fs::path(page).replace_extension(".jpg");
    if (page.extension() != ".html" || !fs::exists(picture)) continue;
    const std::string name = page.lexically_relative(folder).generic_string();
    std::string title = title_of(page);
    if (title.empty()) title = page.stem().string();
    entries.push_back({name, picture.lexically_relative(folder).generic_string(), std::move(title)});
  }
  std::ranges::sort(entries, {}, &GalleryEntry::page);
  return entries;
}

std::string gallery_page(std::span<const GalleryEntry> entries, const PageWords& words) {
  std::string page = html_head(words.title, style,
                               "default-src 'none'; style-src 'unsafe-inline'; img-src 'self'; base-uri 'none'; "
                               "form-action 'none'") +
                     fmt::format("<h1>{}</h1>\n", html_text(words.title));
  for (const std::string& text : {words.description, words.caption})
    if (!text.empty()) page += fmt::format("<p>{}</p>\n", html_text(text));
  page += "<main>\n";
  for (const GalleryEntry& entry : entries)
    page += fmt::format(
        "<figure><a href=\"{0}\"><img src=\"{1}\" alt=\"{2}\" "
        "loading=\"lazy\"><figcaption>{2}</figcaption></a></figure>\n",
        link_to(entry.page), link_to(entry.picture), html_text(entry.title));
  return page + "</main>\n</body></html>\n";
}

}  // namespace wheatstone
