#pragma once

#include <stdexcept>
#include <string>

namespace wheatstone {

/// Why a run ended; the value is the exit code of the command line.
enum class ErrorKind {
  wrong_usage = 2,        ///< an option, or a combination of options, that makes no sense
  bad_input = 3,          ///< a file or picture that cannot be used for what was asked
  cannot_read_write = 4,  ///< the system refused: no such folder, no permission, disk full, pipe closed
  interrupted = 5,        ///< the user asked to stop
};

/// The one exception that leaves the library. Its message is one line, without a final full stop, and names the file
/// or option, what is wrong with it and what was expected: "left.png: 3x2 pixels, expected at least 16x16".
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace wheatstone
