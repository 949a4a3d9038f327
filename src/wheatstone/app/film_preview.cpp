#include "wheatstone/app/film_preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "wheatstone/app/contact_sheet.h"
#include "wheatstone/app/frame_search_internal.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/app/paint_film_frame_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/stopwatch.h"
#include "wheatstone/video/film_time.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr int reduction = 3;
constexpr std::int64_t pictures_a_shot = 5;

/// A shot as it is looked at.
struct PreviewedShot {
  std::int64_t begin = 0, end = 0;
  std::int64_t painted_frames = 0;  ///< in the whole film
  std::set<std::int64_t> shown;
  double shown_s = 0;  ///< that painting these took
};

std::vector<PreviewedShot> shots_to_preview(const RotoscopeFilmOptions& options, std::int64_t frames) {
  std::vector<PreviewedShot> shots;
  for (std::size_t i = 0; i < options.shots.size(); ++i) {
    PreviewedShot shot{.begin = options.shots[i].begin};
    shot.end = i + 1 < options.shots.size() ? options.shots[i + 1].begin : frames;
    const std::int64_t count = shot.end - shot.begin;
    shot.painted_frames = (options.on_twos ? (count + 1) / 2 : count) + options.shots[i].dissolve_frames;
    for (std::int64_t k = 0; k < pictures_a_shot; ++k)
      shot.shown.insert(shot.begin + (2 * k + 1) * count / (2 * pictures_a_shot));
    shots.push_back(std::move(shot));
  }
  return shots;
}

PictureSize third_of(const Image<Rgb8>& picture) {
  return {std::max(picture.width() / reduction, 1), std::max(picture.height() / reduction, 1)};
}

Image<Rgb8> third(const Image<Rgb8>& picture) {
  return picture.empty() ? Image<Rgb8>() : reduced(picture, third_of(picture));
}

void reduce_lengths(Style& style) {
  if (!style.absolute_radii) return;
  for (float& radius : style.radii_px) radius = std::max(radius / reduction, 0.5f);
  style.depth_threshold_px /= reduction;
}

/// The options for frames of a third of the size.
RotoscopeFilmOptions at_a_third(RotoscopeFilmOptions options) {
  options.frames.at_half_size = false;
  if (auto& range = options.frames.matching.range)
    range = DisparityRange{range->least / reduction - 1, range->largest / reduction + 1};
  if (options.frames.outside) reduce_lengths(*options.frames.outside);
  for (FilmShot& shot : options.shots) {
    reduce_lengths(shot.style);
    if (shot.zero_parallax_px) *shot.zero_parallax_px /= reduction;
    for (MovingParameter& moving : shot.moving)
      if (moving.name == "zero-parallax")
        for (ParameterKey& key : moving.keys) key.value /= reduction;
  }
  return options;
}

/// The shots without what needs the shot before them.
RotoscopeFilmOptions without_dissolves(RotoscopeFilmOptions options) {
  for (FilmShot& shot : options.shots) shot.dissolve_frames = 0;
  return options;
}

/// The bytes of the files in a folder.
double bytes_in(const fs::path& folder) {
  double bytes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
  return bytes;
}

/// The first frames of a shot, painted at the size of the film.
struct Sample {
  std::vector<Frame> frames;
  double first_s = 0, others_s = 0;
  double first_bytes = 0, other_bytes = 0;  ///< of a frame

  double frame_s() const {
    const auto others = static_cast<double>(frames.size()) - 1;
    return others > 0 ? others_s / others : first_s;
  }
};

class PreviewWork {
 public:
  PreviewWork(const RotoscopeFilmOptions& options, const fs::path& sheet, const Progress& progress)
      : options_(options),
        whole_(without_dissolves(options)),
        small_(at_a_third(whole_)),
        sheet_(sheet),
        folder_(sheet.string() + ".frames"),
        within_([this, &progress](std::string_view, double) { report(progress, "painting the preview", share_); }) {}

  FilmPreview make(const FilmFiles& film, const fs::path& output) {
    StereoFilmReader counted = open_film(film, options_.reading);
    const std::int64_t frames = counted.skip(std::numeric_limits<std::int64_t>::max());
    if (frames == 0) throw Error(ErrorKind::wrong_usage, "the film has no frame in the requested time range");
    shots_ = shots_to_preview(options_, frames);
    longest_ = &*std::ranges::max_element(shots_, {}, &PreviewedShot::painted_frames);
    FrameSearch search(open_film(film, options_.reading));
    for (PreviewedShot& shot : shots_)
      for (std::int64_t number = shot.begin; number < shot.end; ++number)
        if (shot.shown.contains(number) || is_sampled(shot, number)) look_at(shot, number, search.at(number));
    encode_sample(output);
    write_sheet();
    return {static_cast<std::int64_t>(shots_.size()), frames, seconds_of_film(), bytes_of_film(frames)};
  }

 private:
  bool is_sampled(const PreviewedShot& shot, std::int64_t number) const {
    constexpr std::int64_t frames_of_sample = 6;
    return &shot == longest_ && number < shot.begin + frames_of_sample;
  }

  void look_at(PreviewedShot& shot, std::int64_t number, StereoFrame& frame) {
    share_ = static_cast<double>(number) / static_cast<double>(shots_.back().end);
    // Depth and mask of a frame are asked for once.
    if (options_.known) {
      StereoPair eyes{std::move(frame.left), std::move(frame.right)};
      const KnownFrame known = options_.known(number, eyes);
      frame.left = std::move(eyes.left);
      frame.right = std::move(eyes.right);
      whole_.known = [known = known](std::int64_t, const StereoPair&) { return known; };
      // Geometry and flow are of whole frames; depth fits frames of any size.
      small_.known = known.depth ? whole_.known : KnownFrames();
    }
    if (options_.mask) {
      FrameMask mask = options_.mask(number, frame.left);
      FrameMask of_third{mask_of_picture(third(picture_of_mask(mask.left))),
                         mask_of_picture(third(picture_of_mask(mask.right)))};
      whole_.mask = [mask](std::int64_t, const Image<Rgb8>&) { return mask; };
      small_.mask = [of_third](std::int64_t, const Image<Rgb8>&) { return of_third; };
    }
    if (shot.shown.contains(number)) show(shot, number, frame);
    if (is_sampled(shot, number)) add_to_sample(number, frame);
  }

  void show(PreviewedShot& shot, std::int64_t number, const StereoFrame& frame) {
    const Stopwatch watch(shot.shown_s);
    StereoFrame small{third(frame.left), third(frame.right), frame.pts, frame.time_base, frame.duration};
    FilmState state;
    state.shot.frames = number;
    const Image<Rgb8> picture = paint_film_frame(small, small_, true, state, within_).frame.picture;
    const fs::path file = folder_.file(fmt::format("shown_{:09}.png", number + 1));
    write_image(file, picture);
    entries_.push_back({file, fmt::format("{}: frame {}, {}", &shot - shots_.data() + 1, number + 1,
                                          film_time_text(std::max(seconds_of(frame), 0.)))});
    // What a display shows has its own size.
    tile_ = options_.frames.display ? third_of(picture) : PictureSize{picture.width(), picture.height()};
  }

  void add_to_sample(std::int64_t number, StereoFrame& frame) {
    const Stopwatch watch(sample_.frames.empty() ? sample_.first_s : sample_.others_s);
    sample_state_.shot.frames = number;
    sample_.frames.push_back(frame_at(paint_film_frame(frame, whole_, true, sample_state_, within_).frame, frame));
  }

  /// Encodes the first frame, and all of them, to tell what a frame takes that others go before.
  void encode_sample(const fs::path& output) {
    FilmWriterOptions writing = options_.writing;
    writing.side_streams_from.clear();
    const auto bytes_of = [&](std::size_t frames) {
      const fs::path folder = folder_.file(fmt::format("sample_{}", frames));
      fs::create_directory(folder);
      FilmWriter writer(folder / output.filename(), writing);
      for (std::size_t i = 0; i < frames; ++i) writer.write(sample_.frames[i]);
      writer.finish();
      return bytes_in(folder);
    };
    const std::size_t frames = sample_.frames.size();
    sample_.first_bytes = sample_.other_bytes = bytes_of(1);
    if (frames == 1) return;
    const Stopwatch watch(sample_.others_s);
    sample_.other_bytes = std::max(bytes_of(frames) - sample_.first_bytes, 0.) / static_cast<double>(frames - 1);
  }

  /// A row a shot, and smaller pictures where there are so many shots that the sheet would be too large.
  void write_sheet() {
    constexpr double most_pixels = 60e6;
    const double pixels =
        static_cast<double>(tile_.width) * tile_.height * pictures_a_shot * static_cast<double>(shots_.size());
    const double scale = std::min(std::sqrt(most_pixels / pixels), 1.);
    const auto scaled = [scale](int side) { return std::max(static_cast<int>(scale * side), 16); };
    std::vector<SheetEntry> rows;
    std::size_t next = 0;
    for (const PreviewedShot& shot : shots_) {
      for (std::size_t i = 0; i < shot.shown.size(); ++i) rows.push_back(entries_[next++]);
      for (std::size_t i = shot.shown.size(); i < pictures_a_shot; ++i) rows.emplace_back();
    }
    write_image(sheet_, contact_sheet(rows, {pictures_a_shot, scaled(tile_.width), scaled(tile_.height)}));
  }

  double seconds_of_film() const {
    // How much longer a frame takes than a third of its size, which is painted anew.
    const auto shown_s = [](const PreviewedShot& shot) {
      return shot.shown_s / static_cast<double>(shot.shown.size());
    };
    const double longer = sample_.frame_s() / std::max(shown_s(*longest_), 1e-9);
    double seconds = 0;
    for (const PreviewedShot& shot : shots_)
      seconds += shown_s(shot) * longer * static_cast<double>(shot.painted_frames);
    return seconds;
  }

  double bytes_of_film(std::int64_t frames) const {
    const auto all = static_cast<double>(frames);
    // A segment of the film, and what cannot be told from the frame before, begins with a whole picture.
    const double whole =
        std::min(std::ceil(all / options_.frames_between_checkpoints) + static_cast<double>(shots_.size()) - 1, all);
    return whole * sample_.first_bytes + (all - whole) * sample_.other_bytes;
  }

  const RotoscopeFilmOptions& options_;
  RotoscopeFilmOptions whole_, small_;
  fs::path sheet_;
  OutputFolder folder_;
  double share_ = 0;  ///< of the film that has been looked at
  Progress within_;   ///< the steps within a frame are asked only whether to go on
  std::vector<PreviewedShot> shots_;
  const PreviewedShot* longest_ = nullptr;
  Sample sample_;
  FilmState sample_state_;
  std::vector<SheetEntry> entries_;
  PictureSize tile_;
};

}  // namespace

FilmPreview preview_film(const FilmFiles& film, const fs::path& output, const fs::path& sheet,
                         const RotoscopeFilmOptions& options, const Progress& progress) {
  if (!is_picture_name(sheet))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: expected the name of a picture, as preview.jpg", sheet.string()));
  return PreviewWork(options, sheet, progress).make(film, output);
}

}  // namespace wheatstone
