#include "stereo_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/matching/eye_order.h"
#include "wheatstone/matching/not_a_pair.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/fitting_pair.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone::cli {
namespace {

void check_sizes(const StereoPair& pair, const std::string& left, const std::string& right) {
  check_same_size(right + ":", pair.right, left + "'s", pair.left);
  constexpr int least_side_px = 16;
  if (pair.left.width() < least_side_px || pair.left.height() < least_side_px)
    throw Error(ErrorKind::bad_input, fmt::format("{}: is {}x{} pixels, expected at least {}x{}", left,
                                                  pair.left.width(), pair.left.height(), least_side_px, least_side_px));
}

/// The two views that are painted or matched: neighbours in the middle where there are more.
StereoPair middle_pair(ViewsFile& file) {
  const std::size_t right = file.views.size() / 2;
  return {std::move(file.views[right - 1]), std::move(file.views[right])};
}

/// One picture without depth.
NamedPair read_flat(const std::string& file) {
  Image<Rgb8> picture = read_image(file);
  check_sizes({picture, picture}, file, file);
  return {
      {std::move(picture), {}},
      file,
      fmt::format(
          "{}: one picture without depth, painted flat; --depth gives it depth, --layout says how it holds two views",
          file)};
}

NamedPair read_one_file(const StereoArguments& arguments) {
  ReadViewsOptions options = arguments.layout.empty() ? ReadViewsOptions() : options_for_layout(arguments.layout);
  options.swap = arguments.swap;
  options.keep_profile = arguments.keep_profile;
  std::optional<ViewsFile> found = find_views(arguments.left, options);
  if (!found && arguments.may_be_flat && arguments.layout.empty() && !arguments.swap) return read_flat(arguments.left);
  if (!found)
    throw Error(
        ErrorKind::bad_input,
        fmt::format("{}: holds one view; give LEFT and RIGHT, or --layout ('paint' and 'share' also take --depth)",
                    arguments.left));
  ViewsFile file = std::move(*found);
  std::string how = describe_views(file);
  if (file.views.size() > 2)
    how += fmt::format(", of which {} and {} are taken", file.views.size() / 2, file.views.size() / 2 + 1);
  if (arguments.swap) how += ", swapped";
  if (!file.note.empty()) how += "; " + file.note;
  NamedPair read{middle_pair(file), fmt::format("{} ({})", arguments.left, how),
                 fmt::format("{}: {}", arguments.left, how), file.how_known == HowKnown::halves,
                 std::move(file.colour_profile)};
  check_sizes(read.pictures, arguments.left, arguments.left);
  return read;
}

/// Makes a pair smaller where its longer side is above `longest_px`, which 0 leaves open; gives the size that it had.
PictureSize reduce(StereoPair& pair, int longest_px) {
  const PictureSize whole{pair.left.width(), pair.left.height()};
  if (longest_px == 0 || std::max(whole.width, whole.height) <= longest_px) return {};
  const PictureSize size = reduced_size(whole, longest_px);
  pair = {reduced(pair.left, size), pair.right.empty() ? Image<Rgb8>() : reduced(pair.right, size)};
  return whole;
}

NamedPair read_two_files(const StereoArguments& arguments) {
  if (!arguments.layout.empty())
    throw Error(ErrorKind::wrong_usage, "--layout is for one file that holds both views, but two files are given");
  std::array<PictureInProfile, 2> files = read_two_in_profile(arguments.left, arguments.right);
  const std::string profile = bring_to_one_profile(files, arguments.keep_profile);
  StereoPair pair{std::move(files[0].picture), std::move(files[1].picture)};
  std::string framed;
  const PictureSize left{pair.left.width(), pair.left.height()}, right{pair.right.width(), pair.right.height()};
  if (differ_by_few(left, right)) {
    frame_common_part(pair);
    framed = fmt::format("{}, {}: {}x{} and {}x{} pixels, framed to the common {}x{}", arguments.left, arguments.right,
                         left.width, left.height, right.width, right.height, pair.left.width(), pair.left.height());
  }
  check_sizes(pair, arguments.left, arguments.right);
  NamedPair read{std::move(pair), fmt::format("{}, {}", arguments.left, arguments.right), {}};
  read.colour_profile = profile;
  read.framed = std::move(framed);
  if (arguments.swap) std::swap(read.pictures.left, read.pictures.right);
  return read;
}

}  // namespace

Row layout_row(std::string& layout, Reasons unless, std::string_view also) {
  return row("--layout", text(layout),
             fmt::format("Layout of one file that holds both views: {}{}; detected by default",
                         fmt::join(photograph_layout_names(), ", "), also),
             std::move(unless));
}

Row swap_row(bool& swap, Reasons unless) { return row("--swap", flag(swap), "Swap the two views", std::move(unless)); }

Row max_size_row(int& longest_px, Reasons unless) {
  return row("--max-size", without_default(number(longest_px, {16, 65535})),
             "Work on a reduced copy whose longer side has at most this many pixels", std::move(unless));
}

Row rectify_row(RectifyPolicy& policy, Reasons unless) {
  static constexpr std::array<Choice<RectifyPolicy>, 3> policies{
      {{"auto", RectifyPolicy::automatic}, {"never", RectifyPolicy::never}, {"always", RectifyPolicy::always}}};
  return row("--rectify", choice(policy, policies),
             "Rectify the views first, as 'wheatstone rectify' does; auto: if their rows differ", std::move(unless));
}

Rows pair_rows(StereoArguments& arguments) {
  return {
      row("LEFT", required(text(arguments.left)),
          "Left photograph; or one file with both views: MPO, JPS, side by side, one above the other; or a folder of "
          "photographs"),
      row("RIGHT", text(arguments.right), "Right photograph, of the same size")};
}

Image<float> read_disparity_argument(const std::string& argument) {
  const std::size_t colon = argument.rfind(':');
  if (colon == std::string::npos || std::filesystem::exists(argument)) return read_disparity(argument);
  // Stored values are divided by the scale.
  const auto scale = static_cast<float>(
      parse_number(argument.substr(0, colon) + ": the scale", argument.substr(colon + 1), {1e-9, 1e9}));
  return read_disparity(argument.substr(0, colon), scale);
}

StereoPair read_pair(const std::string& left, const std::string& right) {
  auto [of_left, of_right] = read_two_images(left, right);
  StereoPair pair{std::move(of_left), std::move(of_right)};
  check_sizes(pair, left, right);
  return pair;
}

PreparedPair prepare_named_pair(StereoPair pair, const PreparePairOptions& options, const std::string& name,
                                const Session& session) {
  try {
    return prepare_pair(std::move(pair), options, session.progress);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_input) throw;
    throw Error(error.kind(), fmt::format("{}: {}", name, error.what()));
  }
}

void tell_of_rows(const PreparedPair& pair, const std::string& name, const Session& session) {
  if (const std::string note = rectified_note(pair); !note.empty()) remark(session, fmt::format("{}: {}", name, note));
  for (const std::string& warning : {row_warning(pair), area_warning(pair)})
    if (!warning.empty()) remark(session, fmt::format("warning: {}: {}", name, warning));
}

void tell_of_match(const ReadPhotograph& photograph, const MatchConfidence& confidence, const Session& session) {
  const std::string warning = match_warning(confidence);
  if (warning.empty() || !row_warning(photograph.pair).empty()) return;
  remark(session, fmt::format("warning: {}: {}", photograph.name, warning));
}

std::string_view undecided_eyes(const PreparedPair& pair) {
  if (pair.eyes != EyeOrder::undecided) return {};
  return "the pictures do not tell left from right; --swap if near and far come out the wrong way round";
}

NamedPair read_named_pair(const StereoArguments& arguments) {
  return arguments.right.empty() ? read_one_file(arguments) : read_two_files(arguments);
}

void tell_of_layout(const NamedPair& pair, const Session& session) {
  for (const std::string& line : {pair.note, pair.framed})
    if (!line.empty()) remark(session, line);
}

ReadPhotograph read_photographs(const StereoArguments& arguments, bool disparity_is_given, const Session& session) {
  if (disparity_is_given && arguments.rectify == RectifyPolicy::always)
    throw Error(ErrorKind::wrong_usage,
                "--rectify changes the pictures, but --disparity belongs to the unchanged pictures; expected only one "
                "of the two");
  report(session.progress, "reading", 0);
  NamedPair read = read_named_pair(arguments);
  const PictureSize whole = reduce(read.pictures, arguments.max_size);
  if (read.pictures.right.empty()) {
    tell_of_layout(read, session);
    return {{.pictures = std::move(read.pictures)}, whole, arguments.left};
  }
  report(session.progress, "comparing the views", 0);
  PreparedPair prepared;
  if (disparity_is_given) {
    if (not_a_pair(read.pictures))
      throw Error(ErrorKind::bad_input, fmt::format("{}: show different scenes", read.name));
    prepared.pictures = std::move(read.pictures);
    prepared.eyes = eye_order(prepared.pictures);
  } else {
    prepared = prepare_named_pair(std::move(read.pictures), {.rectify = arguments.rectify}, read.name, session);
  }
  tell_of_layout(read, session);
  if (!read.eyes_known_from_picture && prepared.eyes == EyeOrder::swapped)
    remark(session, fmt::format("{}: the eyes look swapped; {} --swap if near and far come out the wrong way round",
                                arguments.left, arguments.swap ? "leave out" : "add"));
  std::string name = read.note.empty() ? read.name : arguments.left;
  tell_of_rows(prepared, name, session);
  return {std::move(prepared), whole, std::move(name)};
}

}  // namespace wheatstone::cli
