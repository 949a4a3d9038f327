#include "wheatstone/video/stereo_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/video/guess_layout_internal.h"

namespace wheatstone {
namespace {

constexpr int frames_to_guess_from = 6;
constexpr int frames_between = 8;

GuessedLayout guess_of(const std::filesystem::path& path, const FilmReaderOptions& options) {
  FilmReader reader = open_film(path, options);
  std::vector<Image<Rgb8>> frames;
  for (Frame frame; frames.size() < frames_to_guess_from && reader.read(frame); reader.skip(frames_between - 1)) {
    frames.push_back(frame.picture);
  }
  return guess_layout(frames);
}

}  // namespace

struct StereoFilmReader::Implementation {
  explicit Implementation(GuessedLayout found) : layout(std::move(found)) {}
  virtual ~Implementation() = default;

  GuessedLayout layout;

  virtual const FilmFacts& facts() const = 0;
  virtual bool read(StereoFrame& eyes) = 0;
  virtual std::int64_t skip(std::int64_t frames) = 0;
  virtual void skip_rest() = 0;
  virtual std::optional<std::string> loss() const = 0;
};

struct StereoFilmReader::Recorded : Implementation {
  Recorded(FilmReader of_left, const std::filesystem::path& path, GuessedLayout found)
      : Implementation(std::move(found)), left(std::move(of_left)), left_path(path) {}

  FilmReader left;
  std::optional<FilmReader> right;
  std::filesystem::path left_path;
  std::filesystem::path right_path;
  std::int64_t delivered = 0;
  Frame frame;
  Frame other;

  FilmReaderOptions options;  ///< of moments, where a moment is two frames
  std::int64_t pairs_seen = 0;

  bool is_alternating() const { return traits_of(layout.layout).arrangement == Arrangement::in_time; }

  /// One eye ended and the other did not: says how many frames each has.
  [[noreturn]] void refuse_shorter_eye(bool left_ended) {
    FilmReader& longer = left_ended ? *right : left;
    const std::int64_t rest = 1 + longer.skip(std::numeric_limits<std::int64_t>::max());
    const std::int64_t left_count = delivered + (left_ended ? 0 : rest);
    const std::int64_t right_count = delivered + (left_ended ? rest : 0);
    throw Error(ErrorKind::bad_input, fmt::format("{}: {} frames, expected {} like {}", right_path.string(),
                                                  right_count, left_count, left_path.string()));
  }

  bool read_both() {
    const bool has_left = left.read(frame);
    const bool has_right = right->read(other);
    if (has_left != has_right) refuse_shorter_eye(!has_left);
    return has_left;
  }

  /// Two frames that belong together. Counted from the film's beginning: a search could begin with the wrong eye.
  bool read_pair() {
    // A last frame without its partner is no moment.
    while (left.read(frame) && left.read(other)) {
      constexpr double mercy_s = 0.0005;
      if (options.from_s && frame.seconds() + mercy_s < *options.from_s) continue;
      if (options.to_s && frame.seconds() + mercy_s >= *options.to_s) return false;
      if (pairs_seen++ % options.every != 0) continue;
      frame.duration = (frame.duration + other.duration) * options.every;
      if (traits_of(layout.layout).right_first) {
        std::swap(frame.picture, other.picture);
        std::swap(frame.deep, other.deep);
      }
      return true;
    }
    return false;
  }

  const FilmFacts& facts() const override { return left.facts(); }

  bool read(StereoFrame& eyes) override {
    if (right || is_alternating()) {
      if (!(right ? read_both() : read_pair())) return false;
      std::swap(eyes.left, frame.picture);
      std::swap(eyes.left_deep, frame.deep);
      std::swap(eyes.right, other.picture);
      std::swap(eyes.right_deep, other.deep);
    } else {
      if (!left.read(frame)) return false;
      if (layout.layout == StereoLayout::mono) {
        std::swap(eyes.left, frame.picture);
        std::swap(eyes.left_deep, frame.deep);
        eyes.right = {};
        eyes.right_deep = {};
      } else {
        StereoPair pair = cut_apart(frame.picture, layout.layout, "frame");
        eyes.left = std::move(pair.left);
        eyes.right = std::move(pair.right);
        if (!frame.deep.empty())
          std::tie(eyes.left_deep, eyes.right_deep) = cut_apart(frame.deep, layout.layout, "frame");
      }
    }
    eyes.pts = frame.pts;
    eyes.time_base = frame.time_base;
    eyes.duration = frame.duration;
    ++delivered;
    return true;
  }

  std::int64_t skip(std::int64_t frames) override {
    std::int64_t skipped = 0;
    if (is_alternating()) {
      while (skipped < frames && read_pair()) ++skipped;
    } else {
      skipped = left.skip(frames);
    }
    if (right) {
      const std::int64_t of_right = right->skip(skipped);
      delivered += of_right;
      if (of_right < skipped) {
        throw Error(ErrorKind::bad_input, fmt::format("{}: {} frames, expected {} or more like {}", right_path.string(),
                                                      delivered, delivered - of_right + skipped, left_path.string()));
      }
      return skipped;
    }
    delivered += skipped;
    return skipped;
  }

  void skip_rest() override {
    left.skip_rest();
    if (right) right->skip_rest();
  }

  std::optional<std::string> loss() const override {
    const std::optional<std::string> of_left = left.loss();
    const std::optional<std::string> of_right = right ? right->loss() : std::nullopt;
    if (of_left && of_right) return *of_left + "; " + *of_right;
    return of_left ? of_left : of_right;
  }
};

struct StereoFilmReader::Made : Implementation {
  Made(FilmFacts known, MakePair make)
      : Implementation({StereoLayout::left_right, "made for two eyes"}),
        known_(std::move(known)),
        make_(std::move(make)) {}

  const FilmFacts& facts() const override { return known_; }

  bool read(StereoFrame& eyes) override {
    if (next_ == *known_.frame_count) return false;
    StereoPair pair = make_(next_);
    eyes = {std::move(pair.left), std::move(pair.right), next_, known_.time_base, 1};
    ++next_;
    return true;
  }

  std::int64_t skip(std::int64_t frames) override {
    const std::int64_t skipped = std::min(frames, *known_.frame_count - next_);
    next_ += skipped;
    return skipped;
  }

  void skip_rest() override { next_ = *known_.frame_count; }
  std::optional<std::string> loss() const override { return {}; }

 private:
  FilmFacts known_;
  MakePair make_;
  std::int64_t next_ = 0;
};

StereoFilmReader::StereoFilmReader(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
StereoFilmReader::StereoFilmReader(StereoFilmReader&&) noexcept = default;
StereoFilmReader& StereoFilmReader::operator=(StereoFilmReader&&) noexcept = default;
StereoFilmReader::~StereoFilmReader() = default;

const FilmFacts& StereoFilmReader::facts() const { return implementation_->facts(); }
StereoLayout StereoFilmReader::layout() const { return implementation_->layout.layout; }
const std::string& StereoFilmReader::layout_how() const { return implementation_->layout.how; }
bool StereoFilmReader::read(StereoFrame& frame) { return implementation_->read(frame); }
std::int64_t StereoFilmReader::skip(std::int64_t frames) { return implementation_->skip(frames); }
void StereoFilmReader::skip_rest() { implementation_->skip_rest(); }
std::optional<std::string> StereoFilmReader::loss() const { return implementation_->loss(); }

StereoFilmReader open_stereo_film(const std::filesystem::path& packed, std::optional<StereoLayout> layout,
                                  const FilmReaderOptions& options) {
  FilmReader reader = open_film(packed, options);
  GuessedLayout found;
  if (layout) {
    found = {*layout, "as asked"};
  } else if (!reader.facts().layout_how.empty()) {
    found = {reader.facts().layout, reader.facts().layout_how};
  } else {
    found = guess_of(packed, options);
  }
  auto both = std::make_unique<StereoFilmReader::Recorded>(std::move(reader), packed, std::move(found));
  if (both->is_alternating()) {
    both->options = options;
    both->left =
        open_film(packed, {.threads = options.threads, .sequence_rate = options.sequence_rate, .deep = options.deep});
  }
  return StereoFilmReader(std::move(both));
}

StereoFilmReader open_eye_films(const std::filesystem::path& left, const std::filesystem::path& right,
                                const FilmReaderOptions& options) {
  FilmReader left_reader = open_film(left, options), right_reader = open_film(right, options);
  const FilmFacts& a = left_reader.facts();
  const FilmFacts& b = right_reader.facts();
  if (a.width != b.width || a.height != b.height) {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}x{} pixels, expected {}x{} like {}", right.string(), b.width,
                                                  b.height, a.width, a.height, left.string()));
  }
  if (a.frame_count && b.frame_count && *a.frame_count != *b.frame_count) {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {} frames, expected {} like {}", right.string(), *b.frame_count,
                                                  *a.frame_count, left.string()));
  }
  auto both = std::make_unique<StereoFilmReader::Recorded>(std::move(left_reader), left,
                                                           GuessedLayout{StereoLayout::mono, "a film an eye"});
  both->right = std::move(right_reader);
  both->right_path = right;
  return StereoFilmReader(std::move(both));
}

StereoFilmReader made_film(PictureSize size, std::int64_t frames, Rational rate, MakePair make) {
  FilmFacts facts{.container = "made", .width = size.width, .height = size.height, .frame_rate = rate};
  facts.time_base = {rate.denominator, rate.numerator};
  facts.frame_count = frames;
  facts.duration_s = static_cast<double>(frames) / rate.value();
  return StereoFilmReader(std::make_unique<StereoFilmReader::Made>(std::move(facts), std::move(make)));
}

}  // namespace wheatstone
