#include "content.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "film_player.h"
#include "particle_film.h"
#include "wheatstone/calibration/prepare_pair.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/matching/not_a_pair.h"
#include "wheatstone/models/read_model.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/photograph/carried_depth.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/disparity_from_depth.h"
#include "wheatstone/stereo/single_view.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::viewer {
namespace {

struct SizeOf {
  PictureSize operator()(std::monostate) const { return {}; }
  PictureSize operator()(const PaintedContent& content) const {
    if (content.painting) return {width_of(*content.painting), height_of(*content.painting)};
    return {content.photograph->pictures.left.width(), content.photograph->pictures.left.height()};
  }
  PictureSize operator()(const ViewsContent& content) const {
    return {content.views->front().width(), content.views->front().height()};
  }
  PictureSize operator()(const SlicesContent& content) const { return {content.slices->width, content.slices->height}; }
  PictureSize operator()(const ParticlesContent& /*content*/) const { return {}; }
  PictureSize operator()(const ModelContent& /*content*/) const { return {}; }
};

namespace fs = std::filesystem;

/// Who is told of what an opening does, and what is wanted of it.
struct Listeners {
  const Progress& progress;
  const ShowFirst& show;
  const ParticleChoice& particles;
};

void show_as_it_came(const StereoPair& pictures, const ShowFirst& show) {
  if (!show || pictures.left.empty() || !same_size(pictures.left, pictures.right)) return;
  auto photograph = std::make_shared<Photograph>();
  photograph->pictures = pictures;
  show({.content = PaintedContent{nullptr, std::move(photograph)}, .kind = "photograph", .is_ready = false});
}

Opened opened_photograph(StereoPair pictures, const std::string& name, const Listeners& listeners) {
  show_as_it_came(pictures, listeners.show);
  PreparedPair prepared;
  try {
    prepared = prepare_pair(std::move(pictures), {}, listeners.progress);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_input) throw;
    throw Error(error.kind(), fmt::format("{}: {}", name, error.what()));
  }
  Opened opened{.kind = "photograph"};
  for (const std::string& note : {rectified_note(prepared), row_warning(prepared), area_warning(prepared)})
    if (!note.empty()) opened.notes.push_back(note);
  if (prepared.eyes == EyeOrder::swapped) opened.notes.emplace_back("the eyes look swapped");
  auto photograph = std::make_shared<Photograph>();
  photograph->is_rectified = prepared.rectification.has_value();
  photograph->pictures = std::move(prepared.pictures);
  opened.content = PaintedContent{nullptr, std::move(photograph)};
  return opened;
}

Opened opened_with_depth(CarriedDepth found, const fs::path& path) {
  Image<float> disparity;
  try {
    disparity = disparity_from_depth(found.depth, found.picture, {.kind = found.kind});
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", path.string(), error.what()));
  }
  MadePair pair = make_pair_from_single_view(std::move(found.picture), std::move(disparity));
  auto photograph = std::make_shared<Photograph>();
  photograph->pictures = std::move(pair.pictures);
  photograph->geometry = std::move(pair.geometry);
  return {PaintedContent{nullptr, std::move(photograph)}, "picture with depth", {"with the depth of " + found.how}};
}

Opened opened_views(std::vector<Image<Rgb8>> views, std::string kind) {
  // Neighbours are an eye separation apart where nothing tells otherwise.
  const float span = kind == "quilt" ? 1.f : static_cast<float>(views.size() - 1);
  return {ViewsContent{std::make_shared<const std::vector<Image<Rgb8>>>(std::move(views)), span}, std::move(kind), {}};
}

Opened open_picture(const fs::path& path, const Listeners& listeners) {
  if (const std::optional<NamedQuilt> quilt = quilt_of_name(path.filename().string()))
    return opened_views(views_of_quilt(read_image(path), quilt->layout), "quilt");
  if (std::optional<CarriedDepth> depth = find_carried_depth(path)) return opened_with_depth(std::move(*depth), path);
  std::optional<ViewsFile> found = find_views(path);
  if (!found) {
    std::vector<Image<Rgb8>> one;
    one.push_back(read_image(path));
    return {ViewsContent{std::make_shared<const std::vector<Image<Rgb8>>>(std::move(one)), 0}, "picture", {}};
  }
  const std::string how = describe_views(*found);
  if (found->views.size() > 2) return opened_views(std::move(found->views), "views");
  Opened opened = opened_photograph({std::move(found->views[0]), std::move(found->views[1])}, path.string(), listeners);
  opened.notes.insert(opened.notes.begin(), how);
  return opened;
}

/// Whether a file, or what stands for several, is a film.
bool names_film(const fs::path& path) {
  const bool is_two = !fs::exists(path) && path.string().find(',') != std::string::npos;
  return is_film(path) || is_two || fs::is_directory(path);
}

Opened open_film_files(const FilmFiles& files) {
  auto film = std::make_shared<const OpenedFilm>(open_film_to_play(files));
  Opened opened{film->first.content, "film", {}};
  if (film->film.files.layout)
    opened.notes.push_back(
        fmt::format("{} ({})", layout_name(*film->film.files.layout), film->film.quilt ? "a quilt" : film->layout_how));
  opened.film = std::move(film);
  return opened;
}

Opened opened_slice_film(OpenedFilm slices) {
  auto film = std::make_shared<const OpenedFilm>(std::move(slices));
  std::uintmax_t bytes = 0;
  for (const fs::path& file : film->film.slices) bytes += fs::file_size(file);
  const std::size_t count = film->film.slices.size();
  Opened opened{film->first.content, "film of slices", {}};
  opened.notes.push_back(fmt::format("{} frames of slices, {:.1f} MB each", count,
                                     static_cast<double>(bytes) / 1e6 / static_cast<double>(count)));
  opened.film = std::move(film);
  return opened;
}

/// Whether a path is the pattern of snapshots.
bool names_series(const fs::path& path) {
  const std::optional<FramePattern> pattern = frame_pattern(path);
  if (!pattern) return false;
  const std::vector<std::int64_t> numbers = numbers_of(*pattern);
  return !numbers.empty() && holds_particles(pattern->file(numbers.front()));
}

Opened open_particles(const fs::path& path, const Listeners& listeners) {
  auto reader = std::make_shared<ParticleReader>(path);
  const bool is_series = !reader->times().empty();
  const double time = is_series ? reader->times().front() : 0;
  Opened opened{ParticlesContent{reader->read(listeners.particles, time, listeners.progress)}, "particles", {}};
  if (is_series) opened.notes.push_back(fmt::format("a series of {} snapshots", reader->times().size()));
  if (!is_series && series_pattern_of(path))
    opened.notes.emplace_back("'open-series' plays all snapshots of this name");
  opened.reader = std::move(reader);
  return opened;
}

Opened open_model(const fs::path& path, const Listeners& listeners) {
  const auto model = std::make_shared<const ReadyModel>(ready_model(path, {}, listeners.progress));
  return {ModelContent{model}, "model", model->read.warnings};
}

Opened open_without_depth(std::span<const fs::path> files, const Listeners& listeners) {
  const fs::path& path = files.front();
  report(listeners.progress, "reading", 0);
  if (names_series(path)) return open_particles(path, listeners);
  if (std::optional<OpenedFilm> slices = open_slices_to_play(path)) return opened_slice_film(*std::move(slices));
  if (names_film(path))
    return open_film_files(files.size() == 2 ? FilmFiles{path, files[1], {}} : find_film(path.string()));
  if (files.size() == 2) {
    auto [of_left, of_right] = read_two_images(path, files[1]);
    return opened_photograph({std::move(of_left), std::move(of_right)},
                             fmt::format("{}, {}", path.string(), files[1].string()), listeners);
  }
  if (path.extension() == ".wst")
    return {PaintedContent{std::make_shared<const Painting>(read_painting(path)), nullptr}, "painting", {}};
  if (path.extension() == ".exr") {
    if (is_multiview_exr(path)) return opened_views(read_multiview_exr(path), "views");
    return {SlicesContent{std::make_shared<const SliceStack>(read_slices(path))}, "slices", {}};
  }
  if (is_model(path)) return open_model(path, listeners);
  if (holds_particles(path)) return open_particles(path, listeners);
  return open_picture(path, listeners);
}

}  // namespace

PictureSize size_of(const Content& content) { return std::visit(SizeOf(), content); }

bool is_scene(const Content& content) {
  return std::holds_alternative<ParticlesContent>(content) || std::holds_alternative<ModelContent>(content) ||
         std::holds_alternative<SlicesContent>(content);
}

bool has_one_view(const Content& content) {
  const auto* const views = std::get_if<ViewsContent>(&content);
  return views != nullptr && views->views->size() == 1;
}

std::vector<std::string> names_of_right_eye(const std::string& left) {
  static constexpr std::array eyes{std::pair("left", "right"), std::pair("Left", "Right"), std::pair("_L.", "_R."),
                                   std::pair("-L.", "-R."), std::pair("_l.", "_r.")};
  std::vector<std::string> names;
  for (const auto& [word, other] : eyes)
    if (const std::size_t at = left.rfind(word); at != std::string::npos)
      names.push_back(std::string(left).replace(at, std::strlen(word), other));
  return names;
}

bool are_named_as_eyes(const fs::path& left, const fs::path& right) {
  const std::vector<std::string> names = names_of_right_eye(left.filename().string());
  return std::ranges::find(names, right.filename().string()) != names.end();
}

std::optional<fs::path> find_other_eye(const fs::path& picture) {
  std::vector<fs::path> beside;
  for (const fs::directory_entry& entry : fs::directory_iterator(picture.parent_path()))
    if (entry.path().extension() == picture.extension()) beside.push_back(entry.path());
  std::ranges::sort(beside);
  const auto own = std::ranges::find(beside, picture.filename(), [](const fs::path& path) { return path.filename(); });
  std::vector<fs::path> likely;
  for (const fs::path& other : beside)
    if (are_named_as_eyes(picture, other) || are_named_as_eyes(other, picture)) likely.push_back(other);
  if (own != beside.end() && own + 1 != beside.end()) likely.push_back(own[1]);
  if (own != beside.end() && own != beside.begin()) likely.push_back(own[-1]);
  for (const fs::path& other : likely)
    if (other.filename() != picture.filename() && are_eyes_of_one(picture, other)) return other;
  return {};
}

std::optional<DepthEnds> depth_of(const Content& content) {
  if (const auto* const painted = std::get_if<PaintedContent>(&content)) {
    if (painted->painting && !painted->painting->surfaces.seen.empty())
      return depth_ends(painted->painting->surfaces.seen.front().disparity);
    if (painted->photograph && painted->photograph->geometry)
      return depth_ends(painted->photograph->geometry->left_disparity);
  }
  if (const auto* const sliced = std::get_if<SlicesContent>(&content))
    if (!sliced->slices->slices.empty())
      return DepthEnds{-sliced->slices->slices.back().parallax_px, -sliced->slices->slices.front().parallax_px};
  return {};
}

Opened open_content(std::span<const fs::path> files, const Progress& progress, const ShowFirst& show,
                    const ParticleChoice& particles) {
  Opened opened = open_without_depth(files, {progress, show, particles});
  opened.depth = depth_of(opened.content);
  return opened;
}

bool are_eyes_of_one(const fs::path& left, const fs::path& right, const ShowFirst& show) {
  if (names_film(left) || names_film(right))
    return names_film(left) && names_film(right) && are_named_as_eyes(left, right);
  for (const fs::path* path : {&left, &right})
    if (path->extension() == ".wst" || path->extension() == ".exr" || is_model(*path) || holds_particles(*path) ||
        quilt_of_name(path->filename().string()))
      return false;
  try {
    auto [of_left, of_right] = read_two_images(left, right);
    const StereoPair pair{std::move(of_left), std::move(of_right)};
    show_as_it_came(pair, show);
    return same_size(pair.left, pair.right) && !find_views(left) && !find_views(right) && !not_a_pair(pair);
  } catch (const Error&) {
    return false;
  }
}

}  // namespace wheatstone::viewer
