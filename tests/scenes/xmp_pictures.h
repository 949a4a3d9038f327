#pragma once

// JPEGs with XMP for tests: Google's depth maps and VR photographs.

#include <algorithm>
#include <string>
#include <string_view>

namespace wheatstone {

inline std::string base64_of(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

inline std::string number_bytes(std::size_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xFF);
  return bytes;
}

inline std::string app1_segment(const std::string& data) {
  const std::size_t length = data.size() + 2;
  return std::string("\xFF\xE1") + static_cast<char>(length >> 8) + static_cast<char>(length & 0xFF) + data;
}

inline std::string packet_segment(const std::string& attributes, const std::string& elements = "") {
  return app1_segment(std::string("http://ns.adobe.com/xap/1.0/\0", 29) +
                      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF><rdf:Description rdf:about=\"\" " + attributes +
                      ">" + elements + "</rdf:Description></rdf:RDF></x:xmpmeta>");
}

constexpr std::string_view extended_guid = "0123456789ABCDEF0123456789ABCDEF";

/// What does not fit into a packet, in chunks of this many bytes.
inline std::string extended_segments(const std::string& text, std::size_t chunk_size = 60000) {
  std::string segments;
  for (std::size_t at = 0; at < text.size(); at += chunk_size)
    segments += app1_segment(std::string("http://ns.adobe.com/xmp/extension/\0", 35) + std::string(extended_guid) +
                             number_bytes(text.size()) + number_bytes(at) + text.substr(at, chunk_size));
  return segments;
}

/// A JPEG with these segments at its start.
inline std::string with_segments(const std::string& jpeg, const std::string& segments) {
  return jpeg.substr(0, 2) + segments + jpeg.substr(2);
}

/// A JPEG whose XMP holds `name` with the bytes of another picture, in its extended part; `attributes` stand in the
/// packet.
inline std::string with_extended_data(const std::string& jpeg, const std::string& attributes, const std::string& name,
                                      std::string_view bytes, std::size_t chunk_size = 60000) {
  const std::string extended = "<rdf:Description " + name + "=\"" + base64_of(bytes) + "\"/>";
  return with_segments(jpeg,
                       packet_segment(attributes + " xmpNote:HasExtendedXMP=\"" + std::string(extended_guid) + "\"") +
                           extended_segments(extended, chunk_size));
}

}  // namespace wheatstone
