#pragma once

#include <cstddef>

namespace wheatstone {

/// Throws std::bad_alloc where this process may not use so many bytes of addresses more (ulimit -v). Asked before
/// libraries are called that crash, or write on standard error, where memory is short.
void require_address_space(std::size_t bytes);

}  // namespace wheatstone
