#include "wheatstone/video/kept_metadata_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>

extern "C" {
#include <libavutil/spherical.h>
}

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

constexpr std::uint32_t quarter = std::uint32_t{1} << 30;  ///< of the width, as spherical side data counts

bool near_quarter(std::uint32_t bound) { return bound >= quarter - quarter / 64 && bound <= quarter + quarter / 64; }

const AVSphericalMapping* mapping_of(const AVStream& stream) {
  std::size_t size = 0;
  const std::uint8_t* data = libav().av_stream_get_side_data(&stream, AV_PKT_DATA_SPHERICAL, &size);
  return size >= sizeof(AVSphericalMapping) ? reinterpret_cast<const AVSphericalMapping*>(data) : nullptr;
}

void add_mapping(const AVSphericalMapping& mapping, AVStream& stream) {
  std::uint8_t* data = libav().av_stream_new_side_data(&stream, AV_PKT_DATA_SPHERICAL, sizeof(AVSphericalMapping));
  if (data == nullptr) throw std::bad_alloc();
  std::memcpy(data, &mapping, sizeof(AVSphericalMapping));
}

const char* timecode_tag(const AVFormatContext& source) {
  for (unsigned i = 0; i <= source.nb_streams; ++i) {
    const AVDictionary* tags = i == 0 ? source.metadata : source.streams[i - 1]->metadata;
    if (const AVDictionaryEntry* entry = libav().av_dict_get(tags, "timecode", nullptr, 0)) return entry->value;
  }
  return nullptr;
}

}  // namespace

std::string projection_of(const AVStream& stream) {
  const AVSphericalMapping* mapping = mapping_of(stream);
  if (mapping == nullptr) return "flat";
  if (mapping->projection == AV_SPHERICAL_EQUIRECTANGULAR) return "360";
  const bool is_half = mapping->projection == AV_SPHERICAL_EQUIRECTANGULAR_TILE && near_quarter(mapping->bound_left) &&
                       near_quarter(mapping->bound_right) && mapping->bound_top == 0 && mapping->bound_bottom == 0;
  return is_half ? "180" : "other";
}

void check_projection(std::string_view projection) {
  for (const std::string_view known : {"source", "flat", "180", "360"})
    if (projection == known) return;
  throw Error(ErrorKind::wrong_usage, fmt::format("projection: {}, expected source, flat, 180 or 360", projection));
}

void say_projection(const AVFormatContext* source, const FilmWriterOptions& options, AVStream& stream) {
  if (options.projection == "flat") return;
  if (options.projection == "source") {
    const int index = source != nullptr ? video_stream_of(*source) : -1;
    const AVSphericalMapping* mapping = index >= 0 ? mapping_of(*source->streams[index]) : nullptr;
    if (mapping != nullptr) add_mapping(*mapping, stream);
    return;
  }
  AVSphericalMapping mapping{};
  mapping.projection = AV_SPHERICAL_EQUIRECTANGULAR;
  if (options.projection == "180") {
    mapping.projection = AV_SPHERICAL_EQUIRECTANGULAR_TILE;
    mapping.bound_left = mapping.bound_right = quarter - 1;
  }
  add_mapping(mapping, stream);
}

void keep_chapters(const AVFormatContext& source, const FilmWriterOptions& options, AVFormatContext& output) {
  std::vector<AVChapter*> kept;
  for (unsigned i = 0; i < source.nb_chapters; ++i) {
    const AVChapter& from = *source.chapters[i];
    const double tick = av_q2d(from.time_base);
    const auto ticks = [&](double seconds) { return static_cast<std::int64_t>(std::llround(seconds / tick)); };
    const std::int64_t first = ticks(options.start_s), last = options.end_s ? ticks(*options.end_s) : from.end;
    if (from.end <= first || from.start >= last) continue;
    auto* const chapter = static_cast<AVChapter*>(libav().av_mallocz(sizeof(AVChapter)));
    if (chapter == nullptr) throw std::bad_alloc();
    chapter->id = from.id;
    chapter->time_base = from.time_base;
    chapter->start = std::max(from.start, first) - first;
    chapter->end = std::min(from.end, last) - first;
    libav().av_dict_copy(&chapter->metadata, from.metadata, 0);
    kept.push_back(chapter);
  }
  if (kept.empty()) return;
  // The output frees them.
  output.chapters = static_cast<AVChapter**>(libav().av_malloc(kept.size() * sizeof(AVChapter*)));
  if (output.chapters == nullptr) throw std::bad_alloc();
  std::ranges::copy(kept, output.chapters);
  output.nb_chapters = static_cast<unsigned>(kept.size());
}

void keep_timecode(const AVFormatContext& source, const FilmWriterOptions& options, AVStream& stream,
                   std::vector<std::string>& notes) {
  const char* const tag = timecode_tag(source);
  if (tag == nullptr) return;
  const AVRational rate = as_av(options.frame_rate);
  AVTimecode timecode{};
  if (rate.num <= 0 || libav().av_timecode_init_from_string(&timecode, rate, tag, nullptr) < 0) {
    notes.push_back(fmt::format("the timecode {} is left out: it cannot be counted at {}/{} frames a second", tag,
                                rate.num, rate.den));
    return;
  }
  std::array<char, AV_TIMECODE_STR_SIZE> text{};
  libav().av_timecode_make_string(&timecode, text.data(),
                                  static_cast<int>(std::lround(options.start_s * av_q2d(rate))));
  libav().av_dict_set(&stream.metadata, "timecode", text.data(), 0);
  stream.avg_frame_rate = rate;
}

}  // namespace wheatstone
