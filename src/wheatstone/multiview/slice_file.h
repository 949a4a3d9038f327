#pragma once

#include <filesystem>

#include "wheatstone/files/temporary_file.h"
#include "wheatstone/multiview/slice_stack.h"

namespace wheatstone {

/// Writes slices as a multi-part OpenEXR, half float, RGBA, one part a slice with its data window cropped to what is
/// not empty and the view as its display window; parallax, span, exposure and viewing geometry are attributes of the
/// parts
/// (`wheatstone:parallax_px` …, docs/slices.md). Light beyond what a half float holds is limited to it. Appears only
/// when it is whole. Throws Error{cannot_read_write}.
void write_slices(const std::filesystem::path& path, const SliceStack& stack);

/// The same into a file that the caller commits, together with other results. Throws Error{cannot_read_write}.
void write_slices(const TemporaryFile& file, const SliceStack& stack);

/// Whether a file is an OpenEXR whose header has our attributes; not where it cannot be read.
bool holds_slices(const std::filesystem::path& path);

/// Throws Error{bad_input} where the file is no OpenEXR, is cut short, lacks our attributes, or would not fit in
/// memory.
SliceStack read_slices(const std::filesystem::path& path);

}  // namespace wheatstone
