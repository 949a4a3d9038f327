#pragma once

#include <filesystem>
#include <string_view>

#include "wheatstone/particles/cloud_source.h"

namespace wheatstone {

// One for each format. Each throws Error{bad_input} as open_cloud does.
CloudSource open_hdf5_cloud(const std::filesystem::path& path, const CloudChoice& choice);
CloudSource open_gadget_binary(const std::filesystem::path& path, const CloudChoice& choice);
CloudSource open_ply(const std::filesystem::path& path, const CloudChoice& choice);
CloudSource open_las(const std::filesystem::path& path, const CloudChoice& choice);
CloudSource open_npy(const std::filesystem::path& path, const CloudChoice& choice);
CloudSource open_npz(const std::filesystem::path& path, const CloudChoice& choice);
CloudSource open_fits(const std::filesystem::path& path, const CloudChoice& choice);
CloudSource open_text_table(const std::filesystem::path& path, const CloudChoice& choice);

/// Whether a file that begins with these bytes is a GADGET binary snapshot, format 1 or 2, of either byte order.
bool looks_like_gadget_binary(std::string_view first_bytes);

}  // namespace wheatstone
