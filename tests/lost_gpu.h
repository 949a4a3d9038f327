#pragma once

#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace wheatstone {

/// In this process, the graphics processor that the processor imitates passes for a real one from now on, and is lost
/// when it has finished some work that many times. To be called before it is first used.
inline void pass_for_real_and_be_lost_after(int works) {
  static auto* const driver = reinterpret_cast<const GLubyte* (*)(GLenum)>(eglGetProcAddress("glGetString"));
  static int left = 0;
  left = works;
  // Through these pointers epoxy calls the driver.
  epoxy_glGetString = [](GLenum what) {
    return what == GL_RENDERER ? reinterpret_cast<const GLubyte*>("of a test") : driver(what);
  };
  epoxy_glGetGraphicsResetStatus = []() -> GLenum { return left-- > 0 ? GL_NO_ERROR : GL_UNKNOWN_CONTEXT_RESET; };
}

}  // namespace wheatstone
