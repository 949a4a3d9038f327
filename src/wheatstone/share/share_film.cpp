#include "wheatstone/share/share_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/share/surface_parts_internal.h"
#include "wheatstone/video/stereo_film.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

struct PlayedCodec {
  std::string_view codec, words;
};
constexpr std::array<PlayedCodec, 5> played_codecs{
    {{"h264", "H.264"}, {"hevc", "H.265 (HEVC)"}, {"vp8", "VP8"}, {"vp9", "VP9"}, {"av1", "AV1"}}};

/// What a browser is told of a file. QuickTime and Matroska are read by what also reads MP4 and WebM.
std::string_view type_of(const FilmFacts& facts) {
  if (facts.container == "mp4" || facts.container == "mov" || facts.container == "quicktime") return "video/mp4";
  if (facts.container == "matroska" || facts.container == "webm") return "video/webm";
  return {};
}

/// How the views lie in each frame, and the first frame's still picture.
struct FilmViews {
  FilmFacts facts;
  QuiltLayout places;
  bool upwards = true, leftwards = false;
  Image<Rgb8> still;
  std::optional<std::string> loss = {};
};

FilmViews views_of_quilts(const fs::path& film, const QuiltLayout& quilt) {
  FilmReader reader = open_film(film);
  Frame frame;
  if (!reader.read(frame)) throw Error(ErrorKind::bad_input, fmt::format("{}: has no frames", film.string()));
  std::vector<Image<Rgb8>> views = views_of_quilt(frame.picture, quilt);
  reader.skip_rest();
  return {reader.facts(), quilt, true, false, std::move(views[views.size() / 2]), reader.loss()};
}

FilmViews views_of_eyes(const fs::path& film, std::optional<StereoLayout> layout) {
  StereoFilmReader reader = open_stereo_film(film, layout);
  const LayoutTraits& traits = traits_of(reader.layout());
  const bool beside = traits.arrangement == Arrangement::side_by_side;
  if (!beside && traits.arrangement != Arrangement::over_under)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: its layout is {}, expected both eyes side by side or one above the other (--layout "
                            "where the film does not say)",
                            film.string(), traits.name));
  StereoFrame frame;
  if (!reader.read(frame)) throw Error(ErrorKind::bad_input, fmt::format("{}: has no frames", film.string()));
  reader.skip_rest();
  if (beside) return {reader.facts(), {2, 1}, true, traits.right_first, std::move(frame.left), reader.loss()};
  return {reader.facts(), {1, 2}, traits.right_first, false, std::move(frame.left), reader.loss()};
}

/// Subtitles as the page has them. What browsers would not read is refused here, where somebody can mend it.
PagePart subtitles_part(const fs::path& file) {
  constexpr std::size_t most_bytes = 4'000'000;
  const std::string text = read_whole_file(file, most_bytes);
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF", signature = "WEBVTT";
  const std::string_view begin = std::string_view(text).substr(text.starts_with(byte_order_mark) ? 3 : 0);
  if (!begin.starts_with(signature))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: does not begin with WEBVTT, expected subtitles as a WebVTT file", file.string()));
  return {"subtitles", {text.begin(), text.end()}};
}

/// The address of a film from where a page stands.
std::string address_of(const fs::path& film, const fs::path& page) {
  const fs::path folder = fs::absolute(page).parent_path();
  std::string address;
  for (const char c : fs::absolute(film).lexically_relative(folder).generic_string()) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                          std::string_view("/._-~").find(c) != std::string_view::npos;
    address += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return address;
}

}  // namespace

SharedPicture share_film(const fs::path& film, const ShareFilmOptions& options) {
  const FilmViews views = options.quilt ? views_of_quilts(film, *options.quilt) : views_of_eyes(film, options.layout);
  const std::string_view type = type_of(views.facts);
  const auto codec = std::ranges::find(played_codecs, views.facts.codec, &PlayedCodec::codec);
  if (type.empty() || codec == played_codecs.end() || fs::is_directory(film))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is {} in {}, which browsers do not play; expected H.264, VP8, VP9 or AV1 in MP4, "
                            "QuickTime, Matroska or WebM",
                            film.string(), views.facts.codec, views.facts.container));
  // A light-field display's views stand farther apart than the eyes that look at it.
  SharedPicture shared{.width = views.still.width(), .height = views.still.height()};
  shared.still_jpeg = still_of(views.still);
  // The page plays what there is.
  if (views.loss) shared.note = *views.loss;
  Json facts = facts_of_views(options.title, shared.width, shared.height, views.places);
  facts["upwards"] = views.upwards;
  facts["leftwards"] = views.leftwards;
  facts["type"] = type;
  facts["codec"] = codec->words;
  facts["hasSound"] = std::ranges::count(views.facts.side_streams, "audio", &SideStream::kind) > 0;
  facts["hasSubtitles"] = !options.subtitles.empty();
  if (!options.subtitles.empty()) shared.parts.push_back(subtitles_part(options.subtitles));
  const std::uintmax_t bytes = fs::file_size(film);
  if (page_bytes(shared) + bytes * 4 / 3 <= options.most_bytes) {
    const std::string whole = read_whole_file(film, std::numeric_limits<std::size_t>::max());
    shared.parts.push_back({"views", {whole.begin(), whole.end()}});
  } else {
    facts["file"] = address_of(film, options.page);
    shared.has_file_beside = true;
    shared.note += shared.note.empty() ? "" : "; ";
    shared.note += fmt::format(
        "the film takes {:.1f} MB, so that the page plays {} from where it is; a server has to "
        "send both",
        static_cast<double>(bytes) / 1e6, film.string());
  }
  shared.facts = text_of(facts);
  return shared;
}

}  // namespace wheatstone
