// The process around the command line: its signals, its standard output, and OpenCV, which must not speak up.

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <optional>
#include <string>
#include <vector>

#include "interrupt.h"
#include "run.h"
#include "wheatstone/app/process_memory.h"
#include "wheatstone/ranks/launch.h"

namespace {

// OpenCV prints what it throws, and warns of plug-ins that it does not find; here an error is one line of ours.
void silence_opencv() {
  cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

/// Of the processes of mpirun only the first speaks.
void silence_unless_first() {
  const std::optional<wheatstone::Launch> launch = wheatstone::mpi_launch();
  if (!launch || launch->rank == 0) return;
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  ::close(nowhere);
}

}  // namespace

int main(int argc, char** argv) {
  silence_unless_first();
  wheatstone::use_huge_pages();
  // Results wait until the progress bar is gone, which would share their line.
  std::setvbuf(stdout, nullptr, _IOFBF, 1 << 16);
  std::cerr.tie(nullptr);
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  const bool json = std::ranges::find(arguments, "--json") != arguments.end();
  wheatstone::cli::end_in_one_line(json);
  return wheatstone::cli::run_command_line(arguments, std::cout, std::cerr, wheatstone::cli::style_for_standard_error(),
                                           [] {
                                             wheatstone::cli::watch_signals();
                                             silence_opencv();
                                           });
}
