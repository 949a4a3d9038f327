#include "wheatstone/video/segmented_film.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <map>
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

namespace wheatstone {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t most_bytes_of_manifest = 1 << 16;

/// Holds a folder for one process; the system lets go when that ends, however it ends.
class FolderLock {
 public:
  FolderLock(const fs::path& folder, const fs::path& film)
      : file_(::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ < 0) fail_to_write_film(film, AVERROR(errno));
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    ::close(file_);
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: another run is writing it", film.string()));
  }
  ~FolderLock() { ::close(file_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

fs::path made_folder(const fs::path& film) {
  std::error_code error;
  fs::path folder = segment_folder(film);
  fs::create_directory(folder, error);
  if (error) fail_to_write_film(film, AVERROR(error.value()));
  return folder;
}

/// Takes over the folder of an earlier run with the same fingerprint, or begins a new one.
void claim(const fs::path& folder, const std::string& fingerprint) {
  const fs::path manifest = folder / "manifest.json";
  std::error_code ignored;
  if (!fs::exists(manifest, ignored)) {
    write_whole_file(manifest,
                     json{{"format", "wheatstone segments"}, {"version", 1}, {"made_of", fingerprint}}.dump(2));
    return;
  }
  const json found = json::parse(read_whole_file(manifest, most_bytes_of_manifest), nullptr, false);
  if (!found.is_discarded() && found.value("made_of", std::string()) == fingerprint) return;
  throw Error(ErrorKind::wrong_usage,
              fmt::format("{}: left by a run with other options or sources; repeat those, or remove it to begin anew",
                          folder.string()));
}

/// A killed run may have left temporary files.
void sweep(const fs::path& folder) {
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    std::error_code ignored;
    if (entry->path().filename().string().starts_with(".")) fs::remove(entry->path(), ignored);
  }
}

FilmWriterOptions options_of_segments(const FilmWriterOptions& options, bool is_sequence) {
  FilmWriterOptions result = options;
  if (!is_sequence) return result;
  result.codec = "ffv1";
  result.crf.reset();
  result.pixel_format.clear();
  return result;
}

}  // namespace

fs::path segment_folder(const fs::path& film) { return film.string() + ".part"; }

struct SegmentedFilm::Implementation {
  Implementation(const fs::path& name, const FilmWriterOptions& wanted, const SegmentOptions& segments)
      : path(name),
        pattern(frame_pattern(name)),
        options(options_of_segments(wanted, pattern.has_value())),
        frames_per_segment(segments.frames_per_segment),
        steps(name) {
    if (frames_per_segment < 1) {
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("frames per segment: {}, expected 1 or more", frames_per_segment));
    }
    check_encoding(options);
    if (pattern) {
      check_no_pictures(path, *pattern);
    } else {
      check_container(path, options);
    }
    folder = made_folder(path);
    lock.emplace(folder, path);
    claim(folder, fingerprint_of(options, segments));
    sweep(folder);
    while (auto times = segment_times(folder, whole_segments)) {
      frames_done += static_cast<std::int64_t>(times->size());
      ++whole_segments;
    }
  }

  void close_segment() {
    if (!segment) return;
    segment->finish();
    frames_done += static_cast<std::int64_t>(segment->size());
    segment.reset();
    ++whole_segments;
  }

  void join_as_pictures(const Progress& progress) {
    SequenceFile sequence(path, *pattern);
    for (std::int64_t number = 0; number < whole_segments; ++number) {
      FilmReader reader = open_film(segment_film(folder, number));
      for (Frame frame; reader.read(frame);) sequence.add(frame.picture);
      report(progress, "join", static_cast<double>(number + 1) / static_cast<double>(whole_segments));
    }
    sequence.finish();
  }

  void remove_folder() {
    lock.reset();
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }

  fs::path path;
  std::optional<FramePattern> pattern;
  FilmWriterOptions options;
  int frames_per_segment;
  FrameSteps steps;
  fs::path folder;
  std::optional<FolderLock> lock;
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

void SegmentedFilm::finish(const Progress& progress) {
  Implementation& own = *implementation_;
  own.close_segment();
  if (own.whole_segments == 0) own.steps.check_any();
  if (own.pattern) {
    own.join_as_pictures(progress);
  } else {
    join_segments(own.folder, own.whole_segments, own.path, own.options, own.notes, progress);
  }
  own.remove_folder();
}

const std::vector<std::string>& SegmentedFilm::notes() const { return implementation_->notes; }

}  // namespace wheatstone
