#include "wheatstone/display/looking_glass_bridge.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

constexpr auto library_name = "libbridge_inproc.so";

// Functions of the library that are used, with C linkage.
using Initialize = bool(const char* program);
using Uninitialize = bool();
using GetDisplays = bool(int* count, unsigned long* numbers);
using GetRedIndex = bool(unsigned long display, int* index);  // of a pixel's sub-pixels from left to right: 0 or 2
using GetCalibration = bool(unsigned long display, float* center, float* pitch, float* slope, int* width, int* height,
                            float* dpi, float* flip_x, int* inverted_views, float* view_cone, float* fringe,
                            int* cell_pattern, int* cell_count, void* cells);

[[noreturn]] void fail(std::string_view why) {
  throw Error(ErrorKind::cannot_read_write, fmt::format("Looking Glass Bridge {}", why));
}

template <class Function>
Function* function_of(void* library, const char* name) {
  void* const found = dlsym(library, name);
  if (found == nullptr) fail(fmt::format("has no function {}", name));
  return reinterpret_cast<Function*>(found);
}

/// 2.10 is newer than 2.9.
std::vector<int> numbers_of(const std::string& version) {
  std::vector<int> numbers(1, 0);
  for (const char letter : version) {
    if (letter == '.') {
      numbers.push_back(0);
    } else if (letter >= '0' && letter <= '9') {
      numbers.back() = std::min(numbers.back(), 99999) * 10 + (letter - '0');
    }
  }
  return numbers;
}

LenticularScreen calibration_of(void* library, unsigned long display) {
  float center = 0, pitch = 0, slope = 0, dpi = 0, flip_x = 0, view_cone = 0, fringe = 0;
  int width = 0, height = 0, inverted_views = 0, cell_pattern = 0, cell_count = 0, red_index = 0;
  if (!function_of<GetCalibration>(library, "get_calibration_for_display")(
          display, &center, &pitch, &slope, &width, &height, &dpi, &flip_x, &inverted_views, &view_cone, &fringe,
          &cell_pattern, &cell_count, nullptr))
    fail("does not tell the display's calibration");
  function_of<GetRedIndex>(library, "get_ri_for_display")(display, &red_index);
  return {.width = width,
          .height = height,
          .pitch = pitch,
          .slope = slope,
          .center = center,
          .dpi = dpi,
          .flip = flip_x != 0,
          .blue_first = red_index == 2,
          .first_from_left = inverted_views == 0};
}

}  // namespace

std::filesystem::path bridge_library() {
  const char* const home = std::getenv("HOME");
  const std::filesystem::path settings =
      std::filesystem::path(home != nullptr ? home : "") / ".lgf/Bridge/settings.json";
  std::error_code error;
  if (!std::filesystem::exists(settings, error)) return library_name;
  constexpr std::size_t most_bytes = 1 << 20;
  const nlohmann::json json = nlohmann::json::parse(read_whole_file(settings, most_bytes), nullptr, false);
  if (!json.is_object() || !json.contains("install_locations")) return library_name;
  std::vector<int> newest;
  std::filesystem::path library = library_name;
  for (const nlohmann::json& place : json["install_locations"]) {
    if (!place.is_object() || !place.contains("path") || !place["path"].is_string()) continue;
    const std::vector<int> version = numbers_of(place.contains("version") ? place["version"].dump() : std::string());
    if (version < newest) continue;
    newest = version;
    library = std::filesystem::path(place["path"].get<std::string>()) / library_name;
  }
  return library;
}

LenticularScreen calibration_from_bridge(const std::filesystem::path& path) {
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (library == nullptr) fail(fmt::format("cannot be loaded: {}", dlerror()));
  if (!function_of<Initialize>(library, "initialize_bridge")("Wheatstone")) fail("cannot be initialised");
  int count = 0;
  auto* const get_displays = function_of<GetDisplays>(library, "get_displays");
  get_displays(&count, nullptr);
  constexpr int most_displays = 64;
  std::array<unsigned long, most_displays> numbers{};
  if (count < 1 || count > most_displays || !get_displays(&count, numbers.data()))
    fail("finds no Looking Glass display");
  const LenticularScreen screen = calibration_of(library, numbers.front());
  function_of<Uninitialize>(library, "uninitialize_bridge")();
  return screen;
}

std::string calibration_text(const LenticularScreen& screen) {
  const nlohmann::ordered_json json{
      {"screenW", screen.width},   {"screenH", screen.height},      {"pitch", screen.pitch},
      {"slope", screen.slope},     {"center", screen.center},       {"DPI", screen.dpi},
      {"flipImageX", screen.flip}, {"flipSubp", screen.blue_first}, {"invView", !screen.first_from_left}};
  return json.dump(2) + '\n';
}

}  // namespace wheatstone
