#include "wheatstone/photograph/read_views.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/photograph/card_windows_internal.h"
#include "wheatstone/photograph/find_layout.h"
#include "wheatstone/photograph/jpeg_segments_internal.h"
#include "wheatstone/photograph/multi_picture_internal.h"
#include "wheatstone/photograph/stereo_marks_internal.h"
#include "wheatstone/photograph/xmp_internal.h"
#include "wheatstone/pictures/heif_pictures.h"
#include "wheatstone/pictures/jpeg.h"
#include "wheatstone/pictures/open_picture.h"
#include "wheatstone/pictures/picture_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, std::string_view what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), what));
}

std::string kind_of(std::string_view bytes, const fs::path& path) {
  if (is_jpeg(bytes)) return "JPEG";
  if (bytes.starts_with("\x89PNG")) return "PNG";
  if (is_heif(bytes)) return "HEIC";
  if (bytes.starts_with("GIF8")) return "GIF";
  std::string ending = ending_of(path);
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::toupper(c); });
  return ending.empty() ? "picture" : ending.substr(1);
}

void check_one_size(const std::vector<Image<Rgb8>>& views, const fs::path& path) {
  for (const Image<Rgb8>& view : views)
    if (!same_size(view, views.front()))
      refuse(path, fmt::format("its views have {}x{} and {}x{} pixels, expected one size", views.front().width(),
                               views.front().height(), view.width(), view.height()));
}

// ---- a picture a view

bool is_layout_given(const ReadViewsOptions& options) { return options.layout || options.scan; }

[[noreturn]] void refuse_layout(const fs::path& path, std::string_view contents) {
  throw Error(ErrorKind::wrong_usage,
              fmt::format("{}: {}, one per view, expected one picture with both views for a given layout",
                          path.string(), contents));
}

bool is_view(const MultiPictureEntry& entry) {
  return entry.type == multi_picture_disparity || entry.type == multi_picture_primary ||
         entry.type == multi_picture_undefined;
}

/// The entries that are views, from left to right; none where the index is of something else.
std::vector<MultiPictureEntry> views_among(std::vector<MultiPictureEntry> entries, std::string_view bytes) {
  const bool says_disparity = std::any_of(entries.begin(), entries.end(), [](const MultiPictureEntry& entry) {
    return entry.type == multi_picture_disparity;
  });
  std::erase_if(entries, [](const MultiPictureEntry& entry) { return !is_view(entry); });
  // Many files say "undefined" of everything. A gain map or a preview among them has not the photograph's size.
  if (!says_disparity && !entries.empty()) {
    const auto size_of = [&](const MultiPictureEntry& entry) {
      return jpeg_size(bytes.substr(entry.begin, entry.length));
    };
    const auto size = size_of(entries.front());
    std::erase_if(entries, [&](const MultiPictureEntry& entry) { return size_of(entry) != size; });
  }
  // Views are numbered from the left (DC-007, sec. 5.2.4.1), where all are.
  const bool numbered = std::all_of(entries.begin(), entries.end(),
                                    [](const MultiPictureEntry& entry) { return entry.number.has_value(); });
  if (numbered)
    std::stable_sort(entries.begin(), entries.end(),
                     [](const MultiPictureEntry& a, const MultiPictureEntry& b) { return *a.number < *b.number; });
  return entries;
}

/// Takes pictures as the views, in their profile where that is wanted.
void take_views(std::vector<PictureInProfile> pictures, const ReadViewsOptions& options, ViewsFile& file) {
  file.colour_profile = bring_to_one_profile(pictures, options.keep_profile);
  for (PictureInProfile& picture : pictures) file.views.push_back(std::move(picture.picture));
}

/// The views of a JPEG with an index of them; none where it is an ordinary JPEG.
std::optional<ViewsFile> multi_picture_views(std::string_view bytes, const fs::path& path,
                                             const ReadViewsOptions& options) {
  const bool is_mpo = ending_of(path) == ".mpo";
  // A program that changed a photograph may have left an index that no longer fits: who says what is in it is believed.
  if (is_layout_given(options) && !is_mpo) {
    try {
      if (views_among(read_multi_picture_index(bytes, path), bytes).size() < 2) return {};
    } catch (const Error&) {
      return {};
    }
  }
  const std::vector<MultiPictureEntry> all = read_multi_picture_index(bytes, path);
  const std::vector<MultiPictureEntry> entries = views_among(all, bytes);
  if (entries.size() < 2) {
    if (!is_mpo) return {};
    if (all.empty()) refuse(path, "has no MP index, expected an MPO of two or more views");
    refuse(path, fmt::format("holds {} view{}, expected two or more", entries.empty() ? "no" : "one",
                             entries.empty() ? "s" : ""));
  }
  if (is_layout_given(options)) refuse_layout(path, fmt::format("contains {} pictures", entries.size()));
  ViewsFile file;
  file.kind = "MPO";
  std::vector<PictureInProfile> pictures;
  for (const MultiPictureEntry& entry : entries)
    pictures.push_back(decode_jpeg_in_profile(bytes.substr(entry.begin, entry.length), path));
  take_views(std::move(pictures), options, file);
  check_one_size(file.views, path);
  return file;
}

/// Google's VR photographs (VR180, Cardboard): the picture is the left eye's, and its XMP holds the right eye's.
/// https://developers.google.com/vr/reference/cardboard-camera-vr-photo-format
std::optional<ViewsFile> views_with_xmp(std::string_view bytes, const fs::path& path, const ReadViewsOptions& options) {
  if (is_layout_given(options) || bytes.find("GImage:Mime") == bytes.npos) return {};
  const Xmp xmp = read_xmp(bytes, path);
  const auto data = xmp_property(xmp, "GImage:Data");
  if (!data) return {};
  const std::optional<std::string> right = decode_base64(*data);
  if (!right || !is_jpeg(*right)) refuse(path, "the right eye's picture in its XMP is not a JPEG");
  ViewsFile file;
  file.kind = "VR photograph";
  std::vector<PictureInProfile> pictures;
  pictures.push_back(read_in_profile(path));
  pictures.push_back(decode_jpeg_in_profile(*right, path));
  take_views(std::move(pictures), options, file);
  check_one_size(file.views, path);
  return file;
}

std::optional<ViewsFile> heif_views(const fs::path& path, const ReadViewsOptions& options) {
  std::vector<PictureInProfile> pictures = read_heif_pictures(path);
  if (pictures.size() < 2) return {};
  if (pictures.size() > 2 || !same_size(pictures[0].picture, pictures[1].picture))
    refuse(path, fmt::format("holds {} pictures, and the installed libheif {} does not report which are a stereo pair; "
                             "expected two of one size",
                             pictures.size(), heif_version()));
  if (is_layout_given(options)) refuse_layout(path, "contains 2 pictures");
  ViewsFile file;
  file.kind = "HEIC";
  take_views(std::move(pictures), options, file);
  file.note = fmt::format(
      "libheif {} does not report which eye a picture belongs to: the first is used for the left eye", heif_version());
  return file;
}

/// The views of an animation of two frames; none where it has one.
std::optional<ViewsFile> views_in_time(const fs::path& path, std::string_view kind, const ReadViewsOptions& options) {
  constexpr int two = 2;
  std::vector<Image<Rgb8>> frames = read_picture_frames(path, two + 1);
  if (frames.size() < two) return {};
  if (frames.size() > two) refuse(path, "has more than two frames, expected two: the left view, then the right view");
  if (is_layout_given(options)) refuse_layout(path, "contains 2 frames");
  check_one_size(frames, path);
  ViewsFile file;
  file.kind = kind;
  file.views = std::move(frames);
  file.note = "the first frame is used for the left eye";
  return file;
}

// ---- one picture that holds both

StereoLayout layout_of(const JpsDescriptor& descriptor, const fs::path& path) {
  using Arrangement = JpsDescriptor::Arrangement;
  if (!descriptor.stereo) refuse(path, "is for one eye only, according to its JPS descriptor");
  const bool side_by_side = descriptor.arrangement == Arrangement::side_by_side;
  if (!side_by_side && descriptor.arrangement != Arrangement::over_under)
    refuse(path, fmt::format("is {} according to its JPS descriptor, expected side by side or one above the other",
                             descriptor.arrangement == Arrangement::anaglyph ? "an anaglyph" : "interleaved"));
  StereoLayout layout = side_by_side ? StereoLayout::left_right : StereoLayout::top_bottom;
  if (!descriptor.left_first) layout = with_eyes_swapped(layout);
  return with_half_size(layout, side_by_side ? descriptor.half_width : descriptor.half_height);
}

struct KnownLayout {
  StereoLayout layout;
  HowKnown how;
};

/// The layout that is given or that the file says of a picture of this size.
std::optional<KnownLayout> told_layout(std::string_view bytes, const fs::path& path, int width, int height,
                                       const ReadViewsOptions& options) {
  if (options.layout) return KnownLayout{*options.layout, HowKnown::given};
  if (const auto descriptor = read_jps_descriptor(bytes, path))
    return KnownLayout{layout_of(*descriptor, path), HowKnown::metadata};
  if (const auto chunk = read_stereo_chunk(bytes))
    return KnownLayout{chunk->left_first ? StereoLayout::left_right : StereoLayout::right_left, HowKnown::metadata};
  const std::optional<StereoLayout> by_name = layout_from_name(path, width, height);
  if (by_name) return KnownLayout{*by_name, HowKnown::name};
  const std::string ending = ending_of(path);
  if (ending == ".jps" || ending == ".pns") return KnownLayout{StereoLayout::right_left, HowKnown::name};
  return {};
}

/// Whether a first look at a JPEG shows that it holds one view, as most photographs do.
bool holds_one_view(std::string_view bytes, const fs::path& path, const ReadViewsOptions& options) {
  // The size only tells whether views are squeezed.
  if (!is_jpeg(bytes) || told_layout(bytes, path, 1, 1, options)) return false;
  return !arrangement_of_halves(decode_small_jpeg(bytes, path));
}

/// Takes out the columns between the two pictures of a PNG with the chunk sTER: the right one begins at a column that
/// is a multiple of eight, so the whole is wider than two by what is missing there.
Image<Rgb8> without_gap(Image<Rgb8> picture) {
  constexpr int alignment = 8;
  const int width = picture.width();
  // A view of 8 k + r columns, r from 1 to 8, makes a picture of 16 k + 8 + r.
  const int rest = (width + alignment - 1) % (2 * alignment) + 1;
  if (rest > alignment) return picture;
  const int view = (width - alignment - rest) / 2 + rest;
  Image<Rgb8> joined(2 * view, picture.height());
  for (int y = 0; y < picture.height(); ++y) {
    std::copy_n(picture.row(y).begin(), view, joined.row(y).begin());
    std::copy_n(picture.row(y).end() - view, view, joined.row(y).begin() + view);
  }
  return joined;
}

ViewsFile views_of_scan(ImageView<const Rgb8> picture, const fs::path& path, ScanLayout layout) {
  ViewsFile file;
  file.scan = layout;
  file.how_known = HowKnown::given;
  StereoPair pair;
  if (layout == ScanLayout::card) {
    const std::optional<CardWindows> windows = find_card_windows(picture);
    if (!windows)
      refuse(path,
             "no two windows of a stereograph card are found, expected two pictures of one size, side by side, "
             "on a mount of one colour");
    pair = cut_card(picture, *windows);
    file.note = describe_card(*windows);
  } else {
    pair = separate_anaglyph(picture, layout);
    file.note = "each view kept only some of its colours: both are grey";
  }
  file.views.push_back(std::move(pair.left));
  file.views.push_back(std::move(pair.right));
  return file;
}

std::optional<ViewsFile> views_in_one_picture(std::string_view bytes, const fs::path& path,
                                              const ReadViewsOptions& options) {
  if (!options.scan && holds_one_view(bytes, path, options)) return {};
  PictureInProfile read = read_in_profile(path);
  // An anaglyph's colours tell its views apart.
  const std::string profile = bring_to_one_profile({&read, 1}, options.keep_profile && !options.scan);
  Image<Rgb8> picture = std::move(read.picture);
  if (options.scan) return views_of_scan(picture, path, *options.scan);
  std::optional<KnownLayout> known = told_layout(bytes, path, picture.width(), picture.height(), options);
  if (!known)
    if (const auto seen = layout_from_halves(picture)) known = {*seen, HowKnown::halves};
  if (!known) return {};
  if (known->how == HowKnown::metadata && read_stereo_chunk(bytes)) picture = without_gap(std::move(picture));
  ViewsFile file;
  file.colour_profile = profile;
  if (std::optional<Image<Rgb8>> even = without_middle(picture, known->layout)) {
    picture = std::move(*even);
    file.note = fmt::format("the middle {} belongs to neither view", is_side_by_side(known->layout) ? "column" : "row");
  }
  StereoPair pair = cut_apart(picture, known->layout, path.string());
  file.views.push_back(std::move(pair.left));
  file.views.push_back(std::move(pair.right));
  file.kind = ending_of(path) == ".jps" && is_jpeg(bytes) ? "JPS" : kind_of(bytes, path);
  file.layout = known->layout;
  file.how_known = known->how;
  return file;
}

}  // namespace

std::string_view how_known_words(HowKnown how) {
  switch (how) {
    case HowKnown::given:
      return "given";
    case HowKnown::metadata:
      return "from its metadata";
    case HowKnown::name:
      return "from its name";
    case HowKnown::halves:
      break;
  }
  return "from comparing its halves";
}

ReadViewsOptions options_for_layout(std::string_view name) {
  ReadViewsOptions options;
  options.scan = find_scan_layout(name);
  if (options.scan) return options;
  options.layout = find_stereo_layout(name);
  if (options.layout) return options;
  const auto anaglyphs = scan_layouts().subspan(1);
  std::vector<std::string_view> names;
  for (const ScanTraits& traits : anaglyphs) names.push_back(traits.name);
  if (name == "anaglyph")
    throw Error(ErrorKind::wrong_usage, fmt::format("layout: is 'anaglyph', expected one that names the colours of its "
                                                    "glasses, the left eye's first: {}",
                                                    fmt::join(names, ", ")));
  throw Error(ErrorKind::wrong_usage, fmt::format("layout: is '{}', expected one of {}, card, {}", name,
                                                  stereo_layout_names(), fmt::join(names, ", ")));
}

std::vector<std::string_view> photograph_layout_names() {
  std::vector<std::string_view> names(layout_names().begin(), layout_names().end());
  for (const ScanTraits& traits : scan_layouts()) names.push_back(traits.name);
  return names;
}

std::string describe_views(const ViewsFile& file) {
  if (file.scan) return fmt::format("{} ({})", traits_of(*file.scan).words, how_known_words(file.how_known));
  if (file.layout) return fmt::format("{} ({})", traits_of(*file.layout).words, how_known_words(file.how_known));
  return fmt::format("{}, {} pictures ({})", file.kind, file.views.size(), how_known_words(file.how_known));
}

std::optional<ViewsFile> find_views(const fs::path& path, const ReadViewsOptions& options) {
  const std::string bytes = read_picture_bytes(path);
  std::optional<ViewsFile> file;
  if (is_jpeg(bytes)) file = multi_picture_views(bytes, path, options);
  if (is_jpeg(bytes) && !file) file = views_with_xmp(bytes, path, options);
  if (is_heif(bytes)) file = heif_views(path, options);
  if (may_be_animated(bytes)) file = views_in_time(path, kind_of(bytes, path), options);
  if (!file) file = views_in_one_picture(bytes, path, options);
  if (file && options.swap) std::reverse(file->views.begin(), file->views.end());
  return file;
}

ViewsFile read_views(const fs::path& path, const ReadViewsOptions& options) {
  std::optional<ViewsFile> file = find_views(path, options);
  if (file) return std::move(*file);
  refuse(path, "holds one view; expected two files, or a stereo photograph whose layout is found or given");
}

}  // namespace wheatstone
