#pragma once

// A film file that is being written: coded pictures and copied side streams into a container, whole or not at all.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/files/temporary_file.h"
#include "wheatstone/video/film_writer.h"
#include "wheatstone/video/libav_internal.h"
#include "wheatstone/video/side_streams_internal.h"

namespace wheatstone {

/// Throws Error{wrong_usage} where the file's ending is none that films are written to, or does not hold the codec.
void check_container(const std::filesystem::path& path, const FilmWriterOptions& options);

class FilmFile {
 public:
  /// `notes` gets what the user should know, until the file is finished.
  FilmFile(std::filesystem::path path, const FilmWriterOptions& options, std::vector<std::string>& notes);
  ~FilmFile();
  FilmFile(const FilmFile&) = delete;
  FilmFile& operator=(const FilmFile&) = delete;

  /// Writes the head of the file: what the coded pictures are, in which ticks their times count, and the side streams.
  void begin(const AVCodecParameters& coded, Rational time_base, std::optional<Rational> rate = {});
  /// Adds a coded picture, in the order of decoding; takes its data.
  void add(AVPacket& packet);
  /// Adds the rest of the side streams and the file's tail, and gives it its name.
  void finish();

 private:
  void say_layout(AVStream& stream);
  void check(int error) const;

  std::filesystem::path path_;
  FilmWriterOptions options_;
  TemporaryFile file_;
  AVFormatContext* output_ = nullptr;
  AVStream* stream_ = nullptr;
  AVRational time_base_{0, 1};
  std::int64_t shift_ = 0;  ///< of the pictures' times, in time_base_
  std::optional<SideStreams> side_streams_;
  std::vector<std::string>& notes_;
  bool rounds_times_ = false;
};

}  // namespace wheatstone
