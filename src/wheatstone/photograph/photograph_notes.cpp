#include "wheatstone/photograph/photograph_notes.h"

#include <libexif/exif-data.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/photograph/jpeg_segments_internal.h"
#include "wheatstone/photograph/xmp_internal.h"
#include "wheatstone/pictures/heif_pictures.h"
#include "wheatstone/pictures/jpeg.h"
#include "wheatstone/pictures/open_picture.h"
#include "wheatstone/pictures/png_chunks.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view exif_signature("Exif\0\0", 6);

/// EXIF data from the TIFF header on, as the file has them.
std::string raw_exif(std::string_view bytes) {
  if (is_jpeg(bytes)) {
    for (const JpegSegment& segment : jpeg_segments(bytes))
      if (segment.marker == app1 && segment.data.starts_with(exif_signature))
        return std::string(segment.data.substr(exif_signature.size()));
  } else if (is_heif(bytes)) {
    return heif_exif(bytes);
  } else if (bytes.starts_with("\x89PNG")) {
    for (const PngChunk& chunk : png_chunks(bytes).value_or(std::vector<PngChunk>{}))
      if (chunk.type == "eXIf") return std::string(chunk.data);
  }
  return {};
}

/// A text of a file as UTF-8 on one line: what is not UTF-8 is taken for Latin-1.
std::string as_line(std::string_view bytes) {
  bytes = bytes.substr(0, bytes.find('\0'));
  const bool is_understood = is_utf8(bytes);
  std::string line;
  for (const char letter : bytes) {
    const auto code = static_cast<unsigned char>(letter);
    if (code <= ' ' || code == 0x7f) {
      if (!line.empty() && line.back() != ' ') line += ' ';
    } else if (code < 0x80 || is_understood) {
      line += letter;
    } else {
      line += {static_cast<char>(0xC0 | code >> 6), static_cast<char>(0x80 | (code & 0x3F))};
    }
  }
  while (line.ends_with(' ')) line.pop_back();
  return line;
}

/// Cameras put their own name where a title is to stand.
std::string without_camera_words(std::string title) {
  const std::string small = lower_case(title);
  const bool is_of_camera = small.ends_with("digital camera") || small.ends_with("digital still camera") ||
                            small == "sony dsc" || small == "default";
  return is_of_camera ? std::string() : title;
}

struct ExifFreed {
  void operator()(ExifData* data) const { exif_data_unref(data); }
};
using Exif = std::unique_ptr<ExifData, ExifFreed>;

/// Windows' titles (XPTitle) are UTF-16, the lowest byte first.
std::string from_utf16(std::string_view bytes) {
  std::string text;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const unsigned code =
        static_cast<unsigned char>(bytes[i]) | static_cast<unsigned>(static_cast<unsigned char>(bytes[i + 1])) << 8;
    if (code == 0) break;
    if (code < 0x80) {
      text += static_cast<char>(code);
    } else if (code < 0x800) {
      text += {static_cast<char>(0xC0 | code >> 6), static_cast<char>(0x80 | (code & 0x3F))};
    } else if (code < 0xD800 || code > 0xDFFF) {
      text += {static_cast<char>(0xE0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 0x3F)),
               static_cast<char>(0x80 | (code & 0x3F))};
    }
  }
  return as_line(text);
}

std::string_view bytes_of(const Exif& exif, ExifIfd directory, ExifTag tag) {
  const ExifEntry* const entry = exif_content_get_entry(exif->ifd[directory], tag);
  if (entry == nullptr || entry->data == nullptr) return {};
  return {reinterpret_cast<const char*>(entry->data), entry->size};
}

Exif parsed(const std::string& raw) {
  Exif exif(exif_data_new());
  if (!exif) return exif;
  exif_data_unset_option(exif.get(), EXIF_DATA_OPTION_FOLLOW_SPECIFICATION);
  exif_data_unset_option(exif.get(), EXIF_DATA_OPTION_IGNORE_UNKNOWN_TAGS);
  exif_data_set_option(exif.get(), EXIF_DATA_OPTION_DONT_CHANGE_MAKER_NOTE);
  const std::string whole = std::string(exif_signature) + raw;
  exif_data_load_data(exif.get(), reinterpret_cast<const unsigned char*>(whole.data()),
                      static_cast<unsigned>(whole.size()));
  return exif;
}

void remove(const Exif& exif, ExifIfd directory, ExifTag tag) {
  ExifContent* const content = exif->ifd[directory];
  while (ExifEntry* const entry = exif_content_get_entry(content, tag)) exif_content_remove_entry(content, entry);
}

void remove_all(const Exif& exif, ExifIfd directory) {
  ExifContent* const content = exif->ifd[directory];
  while (content->count > 0) exif_content_remove_entry(content, content->entries[content->count - 1]);
}

/// The data without what belongs to the file that they come from.
std::string carried(const Exif& exif, bool keep_location) {
  constexpr std::array of_pictures{
      EXIF_TAG_ORIENTATION,        EXIF_TAG_IMAGE_WIDTH,           EXIF_TAG_IMAGE_LENGTH,
      EXIF_TAG_BITS_PER_SAMPLE,    EXIF_TAG_COMPRESSION,           EXIF_TAG_STRIP_OFFSETS,
      EXIF_TAG_STRIP_BYTE_COUNTS,  EXIF_TAG_WHITE_POINT,           EXIF_TAG_X_RESOLUTION,
      EXIF_TAG_Y_RESOLUTION,       EXIF_TAG_RESOLUTION_UNIT,       EXIF_TAG_YCBCR_POSITIONING,
      EXIF_TAG_YCBCR_COEFFICIENTS, EXIF_TAG_PRIMARY_CHROMATICITIES};
  for (const ExifTag tag : of_pictures) remove(exif, EXIF_IFD_0, tag);
  for (const ExifTag tag : {EXIF_TAG_MAKER_NOTE, EXIF_TAG_PIXEL_X_DIMENSION, EXIF_TAG_PIXEL_Y_DIMENSION,
                            EXIF_TAG_COLOR_SPACE, EXIF_TAG_GAMMA, EXIF_TAG_COMPRESSED_BITS_PER_PIXEL})
    remove(exif, EXIF_IFD_EXIF, tag);
  remove_all(exif, EXIF_IFD_1);
  remove_all(exif, EXIF_IFD_INTEROPERABILITY);
  if (!keep_location) remove_all(exif, EXIF_IFD_GPS);
  std::free(exif->data);  // the thumbnail
  exif->data = nullptr;
  exif->size = 0;
  const bool is_empty =
      exif->ifd[EXIF_IFD_0]->count == 0 && exif->ifd[EXIF_IFD_EXIF]->count == 0 && exif->ifd[EXIF_IFD_GPS]->count == 0;
  if (is_empty) return {};
  unsigned char* saved = nullptr;
  unsigned size = 0;
  exif_data_save_data(exif.get(), &saved, &size);
  const std::string all(reinterpret_cast<const char*>(saved), saved != nullptr ? size : 0);
  std::free(saved);
  return all.starts_with(exif_signature) ? all.substr(exif_signature.size()) : std::string();
}

/// The title that a JPEG's XMP gives in its first language.
std::string xmp_title(std::string_view bytes, const fs::path& path) {
  const std::string packet = read_xmp(bytes, path).packet;
  const std::size_t begin = packet.find("<dc:title"), end = packet.find("</dc:title>");
  if (begin == packet.npos || end == packet.npos || end < begin) return {};
  const std::size_t item = packet.find("<rdf:li", begin), text = packet.find('>', item);
  if (item == packet.npos || text > end) return {};
  std::string title = packet.substr(text + 1, packet.find('<', text) - text - 1);
  constexpr std::array<std::array<std::string_view, 2>, 5> references{
      {{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}, {"&amp;", "&"}}};
  for (const auto& [reference, letter] : references)
    for (std::size_t at = title.find(reference); at != title.npos; at = title.find(reference, at + 1))
      title.replace(at, reference.size(), letter);
  return as_line(title);
}

std::string png_title(std::string_view bytes) {
  for (const PngChunk& chunk : png_chunks(bytes).value_or(std::vector<PngChunk>{})) {
    constexpr std::string_view key("Title\0", 6);
    if (!chunk.data.starts_with(key)) continue;
    const std::string_view rest = chunk.data.substr(key.size());
    if (chunk.type == "tEXt") return as_line(rest);
    // Not compressed: two bytes, then a language and a key of that language, each with a zero behind it.
    if (chunk.type != "iTXt" || rest.size() < 2 || rest[0] != 0) continue;
    const std::size_t language = rest.find('\0', 2),
                      key_end = language == rest.npos ? rest.npos : rest.find('\0', language + 1);
    if (key_end != rest.npos) return as_line(rest.substr(key_end + 1));
  }
  return {};
}

PictureNotes notes_of(const fs::path& path, bool keep_location) {
  const std::string bytes = read_picture_bytes(path);
  PictureNotes notes;
  if (const std::string raw = raw_exif(bytes); !raw.empty()) {
    if (const Exif exif = parsed(raw)) {
      for (const auto& [directory, tag] :
           {std::pair(EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_ORIGINAL),
            std::pair(EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_DIGITIZED), std::pair(EXIF_IFD_0, EXIF_TAG_DATE_TIME)})
        if (notes.taken.empty()) notes.taken = as_line(bytes_of(exif, directory, tag));
      notes.title = from_utf16(bytes_of(exif, EXIF_IFD_0, EXIF_TAG_XP_TITLE));
      if (notes.title.empty())
        notes.title = without_camera_words(as_line(bytes_of(exif, EXIF_IFD_0, EXIF_TAG_IMAGE_DESCRIPTION)));
      notes.exif = carried(exif, keep_location);
    }
  } else if (!is_jpeg(bytes) && !is_heif(bytes) && !bytes.starts_with("\x89PNG")) {
    const OpenPicture open = open_picture(path);
    const StoredPicture& picture = open.reader->picture();
    notes.title = without_camera_words(as_line(picture.value_of<std::string>("ImageDescription", {})));
    notes.taken = picture.value_of<std::string>("Exif:DateTimeOriginal", picture.value_of<std::string>("DateTime", {}));
  }
  if (is_jpeg(bytes))
    if (std::string title = xmp_title(bytes, path); !title.empty()) notes.title = std::move(title);
  if (bytes.starts_with("\x89PNG"))
    if (std::string title = png_title(bytes); !title.empty()) notes.title = std::move(title);
  // Cameras whose clock was never set write zeros, or blanks.
  if (notes.taken.size() < 10 || notes.taken.starts_with("0000")) notes.taken.clear();
  return notes;
}

}  // namespace

PictureNotes read_photograph_notes(const fs::path& path, bool keep_location) {
  try {
    return notes_of(path, keep_location);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace wheatstone
