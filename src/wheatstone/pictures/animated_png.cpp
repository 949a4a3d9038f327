#include <algorithm>

#include "wheatstone/pictures/animated_png_internal.h"
#include "wheatstone/pictures/png_chunks.h"

namespace wheatstone {
namespace {

/// A frame's control chunk, fcTL: its size and place, and whether it is blended with what was there.
bool replaces_all(std::string_view control, std::string_view header) {
  constexpr std::size_t control_size = 26, place_at = 12, blend_at = 25, colour_type_at = 9;
  constexpr int has_alpha = 4;
  if (control.size() != control_size || header.size() <= colour_type_at) return false;
  const bool is_blended = control[blend_at] != 0 && (header[colour_type_at] & has_alpha) != 0;
  const bool at_corner = png_number(control, place_at) == 0 && png_number(control, place_at + 4) == 0;
  return at_corner && !is_blended && control.substr(4, 8) == header.substr(0, 8);
}

}  // namespace

bool is_animated_png(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1a\n") && bytes.find("acTL") < bytes.find("IDAT");
}

std::optional<std::vector<std::string>> frames_of_png(std::string_view bytes, int most_frames) {
  const auto chunks = png_chunks(bytes);
  if (!chunks || chunks->front().type != "IHDR") return {};
  const std::string_view header = chunks->front().data;
  std::string begin(bytes.substr(0, png_signature_size));
  append_png_chunk("IHDR", header, begin);
  for (const PngChunk& chunk : *chunks)
    if (chunk.type == "PLTE" || chunk.type == "tRNS") append_png_chunk(chunk.type, chunk.data, begin);

  constexpr std::size_t number_size = 4;  // of a frame's data, before them
  std::vector<std::string> frames;
  for (const PngChunk& chunk : *chunks) {
    if (chunk.type == "fcTL") {
      if (static_cast<int>(frames.size()) == most_frames) break;
      if (!replaces_all(chunk.data, header)) return {};
      frames.push_back(begin);
    }
    // What stands before the first frame is shown only where frames are not.
    if (frames.empty()) continue;
    if (chunk.type == "IDAT") append_png_chunk("IDAT", chunk.data, frames.back());
    if (chunk.type == "fdAT")
      append_png_chunk("IDAT", chunk.data.substr(std::min(number_size, chunk.data.size())), frames.back());
  }
  for (std::string& frame : frames) append_png_chunk("IEND", {}, frame);
  return frames;
}

}  // namespace wheatstone
