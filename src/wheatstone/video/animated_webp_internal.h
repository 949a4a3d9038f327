#pragma once

// An animated WebP as a film: libav does not read them.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "wheatstone/video/decoded_film_internal.h"

struct WebPAnimDecoder;

namespace wheatstone {

/// Whether a file begins as a WebP does.
bool is_webp(const std::filesystem::path& path);

class AnimatedWebp {
 public:
  /// Throws Error{bad_input} where it is damaged.
  explicit AnimatedWebp(std::filesystem::path path);

  const FilmFacts& facts() const { return facts_; }
  /// Frames are made of those before: all are decoded, from the first.
  void seek_before(double /*seconds*/) {}
  bool step();
  FrameTime time() const { return time_; }
  /// What is transparent is black.
  void convert(Image<Rgb8>& picture) const;
  std::optional<std::string> loss() const;

 private:
  struct Deleter {
    void operator()(WebPAnimDecoder* decoder) const;
  };

  std::filesystem::path path_;
  std::string bytes_;
  std::unique_ptr<WebPAnimDecoder, Deleter> decoder_;
  std::vector<std::int64_t> durations_ms_;
  FilmFacts facts_;
  FrameTime time_;
  std::size_t next_ = 0;
  bool broke_off_ = false;
  const std::uint8_t* pixels_ = nullptr;  ///< of the frame at hand, the decoder's; red, green, blue, alpha
};

}  // namespace wheatstone
