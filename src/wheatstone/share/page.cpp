#include "wheatstone/share/page.h"

#include <fmt/format.h>

#include <charconv>
#include <iterator>

#include "wheatstone/files/text_encoding.h"
#include "wheatstone/share/page_code_internal.h"

namespace wheatstone {
namespace {

/// As a Content-Security-Policy names a text.
std::string source_of(const PageText& text) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < text.sha256.size(); i += 2) {
    unsigned byte = 0;
    std::from_chars(text.sha256.data() + i, text.sha256.data() + i + 2, byte, 16);
    bytes.push_back(static_cast<char>(byte));
  }
  return fmt::format("'sha256-{}'", base64(bytes));
}

/// JSON that no text in it can end early: a "<" stands in strings only.
std::string script_text(std::string_view json) {
  std::string result;
  for (const char c : json) {
    if (c == '<') {
      result += "\\u003c";
    } else {
      result += c;
    }
  }
  return result;
}

std::string_view as_text(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

constexpr std::string_view without_script =
    "This page needs JavaScript to show the depth of the picture, which is shown still without it.";

}  // namespace

std::string html_page(const SharedPicture& picture, const PageWords& words) {
  std::string page;
  const auto to = std::back_inserter(page);
  // The code stands before the data: it can say that they were cut off.
  page += html_head(words.title, page_style.text,
                    fmt::format("default-src 'none'; script-src {}; style-src {}; img-src data: blob:; media-src "
                                "{}blob:; base-uri 'none'; form-action 'none'",
                                source_of(page_code), source_of(page_style), picture.has_file_beside ? "'self' " : ""),
                    fmt::format("<script>{}</script>\n", page_code.text));
  fmt::format_to(to,
                 "<figure>\n<wheatstone-picture src=\"#picture\"><img src=\"data:image/jpeg;base64,{}\" width=\"{}\" "
                 "height=\"{}\" alt=\"{}\"></wheatstone-picture>\n",
                 base64(picture.still_jpeg), picture.width, picture.height,
                 html_text(words.description.empty() ? words.title : words.description));
  if (!words.caption.empty()) fmt::format_to(to, "<figcaption>{}</figcaption>\n", html_text(words.caption));
  fmt::format_to(to, "<noscript><p>{}</p></noscript>\n</figure>\n", without_script);
  fmt::format_to(to, "<script type=\"application/json\" id=\"picture\">{}</script>\n", script_text(picture.facts));
  for (const PagePart& part : picture.parts)
    fmt::format_to(to, "<script type=\"text/plain\" data-part=\"picture/{}\">base64:{}:{}</script>\n", part.name,
                   part.bytes.size(), base64(as_text(part.bytes)));
  page += "</body></html>\n";
  return page;
}

std::size_t page_bytes(const SharedPicture& picture) {
  const auto in_base64 = [](std::size_t bytes) { return (bytes + 2) / 3 * 4; };
  constexpr std::size_t around = 1000, around_part = 80;
  std::size_t bytes = around + page_code.text.size() + page_style.text.size() + picture.facts.size() +
                      in_base64(picture.still_jpeg.size());
  for (const PagePart& part : picture.parts) bytes += around_part + in_base64(part.bytes.size());
  return bytes;
}

std::string_view page_element_code() { return page_code.text; }

}  // namespace wheatstone
