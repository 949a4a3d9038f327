#include "failure.h"

#include <fmt/format.h>

#include <new>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone::cli {
namespace {

constexpr int internal_error = 1;

bool is_for_lack_of_memory(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return true;
  if (const auto* const system = dynamic_cast<const std::system_error*>(&error))
    return system->code() == std::errc::not_enough_memory ||
           system->code() == std::errc::resource_unavailable_try_again;
  if (const auto* const opencv = dynamic_cast<const cv::Exception*>(&error)) return opencv->code == cv::Error::StsNoMem;
  // TBB's words for a thread that cannot be started.
  return std::string_view(error.what()).starts_with("pthread_create has failed");
}

Ranks::Failure failure_with(ErrorKind kind, std::string message) {
  return {static_cast<int>(kind), std::move(message)};
}

}  // namespace

Ranks::Failure failure_of(const std::exception_ptr& thrown) {
  Ranks::Failure lack_of_memory = failure_with(ErrorKind::cannot_read_write, "not enough memory");
  if (!thrown) return lack_of_memory;
  try {
    std::rethrow_exception(thrown);
  } catch (const Error& error) {
    return failure_with(error.kind(), error.what());
  } catch (const std::exception& error) {
    if (is_for_lack_of_memory(error)) return lack_of_memory;
    if (const auto* const opencv = dynamic_cast<const cv::Exception*>(&error))
      return {internal_error, fmt::format("internal error in OpenCV: {} ({})", opencv->err, opencv->func)};
    if (dynamic_cast<const std::system_error*>(&error) != nullptr)
      return failure_with(ErrorKind::cannot_read_write, error.what());
    return {internal_error, fmt::format("internal error: {}", error.what())};
  } catch (...) {
    return {internal_error, "internal error"};
  }
}

}  // namespace wheatstone::cli
