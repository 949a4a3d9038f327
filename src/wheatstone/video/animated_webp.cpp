#include "wheatstone/video/animated_webp_internal.h"

#include <fmt/format.h>
#include <webp/demux.h>

#include <array>
#include <fstream>
#include <numeric>
#include <string_view>
#include <utility>

#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;

/// As browsers show them: what asks for less than 11 ms is shown for 100.
std::int64_t shown_ms(int stated_ms) { return stated_ms <= 10 ? 100 : stated_ms; }

std::vector<std::int64_t> durations_of(const WebPAnimDecoder* decoder) {
  std::vector<std::int64_t> durations;
  WebPIterator frame;
  if (WebPDemuxGetFrame(WebPAnimDecoderGetDemuxer(decoder), 1, &frame) != 0) {
    do durations.push_back(shown_ms(frame.duration));
    while (WebPDemuxNextFrame(&frame) != 0);
    WebPDemuxReleaseIterator(&frame);
  }
  return durations;
}

}  // namespace

bool is_webp(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::array<char, 12> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), head.size());
  const std::string_view text(head.data(), head.size());
  return file && text.starts_with("RIFF") && text.ends_with("WEBP");
}

void AnimatedWebp::Deleter::operator()(WebPAnimDecoder* decoder) const { WebPAnimDecoderDelete(decoder); }

AnimatedWebp::AnimatedWebp(std::filesystem::path path)
    : path_(std::move(path)), bytes_(read_whole_file(path_, most_bytes)) {
  WebPAnimDecoderOptions options;
  WebPAnimDecoderOptionsInit(&options);
  options.color_mode = MODE_rgbA;
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size()};  // NOLINT: bytes as text
  decoder_.reset(WebPAnimDecoderNew(&data, &options));
  WebPAnimInfo info;
  if (!decoder_ || WebPAnimDecoderGetInfo(decoder_.get(), &info) == 0 || info.frame_count == 0)
    refuse_film(path_, "a damaged WebP, expected an animation");
  durations_ms_ = durations_of(decoder_.get());
  facts_.container = "webp";
  facts_.codec = "webp";
  facts_.pixel_format = "rgba";
  facts_.width = static_cast<int>(info.canvas_width);
  facts_.height = static_cast<int>(info.canvas_height);
  facts_.time_base = {1, 1000};
  const std::int64_t total_ms = std::accumulate(durations_ms_.begin(), durations_ms_.end(), std::int64_t{0});
  facts_.duration_s = static_cast<double>(total_ms) / 1000;
  facts_.frame_count = static_cast<std::int64_t>(durations_ms_.size());
  if (total_ms > 0)
    facts_.frame_rate = from_av(libav().av_d2q(static_cast<double>(*facts_.frame_count) / facts_.duration_s, 1000));
}

bool AnimatedWebp::step() {
  if (next_ >= durations_ms_.size()) return false;
  std::uint8_t* pixels = nullptr;
  int ignored_end_ms = 0;
  broke_off_ = WebPAnimDecoderGetNext(decoder_.get(), &pixels, &ignored_end_ms) == 0;
  if (broke_off_) return false;
  pixels_ = pixels;
  time_ = {time_.pts + time_.duration, durations_ms_[next_++]};
  return true;
}

void AnimatedWebp::convert(Image<Rgb8>& picture) const {
  picture = Image<Rgb8>(facts_.width, facts_.height);
  const std::uint8_t* from = pixels_;
  for (Rgb8& pixel : picture.pixels()) {
    pixel = {from[0], from[1], from[2]};
    from += 4;
  }
}

std::optional<std::string> AnimatedWebp::loss() const {
  if (!broke_off_) return {};
  return fmt::format("{}: breaks off after {} of {} frames", path_.string(), next_, durations_ms_.size());
}

}  // namespace wheatstone
