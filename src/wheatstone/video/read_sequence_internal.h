#pragma once

// Numbered pictures as a film.

#include <vector>

#include "wheatstone/video/decoded_film_internal.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone {

class PictureSequence {
 public:
  /// Throws Error{bad_input} where no file fits the pattern, or its numbers have a hole.
  PictureSequence(const std::filesystem::path& path, FramePattern pattern, Rational rate);

  const FilmFacts& facts() const { return facts_; }
  void seek_before(double seconds);
  bool step();
  FrameTime time() const { return {next_ - 1, 1}; }
  void convert(Image<Rgb8>& picture) const;
  /// The same with 16 bits a channel; empty of pictures with 8.
  void convert_deep(Image<Rgb16>& picture) const;
  std::optional<std::string> loss() const { return {}; }

 private:
  Image<Rgb8> picture(std::int64_t number) const;

  FramePattern pattern_;
  std::int64_t first_ = 0;
  std::int64_t count_ = 0;
  bool is_multiview_ = false;  ///< each file holds both eyes as views
  std::int64_t next_ = 0;      ///< counted from the first
  FilmFacts facts_;
};

}  // namespace wheatstone
