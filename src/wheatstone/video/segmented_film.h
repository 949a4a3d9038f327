#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/progress.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone {

/// The frames of a film that is not finished are kept in a folder: the film may be opened again to go on with them, or
/// the folder deleted.
class UnfinishedFilm : public Error {
 public:
  using Error::Error;
};

struct SegmentOptions {
  int frames_per_segment = 48;  ///< what a killed run loses at most
  std::string made_by;          ///< any text that says what else decides the frames: style, seed, version
  std::vector<std::filesystem::path> made_from;  ///< sources: files or patterns. Their sizes and samples are compared
  bool resume = true;                            ///< false: what an earlier run has left is refused
};

/// How many frames a film that is not finished has in closed files; 0 where there is none.
std::int64_t frames_kept(const std::filesystem::path& film);

/// A closed file of frames of a film, coded afresh: one of those that a SegmentedFilm writes, made apart from the
/// others. Segments of one film may be made in any order, by any number of processes.
class FilmSegment {
 public:
  /// `number` counts from 0; `film` and `options` are those of the whole film. Throws as FilmWriter.
  FilmSegment(std::filesystem::path folder, std::int64_t number, const std::filesystem::path& film,
              const FilmWriterOptions& options);
  FilmSegment(FilmSegment&&) noexcept;
  FilmSegment& operator=(FilmSegment&&) noexcept;
  ~FilmSegment();

  /// As FilmWriter::write.
  void write(const Frame& frame);

  /// Closes the file. Destroyed before, the segment leaves nothing.
  void finish();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// How many frames the closed segment of this number in a folder has; 0 where there is none. Throws Error{bad_input}
/// where it is damaged.
std::int64_t frames_of_segment(const std::filesystem::path& folder, std::int64_t number);

/// A film that takes long to make and may be killed at any moment. Beside `out.mp4` lies a folder `out.mp4.part` with a
/// manifest and closed files of `frames_per_segment` frames each, every one coded afresh. `finish` joins them, without
/// coding again, into the film, copies the side streams, and removes the folder. Destroyed before, it leaves the
/// folder, and whoever opens the same film with the same options goes on from there: the finished film is the same,
/// byte for byte, as if nothing had happened. Numbered pictures go through lossless segments.
class SegmentedFilm {
 public:
  /// Throws as FilmWriter, and Error{wrong_usage} where the folder belongs to a run with other options or sources, or
  /// to one that is still going on, UnfinishedFilm{wrong_usage} where there is one and `resume` is false.
  SegmentedFilm(const std::filesystem::path& path, const FilmWriterOptions& options, const SegmentOptions& segments);
  SegmentedFilm(SegmentedFilm&&) noexcept;
  SegmentedFilm& operator=(SegmentedFilm&&) noexcept;
  ~SegmentedFilm();

  /// How many frames are in closed files. After opening these are what an earlier run has left: the caller passes over
  /// them (FilmReader::skip).
  std::int64_t frames_done() const;

  /// As FilmWriter::write.
  void write(const Frame& frame);

  /// Takes closed segments, from 0 on, from another folder, where they stay. No frame can be written to this film.
  void take_segments(const std::filesystem::path& folder);

  /// A comment that the film is to carry, where it cannot be told before all frames are there.
  void set_comment(const std::string& comment);

  /// As FilmWriter::finish. A failure leaves the folder: what is done is not lost.
  void finish(const Progress& progress = {});

  /// Removes the folder: nothing remains, and nothing can be added.
  void discard();

  const std::vector<std::string>& notes() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace wheatstone
