#pragma once

#include <cstddef>
#include <string>

namespace wheatstone {

/// Throws std::bad_alloc where this process may not use so many bytes of addresses more (ulimit -v). Asked before
/// libraries are called that crash, or write on standard error, where memory is short.
void require_address_space(std::size_t bytes);

/// A function of a module: code that stands apart from the program with the libraries that it needs, so that a run
/// without need of it does not wait for them to load. `module` is its name without lib and .so; it is looked for where
/// the program's own libraries are (its run path, then the system's), is loaded at the first call and stays. Its
/// libraries and what they begin with take `address_space_bytes`. Throws Error{cannot_read_write} where it is missing,
/// cannot be loaded or is of another version, std::bad_alloc where there is too little memory.
void* function_of_module(const std::string& module, const std::string& function, std::size_t address_space_bytes);

}  // namespace wheatstone
