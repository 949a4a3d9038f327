#include "wheatstone/files/child_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <chrono>
#include <thread>

#include "temporary_folder.h"
#include "throws_error.h"

namespace wheatstone::child_process_test {

TEST(ChildProcess, HandsItsStatusOn) {
  EXPECT_EQ(WEXITSTATUS(ChildProcess({"sh", "-c", "exit 7"}).wait()), 7);
  const ChildProcess sleeping({"sleep", "60"});
  sleeping.signal(SIGTERM);
  EXPECT_EQ(WTERMSIG(sleeping.wait()), SIGTERM);
}

TEST(ChildProcess, ThatCannotBeStartedIsAnError) {
  expect_error(ErrorKind::cannot_read_write, "/nowhere/program: cannot be started: No such file",
               [] { ChildProcess({"/nowhere/program"}); });
}

/// Whether a process is there and has not ended.
bool is_running(int process) {
  const std::string status = bytes_of("/proc/" + std::to_string(process) + "/stat");
  return !status.empty() && status.find(") Z ") == std::string::npos;
}

TEST(ChildProcess, EndsWithAParentThatIsKilled) {
  const TemporaryFolder folder;
  const std::string file = folder / "process";
  const pid_t parent = ::fork();
  if (parent == 0) {
    ChildProcess({"sh", "-c", "echo $$ >'" + file + ".new'; mv '" + file + ".new' '" + file + "'; exec sleep 60"})
        .wait();
    ::_exit(0);
  }
  for (int tries = 0; tries < 500 && bytes_of(file).empty(); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const int child = std::stoi(bytes_of(file));
  EXPECT_TRUE(is_running(child));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  for (int tries = 0; tries < 100 && is_running(child); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(is_running(child));
  ::kill(child, SIGKILL);
}

}  // namespace wheatstone::child_process_test
