#include <algorithm>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
// libjpeg's header wants the ones above before it.
#include <jpeglib.h>

#include <memory>
#include <vector>

#include "wheatstone/pictures/jpeg.h"
#include "wheatstone/pictures/upright.h"

namespace wheatstone {
namespace {

/// libjpeg leaves a function that has failed by a long jump: those that call it here have no local objects. What it
/// only warns of is harmless.
struct Failure : jpeg_error_mgr {
  std::jmp_buf jump;
  char complaint[JMSG_LENGTH_MAX] = {};

  explicit Failure(jpeg_error_mgr*& errors) {
    errors = jpeg_std_error(this);
    error_exit = [](j_common_ptr common) {
      auto* const self = static_cast<Failure*>(common->err);
      self->format_message(common, self->complaint);
      std::longjmp(self->jump, 1);
    };
    emit_message = [](j_common_ptr, int) {};
    output_message = [](j_common_ptr) {};
  }
};

class JpegReader : public PictureReader {
 public:
  explicit JpegReader(std::string_view bytes) : bytes_(bytes), failure_(jpeg_.err) {}
  ~JpegReader() override { jpeg_destroy_decompress(&jpeg_); }

  bool open(int least_side) {
    if (!read_header(least_side)) return false;
    describe();
    return true;
  }

  std::string format() const override { return "jpeg"; }
  const StoredPicture& picture() const override { return picture_; }
  bool go_to(int picture) override { return picture == 0; }
  bool read(std::uint8_t* to) override {
    if (jpeg_.num_components < 4) return decode(to);
    std::vector<std::uint8_t> inks(4 * pixels());
    if (!decode(inks.data())) return false;
    // Adobe's files, the only ones with four inks, say how much of each is missing.
    for (std::size_t i = 0; i < pixels(); ++i)
      for (std::size_t ink = 0; ink < 3; ++ink)
        to[3 * i + ink] = static_cast<std::uint8_t>((inks[4 * i + ink] * inks[4 * i + 3] + 127) / 255);
    return true;
  }
  bool read(int first_row, int rows, int channels, float* to) override {
    if (decoded_.empty()) {
      std::vector<std::uint8_t> all(pixels() * static_cast<std::size_t>(picture_.channels));
      if (!read(all.data())) return false;
      decoded_ = std::move(all);
    }
    const auto width = static_cast<std::size_t>(picture_.width);
    const std::uint8_t* from = decoded_.data() + static_cast<std::size_t>(first_row * picture_.channels) * width;
    for (std::size_t i = 0; i < static_cast<std::size_t>(rows) * width; ++i, from += picture_.channels)
      for (int channel = 0; channel < channels; ++channel) *to++ = static_cast<float>(from[channel]) * (1.f / 255);
    return true;
  }
  std::string complaint() override {
    std::string complaint = failure_.complaint;
    failure_.complaint[0] = '\0';
    return complaint;
  }

 private:
  std::size_t pixels() const {
    return static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(picture_.height);
  }

  bool read_header(int least_side) {
    if (setjmp(failure_.jump) != 0) return false;
    jpeg_create_decompress(&jpeg_);
    jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
    constexpr unsigned int longest = 0xffff;
    jpeg_save_markers(&jpeg_, JPEG_APP0 + 1, longest);
    jpeg_save_markers(&jpeg_, JPEG_APP0 + 2, longest);
    jpeg_read_header(&jpeg_, TRUE);
    if (jpeg_.num_components == 4)
      jpeg_.out_color_space = JCS_CMYK;
    else
      jpeg_.out_color_space = jpeg_.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    constexpr unsigned int smallest = 8;
    const unsigned int shorter = std::min(jpeg_.image_width, jpeg_.image_height);
    jpeg_.scale_num = jpeg_.scale_denom = 1;
    while (jpeg_.scale_denom < smallest && shorter / (2 * jpeg_.scale_denom) >= static_cast<unsigned int>(least_side))
      jpeg_.scale_denom *= 2;
    jpeg_calc_output_dimensions(&jpeg_);
    return true;
  }

  void describe() {
    picture_.width = static_cast<int>(jpeg_.output_width);
    picture_.height = static_cast<int>(jpeg_.output_height);
    picture_.channels = jpeg_.num_components == 1 ? 1 : 3;
    picture_.kind = bytes_kind;
    picture_.full_width = picture_.width;
    picture_.full_height = picture_.height;
    constexpr std::string_view exif("Exif\0\0", 6);
    for (jpeg_saved_marker_ptr marker = jpeg_.marker_list; marker != nullptr; marker = marker->next) {
      const std::string_view data(reinterpret_cast<const char*>(marker->data), marker->data_length);
      if (marker->marker == JPEG_APP0 + 1 && data.starts_with(exif))
        picture_.put("Orientation", exif_orientation(data.substr(exif.size())));
    }
    JOCTET* profile = nullptr;
    unsigned int size = 0;
    if (jpeg_read_icc_profile(&jpeg_, &profile, &size) == TRUE)
      picture_.put("ICCProfile", std::vector<std::uint8_t>(profile, profile + size));
    std::free(profile);
  }

  /// A JPEG is decoded once, from its first row to its last.
  bool decode(std::uint8_t* to) {
    if (setjmp(failure_.jump) != 0) return false;
    jpeg_start_decompress(&jpeg_);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = to + static_cast<std::size_t>(jpeg_.output_scanline) * jpeg_.output_width *
                              static_cast<std::size_t>(jpeg_.output_components);
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }

  std::string_view bytes_;
  jpeg_decompress_struct jpeg_{};
  Failure failure_;
  StoredPicture picture_;
  std::vector<std::uint8_t> decoded_;
};

}  // namespace

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xFF\xD8"); }

std::string jpeg_segment(std::uint8_t marker, std::string_view data) {
  const std::size_t length = 2 + data.size();
  const std::string head{'\xFF', static_cast<char>(marker), static_cast<char>(length >> 8), static_cast<char>(length)};
  return head + std::string(data);
}

bool jpeg_is_whole(std::string_view bytes) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  if (bytes.size() < 4 || !is_jpeg(bytes)) return true;
  constexpr std::uint8_t start_of_scan = 0xDA;

  // Segments with a length come first; a thumbnail with an end marker of its own may hide in them.
  std::size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (byte(at) != 0xFF) return false;
    const std::uint8_t marker = byte(at + 1);
    if (marker == 0xFF) {
      ++at;
      continue;
    }
    at += 2 + (static_cast<std::size_t>(byte(at + 2)) << 8 | byte(at + 3));
    if (marker == start_of_scan) return bytes.find("\xFF\xD9", at) != std::string_view::npos;
  }
  return false;
}

OpenedPicture open_jpeg_bytes(std::string_view bytes, int least_side) {
  auto reader = std::make_unique<JpegReader>(bytes);
  if (!reader->open(least_side)) return {nullptr, reader->complaint()};
  return {std::move(reader), {}};
}

EncodedPicture encode_jpeg(const StoredPicture& picture, const PixelRows& rows, int quality) {
  struct Made {
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    ~Made() { std::free(bytes); }
  } made;
  jpeg_compress_struct jpeg{};
  Failure failure(jpeg.err);
  if (setjmp(failure.jump) != 0) {
    jpeg_destroy_compress(&jpeg);
    return {{}, failure.complaint};
  }
  jpeg_create_compress(&jpeg);
  jpeg_mem_dest(&jpeg, &made.bytes, &made.size);
  jpeg.image_width = static_cast<JDIMENSION>(picture.width);
  jpeg.image_height = static_cast<JDIMENSION>(picture.height);
  jpeg.input_components = picture.channels;
  jpeg.in_color_space = picture.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, quality, TRUE);
  jpeg.comp_info[0].h_samp_factor = jpeg.comp_info[0].v_samp_factor = 1;
  jpeg_start_compress(&jpeg, TRUE);
  while (jpeg.next_scanline < jpeg.image_height) {
    const auto* const row =
        static_cast<const std::uint8_t*>(rows.first) + static_cast<std::ptrdiff_t>(jpeg.next_scanline) * rows.row_bytes;
    auto* given = const_cast<JSAMPROW>(row);  // libjpeg only reads it
    jpeg_write_scanlines(&jpeg, &given, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  return {{reinterpret_cast<const char*>(made.bytes), made.size}, {}};
}

}  // namespace wheatstone
