#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/stereo/stereo_pair.h"
#include "wheatstone/video/film_reader.h"

namespace wheatstone {

/// Makes the eyes' pictures of a frame, counted from 0. All have one size.
using MakePair = std::function<StereoPair(std::int64_t frame)>;

/// Delivers the eyes of a film, frame by frame: of one film in any layout, of a film an eye, or made one by one.
class StereoFilmReader {
 public:
  StereoFilmReader(StereoFilmReader&&) noexcept;
  StereoFilmReader& operator=(StereoFilmReader&&) noexcept;
  ~StereoFilmReader();

  /// Of the packed film, or of the left eye's.
  const FilmFacts& facts() const;
  StereoLayout layout() const;            ///< mono where there is a film an eye
  const std::string& layout_how() const;  ///< how it is known, for the user

  /// The next moment; of an alternating film, two frames. `right` stays empty where the film is mono. Throws
  /// Error{bad_input} where one eye ends before the other, with both counts.
  bool read(StereoFrame& frame);

  /// As FilmReader, counted in moments.
  std::int64_t skip(std::int64_t frames);

  /// As FilmReader, of both films, whose numbers of frames are not compared.
  void skip_rest();

  /// As FilmReader, of both films.
  std::optional<std::string> loss() const;

 private:
  struct Implementation;
  struct Recorded;
  struct Made;
  explicit StereoFilmReader(std::unique_ptr<Implementation> implementation);
  friend StereoFilmReader open_stereo_film(const std::filesystem::path&, std::optional<StereoLayout>,
                                           const FilmReaderOptions&);
  friend StereoFilmReader open_eye_films(const std::filesystem::path&, const std::filesystem::path&,
                                         const FilmReaderOptions&);
  friend StereoFilmReader made_film(PictureSize, std::int64_t, Rational, MakePair);
  std::unique_ptr<Implementation> implementation_;
};

/// Opens a film, or numbered pictures, that hold both eyes: in the layout given, else in the one that the film says,
/// else in the one that its first frames let guess (guess_layout). Throws as open_film.
StereoFilmReader open_stereo_film(const std::filesystem::path& packed, std::optional<StereoLayout> layout = {},
                                  const FilmReaderOptions& options = {});

/// Opens a film, or numbered pictures, an eye. Throws as open_film, and Error{bad_input} where the eyes differ in size
/// or, as far as the films say, in their number of frames. Times are the left eye's.
StereoFilmReader open_eye_films(const std::filesystem::path& left, const std::filesystem::path& right,
                                const FilmReaderOptions& options = {});

/// A film of so many frames at an even rate, each made when it is read. Reading throws as `make`.
StereoFilmReader made_film(PictureSize size, std::int64_t frames, Rational rate, MakePair make);

}  // namespace wheatstone
