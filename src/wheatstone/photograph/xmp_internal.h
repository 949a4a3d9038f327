#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace wheatstone {

/// The XMP of a JPEG: its packet, and what did not fit into it (XMP specification, part 3, sec. 1.1.3).
struct Xmp {
  std::string packet, extended;
};

/// Reads the XMP of a JPEG; empty where there is none. `path` stands for it in messages. Throws Error{bad_input} where
/// the extended part that the packet names is not whole.
Xmp read_xmp(std::string_view jpeg, const std::filesystem::path& path);

/// The text of a property, as "GDepth:Format", that stands as an attribute or as an element; none where there is none.
std::optional<std::string_view> xmp_property(std::string_view text, std::string_view name);
std::optional<std::string_view> xmp_property(const Xmp& xmp, std::string_view name);

/// The bytes that base64 text stands for (RFC 4648); white space and character references to it are passed over. None
/// where it is not base64.
std::optional<std::string> decode_base64(std::string_view text);

}  // namespace wheatstone
