#include <fmt/format.h>

#include "wheatstone/error.h"
#include "wheatstone/photograph/jpeg_segments_internal.h"
#include "wheatstone/photograph/multi_picture_internal.h"
#include "wheatstone/pictures/jpeg.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view signature{"MPF\0", 4};
constexpr std::uint16_t number_of_pictures_tag = 0xB001, entries_tag = 0xB002, individual_number_tag = 0xB101;
constexpr std::uint32_t most_pictures = 1024;
constexpr std::size_t entry_size = 16, field_size = 12;

[[noreturn]] void refuse_index(const fs::path& path, std::string_view what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: its MP index is damaged: {}", path.string(), what));
}

/// A TIFF structure in one byte order, as it stands in a segment.
class TiffBytes {
 public:
  TiffBytes(std::string_view bytes, const fs::path& path) : bytes_(bytes), path_(path) {
    if (bytes.size() < 8) refuse_index(path, "it is too short");
    little_ = bytes.starts_with(std::string_view("II\x2A\0", 4));
    if (!little_ && !bytes.starts_with(std::string_view("MM\0\x2A", 4))) refuse_index(path, "it has no byte order");
  }

  std::uint32_t number(std::size_t at, std::size_t length) const {
    if (at > bytes_.size() || length > bytes_.size() - at) refuse_index(path_, "it refers to data beyond its end");
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < length; ++i)
      number = number << 8 | static_cast<std::uint8_t>(bytes_[at + (little_ ? length - 1 - i : i)]);
    return number;
  }
  std::uint32_t short_at(std::size_t at) const { return number(at, 2); }
  std::uint32_t long_at(std::size_t at) const { return number(at, 4); }

  /// Where the directory at `directory` has this field; none where it has not.
  std::optional<std::size_t> field(std::size_t directory, std::uint16_t tag) const {
    const std::size_t count = short_at(directory);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = directory + 2 + i * field_size;
      if (short_at(at) == tag) return at;
    }
    return {};
  }
  /// Where the next directory stands; 0 for none.
  std::size_t next_directory(std::size_t directory) const {
    return long_at(directory + 2 + short_at(directory) * field_size);
  }

 private:
  std::string_view bytes_;
  const fs::path& path_;
  bool little_ = false;
};

struct FoundIndex {
  std::string_view bytes;    ///< from the byte order on
  std::size_t begin_in = 0;  ///< where that is in the file
};

std::optional<FoundIndex> find_index(std::string_view jpeg) {
  for (const JpegSegment& segment : jpeg_segments(jpeg))
    if (segment.marker == app2 && segment.data.starts_with(signature))
      return FoundIndex{segment.data.substr(signature.size()), segment.begin + 4 + signature.size()};
  return {};
}

/// MPIndividualNum in an attribute directory. 0 and all ones stand for "not known".
std::optional<std::uint32_t> individual_number(const TiffBytes& tiff, std::size_t directory) {
  const std::optional<std::size_t> field = tiff.field(directory, individual_number_tag);
  if (!field) return {};
  const std::uint32_t number = tiff.long_at(*field + 8);
  if (number == 0 || number == 0xFFFFFFFF) return {};
  return number;
}

/// The entry that stands `at` so many bytes into the index of a file.
MultiPictureEntry read_entry(const TiffBytes& tiff, std::size_t at, const FoundIndex& index, std::string_view file,
                             const fs::path& path) {
  MultiPictureEntry entry;
  constexpr std::uint32_t format_bits = 0x07000000, type_bits = 0x00FFFFFF;
  const std::uint32_t attribute = tiff.long_at(at);
  const std::size_t offset = tiff.long_at(at + 8);
  if ((attribute & format_bits) != 0) refuse_index(path, "one of its pictures is not a JPEG");
  entry.type = attribute & type_bits;
  entry.length = tiff.long_at(at + 4);
  // The first picture is the file's start; the others are counted from the index's byte order on.
  entry.begin = offset == 0 ? 0 : index.begin_in + offset;
  if (entry.begin > file.size() || entry.length > file.size() - entry.begin || entry.length < 4)
    refuse_index(path, "one of its pictures lies beyond the end of the file");
  if (!file.substr(entry.begin, 2).starts_with("\xFF\xD8"))
    refuse_index(path, "one of its pictures does not begin at the listed position");
  return entry;
}

}  // namespace

std::vector<MultiPictureEntry> read_multi_picture_index(std::string_view bytes, const fs::path& path) {
  const std::optional<FoundIndex> index = find_index(bytes);
  if (!index) return {};
  const TiffBytes tiff(index->bytes, path);
  const std::size_t directory = tiff.long_at(4);
  const std::optional<std::size_t> count_field = tiff.field(directory, number_of_pictures_tag);
  const std::optional<std::size_t> entries_field = tiff.field(directory, entries_tag);
  if (!count_field || !entries_field) refuse_index(path, "it lists no pictures");
  const std::uint32_t count = tiff.long_at(*count_field + 8);
  if (count == 0 || count > most_pictures) refuse_index(path, fmt::format("it lists {} pictures", count));
  if (tiff.long_at(*entries_field + 4) != count * entry_size) refuse_index(path, "length mismatch");

  const std::size_t list = tiff.long_at(*entries_field + 8);
  std::vector<MultiPictureEntry> entries(count);
  for (std::size_t i = 0; i < count; ++i) {
    entries[i] = read_entry(tiff, list + i * entry_size, *index, bytes, path);
    for (std::size_t before = 0; before < i; ++before)
      if (entries[before].begin == entries[i].begin) refuse_index(path, "it lists one picture twice");
    if (entries[i].begin == 0) {
      const std::size_t attributes = tiff.next_directory(directory);
      if (attributes != 0) entries[i].number = individual_number(tiff, attributes);
      continue;
    }
    // The other pictures tell their number in an index of their own, which has no list.
    const std::optional<FoundIndex> own = find_index(bytes.substr(entries[i].begin, entries[i].length));
    if (!own) continue;
    const TiffBytes own_tiff(own->bytes, path);
    entries[i].number = individual_number(own_tiff, own_tiff.long_at(4));
  }
  return entries;
}

namespace {

void put(std::string& bytes, std::uint32_t number, int length) {
  for (int i = length - 1; i >= 0; --i) bytes += static_cast<char>(number >> (8 * i));
}

void put_field(std::string& bytes, std::uint16_t tag, std::uint16_t type, std::uint32_t count, std::uint32_t value) {
  put(bytes, tag, 2);
  put(bytes, type, 2);
  put(bytes, count, 4);
  put(bytes, value, 4);
}

constexpr std::uint16_t type_long = 4, type_undefined = 7;
constexpr std::uint32_t version = 0x30313030;  // "0100"
constexpr std::uint32_t header_size = 8;

/// Version, number and base viewpoint of one picture: DC-007, sec. 5.2.4. The first's version stands in its index.
void put_attributes(std::string& bytes, std::uint32_t number, bool with_version) {
  constexpr std::uint16_t version_tag = 0xB000, base_viewpoint_tag = 0xB204;
  put(bytes, with_version ? 3 : 2, 2);
  if (with_version) put_field(bytes, version_tag, type_undefined, 4, version);
  put_field(bytes, individual_number_tag, type_long, 1, number);
  put_field(bytes, base_viewpoint_tag, type_long, 1, 1);
  put(bytes, 0, 4);
}

std::string segment_of(const std::string& tiff) { return jpeg_segment(app2, std::string(signature) + tiff); }

std::string big_endian_header() {
  std::string tiff("MM\0\x2A", 4);
  put(tiff, header_size, 4);
  return tiff;
}

std::string index_tiff(std::span<const MultiPictureEntry> entries, std::size_t index_begin) {
  constexpr std::uint32_t representative = 1U << 29;
  constexpr std::uint32_t fields = 3;
  const auto list = static_cast<std::uint32_t>(header_size + 2 + fields * field_size + 4);
  const auto list_size = static_cast<std::uint32_t>(entries.size() * entry_size);
  std::string tiff = big_endian_header();
  put(tiff, fields, 2);
  put_field(tiff, 0xB000, type_undefined, 4, version);
  put_field(tiff, number_of_pictures_tag, type_long, 1, static_cast<std::uint32_t>(entries.size()));
  put_field(tiff, entries_tag, type_undefined, list_size, list);
  put(tiff, list + list_size, 4);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    put(tiff, multi_picture_disparity | (i == 0 ? representative : 0), 4);
    put(tiff, static_cast<std::uint32_t>(entries[i].length), 4);
    put(tiff, i == 0 ? 0 : static_cast<std::uint32_t>(entries[i].begin - index_begin), 4);
    put(tiff, 0, 4);
  }
  put_attributes(tiff, 1, false);
  return tiff;
}

}  // namespace

std::string join_multi_pictures(std::span<const std::string> jpegs) {
  const std::size_t place = end_of_first_segments(jpegs.front());
  const std::size_t index_begin = place + 4 + signature.size();
  std::vector<MultiPictureEntry> entries(jpegs.size());
  entries[0].length = jpegs[0].size() + segment_of(index_tiff(entries, index_begin)).size();
  std::string others;
  for (std::size_t i = 1; i < jpegs.size(); ++i) {
    std::string tiff = big_endian_header();
    put_attributes(tiff, static_cast<std::uint32_t>(i + 1), true);
    std::string jpeg = jpegs[i];
    jpeg.insert(end_of_first_segments(jpeg), segment_of(tiff));
    entries[i].begin = entries[0].length + others.size();
    entries[i].length = jpeg.size();
    others += jpeg;
  }
  std::string first = jpegs.front();
  first.insert(place, segment_of(index_tiff(entries, index_begin)));
  return first + others;
}

}  // namespace wheatstone
