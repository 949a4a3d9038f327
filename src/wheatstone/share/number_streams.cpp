#include <utility>

#include "wheatstone/files/deflate.h"
#include "wheatstone/share/number_streams_internal.h"

namespace wheatstone {

PagePart part_of_streams(std::string name, std::span<const NumberStream> streams) {
  constexpr int smallest = 9;
  std::vector<std::uint8_t> bytes;
  const auto add_number = [&bytes](std::size_t number) {
    for (int byte = 0; byte < 4; ++byte) bytes.push_back(static_cast<std::uint8_t>(number >> (8 * byte)));
  };
  add_number(streams.size());
  for (const NumberStream& stream : streams) add_number(stream.bytes().size());
  for (const NumberStream& stream : streams) bytes.insert(bytes.end(), stream.bytes().begin(), stream.bytes().end());
  return {std::move(name), deflated(bytes, smallest)};
}

}  // namespace wheatstone
