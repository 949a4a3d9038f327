#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "wheatstone/motion/flow.h"

namespace wheatstone {

/// Reads a flow as Middlebury's .flo files hold it. Values beyond 10⁹, with which they mark the unknown, become NaN.
/// Throws Error{bad_input} where the file is missing, damaged or of another kind.
Flow read_flow(const std::filesystem::path& path);

/// The same of bytes; `name` stands for the file in messages.
Flow decode_flow(std::string_view bytes, std::string_view name);

/// Writes a .flo file, under a temporary name first. Throws Error{cannot_read_write}.
void write_flow(const std::filesystem::path& path, const Flow& flow);

}  // namespace wheatstone
