#include "wheatstone/display/wiggle.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {
namespace {

constexpr std::size_t most_wiggle_bytes = std::size_t{1} << 34;
constexpr char end_of_gif = ';';

[[noreturn]] void refuse_writing(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot write: {}", path.string(), why));
}

/// There and back: each of the two ends is shown once.
std::vector<const Image<Rgb8>*> there_and_back(std::span<const Image<Rgb8>> views) {
  std::vector<const Image<Rgb8>*> frames;
  for (const Image<Rgb8>& view : views) frames.push_back(&view);
  for (std::size_t i = views.size() - 1; i-- > 1;) frames.push_back(&views[i]);
  return frames;
}

/// A file without a place on a disk, for an encoder that knows only names. OpenImageIO's GIF does not notice that a
/// disk is full: its files are written by us.
class MemoryFile {
 public:
  MemoryFile() : file_(::memfd_create("wiggle", MFD_CLOEXEC)) {
    if (file_ < 0)
      throw Error(ErrorKind::cannot_read_write,
                  fmt::format("no memory for a file: {}", std::generic_category().message(errno)));
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string name() const { return fmt::format("/proc/self/fd/{}", file_); }

 private:
  int file_;
};

void write_gif(const std::filesystem::path& path, std::span<const Image<Rgb8>* const> frames, double seconds) {
  const MemoryFile memory;
  const std::string name = memory.name();
  const std::unique_ptr<PictureWriter> writer = picture_writer(".gif", name);
  StoredPicture picture{frames.front()->width(), frames.front()->height(), 3};
  const int frames_a_second = std::max(1, static_cast<int>(std::lround(static_cast<double>(frames.size()) / seconds)));
  picture.put("FramesPerSecond", Ratio{frames_a_second, 1});
  picture.put("gif:LoopCount", 0);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool begun = i == 0 ? writer->begin({&picture, 1}) : writer->begin_next(picture);
    if (!begun || !writer->write(rows_of(*frames[i]))) refuse_writing(path, writer->complaint());
  }
  if (!writer->end()) refuse_writing(path, writer->complaint());
  const std::string bytes = read_whole_file(name, most_wiggle_bytes);
  if (!bytes.ends_with(end_of_gif)) refuse_writing(path, "not enough memory");
  write_whole_file(path, bytes);
}

void write_webp(const std::filesystem::path& path, std::span<const Image<Rgb8>* const> frames, double seconds) {
  const Image<Rgb8>& first = *frames.front();
  WebPAnimEncoderOptions options;
  WebPConfig config;
  if (WebPAnimEncoderOptionsInit(&options) == 0 || WebPConfigInit(&config) == 0)
    refuse_writing(path, "the installed libwebp does not fit this program");
  config.lossless = 1;
  config.method = 2;  // of 0, fast, to 6, small
  const std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)> encoder(
      WebPAnimEncoderNew(first.width(), first.height(), &options), WebPAnimEncoderDelete);
  if (!encoder) refuse_writing(path, "a WebP of this size cannot be made");
  double time_ms = 0;
  for (const Image<Rgb8>* frame : frames) {
    WebPPicture picture;
    if (WebPPictureInit(&picture) == 0) refuse_writing(path, "the installed libwebp does not fit this program");
    const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> held(&picture, WebPPictureFree);
    picture.use_argb = 1;
    picture.width = frame->width();
    picture.height = frame->height();
    const bool added = WebPPictureImportRGB(&picture, &frame->pixels().data()->r, 3 * frame->width()) != 0 &&
                       WebPAnimEncoderAdd(encoder.get(), &picture, static_cast<int>(time_ms), &config) != 0;
    if (!added) refuse_writing(path, WebPAnimEncoderGetError(encoder.get()));
    time_ms += 1000 * seconds / static_cast<double>(frames.size());
  }
  WebPData data;
  WebPDataInit(&data);
  const std::unique_ptr<WebPData, decltype(&WebPDataClear)> held(&data, WebPDataClear);
  if (WebPAnimEncoderAdd(encoder.get(), nullptr, static_cast<int>(time_ms), nullptr) == 0 ||
      WebPAnimEncoderAssemble(encoder.get(), &data) == 0)
    refuse_writing(path, WebPAnimEncoderGetError(encoder.get()));
  write_whole_file(path, {reinterpret_cast<const char*>(data.bytes), data.size});
}

}  // namespace

void write_wiggle(const std::filesystem::path& path, std::span<const Image<Rgb8>> views, double seconds) {
  if (views.size() < 2)
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: {} views, expected two or more", path.string(), views.size()));
  for (const Image<Rgb8>& view : views)
    if (view.empty() || !same_size(view, views.front()))
      throw Error(ErrorKind::wrong_usage, fmt::format("{}: views of different sizes, expected one", path.string()));
  const std::vector<const Image<Rgb8>*> frames = there_and_back(views);
  if (path.extension() == ".gif") return write_gif(path, frames, seconds);
  if (path.extension() == ".webp") return write_webp(path, frames, seconds);
  throw Error(ErrorKind::wrong_usage,
              fmt::format("{}: unknown animation format, expected a name that ends in .gif or .webp", path.string()));
}

}  // namespace wheatstone
