#include "wheatstone/video/segmented_film.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/video/film_reader.h"
#include "wheatstone/video/fingerprint_internal.h"
#include "wheatstone/video/frame_steps_internal.h"
#include "wheatstone/video/join_segments_internal.h"
#include "wheatstone/video/segment_internal.h"
#include "wheatstone/video/sequence_file_internal.h"
#include "wheatstone/video/work_folder.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t most_bytes_of_manifest = 1 << 16;

/// Stands in the folder while numbered pictures get their names: those that are there belong to this film.
constexpr const char* naming_file = "naming";
/// Of numbered pictures that are being decoded.
constexpr const char* pictures_folder = ".pictures";

/// Takes over the folder of an earlier run with the same fingerprint, or begins a new one.
void claim(const fs::path& folder, const std::string& fingerprint, bool resume) {
  const fs::path manifest = folder / "manifest.json";
  // The fingerprint has file names in it, which are bytes and need not be UTF-8.
  const std::string wanted = json{{"format", "wheatstone segments"}, {"version", 1}, {"made_of", fingerprint}}.dump(
      2, ' ', false, json::error_handler_t::replace);
  std::error_code ignored;
  if (!fs::exists(manifest, ignored)) return write_whole_file(manifest, wanted);
  if (!resume)
    throw UnfinishedFilm(
        ErrorKind::wrong_usage,
        fmt::format("{}: was left by a run that did not finish, and must be deleted to start again", folder.string()));
  const json found = json::parse(read_whole_file(manifest, most_bytes_of_manifest), nullptr, false);
  if (found.is_object() && found.value("made_of", json()) == json::parse(wanted).at("made_of")) return;
  throw Error(ErrorKind::wrong_usage, fmt::format("{}: was left by a run with other options or sources; use the same "
                                                  "ones, or delete this folder to start again",
                                                  folder.string()));
}

/// A killed run may have left temporary files.
void sweep(const fs::path& folder) {
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    std::error_code ignored;
    if (entry->path().filename().string().starts_with(".")) fs::remove_all(entry->path(), ignored);
  }
}

FilmWriterOptions options_of_segments(const FilmWriterOptions& options, const fs::path& film) {
  FilmWriterOptions result = options;
  if (!frame_pattern(film)) return result;
  result.codec = "ffv1";
  result.crf.reset();
  result.pixel_format = writes_deep(film, options) ? sixteen_bits : "";
  return result;
}

}  // namespace

struct FilmSegment::Implementation {
  fs::path folder;
  std::int64_t number;
  FilmWriterOptions options;
  FrameSteps steps;
  std::unique_ptr<SegmentFile> file;
};

FilmSegment::FilmSegment(fs::path folder, std::int64_t number, const fs::path& film, const FilmWriterOptions& options)
    : implementation_(std::make_unique<Implementation>(
          Implementation{std::move(folder), number, options_of_segments(options, film), FrameSteps(film), nullptr})) {
  check_encoding(implementation_->options);
}
FilmSegment::FilmSegment(FilmSegment&&) noexcept = default;
FilmSegment& FilmSegment::operator=(FilmSegment&&) noexcept = default;
FilmSegment::~FilmSegment() = default;

void FilmSegment::write(const Frame& frame) {
  Implementation& own = *implementation_;
  own.steps.check(frame);
  if (!own.file) own.file = std::make_unique<SegmentFile>(own.folder, own.number, own.options, frame);
  own.file->add(frame);
}

void FilmSegment::finish() {
  implementation_->steps.check_any();
  implementation_->file->finish();
  implementation_->file.reset();
}

std::int64_t frames_of_segment(const fs::path& folder, std::int64_t number) {
  const std::optional<SegmentTimes> times = segment_times(folder, number);
  return times ? static_cast<std::int64_t>(times->size()) : 0;
}

std::int64_t frames_kept(const fs::path& film) {
  std::int64_t frames = 0, number = 0;
  while (const std::int64_t more = frames_of_segment(work_folder_of(film), number)) {
    frames += more;
    ++number;
  }
  return frames;
}

struct SegmentedFilm::Implementation {
  Implementation(const fs::path& name, const FilmWriterOptions& wanted, const SegmentOptions& segments)
      : path(name),
        pattern(frame_pattern(name)),
        options(options_of_segments(wanted, name)),
        frames_per_segment(segments.frames_per_segment),
        steps(name) {
    if (frames_per_segment < 1) {
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("frames per segment: {}, expected 1 or more", frames_per_segment));
    }
    check_encoding(options);
    std::error_code ignored;
    if (!pattern) {
      check_container(path, options);
    } else if (!fs::exists(work_folder_of(path) / naming_file, ignored)) {
      check_no_pictures(path, *pattern);
    }
    held.emplace(path);
    folder = work_folder_of(path);
    claim(folder, fingerprint_of(options, segments), segments.resume);
    sweep(folder);
    closed = folder;
    count_segments();
    held->keep(frames_done > 0);
  }

  void count_segments() {
    frames_done = whole_segments = 0;
    while (const std::int64_t frames = frames_of_segment(closed, whole_segments)) {
      frames_done += frames;
      ++whole_segments;
    }
  }

  void close_segment() {
    if (!segment) return;
    segment->finish();
    frames_done += static_cast<std::int64_t>(segment->size());
    segment.reset();
    ++whole_segments;
    held->keep(true);
  }

  void join_as_pictures(const Progress& progress) {
    SequenceFile sequence(*pattern, folder / pictures_folder, options.layout);
    for (std::int64_t number = 0; number < whole_segments; ++number) {
      FilmReader reader = open_film(segment_film(closed, number), {.deep = true});
      for (Frame frame; reader.read(frame);) sequence.add(frame);
      report(progress, "join", static_cast<double>(number + 1) / static_cast<double>(whole_segments));
    }
    write_whole_file(folder / naming_file, "");
    sequence.finish();
  }

  fs::path path;
  std::optional<FramePattern> pattern;
  FilmWriterOptions options;
  int frames_per_segment;
  FrameSteps steps;
  fs::path folder;
  fs::path closed;  ///< where the closed segments lie: the same folder, unless they were taken from another
  std::optional<WorkFolder> held;
  std::unique_ptr<SegmentFile> segment;
  std::int64_t whole_segments = 0;
  std::int64_t frames_done = 0;
  std::vector<std::string> notes;
};

SegmentedFilm::SegmentedFilm(const fs::path& path, const FilmWriterOptions& options, const SegmentOptions& segments)
    : implementation_(std::make_unique<Implementation>(path, options, segments)) {}
SegmentedFilm::SegmentedFilm(SegmentedFilm&&) noexcept = default;
SegmentedFilm& SegmentedFilm::operator=(SegmentedFilm&&) noexcept = default;
SegmentedFilm::~SegmentedFilm() = default;

std::int64_t SegmentedFilm::frames_done() const { return implementation_->frames_done; }

void SegmentedFilm::write(const Frame& frame) {
  Implementation& own = *implementation_;
  own.steps.check(frame);
  if (!own.segment) {
    own.segment = std::make_unique<SegmentFile>(own.folder, own.whole_segments, own.options, frame);
    if (own.notes.empty()) note_padding(frame.picture, own.segment->encoder(), own.notes);
  }
  own.segment->add(frame);
  if (own.segment->size() >= static_cast<std::size_t>(own.frames_per_segment)) own.close_segment();
}

void SegmentedFilm::take_segments(const fs::path& folder) {
  implementation_->closed = folder;
  implementation_->count_segments();
}

void SegmentedFilm::set_comment(const std::string& comment) { implementation_->options.comment = comment; }

void SegmentedFilm::finish(const Progress& progress) {
  Implementation& own = *implementation_;
  own.close_segment();
  if (own.whole_segments == 0) own.steps.check_any();
  if (own.pattern) {
    own.join_as_pictures(progress);
  } else {
    join_segments({own.closed, own.whole_segments}, own.path, own.options, own.notes, progress);
  }
  own.held->remove();
}

void SegmentedFilm::discard() {
  Implementation& own = *implementation_;
  own.segment.reset();
  own.held->remove();
}

const std::vector<std::string>& SegmentedFilm::notes() const { return implementation_->notes; }

}  // namespace wheatstone
