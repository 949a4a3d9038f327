#include "wheatstone/gpu/gpu.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <array>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

[[noreturn]] void fail(const std::string& why) {
  throw Error(ErrorKind::wrong_usage, fmt::format("graphics processor: {}; --device cpu works without one", why));
}

std::string text_of(GLenum what) {
  const GLubyte* const text = glGetString(what);
  return text != nullptr ? reinterpret_cast<const char*>(text) : "unnamed";
}

/// A context of OpenGL on one of EGL's displays.
struct Context {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  GpuFacts facts;
};

void make_current(const Context& context) {
  if (eglMakeCurrent(context.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context) != EGL_TRUE)
    fail("the driver refuses a context without a window (EGL_KHR_surfaceless_context)");
}

void release(const Context& context) {
  eglMakeCurrent(context.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

GpuFacts facts_of_current() {
  GpuFacts facts{.name = text_of(GL_RENDERER), .version = text_of(GL_VERSION)};
  for (const std::string_view imitator : {"llvmpipe", "softpipe", "SWR"})
    facts.imitated = facts.imitated || facts.name.find(imitator) != std::string::npos;
  GLint64 bytes = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  facts.largest_buffer = static_cast<std::size_t>(bytes);
  GLint texels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  facts.most_texels = static_cast<std::size_t>(texels);
  return facts;
}

/// A context of OpenGL 4.5 on a display, or why there is none.
std::optional<Context> context_on(EGLDisplay display, std::string& why_not) {
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) return std::nullopt;
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
    why_not = "the driver has no OpenGL, only OpenGL ES";
    return std::nullopt;
  }
  constexpr std::array attributes{EGL_CONTEXT_MAJOR_VERSION,
                                  4,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  5,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                  EGL_LOSE_CONTEXT_ON_RESET,
                                  EGL_NONE};
  Context context{.display = display};
  context.context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
  if (context.context == EGL_NO_CONTEXT) {
    why_not = "the driver has no OpenGL 4.5";
    return std::nullopt;
  }
  make_current(context);
  context.facts = facts_of_current();
  release(context);
  return context;
}

/// The displays that need no window: each graphics processor's own, and Mesa's.
std::vector<EGLDisplay> displays_without_window() {
  std::vector<EGLDisplay> displays;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(devices.size(), devices.data(), &count) == EGL_TRUE)
      for (EGLint i = 0; i < count; ++i)
        displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  return displays;
}

/// The context of this process, made on first use and kept to its end.
class SharedContext {
 public:
  static SharedContext& instance() {
    static SharedContext shared;
    return shared;
  }

  /// The context, with the turn of the caller.
  const Context& take(std::unique_lock<std::mutex>& turn) {
    turn = std::unique_lock(mutex_);
    if (!looked_) find();
    looked_ = true;
    if (!context_) fail(why_not_);
    return *context_;
  }

 private:
  void find() {
    // epoxy ends the program where the library of EGL is missing.
    if (!epoxy_has_egl()) return;
    for (const EGLDisplay display : displays_without_window()) {
      std::optional<Context> found = context_on(display, why_not_);
      if (!found || (context_ && found->facts.imitated)) continue;
      context_ = std::move(found);
      if (!context_->facts.imitated) return;
    }
  }

  std::mutex mutex_;
  bool looked_ = false;
  std::optional<Context> context_;
  std::string why_not_ = "none was found (EGL has no display that needs no window)";
};

void check_state() {
  if (epoxy_has_gl_extension("GL_KHR_robustness") && glGetGraphicsResetStatus() != GL_NO_ERROR)
    fail("the driver lost its state, and the work with it");
  switch (const GLenum error = glGetError()) {
    case GL_NO_ERROR:
      return;
    case GL_OUT_OF_MEMORY:
      fail("its memory does not suffice");
    default:
      fail(fmt::format("the driver reports error {:#06x}", error));
  }
}

}  // namespace

GpuFacts gpu_facts() {
  std::unique_lock<std::mutex> turn;
  return SharedContext::instance().take(turn).facts;
}

bool has_real_gpu() {
  try {
    return !gpu_facts().imitated;
  } catch (const Error&) {
    return false;
  }
}

bool chooses_gpu(Device device, bool worthwhile) {
  if (device != Device::automatic) return device == Device::graphics;
  return worthwhile && has_real_gpu();
}

namespace {

/// What why_left_by_gpu() tells.
struct LeftWork {
  std::mutex mutex;
  std::string why;
};

LeftWork& left_work() {
  static LeftWork left;
  return left;
}

}  // namespace

std::string why_left_by_gpu() {
  const std::lock_guard lock(left_work().mutex);
  return std::exchange(left_work().why, {});
}

bool done_on_gpu(Device device, const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const Error& error) {
    if (device != Device::automatic || error.kind() != ErrorKind::wrong_usage) throw;
    const std::lock_guard lock(left_work().mutex);
    if (left_work().why.empty()) left_work().why = error.what();
    return false;
  }
}

void on_gpu(const std::function<void(const GpuFacts&)>& work) {
  std::unique_lock<std::mutex> turn;
  const Context& context = SharedContext::instance().take(turn);
  make_current(context);
  try {
    work(context.facts);
    check_state();
  } catch (...) {
    release(context);
    throw;
  }
  release(context);
}

void for_each_view(std::size_t views, const std::function<void(std::size_t view)>& work) {
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, views, work); });
}

}  // namespace wheatstone
