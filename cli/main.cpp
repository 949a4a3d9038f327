#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "interrupt.h"
#include "program.h"
#include "progress_display.h"
#include "wheatstone/error.h"

namespace wheatstone::cli {
namespace {

constexpr int unforeseen = 1;

int code_of(ErrorKind kind) { return static_cast<int>(kind); }

/// Says on one line what went wrong and hands the exit code on.
int fail(int code, std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::fputs(fmt::format("wheatstone: {}\n", message).c_str(), stderr);
  return code;
}

// OpenCV prints what it throws, and warns of plug-ins that it does not find; here an error is one line of ours.
void silence_opencv() {
  cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

/// What is wrong with the line, and where to read on.
std::string usage_message(const CLI::App& program, const CLI::ParseError& error) {
  const auto commands = program.get_subcommands();
  const std::string hint = commands.empty() ? "see 'wheatstone --help'"
                                            : fmt::format("see 'wheatstone {} --help'", commands.front()->get_name());
  const std::string found = error.what();
  if (dynamic_cast<const CLI::ConfigError*>(&error) != nullptr) {
    return fmt::format("--config: unknown option '{}' in the file; {}", found.substr(found.rfind(' ') + 1), hint);
  }
  if (commands.empty() && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    const std::vector<std::string> words = program.remaining();
    return words.empty() ? fmt::format("no command given; {}", hint)
                         : fmt::format("{}: no such command; {}", words.front(), hint);
  }
  return fmt::format("{}; {}", found, hint);
}

/// A result must reach its reader: a full disk or a closed pipe behind standard output is an error.
int check_output(int code) {
  std::cout.flush();
  if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    return fail(code_of(ErrorKind::cannot_read_write), "standard output: cannot write");
  }
  return code;
}

int run(int argc, const char* const* argv) {
  SharedOptions options;
  std::optional<ProgressDisplay> display;
  std::optional<tbb::global_control> thread_limit;
  const std::unique_ptr<CLI::App> program = make_program(options);
  // Runs when the whole line is understood and before the command does.
  program->parse_complete_callback([&] {
    Session& session = options.session;
    display.emplace(session.quiet ? ProgressDisplay::Style::none : style_for_standard_error());
    session.progress = [&display](std::string_view step, double done) {
      throw_if_interrupted();
      display->show(step, done);
    };
    if (session.threads > 0) {
      thread_limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(session.threads));
      cv::setNumThreads(session.threads);
    }
  });

  try {
    program->parse(argc, argv);
    throw_if_interrupted();
    return 0;
  } catch (const CLI::ParseError& error) {
    const bool asked_for_help = error.get_exit_code() == 0;
    if (asked_for_help) return program->exit(error);
    const bool missing_file = dynamic_cast<const CLI::FileError*>(&error) != nullptr;
    return fail(code_of(missing_file ? ErrorKind::bad_input : ErrorKind::wrong_usage), usage_message(*program, error));
  } catch (const Error& error) {
    display.reset();
    return fail(code_of(error.kind()), error.what());
  }
}

/// What no one planned for still ends in one line.
int run_guarded(int argc, const char* const* argv) {
  try {
    return check_output(run(argc, argv));
  } catch (const std::bad_alloc&) {
    return fail(code_of(ErrorKind::cannot_read_write), "not enough memory");
  } catch (const cv::Exception& error) {
    if (error.code == cv::Error::StsNoMem) {
      return fail(code_of(ErrorKind::cannot_read_write), "not enough memory");
    }
    return fail(unforeseen, fmt::format("unforeseen error in OpenCV: {} ({})", error.err, error.func));
  } catch (const std::system_error& error) {
    return fail(code_of(ErrorKind::cannot_read_write), error.what());
  } catch (const std::exception& error) {
    return fail(unforeseen, fmt::format("unforeseen error: {}", error.what()));
  }
}

}  // namespace
}  // namespace wheatstone::cli

int main(int argc, char** argv) {
  // Results wait until the progress bar is gone, which would share their line.
  std::setvbuf(stdout, nullptr, _IOFBF, 1 << 16);
  wheatstone::cli::watch_signals();
  wheatstone::cli::silence_opencv();
  return wheatstone::cli::run_guarded(argc, argv);
}
