#include <algorithm>

#include "wheatstone/pictures/plain_png_internal.h"
#include "wheatstone/pictures/png_chunks.h"

namespace wheatstone {
namespace {

bool is_needed(std::string_view type) {
  constexpr std::string_view needed[] = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND", "eXIf"};
  return std::find(std::begin(needed), std::end(needed), type) != std::end(needed);
}

}  // namespace

std::optional<std::string> plain_png(std::string_view bytes) {
  const auto chunks = png_chunks(bytes);
  if (!chunks) return {};
  std::string plain(bytes.substr(0, png_signature_size));
  for (const PngChunk& chunk : *chunks)
    if (is_needed(chunk.type)) plain += chunk.whole;
  return plain;
}

}  // namespace wheatstone
