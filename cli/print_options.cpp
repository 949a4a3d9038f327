#include "print_options.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "placeholders.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/matching/match.h"

namespace wheatstone::cli {
namespace {

Rgb8 parse_named_colour(const std::string& option, const std::string& words) {
  constexpr std::array<std::pair<std::string_view, Rgb8>, 4> named{
      {{"white", {255, 255, 255}}, {"black", {0, 0, 0}}, {"grey", {128, 128, 128}}, {"cream", {246, 240, 226}}}};
  for (const auto& [name, colour] : named)
    if (name == words) return colour;
  return parse_colour(option, words);
}

/// "40", "3%" or either with a colour behind a comma.
Border parse_border(const std::string& option, const std::string& words) {
  const std::size_t comma = words.find(',');
  const std::string width = words.substr(0, comma);
  Border border;
  border.is_share = width.ends_with('%');
  constexpr double most_percent = 50, most_px = 16384;
  border.width = border.is_share ? parse_share(option, width, {0, most_percent})
                                 : static_cast<float>(parse_integer(option, width, {0, most_px}));
  if (comma != std::string::npos) border.colour = parse_named_colour(option, words.substr(comma + 1));
  return border;
}

std::string parse_caption(const std::string& option, const std::string& words) {
  if (!is_utf8(words)) throw Error(ErrorKind::wrong_usage, option + ": is not UTF-8");
  if (std::ranges::all_of(words, [](unsigned char c) { return c <= ' '; }))
    throw Error(ErrorKind::wrong_usage, option + ": is empty, expected a text");
  filled(option, words, std::array<Placeholder, 2>{{{"title", {}}, {"date", {}}}});  // refused before anything is read
  return words;
}

/// The strips that are typed, or those that the matched views need.
FloatingWindow window_for(const StereoPair& pair, const TypedWindow& typed, const Session& session) {
  if (!typed) {
    const std::optional<MatchedPair> matched = match_if_any(pair, {}, session.progress);
    const FloatingWindow window = matched ? floating_window_for(matched->geometry) : FloatingWindow{};
    remark(session, fmt::format("floating window: {} pixels at the left edge, {} at the right", window.left_px,
                                window.right_px));
    return window;
  }
  const int width = pair.left.width();
  if (typed->left_px + typed->right_px >= width)
    throw Error(ErrorKind::wrong_usage, fmt::format("--floating-window: is '{},{}', which leaves nothing of {} pixels",
                                                    typed->left_px, typed->right_px, width));
  return *typed;
}

TypedWindow parse_strips(const std::string& option, const std::string& words) {
  if (words == "auto") return std::nullopt;
  const std::vector<int> strips = parse_integers(option, words, {',', 2, {0, 65535}, "LEFT,RIGHT or auto"});
  return FloatingWindow{strips[0], strips[1]};
}

/// "2019:07:18 14:03:22" as "2019-07-18".
std::string date_of(const std::string& taken) {
  std::string date = taken.substr(0, 10);
  std::ranges::replace(date, ':', '-');
  return date;
}

}  // namespace

Rows print_rows(PrintArguments& a, const Reasons& unless_framed, Reasons unless_bordered, Reasons unless_floating) {
  unless_bordered.insert(unless_bordered.end(), unless_framed.begin(), unless_framed.end());
  const auto crop = [](const std::string& option, const std::string& words) { return parse_crop(words, option); };
  return under(
      "Prints and shows",
      {row("--crop", parsed(a.frame.crop, crop, "WIDTHxHEIGHT+X+Y"),
           "Part of each view that is kept, in pixels; WIDTHxHEIGHT keeps the middle, 4:3 the largest part of this "
           "shape"),
       row("--border", parsed(a.frame.border, parse_border, "WIDTH[,COLOUR]"),
           "Border around each view, in pixels or in % of its longer side; white, or with a colour: 40,black or "
           "3%,F6F0E2",
           std::move(unless_bordered)),
       row("--caption", parsed(a.caption, parse_caption, "TEXT"),
           "Text below each view; {title} stands for the title of the photograph, or else the name of its file, and "
           "{date} for the day when it was taken",
           unless_framed),
       row("--keep-location", flag(a.keep_location),
           "Also write the place where the photograph was taken into the files; the other notes of its camera are "
           "always written, in JPEG, MPO, JPS and PNG"),
       row("--floating-window", parsed(a.floating_window, parse_strips),
           "Width LEFT,RIGHT in pixels of the black strips at the left edge of the left view and the right edge of the "
           "right view; auto: as wide as needed for the frame to cut nothing before the screen for one eye only, found "
           "by matching",
           std::move(unless_floating))});
}

std::vector<Image<Rgb8>> put_in_frame(std::vector<Image<Rgb8>> views, const PrintArguments& arguments,
                                      const PrintFrame& frame, float shift_px, const Session& session) {
  if (frame.crop)
    for (Image<Rgb8>& view : views) view = cropped(view, *frame.crop);
  if (shift_px != 0) views = shifted_views(std::move(views), shift_px);
  if (arguments.floating_window) {
    if (views.size() != 2)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--floating-window: is for two views, but there are {}", views.size()));
    StereoPair pair{std::move(views[0]), std::move(views[1])};
    const FloatingWindow window = window_for(pair, *arguments.floating_window, session);
    put_floating_window(pair, window.left_px, window.right_px);
    views[0] = std::move(pair.left);
    views[1] = std::move(pair.right);
  }
  if (frame.border || !frame.caption.empty())
    for (Image<Rgb8>& view : views) view = with_border_and_caption(view, frame);
  return views;
}

PrintFrame print_frame_from(const PrintArguments& arguments, const PictureNotes& notes,
                            const std::filesystem::path& file) {
  PrintFrame frame = arguments.frame;
  const std::string title = notes.title.empty() ? file.stem().string() : notes.title;
  frame.caption = filled("--caption", arguments.caption,
                         std::array<Placeholder, 2>{{{"title", title}, {"date", date_of(notes.taken)}}});
  if (notes.taken.empty() && arguments.caption.find("{date}") != std::string::npos) {
    // "Apples, {date}" without a date is "Apples".
    constexpr const char* separators = " ,;:-/|";
    frame.caption.erase(0, frame.caption.find_first_not_of(separators));
    frame.caption.erase(frame.caption.find_last_not_of(separators) + 1);
  }
  return frame;
}

}  // namespace wheatstone::cli
