#include "wheatstone/video/join_segments_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "wheatstone/video/segment_internal.h"
#include "wheatstone/video/stereo_metadata_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

/// All frames' times, and the clock of the decoder: a picture is decoded when the one shown `reordering` places before
/// its turn is shown. So it is never decoded after it is shown, whatever the steps between frames.
struct Clock {
  SegmentTimes all;

  std::int64_t dts(std::size_t place) const {
    const auto back = static_cast<std::size_t>(all.reordering);
    if (place >= back) return all.pts[place - back];
    // Before the first frame: steps as long as the first.
    const std::int64_t step =
        all.size() > 1 ? all.pts[1] - all.pts[0] : std::max<std::int64_t>(1, all.durations.front());
    return all.pts.front() - static_cast<std::int64_t>(back - place) * step;
  }
};

Clock clock_of(const Segments& segments) {
  const auto& [folder, count] = segments;
  Clock clock;
  for (std::int64_t number = 0; number < count; ++number) {
    const std::optional<SegmentTimes> times = segment_times(folder, number);
    const fs::path file = segment_film(folder, number);
    if (!times) refuse_film(file, "is missing; delete the folder to start again");
    SegmentTimes& all = clock.all;
    if (number == 0) all.time_base = times->time_base;
    if (times->time_base != all.time_base || (number > 0 && times->pts.front() <= all.pts.back())) {
      refuse_film(file, "its times do not follow those before; delete the folder to start again");
    }
    all.pts.insert(all.pts.end(), times->pts.begin(), times->pts.end());
    all.durations.insert(all.durations.end(), times->durations.begin(), times->durations.end());
    all.reordering = std::max(all.reordering, times->reordering);
  }
  return clock;
}

bool same_coding(const AVCodecParameters& a, const AVCodecParameters& b) {
  return a.codec_id == b.codec_id && a.width == b.width && a.height == b.height &&
         a.extradata_size == b.extradata_size &&
         (a.extradata_size == 0 ||
          std::memcmp(a.extradata, b.extradata, static_cast<std::size_t>(a.extradata_size)) == 0);
}

OwnedParameters copy_of(const AVCodecParameters& coded) {
  OwnedParameters copy(libav().avcodec_parameters_alloc());
  if (!copy || libav().avcodec_parameters_copy(copy.get(), &coded) < 0) throw std::bad_alloc();
  return copy;
}

/// Frames a second, if all are shown equally long.
std::optional<Rational> even_rate(const SegmentTimes& times) {
  const std::int64_t duration = times.durations.front();
  if (duration <= 0 || std::ranges::any_of(times.durations, [&](std::int64_t other) { return other != duration; }))
    return {};
  for (std::size_t i = 1; i < times.pts.size(); ++i)
    if (times.pts[i] - times.pts[i - 1] != duration) return {};
  return from_av(av_inv_q(libav().av_mul_q(as_av(times.time_base), av_make_q(static_cast<int>(duration), 1))));
}

}  // namespace

void join_segments(const Segments& segments, const fs::path& film, const FilmWriterOptions& options,
                   std::vector<std::string>& notes, const Progress& progress) {
  const auto& [folder, count] = segments;
  const Clock clock = clock_of(segments);
  FilmFile joined(film, options, notes);
  OwnedParameters coded;
  std::size_t before = 0;  // frames of the segments before
  std::size_t place = 0;   // in the order of decoding
  for (std::int64_t number = 0; number < count; ++number) {
    const fs::path file = segment_film(folder, number);
    const std::size_t size = segment_times(folder, number)->size();
    const std::int64_t found =
        read_segment(folder, number, [&](const AVCodecParameters& parameters, AVPacket& packet, std::size_t shown) {
          if (!coded) {
            coded = copy_of(parameters);
            // Not all codecs tell it.
            const Rational of_layout = pixel_aspect_of(options.layout);
            const Rational aspect = of_layout == Rational{1, 1} ? options.pixel_aspect : of_layout;
            if (aspect != Rational{1, 1}) coded->sample_aspect_ratio = as_av(aspect);
            joined.begin(*coded, clock.all.time_base, even_rate(clock.all));
          }
          if (!same_coding(parameters, *coded) || shown >= size || place >= clock.all.size()) {
            refuse_film(file, "does not fit the segments before; delete the folder to start again");
          }
          packet.pts = clock.all.pts[before + shown];
          packet.dts = clock.dts(place++);
          packet.duration = clock.all.durations[before + shown];
          joined.add(packet);
        });
    if (found != static_cast<std::int64_t>(size)) {
      refuse_film(file, fmt::format("{} frames, expected {}; delete the folder to start again", found, size));
    }
    before += size;
    report(progress, "join", static_cast<double>(number + 1) / static_cast<double>(count));
  }
  joined.finish();
}

}  // namespace wheatstone
