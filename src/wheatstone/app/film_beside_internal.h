#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "wheatstone/app/film_depth.h"
#include "wheatstone/video/film_reader.h"

namespace wheatstone {

/// Throws Error{bad_input} that names the file.
[[noreturn]] void refuse_film_beside(const std::filesystem::path& path, const std::string& why);

/// A film, or numbered pictures, that is read beside the main film: a frame for each of its frames.
class FilmBeside {
 public:
  /// Throws Error{bad_input} where it is no film, or has not as many frames as the main film, as far as both say.
  FilmBeside(const std::filesystem::path& path, const MainFilm& main);

  const FilmFacts& facts() const { return reader_.facts(); }

  /// A frame, counted from 0. They are asked for in their order; some may be left out. Throws Error{bad_input} where
  /// the film ends before it.
  const Image<Rgb8>& at(std::int64_t frame);

 private:
  std::filesystem::path path_, main_;
  FilmReader reader_;
  std::int64_t next_ = 0;  ///< frame
  Frame frame_{};
};

}  // namespace wheatstone
