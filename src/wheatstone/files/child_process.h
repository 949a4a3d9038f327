#pragma once

#include <string>
#include <vector>

namespace wheatstone {

/// A program that this one started and waits for.
class ChildProcess {
 public:
  /// Starts it; the first word is its file, or a name that is looked for where the shell looks. It gets SIGTERM when
  /// the thread that starts it ends, be it because this program was killed. Throws Error{cannot_read_write}.
  explicit ChildProcess(std::vector<std::string> words);

  /// Waits for its end and returns its status as waitpid does.
  int wait() const;
  /// Sends it a signal.
  void signal(int number) const;

 private:
  int process_ = 0;
};

}  // namespace wheatstone
